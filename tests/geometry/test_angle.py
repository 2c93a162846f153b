"""Doubles in angles: those that stand for multiples of pi are these, others that look like mistakes are reported."""

from __future__ import annotations

import math
import warnings
from random import Random

import numpy as np
import pytest
import sympy
from numpy.typing import NDArray

from symbody import (
    Expr,
    Frame,
    ModelNotice,
    cos,
    cost,
    functions_of_time,
    ground,
    newton_euler,
    number,
    parse,
    pi,
    rotate,
    sin,
    sqrt,
    symbols,
    tan,
    translate,
)
from symbody.errors import FrameError
from symbody.symbolic import identity
from tests.reference import robot as reference

q, psi = functions_of_time("q psi")
a = symbols("a")

MULTIPLES = [
    (math.pi / 2, pi / 2),
    (-math.pi / 4, -pi / 4),
    (2 * math.pi / 3, 2 * pi / 3),
    (3 * (math.pi / 6), pi / 2),
    (math.radians(90), pi / 2),
    (math.radians(45) * 3, 3 * pi / 4),
    (math.radians(7), 7 * pi / 180),
    (math.radians(22.5), pi / 8),
    (math.pi / 11, pi / 11),
    (math.pi - math.pi / 3, 2 * pi / 3),
    (math.acos(0), pi / 2),
    (math.atan(1), pi / 4),
    (5 * math.pi, 5 * pi),
    (1000 * math.pi, 1000 * pi),
    (361 * math.pi / 2, 361 * pi / 2),
    (1e5 * math.pi, 100_000 * pi),
    (np.pi / 2, pi / 2),
    (np.float64(math.pi), pi),
    (np.array(math.pi), pi),
    (number(math.pi) / 2, pi / 2),
]


@pytest.mark.parametrize(("double", "exact"), MULTIPLES)
@pytest.mark.parametrize("axis", ["X", (1, 0, 0), (0.6, 0.8, 0)])
def test_the_double_next_to_a_multiple_of_pi_is_that_multiple(double: float, exact: Expr, axis: str) -> None:
    assert rotate(axis, double) == rotate(axis, exact)
    assert rotate(axis, q + double) == rotate(axis, q + exact)
    assert rotate(axis, q).subs({q: double}) == rotate(axis, exact)
    assert rotate(axis, q - psi).subs({psi: double}) == rotate(axis, q - exact)


def test_sines_take_angles() -> None:
    assert sin(q + math.pi / 2).same_form(cos(q))
    assert tan(q + math.radians(45)).same_form(tan(q + pi / 4))
    assert sin(q + psi).subs({psi: math.pi / 2}).same_form(cos(q))
    assert cos(2 * (q + math.pi / 8)) == cos(2 * q + pi / 4)
    assert cos(psi + (q + math.pi / 2)) == -sin(psi + q)


def test_what_is_no_angle_keeps_its_digits() -> None:
    """Lengths hold decimals, and the sine of a number alone is data; so do angles that are other numbers."""
    assert parse("sin(3.141592653589793)") == sin(math.pi) == sin(q).subs({q: math.pi}) != 0
    assert translate(math.pi, 0, 0) != translate(pi, 0, 0)
    assert sin(q + math.pi / 2 + 1e-12) != cos(q)
    for angle in (0.3, 1.5, 1.6, 0.1, 2.0, 3.0, 1e-9, 0.12345, 355, 5.0):
        assert sin(q + angle) == parse(f"sin(q(t) + {angle})")


def test_doubles_of_axes_are_the_roots_that_they_stand_for() -> None:
    for axis, exact in (
        ((1 / math.sqrt(2), 0, 1 / math.sqrt(2)), (sqrt(2) / 2, 0, sqrt(2) / 2)),
        ((-1 / math.sqrt(3),) * 3, (-sqrt(3) / 3,) * 3),
        (np.array([1, -2, 3]) / np.sqrt(14), (sqrt(14) / 14, -sqrt(14) / 7, 3 * sqrt(14) / 14)),
        ((0.6, 0.8, 0), (number(3) / 5, number(4) / 5, 0)),
        ((math.cos(math.radians(10)), math.sin(math.radians(10)), 0), (cos(pi / 18), sin(pi / 18), 0)),
    ):
        frame = rotate(tuple(axis), q)
        assert frame == rotate(exact, q)
        assert frame.matrix[:3, :3] @ frame.matrix[:3, :3].T == identity(3)


