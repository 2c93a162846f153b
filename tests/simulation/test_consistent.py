"""Consistent states: constraints hold, what is given stays, the rest changes least; what can't be is reported."""

import numpy as np
import pytest
from scipy.optimize import minimize

from symbody import (
    Body,
    System,
    floating_frame,
    functions_of_time,
    lambdify,
    moving_frame,
    newton_euler,
    rotate,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelError, ParameterError
from symbody.simulation.constraint.consistent import consistent_state
from tests.simulation.linkages import double_pendulum, fourbar, hanging_box, pendulum_on_rail, slider_crank
from tests.simulation.singular_mechanisms import cranks

LINKAGES = {
    "fourbar": (fourbar, {"qA": 0.3}, {"qA'": 2.0}),
    "fourbar, nothing fixed": (fourbar, {}, {}),
    "slider-crank, guess in a singular position": (slider_crank, {"phi": 0.0}, {"phi'": 3.0}),
    "slider-crank": (slider_crank, {"s": 0.25}, {"s'": 0.5}),
    "pendulum, guess in a singular position": (pendulum_on_rail, {}, {}),
    "pendulum": (pendulum_on_rail, {"x": 1.0}, {"y'": 1.0}),
    "dependent constraints": (lambda: pendulum_on_rail(twice=True), {"x": 1.0}, {"y'": 1.0}),
    "floating box": (hanging_box, {"e0": 0.8, "e1": 0.6}, {"x'": 0.2, "p": 1.0}),
}


def variables(linkage, given):
    by_name = {str(each): each for each in (*linkage.equations.coordinates, *linkage.equations.speeds)}
    by_name |= {f"{q}'": time_derivative(q) for q in linkage.equations.coordinates}
    return {by_name[name]: value for name, value in given.items()}


def evaluated(linkage, expressions, time, state):
    """Evaluate with another function than the one under test: all variables by name, no Jacobians."""
    arguments = [t, *linkage.parameters, *state]
    return np.array(
        lambdify(arguments, list(expressions))(time, *linkage.parameters.values(), *state.values())
    )


@pytest.mark.parametrize("name", LINKAGES)
@pytest.mark.parametrize("time", [0.0, 0.7])
def test_states_satisfy_constraints_and_keep_what_is_given(name, time):
    make, fixed_q, fixed_u = LINKAGES[name]
    linkage = make()
    system = linkage.equations.system
    given = variables(linkage, fixed_q | fixed_u)
    state = consistent_state(linkage.equations, linkage.parameters, given, t=time)
    rates = system.rate(system.constraints)
    assert list(state) == [*linkage.equations.coordinates, *linkage.equations.speeds]
    assert np.abs(evaluated(linkage, system.constraints, time, state)).max() < 1e-13
    assert np.abs(evaluated(linkage, rates, time, state)).max() < 1e-13
    kinematics = {key: key for key in state} | linkage.equations.kinematics
    kept = evaluated(linkage, [kinematics[key] for key in given], time, state)
    assert np.allclose(kept, list(given.values()), rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize(
    ("make", "guess"),
    [
        (fourbar, {"qA": 0.1, "qB": 1.0, "qC": 0.5}),
        (slider_crank, {"phi": 0.4, "beta": 0.2, "s": 0.5}),
        (pendulum_on_rail, {"x": -2.0, "y": 2.5}),
        (hanging_box, {"x": 0.1, "e0": 0.7, "e1": 0.1, "e2": 0.4, "e3": -0.4}),
    ],
)
def test_coordinates_change_least(make, guess):
    linkage = make()
    q = linkage.equations.coordinates
    start = np.array([guess.get(str(each), 0.0) for each in q])
    phi = lambdify([t, q, list(linkage.parameters)], list(linkage.equations.constraints))
    values = list(linkage.parameters.values())
    nearest = minimize(
        lambda x: np.sum((x - start) ** 2),
        start,
        method="SLSQP",
        constraints={"type": "eq", "fun": lambda x: phi(0.0, x, values)},
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert nearest.success
    state = consistent_state(linkage.equations, linkage.parameters, None, guess=variables(linkage, guess))
    assert np.allclose([state[each] for each in q], nearest.x, atol=2e-6)


def test_speeds_change_least():
    linkage = hanging_box()
    eqs, q = linkage.equations, linkage.equations.coordinates
    guess = variables(linkage, {"p": 1.0, "q": -2.0, "u": 0.5, "phi'": 4.0})
    state = consistent_state(eqs, linkage.parameters, None, guess=guess)
    J = np.array(
        lambdify([q, list(linkage.parameters)], eqs.constraint_jacobian)(
            [state[each] for each in q], list(linkage.parameters.values())
        )
    )
    start = np.array([guess.get(u, 0.0) for u in eqs.speeds])
    multipliers = np.linalg.solve(J @ J.T, J @ start)
    assert np.allclose([state[u] for u in eqs.speeds], start - J.T @ multipliers, atol=1e-13)


def test_guessed_rates_of_a_floating_frame_are_guessed_speeds():
    linkage = hanging_box()
    rate = time_derivative(linkage["phi"])
    state = consistent_state(
        linkage.equations, linkage.parameters, {linkage["e0"]: 0.0, linkage["e3"]: 1.0}, guess={rate: 2.0}
    )
    assert state[rate] == 2.0


def test_numbers_of_seven_digits_are_polished():
    linkage = pendulum_on_rail()
    x, y = linkage["x"], linkage["y"]
    given = {x: 1.2, y: -1.6000004, time_derivative(x): 1.216, time_derivative(y): 0.7500004}
    with pytest.raises(ConstraintError, match=r"the given coordinates, .* is off by 6\.4e-05; give"):
        consistent_state(linkage.equations, linkage.parameters, {**given, y: -1.60002})
    given[time_derivative(y)] = (1.216 - 0.6) * 1.2 / 1.6 * (1 + 1e-7)
    state = consistent_state(linkage.equations, linkage.parameters, given)
    assert np.allclose(list(state.values()), list(given.values()), atol=1e-6)
    rod = evaluated(linkage, linkage.equations.constraints, 0.0, state)
    assert np.abs(rod).max() < 1e-14


def test_a_rate_of_a_driven_constraint_is_satisfied_by_the_rest():
    linkage = pendulum_on_rail()
    x, y = linkage["x"], linkage["y"]
    state = consistent_state(linkage.equations, linkage.parameters, {x: 2.0, y: 0.0})
    assert np.isclose(state[time_derivative(x)], 0.6)  # a w cos(0), along the rod
    assert state[time_derivative(y)] == 0


def test_without_constraints_what_is_not_given_is_guessed_or_zero():
    linkage = double_pendulum()
    q1, q2 = linkage["theta1"], linkage["theta2"]
    state = consistent_state(linkage.equations, None, {q1: 1}, guess={q2: 0.5})
    assert list(state.values()) == [1.0, 0.5, 0.0, 0.0]


def test_coordinates_of_a_pose_begin_at_zero_and_only_a_quaternion_at_one():
    (u, r), (x, y, psi), m = functions_of_time("u r"), functions_of_time("x y psi"), symbols("m")
    car = moving_frame(u, 0, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    state = consistent_state(newton_euler(System([Body(car, m, Iz=1)], speeds=[u, r])), {}, {})
    assert set(state.values()) == {0.0}
    free = newton_euler(System([Body(floating_frame(), m, 1, 1, 1)]))
    state = consistent_state(free, {}, {})
    assert [value for value in state.values() if value] == [1.0]
    assert state[free.coordinates[3]] == 1.0


def test_states_do_not_depend_on_the_run():
    first, second = (consistent_state(L.equations, L.parameters, None) for L in (fourbar(), fourbar()))
    assert list(first.values()) == list(second.values())


def given(make, values, **more):
    linkage = make()
    return consistent_state(linkage.equations, linkage.parameters, variables(linkage, values), **more)


@pytest.mark.parametrize(
    ("make", "values", "message"),
    [
        (
            slider_crank,
            {"s": 0.5},
            r"no coordinates were found with s = 0\.5 that satisfy .* off by -0\.1; give fewer",
        ),
        (
            pendulum_on_rail,
            {"x": 1.0, "y": 1.0},
            r"the given coordinates, x = 1, y = 1, don't satisfy .* constraint 1, .* is off by -2; give some",
        ),
        (
            fourbar,
            {"qA": 0.3, "qA'": 2.0, "qB'": 1.0},
            r"no speeds with qA' = 2, qB' = 1 satisfy constraint 2",
        ),
        (
            pendulum_on_rail,
            {"x": 0.0, "y": -2.0, "y'": 0.1},
            r"no speeds with y' = 0\.1 satisfy constraint 1, .* at t = 0",
        ),
        (
            hanging_box,
            {"p": 0.0, "q": 0.0, "r": 0.0, "x'": 1.0},
            r"consistent_state: no speeds with .*x' = 1",
        ),
    ],
)
def test_what_can_not_be_is_told(make, values, message):
    with pytest.raises(ConstraintError, match=message):
        given(make, values)


def test_a_mistake_in_what_is_given_is_told():
    linkage = pendulum_on_rail()
    with pytest.raises(
        ParameterError, match=r"consistent_state: no value for a, l, w; give parameters=\{a: \.\.\."
    ):
        consistent_state(linkage.equations, {}, None)
    with pytest.raises(ParameterError, match="consistent_state, initial: m is not a coordinate"):
        consistent_state(linkage.equations, linkage.parameters, {linkage["m"]: 1})


def test_inputs_in_constraints_take_part_with_their_rates():
    m, x, y, f = symbols("m"), *functions_of_time("x y f")
    eqs = newton_euler(
        System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - f], inputs=[f])
    )
    state = consistent_state(eqs, None, {y: 1}, t=0.5, inputs={f: 3 * t**2})
    assert np.allclose(list(state.values()), [0.75, 1.0, 3.0, 0.0])
    with pytest.raises(
        ModelError, match=r"consistent_state: the constraints contain the functions of time f"
    ):
        consistent_state(eqs, None, {y: 1})


def test_a_place_where_the_constraints_are_no_numbers_is_told():
    m, x = symbols("m"), functions_of_time("x")
    z = functions_of_time("z")
    eqs = newton_euler(
        System([Body(translate(x, 0, z), m)], coordinates=[x, z], constraints=[x ** (1 / 2) - z])
    )
    with pytest.raises(ConstraintError, match="is off by nan"):
        consistent_state(eqs, None, {x: -1})


@pytest.mark.parametrize("off", [0.0, 3e-12, 1e-9])
def test_speeds_of_a_motion_are_accepted_where_a_gradient_vanishes(off: float) -> None:
    """Nearly flat, the first constraint of a parallelogram has a rounding error for its direction."""
    found = cranks(1)
    (a, b), (c,) = found.equations.coordinates[:2], found.equations.coordinates[2:]
    given = {a: 2 * off, b: off, c: -off, a.diff(t): -4.95, b.diff(t): -4.95, c.diff(t): off}
    state = consistent_state(found.equations, found.parameters, given)
    assert np.allclose([state[name] for name in given], list(given.values()), rtol=0, atol=2e-8)
    with pytest.raises(ConstraintError, match="no speeds with"):
        consistent_state(found.equations, found.parameters, given | {b.diff(t): -4.9})
