"""Mistakes with linear models: their whole messages."""

from __future__ import annotations

import sys
from collections.abc import Callable

import pytest

from symbody import (
    Abs,
    Body,
    Constraint,
    Force,
    StateSpace,
    SymbodyError,
    System,
    Vector,
    equations_of,
    errors,
    functions_of_time,
    ground,
    hamilton,
    linearize,
    newton_euler,
    pi,
    rotate,
    sign,
    sin,
    sqrt,
    state_space,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.models import rolling_disc
from tests.errors.given import check

x, y, theta, w, F = functions_of_time("x y theta w F")
m, l, g, k, c, V, theta0 = symbols("m l g k c V theta0")
dx = time_derivative(x)

BOB = Body(rotate("Y", theta) * translate(0, 0, l), m)
PENDULUM = newton_euler(System([BOB], coordinates=[theta], gravity=Vector(ground, 0, 0, g)))
CART = Body(translate(x, 0, 0), m)
PUSH = Force(ground, F - k * x, 0, 0, at=CART.center_of_mass, on=CART)
OSCILLATOR = newton_euler(System([CART], [PUSH], coordinates=[x]))
BELT = newton_euler(
    System(
        [CART],
        [Force(ground, -k * (x - w) - c * (dx - time_derivative(w)), 0, 0, at=CART.center_of_mass, on=CART)],
        coordinates=[x],
    )
)
BEAD = Body(translate(x, y, 0), m)
CIRCLE = newton_euler(
    System(
        [BEAD],
        coordinates=[x, y],
        constraints=[Constraint(x**2 + y**2 - l**2, "bar")],
        gravity=Vector(ground, 0, -g, 0),
    )
)
DISC = rolling_disc()
TURN = {DISC["theta"]: theta0, **{time_derivative(DISC[name]): V for name in ("psi", "phi")}}


def space(**options: object) -> StateSpace:
    return state_space(linearize(OSCILLATOR, **options), {m: 1, k: 1})  # type: ignore[arg-type]


MISTAKES: dict[str, tuple[Callable[[], object], type[SymbodyError], str]] = {
    "a position that is none of rest": (
        lambda: linearize(PENDULUM, {theta: pi / 3}),
        errors.ModelError,
        (
            "linearize: the values in about are no steady motion: the equation of motion of theta' is off by "
            "sqrt(3)*g*l*m/2; give the values of an equilibrium or of a steady motion, as numbers or as "
            "symbols of your own, such as about={theta: theta0}, and the inputs that belong to it"
        ),
    ),
    "a number that is none of rest": (
        lambda: linearize(equations_of([[1]], [1 - x], [x]), {x: 0.5}),
        errors.ModelError,
        (
            "linearize: the values in about are no steady motion: the equation of motion of x' is off by "
            "-0.5; give the values of an equilibrium or of a steady motion, as numbers or as symbols of your "
            "own, such as about={theta: theta0}, and the inputs that belong to it"
        ),
    ),
    "a position off the constraints": (
        lambda: linearize(CIRCLE, {x: 2 * l}),
        errors.ModelError,
        (
            "linearize: the values in about are no steady motion: constraint 1, bar, x**2 + y**2 - l**2 = 0, "
            "is off by 3*l**2; give the values of an equilibrium or of a steady motion, as numbers or as "
            "symbols of your own, such as about={theta: theta0}, and the inputs that belong to it"
        ),
    ),
    "a state that changes": (
        lambda: linearize(equations_of([[1]], [-x], [x], states={y: 1 - y})),
        errors.ModelError,
        (
            "linearize: the values in about are no steady motion: the rate of the state y is off by 1; give "
            "the values of an equilibrium or of a steady motion, as numbers or as symbols of your own, such "
            "as about={theta: theta0}, and the inputs that belong to it"
        ),
    ),
    "parameters that don't belong to the position": (
        lambda: state_space(linearize(PENDULUM, {theta: theta0}), {m: 1, g: 1, l: 1, theta0: 0.3}),
        errors.ModelError,
        (
            "state_space: the values in about are no steady motion with these parameters: the equation of "
            "motion of theta' is off by 0.29552; find the values by equilibrium or steady with the same "
            "parameters"
        ),
    ),
    "a motion through positions that differ": (
        lambda: linearize(PENDULUM, {time_derivative(theta): V}),
        errors.ModelError,
        (
            "linearize: the motion is not steady: the equation of motion of theta' is off by "
            "g*l*m*sin(theta), which changes with theta; expected values in about with which it vanishes at "
            "all times, or speeds in axes that turn with the motion, as those of moving_frame"
        ),
    ),
    "a load that changes in time": (
        lambda: linearize(equations_of([[1]], [sin(t) - x], [x])),
        errors.ModelError,
        (
            "linearize: the motion is not steady: the equation of motion of x' is off by -sin(t), which "
            "changes with t; expected values in about with which it vanishes at all times, or speeds in axes "
            "that turn with the motion, as those of moving_frame"
        ),
    ),
    "a coefficient that changes in time": (
        lambda: linearize(equations_of([[1]], [-x * sin(t)], [x])),
        errors.ModelError,
        (
            "linearize: the linear equations about this motion don't have constant coefficients: that of x'' "
            "is -sin(t), and t changes along the motion; expected a steady motion, or coordinates in which "
            "its equations don't change, such as those of a frame that moves with it"
        ),
    ),
    "ignorable coordinates that move along others": (
        lambda: linearize(newton_euler(DISC.system), TURN),
        errors.ModelError,
        (
            "linearize: the linear equations about this motion don't have constant coefficients: that of x' "
            "is -r*V*sin(psi), and psi changes along the motion; nothing else depends on x, y, psi, phi: pass"
            " keep_ignorable=False to leave them out"
        ),
    ),
    "an unknown coordinate in about": (
        lambda: linearize(PENDULUM, {functions_of_time("thta"): 0}),
        errors.ModelError,
        (
            "linearize, about: thta is not a coordinate, a rate of one, a speed, a state or an input of these"
            " equations; did you mean theta or theta'?"
        ),
    ),
    "a name in about": (
        lambda: linearize(PENDULUM, {"theta": 0}),
        errors.ModelError,
        (
            "linearize: in about, 'theta' is a str; expected a dictionary of variables and their values, such"
            " as {theta: 0}"
        ),
    ),
    "a parameter in about": (
        lambda: linearize(PENDULUM, {m: 0}),
        errors.ModelError,
        (
            "linearize, about: m is not a coordinate, a rate of one, a speed, a state or an input of these "
            "equations; expected one of theta, theta'"
        ),
    ),
    "a value with a coordinate": (
        lambda: linearize(CIRCLE, {x: y}),
        errors.ModelError,
        (
            "linearize, about: the value of x holds y, a variable of the equations; expected a number, or an "
            "expression of parameters and t"
        ),
    ),
    "a value that is nothing": (
        lambda: linearize(CIRCLE, {x: None}),
        errors.ArgumentError,
        (
            "linearize, about, x: None; expected an expression or a number (int, float, Fraction, NumPy "
            "scalar)"
        ),
    ),
    "about that is a list": (
        lambda: linearize(CIRCLE, [x]),  # type: ignore[arg-type]
        errors.ModelError,
        (
            "linearize: about = [x] is a list; expected a dictionary of variables and their values, such as "
            "{theta: 0}"
        ),
    ),
    "a system in place of equations": (
        lambda: linearize(System([CART], coordinates=[x])),  # type: ignore[arg-type]
        errors.ModelError,
        (
            "linearize: eqs = System(1 body, 0 loads, 1 coordinate) is a System; expected equations of "
            "motion, such as newton_euler(system)"
        ),
    ),
    "canonical equations": (
        lambda: linearize(hamilton(System([CART], coordinates=[x]))),  # type: ignore[arg-type]
        errors.ModelError,
        (
            "linearize: eqs = CanonicalEquations(x, p_x) is a CanonicalEquations; expected equations of "
            "motion, such as newton_euler(system)"
        ),
    ),
    "an input that is no variable": (
        lambda: linearize(OSCILLATOR, inputs=[F**2]),
        errors.ModelError,
        (
            "linearize, inputs: F**2 is neither an input nor a parameter of these equations; expected some of"
            " F, k, m"
        ),
    ),
    "a coordinate as an input": (
        lambda: linearize(OSCILLATOR, inputs=[x]),
        errors.ModelError,
        (
            "linearize, inputs: x is neither an input nor a parameter of these equations; expected some of F,"
            " k, m"
        ),
    ),
    "an input twice": (
        lambda: linearize(OSCILLATOR, inputs=[F, F]),
        errors.ModelError,
        ("linearize, inputs: F is given twice, or follows from an earlier one; give it once"),
    ),
    "a text as an output": (
        lambda: linearize(OSCILLATOR, outputs={"a": "x"}),
        errors.ModelError,
        (
            "linearize, outputs, a: 'x' is a str; expected an expression, a vector, a matrix or a list of "
            "expressions"
        ),
    ),
    "an output of an unknown variable": (
        lambda: linearize(OSCILLATOR, outputs=[2 * w]),
        errors.ModelError,
        (
            "linearize, outputs: 2*w holds w, which is not a variable of these equations; expected an "
            "expression of coordinates, speeds, accelerations, multipliers, states, inputs and parameters"
        ),
    ),
    "independent variables that determine nothing": (
        lambda: linearize(CIRCLE, {y: -l}, independent=[y]),
        errors.ConstraintError,
        (
            "linearize, independent: the constraints don't determine x by the others; choose other "
            "independent coordinates or speeds, or leave independent out"
        ),
    ),
    "too many independent variables": (
        lambda: linearize(CIRCLE, {y: -l}, independent=[x, y]),
        errors.ConstraintError,
        ("linearize, independent: 2 of x, y, with 1 independent constraint; expected at most 1 of them"),
    ),
    "an unknown independent variable": (
        lambda: linearize(CIRCLE, {y: -l}, independent=[theta]),
        errors.ModelError,
        (
            "linearize, independent: theta is neither a coordinate nor a speed of these equations; expected "
            "some of x, y, x', y'"
        ),
    ),
    "a singular position": (
        lambda: linearize(newton_euler(System([BEAD], coordinates=[x, y], constraints=[x * y]))),
        errors.ConstraintError,
        (
            "linearize: the position is singular: there, 0 of 1 independent constraints restrain x, y "
            "independently; expected a position beside it, about which motions are those of a linear system"
        ),
    ),
    "a law that is not defined": (
        lambda: linearize(equations_of([[1, 0], [0, 1]], [-x / sqrt(x**2 + y**2), -y], [x, y])),
        errors.ModelError,
        (
            "linearize: the equations, or their derivatives, are not defined in this motion: 1 is divided by "
            "an expression that is identically zero; check the divisor: its terms cancel, or a substitution "
            "makes it zero; expected another motion in about, or laws that are defined there: a slip needs a "
            "speed, a spring a length"
        ),
    ),
    "dry friction at rest": (
        lambda: linearize(equations_of([[1]], [-x - c * sign(dx)], [x])),
        errors.ModelError,
        (
            "linearize: sign(x') has no derivative in this motion, where it changes its branch; expected a "
            "motion in which it doesn't, or a smooth law, such as tanh(u/u0) for sign(u)"
        ),
    ),
    "a modulus at its kink": (
        lambda: linearize(equations_of([[1]], [-x - Abs(x)], [x])),
        errors.ModelError,
        (
            "linearize: Abs(x) has no derivative in this motion, where it changes its branch; expected a "
            "motion in which it doesn't, or a smooth law, such as tanh(u/u0) for sign(u)"
        ),
    ),
    "no form of second order": (
        lambda: linearize(equations_of([[1]], [-y], [x], states={y: x - y})).M,
        errors.ModelError,
        (
            "Linear: the equations have no form M q'' + C q' + K q = F r: forces depend on states beside the "
            "mechanics; expected a use of E, A0 and B0, or of A and B, of first order"
        ),
    ),
    "a mass matrix that is singular": (
        lambda: linearize(equations_of([[m, m], [m, m]], [-x, -y], [x, y])).A,
        errors.ModelError,
        (
            "Linear: the mass matrix is singular: a combination of x', y' moves no mass; give it some, or "
            "leave a coordinate out, or use E, A0 and B0"
        ),
    ),
    "parameters without mass": (
        lambda: state_space(linearize(OSCILLATOR), {m: 0, k: 1}),
        errors.ModelError,
        (
            "state_space: E of E x' = A0 x + B0 r is singular with these parameters: the speeds x', or a "
            "combination of them, move no mass; give it some, or use modes(linear, parameters), which finds "
            "the eigenvalues of E and A0"
        ),
    ),
    "a part that depends on others": (
        lambda: linearize(OSCILLATOR).part([x]),
        errors.ModelError,
        (
            "Linear.part: the rate of x depends on x'; expected states on which the others have no influence:"
            " name that one, too, or leave the first one out"
        ),
    ),
    "a part of something else": (
        lambda: linearize(OSCILLATOR).part([y]),
        errors.ModelError,
        ("Linear.part: y is not a state; expected some of x, x'"),
    ),
    "a missing value": (
        lambda: state_space(linearize(OSCILLATOR), {m: 1}),
        errors.ParameterError,
        ("state_space: no value for k; give parameters={k: ...}"),
    ),
    "a value that is not finite": (
        lambda: state_space(linearize(OSCILLATOR), {m: 1, k: float("nan")}),
        errors.ParameterError,
        ("state_space, parameters: k is not finite; expected finite numbers"),
    ),
    "values of different shapes": (
        lambda: state_space(linearize(OSCILLATOR), {m: [1, 2, 3], k: [1, 2]}),
        errors.ParameterError,
        (
            "state_space, parameters: the shapes of the values don't broadcast: k of (2,), m of (3,); "
            "expected a number for each parameter, or arrays of one shape"
        ),
    ),
    "an export of many": (
        lambda: state_space(linearize(OSCILLATOR), {m: 1, k: [1, 2]}).to_matlab(),
        errors.ParameterError,
        (
            "StateSpace.to_matlab: the matrices are those of 2 parameter sets; expected one number for each "
            "parameter in state_space(linear, parameters)"
        ),
    ),
    "an input whose rate is another one than that of its course": (
        lambda: linearize(BELT, {w: V * t, time_derivative(w): 2 * V}),
        errors.ModelError,
        (
            "linearize, about: the values of w and w' contradict each other: the rate of V*t is V, not 2*V; leave the "
            "rate out"
        ),
    ),
    "a rate of an input with a course, and the input without": (
        lambda: linearize(BELT, {time_derivative(w): V * t}),
        errors.ModelError,
        ("linearize, about: w' has the course V*t, and w has none; expected that of w, whose rates follow"),
    ),
    "an input that moves, on which a force depends": (
        lambda: linearize(OSCILLATOR, {F: 0, x: 0, time_derivative(F): V}),
        errors.ModelError,
        (
            "linearize, about: F' is not a coordinate, a rate of one, a speed, a state or an input of these "
            "equations; did you mean F?"
        ),
    ),
    "a value that is not a number": (
        lambda: linearize(PENDULUM, {theta: float("nan")}),
        errors.ModelError,
        ("linearize, about: theta is nan; expected a finite number, or an expression"),
    ),
    "an export without inputs": (
        lambda: space(inputs=[]).to_scipy(),
        errors.ModelError,
        (
            "StateSpace.to_scipy: the linear model has no inputs; expected some: give the system functions of"
            " time as inputs, or pass parameters as linearize(equations, inputs=[...])"
        ),
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_message(name: str) -> None:
    mistake, kind, message = MISTAKES[name]
    check(kind, mistake, message)


def test_python_control_that_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(errors.ModelError) as raised:
        space().to_control()
    assert str(raised.value) == (
        "StateSpace.to_control: python-control is not installed; install it with pip install control, or use "
        "to_scipy() or to_matlab()"
    )