@pytest.mark.parametrize("degrees", [7, 10, 22.5, 36, 90, -123.5])
def test_a_matrix_of_doubles_is_turned_by_degrees(degrees: float) -> None:
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turned = Frame([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert turned == rotate("Z", math.radians(degrees))


def test_the_panda_by_doubles_takes_as_few_operations(monkeypatch: pytest.MonkeyPatch) -> None:
    def by_doubles(joint: dict[str, list[list[float]]], coordinate: Expr | None) -> Frame:
        r = joint["R"]
        about_x = round(math.atan2(r[2][1], r[1][1]) / (math.pi / 2)) * math.pi / 2
        about_z = math.atan2(r[1][0], r[0][0])
        placed = translate(*joint["xyz"]) * rotate("Z", about_z) * rotate("X", about_x)  # type: ignore[arg-type]
        return placed if coordinate is None else placed * rotate(tuple(joint["axis"]), coordinate)  # type: ignore[arg-type]

    monkeypatch.setattr(reference, "_joint_frame", by_doubles)
    panda = reference.robot_on(ground, (), "panda_7dof").system
    assert cost(newton_euler(panda).residuals).total == 562


NEARLY = [
    (1.5708, "1.5708 is within 3.7e-06 of pi/2; write pi/2 with symbody.pi if that is meant"),
    (3.1416, "3.1416 is within 7.3e-06 of pi; write pi with symbody.pi if that is meant"),
    (3.1415, "3.1415 is within 9.3e-05 of pi; write pi with symbody.pi if that is meant"),
    (-0.7854, "-0.7854 is within 1.8e-06 of -pi/4; write -pi/4 with symbody.pi if that is meant"),
    (1.57, "1.57 is within 0.0008 of pi/2; write pi/2 with symbody.pi if that is meant"),
    (6.2832, "6.2832 is within 1.5e-05 of 2*pi; write 2*pi with symbody.pi if that is meant"),
    (
        np.float32(math.pi / 2),
        "1.5707964 is within 4.4e-08 of pi/2; write pi/2 with symbody.pi if that is meant",
    ),
    (
        q + 1.5708,
        "q + 1.5708 holds 1.5708, which is within 3.7e-06 of pi/2; write pi/2 with symbody.pi if that is meant",
    ),
    (90, "90 is more than a full turn; angles are in radians: write math.radians(90) if degrees are meant"),
    (
        -45.0,
        "-45.0 is more than a full turn; angles are in radians: write math.radians(-45.0) if degrees are meant",
    ),
    (
        q - 90,
        (
            "q - 90 holds -90, which is more than a full turn; angles are in radians: write math.radians(-90) if "
            "degrees are meant"
        ),
    ),
]


@pytest.mark.parametrize(("angle", "message"), NEARLY)
@pytest.mark.parametrize("axis", ["Z", (0.6, 0, 0.8)])
def test_what_looks_like_a_mistake_has_one_notice(angle: Expr, message: str, axis: str) -> None:
    with pytest.warns(ModelNotice) as notices:
        rotate(axis, angle)
    assert [str(notice.message) for notice in notices] == [f"rotate: angle = {message}"]
    assert notices[0].filename == __file__


@pytest.mark.parametrize("axis", ["Z", (0.6, 0, 0.8)])
def test_angles_put_in_a_frame_have_the_notice_of_rotate(axis: str) -> None:
    for given, message in (
        (
            90,
            "90 is more than a full turn; angles are in radians: write math.radians(90) if degrees are meant",
        ),
        (1.5708, "1.5708 is within 3.7e-06 of pi/2; write pi/2 with symbody.pi if that is meant"),
    ):
        with pytest.warns(ModelNotice) as notices:
            (rotate(axis, a) * translate(1, 0, 0)).subs({a: given})
        assert [str(notice.message) for notice in notices] == [f"subs: angle = {message}"]
        assert notices[0].filename == __file__
    with pytest.warns(ModelNotice, match="rotate: angle"):
        noticed = rotate(axis, 90 + a)
    noticed.subs({q: 1})
    noticed.subs({a: psi})


def test_ordinary_angles_have_no_notice() -> None:
    """Of the numbers with three decimals, one in 180 has the digits of a multiple of pi at most."""
    noticed = []
    for thousandths in range(1, 6284):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            rotate("Z", thousandths / 1000)
        noticed += [thousandths] * len(caught)
    assert len(noticed) <= 34
    for quiet in (4 * pi, 90 * pi / 180, 0.1, 0.5, 1.5, 3.15, 0.79, 1.6, 6, a, 90 * q, math.radians(720)):
        rotate("Z", quiet)


@pytest.mark.parametrize("angle", [3.57, 3.74, 6.01, 1.45, 0.449, 0.725, 2.142])
def test_a_measured_angle_beside_an_odd_fraction_of_pi_has_no_notice(angle: float) -> None:
    rotate("X", angle)


@pytest.mark.parametrize("angle", [1.57, 3.14, 3.1416, 0.7854, 1.0472, 0.5236, 2.0944, 0.2618, 6.28, -4.712])
def test_the_digits_of_a_common_angle_have_a_notice(angle: float) -> None:
    with pytest.warns(ModelNotice, match="write .*pi.* with symbody.pi if that is meant"):
        rotate("X", angle)


def test_a_matrix_that_is_made_orthonormal_says_so() -> None:
    c, s = round(math.cos(0.3), 8), round(math.sin(0.3), 8)
    with pytest.warns(ModelNotice) as notices:
        frame = Frame([[c, -s, 0, 1], [s, c, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])
    assert [str(notice.message) for notice in notices] == [
        (
            "Frame: the rotation part is off a right-handed orthonormal triad by 3.64e-09, more than rounding of "
            "doubles explains; it was replaced by the nearest rotation, which changes entries by up to 1.74e-09; give "
            "all digits, or build the frame with translate and rotate"
        )
    ]
    assert frame.matrix[:3, :3] @ frame.matrix[:3, :3].T == identity(3)


def _turned(yaw: float, pitch: float, roll: float) -> NDArray[np.float64]:
    """Return Rz Ry Rx, in numbers."""
    (a, b), (c, d), (e, f) = ((math.cos(angle), math.sin(angle)) for angle in (yaw, pitch, roll))
    z = np.array([[a, -b, 0], [b, a, 0], [0, 0, 1]])
    y = np.array([[c, 0, d], [0, 1, 0], [-d, 0, c]])
    return z @ y @ np.array([[1, 0, 0], [0, e, -f], [0, f, e]])


def _frame_of(rotation: NDArray[np.float64]) -> Frame:
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    return Frame(matrix.tolist())


def _rotation_of(frame: Frame) -> NDArray[np.float64]:
    return np.array([[float(entry) for entry in row] for row in frame.matrix[:3, :3].tolist()])


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("below", [0, 1e-15, 1e-13, 3e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4])
def test_a_pitch_near_a_right_angle_keeps_the_matrix(side: int, below: float) -> None:
    """Yaw and roll are nearly one rotation there, and rounding must not choose both of them."""
    random = Random(11)
    for _ in range(20):
        given = _turned(random.uniform(-3, 3), side * (math.pi / 2 - below), random.uniform(-3, 3))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            difference = abs(_rotation_of(_frame_of(given)) - given).max()
        assert difference < (2e-15 if below > 1e-12 else 2e-12), "within 1e-12 it is a right angle"


@pytest.mark.parametrize("noise", [1e-7, 1e-8, 1e-10, 3e-12])
def test_noise_of_a_matrix_does_not_turn_it(noise: float) -> None:
    """The frame is the nearest rotation, and the notice says how far it is from what was given."""
    random = np.random.default_rng(3)
    for pitch in (math.pi / 2, -math.pi / 2, 0.4):
        for _ in range(20):
            given = _turned(*random.uniform(-3, 3, 1), pitch, *random.uniform(-3, 3, 1))
            given += random.uniform(-noise, noise, (3, 3))
            with pytest.warns(ModelNotice, match="replaced by the nearest rotation") as notices:
                found = _rotation_of(_frame_of(given))
            difference = abs(found - given).max()
            u, _, v = np.linalg.svd(given)
            assert abs(found - u @ v).max() < 3e-12
            assert difference < 3 * noise
            assert f"changes entries by up to {difference:.3g};" in str(notices[0].message)


def test_single_precision_at_a_right_angle_is_the_same_orientation() -> None:
    given = np.array([[2e-8, -0.4794255, 0.8775826], [1e-8, 0.8775826, 0.4794255], [-1, 1e-8, -1e-8]])
    with pytest.warns(ModelNotice, match="replaced by the nearest rotation"):
        assert abs(_rotation_of(_frame_of(given)) - given).max() < 1e-7


def test_angles_of_a_matrix_are_printed_with_the_digits_they_were_made_of() -> None:
    given = [
        [float(e) for e in row]
        for row in (rotate("Z", 0.3) * rotate("Y", 0.5) * rotate("X", -0.7)).matrix.tolist()
    ]
    assert str(Frame(given)) == 'rotate("Z", 0.3) * rotate("Y", 0.5) * rotate("X", -0.7)'


def test_matrices_of_doubles_and_exact_ones_say_nothing() -> None:
    for angle in (0.3, 1.0, 2.5):
        frame = rotate("Z", angle) * rotate("Y", 0.7) * rotate("X", -1.1)
        Frame([[float(entry) for entry in row] for row in frame.matrix.tolist()])
    Frame([[cos(q), -sin(q), 0, a], [sin(q), cos(q), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    Frame([[0.6, -0.8, 0, 0], [0.8, 0.6, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


@pytest.mark.parametrize("degrees", [90, -90, 45, 180, 20])
def test_a_matrix_of_symbols_and_doubles_is_a_rotation(degrees: float) -> None:
    """Denavit and Hartenberg's matrix: a turn about z by q, then about x by a number."""
    twist = math.radians(degrees)
    c, s, u, v = cos(q), sin(q), math.cos(twist), math.sin(twist)
    link = Frame([[c, -s * u, s * v, a * c], [s, c * u, -c * v, a * s], [0, v, u, 0.3], [0, 0, 0, 1]])
    assert link.is_rigid
    assert link.matrix == (rotate("Z", q) * translate(a, 0, 0.3) * rotate("X", twist)).matrix


def test_a_matrix_of_natural_coordinates_keeps_its_numbers() -> None:
    rows = [[q, -psi, 6.1e-17, 0], [psi, q, 0, 0], [0, 0, 1.0, 0], [0, 0, 0, 1]]
    assert Frame(rows).matrix.tolist() == rows
    assert not Frame(rows).is_rigid


def test_an_axis_that_is_made_a_unit_vector_says_so() -> None:
    with pytest.warns(ModelNotice) as notices:
        assert rotate((0.70710678, 0, 0.70710678), q) == rotate((sqrt(2) / 2, 0, sqrt(2) / 2), q)
    assert [str(notice.message) for notice in notices] == [
        (
            "rotate: the axis (0.70710678, 0, 0.70710678) is off length 1 by 1.68e-09, more than rounding of doubles "
            "explains; it was divided by its length"
        )
    ]


def test_what_is_no_angle_and_no_axis() -> None:
    wanted = "expected an expression, such as symbols('a'), or a finite number"
    for mistake, message in (
        (
            lambda: rotate("X", sympy.pi / 2),
            f"rotate: angle = pi/2 is a Mul; {wanted}; from_sympy converts it",
        ),
        (lambda: rotate("X", "1/2"), f"rotate: angle = '1/2' is a str; {wanted}"),  # type: ignore[arg-type]
        (lambda: translate("1", 0, 0), f"translate: x = '1' is a str; {wanted}"),  # type: ignore[arg-type]
        (
            lambda: rotate(["0", "0.6", "0.8"], q),  # type: ignore[list-item]
            "rotate: in axis, '0' is a str; expected 'X', 'Y', 'Z', a unit triple or a Vector",
        ),
    ):
        with pytest.raises(FrameError) as caught:
            mistake()
        assert str(caught.value) == message
