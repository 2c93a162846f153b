"""No message prints a large thing in full: frames, points, bodies, loads and expressions are cut."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import pytest

from symbody import (
    Body,
    Force,
    Frame,
    ModelNotice,
    Point,
    SymbodyError,
    Vector,
    functions_of_time,
    ground,
    identity,
    kinetic_energy,
    lambdify,
    moving_frame,
    newton_equations,
    rotate,
    solve,
    symbols,
    translate,
)
from symbody.symbolic.given.arguments import brief
from tests.errors import given, test_codegen, test_geometry, test_models, test_symbolic
from tests.errors.dynamics import test_equations, test_formalism, test_reaction
from tests.errors.multibody import (
    test_body,
    test_constraint,
    test_element,
    test_joint,
    test_kinematics,
    test_mechanism,
    test_state,
    test_system,
    test_tire,
)
from tests.errors.simulation import test_other_equations

TABLES = (
    test_symbolic,
    test_codegen,
    test_geometry,
    test_models,
    test_body,
    test_constraint,
    test_element,
    test_joint,
    test_kinematics,
    test_mechanism,
    test_state,
    test_system,
    test_tire,
    test_equations,
    test_formalism,
    test_reaction,
    test_other_equations,
)
"""The files whose mistakes are written with the names of `given.py`."""
SHOWN = 80
"""Characters that a message spends on one thing."""

long_sum = sum(symbols(f"stiffness_{n}") * symbols(f"length_{n}") for n in range(40))
x, y = functions_of_time("x y")
long_frame: Frame = ground
for n in range(6):
    place = symbols(f"along_{n} across_{n} height_{n}")
    long_frame = long_frame * translate(*place) * rotate("Z", functions_of_time(f"angle_of_the_joint_{n}"))
long_body = Body(long_frame * translate(x, y, 0), long_sum)
long_point = Point(long_body.frame, long_sum, x, y)
LONG = {
    "m": long_sum,
    "a": long_sum,
    "b": 2 * long_sum,
    "F": long_sum,
    "body": long_body,
    "other": Body(long_frame, long_sum),
    "G": long_point,
    "push": Force(ground, long_sum, 0, 0, at=long_point, on=long_body),
    "vehicle": moving_frame(long_sum, 0, 0, 0, 0, long_sum),
    "natural": Frame([[long_sum, -y, 0, 0], [y, long_sum, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
}

MISTAKES = [
    *((mistake, message) for table in TABLES for _, mistake, message in table.MISTAKES),
    (lambda: long_sum / (long_sum - long_sum), ""),
    (lambda: float(long_sum), ""),
    (lambda: lambdify([long_sum], long_sum), ""),
    (lambda: solve([long_sum * x**2 - 1], [x]), ""),
    (lambda: long_sum.diff(long_sum), ""),
    (lambda: long_sum * "a text that is no expression", ""),
    (lambda: kinetic_energy([long_body, [long_frame] * 50]), ""),
    (lambda: rotate("W" * 1000, x), ""),
    (lambda: rotate((long_sum, x, y), x), ""),
    (lambda: Point([long_frame] * 50, 0, 0, 0), ""),
]


@pytest.mark.parametrize(("mistake", "usual"), MISTAKES)
def test_no_message_prints_a_large_thing(
    mistake: Callable[[], object], usual: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each mistake of these tables again, with names that hold large things."""
    for name, thing in LONG.items():
        for file in (given, *TABLES):
            if hasattr(file, name):
                monkeypatch.setattr(file, name, thing)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises((SymbodyError, TypeError)) as caught:
            mistake()
    assert len(str(caught.value)) <= max(len(usual), 200) + 3 * SHOWN, str(caught.value)


def test_no_notice_prints_a_large_thing() -> None:
    for mistake in (
        lambda: newton_equations([Body(ground, 1), LONG["push"]]),
        lambda: rotate("Z", long_sum + 90),
        lambda: Body(long_frame, long_sum, 1, 1, 5),
    ):
        with pytest.warns(ModelNotice) as notices:
            mistake()
        assert len(notices) == 1
        assert len(str(notices[0].message)) <= 200 + 2 * SHOWN


def test_frames_are_called_by_what_makes_them() -> None:
    assert str(translate(x, 0, 0) * rotate("Z", y)) == 'translate(x, 0, 0) * rotate("Z", y)'
    assert str(translate(x, 0, 0).named("T") * rotate((0.6, 0, 0.8), y)) == "T * rotate((0.6, 0, 0.8), y)"
    assert str(moving_frame(x, 0, 0, 0, 0, 0, name="car") * rotate("X", y)) == 'car * rotate("X", y)'
    assert str(Frame(identity(4))) == "ground"
    assert repr(Vector(translate(1, 2, 3), x, 0, 0)) == "Vector(translate(1, 2, 3), x, 0, 0)"


def test_what_is_long_is_cut_in_the_middle() -> None:
    assert len(brief(long_frame)) == SHOWN
    assert brief(long_frame).startswith("translate(along_0, across_0, height_0) * rotate(")
    assert brief(long_frame).endswith('"Z", angle_of_the_joint_5)')
    assert brief("short") == "short"
