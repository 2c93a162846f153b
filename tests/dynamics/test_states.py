"""Equations and programs of systems with states beside the mechanics."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Force,
    System,
    describe,
    diff,
    floating_frame,
    forward_dynamics,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    simplify,
    subs,
    substitute,
    symbols,
    time_derivative,
    translate,
)
from tests.dynamics.state_models import (
    T,
    c,
    controlled_cart,
    current,
    heat,
    k,
    ki,
    l,
    m,
    motor_pendulum,
    r,
    sensed_pendulum,
    theta,
    x,
    z,
)

speed, acceleration = time_derivative(x), time_derivative(x, 2)


def damped(force: object, rates: dict) -> System:  # type: ignore[type-arg]
    cart = Body(translate(x, 0, 0), m, name="cart")
    push = Force(ground, force, 0, 0, at=cart.center_of_mass, on=cart, name="push")  # type: ignore[arg-type]
    return System([cart], [push], [x], states=rates)


def test_a_state_is_known_and_no_input() -> None:
    eqs = controlled_cart().equations
    assert eqs.states == (z,)
    assert eqs.state_rates == {time_derivative(z): x - r}
    assert eqs.inputs == ()
    assert eqs.parameters == (c, k, ki, m, r)
    assert eqs.residuals[0] == m * acceleration + k * (x - r) + c * speed + ki * z


def test_rates_of_states_in_loads_are_put_in() -> None:
    """A lead-lag element: the load holds z and z', and both formalisms give the same nodes."""
    system = damped(-k * z - c * time_derivative(z), {z: (x - z) / T})
    newton, lagrange = newton_euler(system), lagrange_equations(system)
    assert newton.residuals == lagrange.residuals
    assert newton.bias == lagrange.bias
    assert newton.residuals[0] == m * acceleration + k * z + c * (x - z) / T
    assert newton.inputs == ()


def test_the_rate_of_a_state_by_the_speeds_of_a_floating_frame() -> None:
    """The rate holds x', which floating frames write by their speeds; the drag holds the filtered velocity."""
    frame = floating_frame("craft")
    hull = Body(frame, m, 1, 1, 1)
    place = frame.pose.origin[0]
    drag = Force(ground, -c * z - T * time_derivative(z), 0, 0, at=hull.center_of_mass, on=hull)
    system = System([hull], [drag], states={z: time_derivative(place) - z})
    (rate,) = newton_euler(system).state_rates.values()
    assert rate == system.kinematics[time_derivative(place)] - z
    residuals = newton_euler(system).residuals
    names = {leaf for residual in residuals for leaf in residual.free_symbols if leaf.kind == "time_function"}
    assert names <= {*system.coordinates, *system.speeds, *system.accelerations, z}


def test_accelerations_and_multipliers_in_rates_are_those_of_the_solution() -> None:
    eqs = sensed_pendulum().equations
    solution = forward_dynamics(eqs)
    (routine,) = (each for each in eqs.program().routines if each.name == "right_hand_side")
    rate = routine.results[0].expressions[-1]
    values = dict(zip(eqs.accelerations, solution.accelerations, strict=True))
    values |= dict(zip(eqs.multipliers, solution.multipliers, strict=True))
    assert rate == substitute([eqs.state_rates[time_derivative(z)]], values)[0]
    assert not {*eqs.accelerations, *eqs.multipliers} & rate.free_symbols


def test_the_routines_and_their_arguments() -> None:
    program = motor_pendulum().equations.program()
    arguments = {routine.name: routine.arguments for routine in program.routines}
    assert arguments["forcing"] == ("p", "q", "u", "z")
    assert arguments["state_rates"] == ("p", "q", "u", "z")
    assert arguments["right_hand_side"] == ("p", "q", "u", "z")
    assert arguments["mass_matrix"] == ("p", "q")
    (states,) = (argument for argument in program.arguments if argument.name == "z")
    assert (states.meaning, states.variables) == ("states: current, heat", (current, heat))
    shapes = {routine.name: [result.shape for result in routine.results] for routine in program.routines}
    assert shapes["right_hand_side"] == [(4,)]
    assert shapes["state_rates"] == [(2,)]


def test_rates_that_hold_accelerations_take_them_as_arguments() -> None:
    program = sensed_pendulum().equations.program(outputs={"lag": time_derivative(z)})
    arguments = {routine.name: routine.arguments for routine in program.routines}
    assert arguments["state_rates"] == ("p", "t", "q", "u", "z", "a", "lambda_")
    assert arguments["outputs"] == ("p", "t", "q", "u", "z", "a", "lambda_")


def test_what_is_shown() -> None:
    eqs = controlled_cart().equations
    assert repr(eqs) == "Equations(1 equation of motion, 0 constraints, coordinate x, state z)"
    assert repr(eqs.system) == "System(controlled_cart, 1 body, 1 load, 1 coordinate, 1 state)"
    assert "    state: z' = x - r" in describe(eqs).splitlines()
    assert "    state: z' = x - r" in describe(eqs.system).splitlines()
    assert r"\dot{z} &= x - r" in eqs.latex()
    assert "of a state" in eqs.system._repr_html_()
    assert repr(motor_pendulum().equations).endswith("coordinate theta, states current, heat)")


def test_substitutions_and_rewrites_reach_the_rates() -> None:
    eqs = subs(motor_pendulum().equations, {l: 2})
    assert eqs.system.states == (current, heat)
    cart = subs(controlled_cart().equations, {r: 3})
    assert cart.state_rates == {time_derivative(z): x - 3}
    assert cart.system.state_rates == cart.state_rates
    assert simplify(cart).state_rates == cart.state_rates
    system = subs(controlled_cart().equations.system, {r: 3})
    assert newton_euler(system).residuals == cart.residuals


def test_functions_of_time_in_rates_are_inputs() -> None:
    drive = functions_of_time("drive")
    eqs = newton_euler(damped(z, {z: drive - z}))
    assert eqs.inputs == (drive,)


def test_the_default_multiplier_avoids_the_names_of_states() -> None:
    other, y = functions_of_time("lambda1 y")
    bead = Body(translate(x, y, 0), m)
    system = System([bead], coordinates=[x, y], constraints=[x - y], states={other: x})
    assert [each.name for each in system.multipliers] == ["lambda2"]


def test_a_default_multiplier_in_a_rate_is_that_of_the_constraint() -> None:
    reaction, y = functions_of_time("lambda1 y")
    bead = Body(translate(x, y, 0), m)
    system = System([bead], coordinates=[x, y], constraints=[x - y], states={z: reaction - z})
    assert system.multipliers == (reaction,)
    assert newton_euler(system).inputs == ()


def test_systems_without_states_are_as_before() -> None:
    cart = System([Body(translate(x, 0, 0), m)], coordinates=[x])
    eqs = newton_euler(cart)
    assert (eqs.states, eqs.state_rates) == ((), {})
    assert "z" not in [argument.name for argument in eqs.program().arguments]
    assert "state" not in cart._repr_html_()


@pytest.mark.parametrize("parameter", symbols("kt U"))
def test_derivatives_of_rates(parameter: object) -> None:
    (first, _) = motor_pendulum().equations.state_rates.values()
    assert not diff(first, parameter).is_zero  # type: ignore[arg-type]
    assert theta not in first.free_symbols
