"""Reading results: expressions in brackets and in lists; everything else is explained by the results' own names."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    InverseDynamics,
    Matrix,
    Motion,
    Point,
    Runs,
    System,
    Vector,
    functions_of_time,
    ground,
    inverse_dynamics,
    newton_euler,
    number,
    simulate,
    simulate_many,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ArgumentError, ParameterError, SimulationError

m, k, absent = symbols("m k absent")
x, y = functions_of_time("x y")
MASS = Body(translate(x, 0, 0), m)
SPRING = newton_euler(
    System([MASS], [Force(ground, -k * x, 0, 0, at=MASS.center_of_mass, on=MASS)], coordinates=[x])
)
POINT, VECTOR = Point(ground, x, 0, 0, name="P"), Vector(ground, x, 0, 0, name="v")
INSTANTS = [0.0, 0.5, 1.0]

MOTION = simulate(SPRING, {m: 1, k: 2}, {x: 1}, INSTANTS)
RUNS = simulate_many(SPRING, {m: 1, k: [1, 2]}, {x: 1}, INSTANTS, outputs={"place": x})
DRIVEN = inverse_dynamics(SPRING, {x: t**2}, {m: 1, k: 2}, INSTANTS)

Readable = Motion | Runs | InverseDynamics

RESULTS: dict[str, Readable] = {"motion": MOTION, "runs": RUNS, "result": DRIVEN}

ROWS = {
    "motion": (
        "motion.t has the instants, motion.states a row for each of them, and motion.state_at(0) is the state at the "
        "first"
    ),
    "runs": (
        "runs.motion(0) is the motion of the first case, runs.states has the states of all of them: cases x instants "
        "x state"
    ),
    "result": (
        "result.t has the instants, and result.coordinates, result.speeds and result.accelerations have a row for each"
    ),
}

INDICES: list[object] = [0, -1, 1.5, True, np.int64(2), slice(0, 2)]
"""What looks like the index of a row; a number was taken as an expression, which is constant."""

STRANGE: list[tuple[object, str]] = [
    ("x", "'x' is a str; expected an expression, such as {name}[x]"),
    (None, "None; expected an expression, such as {name}[x]"),
    (MASS, f"{MASS!r} is a Body; expected an expression, such as {{name}}[x]"),
    (
        [x],
        "[x] is a list; expected an expression, such as {name}[x]; for several expressions: {name}.evaluate([...])",
    ),
    (
        (x, k),
        "(x, k) is a tuple; expected an expression, such as {name}[x]; for several expressions: {name}.evaluate([...])",
    ),
    (
        Matrix([[x, k]]),
        (
            "Matrix([[x, k]]) is a Matrix; expected an expression, such as {name}[x]; its entries are expressions: "
            "{name}.evaluate([*matrix])"
        ),
    ),
    (
        POINT,
        (
            "P is a Point; expected an expression, such as {name}[x]; its coordinates in a frame are expressions: "
            "{name}.evaluate(point.projected(frame).coordinates)"
        ),
    ),
    (
        VECTOR,
        (
            "v is a Vector; expected an expression, such as {name}[x]; its components in a frame are expressions: "
            "{name}.evaluate(vector.projected(frame).components)"
        ),
    ),
]

STRANGE_LISTS: list[tuple[object, str]] = [
    (
        x,
        "x is one expression; expected a list of expressions, such as {name}.evaluate([x]); for one of them {name}[x]",
    ),
    ("x", "'x' is a str; expected a list of expressions"),
    (5, "5 is an int; expected a list of expressions"),
    (
        {"place": x},
        (
            "{{'place': x}} is a dict; expected a list of expressions, such as its values: "
            "{name}.evaluate([*expressions.values()])"
        ),
    ),
    (
        POINT,
        (
            "P is a Point; expected a list of expressions; its coordinates in a frame are expressions: "
            "{name}.evaluate(point.projected(frame).coordinates)"
        ),
    ),
    (
        [x, VECTOR],
        (
            "v is a Vector; expected expressions in the list; its components in a frame are expressions: "
            "{name}.evaluate(vector.projected(frame).components)"
        ),
    ),
    (
        [x, "x"],
        "'x' is a str; expected an expression or a number (int, float, Fraction, NumPy scalar); parse converts it",
    ),
    ([[x]], "[x] is a list; expected an expression or a number (int, float, Fraction, NumPy scalar)"),
]


def error_text(call: Callable[[], object]) -> str:
    with pytest.raises(ArgumentError) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize("name", RESULTS)
@pytest.mark.parametrize("index", INDICES)
def test_numbers_are_no_expressions_here(name: str, index: Any) -> None:
    message = error_text(lambda: RESULTS[name][index])
    kind = type(index).__name__
    article = "an" if kind.startswith("i") else "a"
    assert message == (
        f"{name}[...]: {index!r} is {article} {kind}; expected an expression, such as {name}[x]; {ROWS[name]}"
    )


@pytest.mark.parametrize("name", RESULTS)
@pytest.mark.parametrize("through", [list, iter, reversed, lambda result: [*zip(result, [1], strict=False)]])
def test_no_loop_goes_on_for_ever(name: str, through: Callable[[object], object]) -> None:
    message = error_text(lambda: list(through(RESULTS[name])))  # type: ignore[call-overload]
    assert message.startswith(f"{name}")
    assert message.endswith(ROWS[name])


@pytest.mark.parametrize("name", RESULTS)
@pytest.mark.parametrize(("asked", "message"), STRANGE)
def test_what_is_no_expression(name: str, asked: Any, message: str) -> None:
    assert error_text(lambda: RESULTS[name][asked]) == f"{name}[...]: {message.format(name=name)}"


@pytest.mark.parametrize("name", RESULTS)
@pytest.mark.parametrize(("asked", "message"), STRANGE_LISTS)
def test_what_is_no_list_of_expressions(name: str, asked: Any, message: str) -> None:
    assert (
        error_text(lambda: RESULTS[name].evaluate(asked)) == f"{name}.evaluate: {message.format(name=name)}"
    )


@pytest.mark.parametrize("name", RESULTS)
def test_one_and_several_agree(name: str) -> None:
    result = RESULTS[name]
    wanted = [x, k * x + t, number(2), time_derivative(x, 2)]
    for several in (wanted, tuple(wanted), Matrix([wanted]), np.array(wanted, dtype=object), iter(wanted)):
        values = result.evaluate(several)  # type: ignore[arg-type]
        assert np.array_equal(values, np.stack([result[one] for one in wanted]))
    assert result.evaluate([]).shape == (0, *result[x].shape)
    assert np.array_equal(result.evaluate([1, x]), np.stack([np.ones_like(result[x]), result[x]]))


def test_runs_evaluate_what_is_among_the_outputs_without_states() -> None:
    outputs = {"place": x, "pull": -k * x}
    runs = simulate_many(SPRING, {m: 1, k: [1, 2]}, {x: 1}, INSTANTS, outputs=outputs, keep_states=False)
    assert np.array_equal(runs.evaluate([-k * x, x]), [runs.outputs["pull"], runs.outputs["place"]])
    with pytest.raises(ArgumentError, match="the states of these motions were not kept"):
        runs.evaluate([x, x**2])


@pytest.mark.parametrize("read", [lambda asked: RUNS[asked], lambda asked: RUNS.evaluate([x, asked])])
def test_runs_name_what_has_no_values(read: Callable[[object], object]) -> None:
    with pytest.raises(
        SimulationError, match=r"^runs: no values of y; this motion has values of time, the coo"
    ):
        read(y)
    with pytest.raises(ParameterError) as caught:
        read(absent * x)
    assert str(caught.value) == (
        "runs: absent has no value in this motion; give it with the parameters of simulate_many"
    )


@pytest.mark.parametrize(("instant", "what"), [(3, "3 is an int"), (-4, "-4 is an int"), (x, "x is an Expr")])
def test_states_at_instants_that_there_are_not(instant: Any, what: str) -> None:
    assert error_text(lambda: MOTION.state_at(instant)) == (
        f"motion.state_at: {what}; expected the index of one of the 3 instants, from 0"
    )
    assert MOTION.state_at(-3) == {x: 1.0, time_derivative(x): 0.0}
