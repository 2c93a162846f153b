"""Inverse dynamics of systems with states beside the mechanics, which are integrated along the motion."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Constraint,
    Equations,
    Force,
    System,
    consistent_state,
    functions_of_time,
    ground,
    inverse_dynamics,
    newton_euler,
    simulate,
    sin,
    symbols,
    time_derivative,
    translate,
)
from symbody import t as time
from symbody.errors import ConstraintError, ModelError, ParameterError, SymbodyError
from tests.dynamics.state_models import controlled_cart, current, heat, motor_pendulum, theta
from tests.simulation.test_states_in_constraints import BELT, belt, belt_motion, gear

x, y, z, lam = functions_of_time("x y z lambda1")
m, c, T, F, w, k, r = symbols("m c T F w k r")
dx = time_derivative(x)

CART = {m: 1.3, c: 0.8, T: 0.4}
VALUES = CART | {w: 3.0}


def lagging(rate: object, force: object = 0) -> Equations:
    """A cart with a resistance c z that lags behind its motion."""
    cart = Body(translate(x, 0, 0), m)
    drag = Force(ground, -c * z + force, 0, 0, at=cart.center_of_mass, on=cart)  # type: ignore[operator]
    return newton_euler(System([cart], [drag], [x], states={z: rate}))


def filtered(of_sine: float, of_cosine: float, t: np.ndarray, start: float) -> np.ndarray:
    """Return z of ``T z' + z = a sin(w t) + b cos(w t)``."""
    lag = VALUES[T] * VALUES[w]
    a, b = of_sine / (1 + lag**2), of_cosine / (1 + lag**2)
    wt = VALUES[w] * t
    steady = a * (np.sin(wt) - lag * np.cos(wt)) + b * (np.cos(wt) + lag * np.sin(wt))
    return steady + (start + a * lag - b) * np.exp(-t / VALUES[T])


def test_a_filtered_velocity() -> None:
    result = inverse_dynamics(lagging((dx - z) / T), {x: sin(w * time)}, VALUES, (0, 3), initial={z: 0.7})
    speed = VALUES[w]
    expected = filtered(0, speed, result.t, 0.7)
    assert_allclose(result[z], expected, atol=1e-8)
    assert_allclose(result.states[z], expected, atol=1e-8)
    inertia = -VALUES[m] * speed**2 * np.sin(speed * result.t)
    assert_allclose(result.forces[x], inertia + VALUES[c] * expected, atol=1e-8)
    assert_allclose(result[time_derivative(z)], (result[dx] - expected) / VALUES[T], atol=1e-6)


def test_a_filtered_acceleration_from_zero() -> None:
    equations = lagging((time_derivative(x, 2) - z) / T)
    result = inverse_dynamics(equations, {x: sin(w * time)}, VALUES, (0, 3))
    assert_allclose(result[z], filtered(-(VALUES[w] ** 2), 0, result.t, 0.0), atol=1e-8)


def test_samples() -> None:
    t = np.linspace(0, 3, 301)
    result = inverse_dynamics(lagging((dx - z) / T), {x: np.sin(3 * t)}, CART, t)
    assert_allclose(result[z], filtered(0, 3.0, t, 0.0), atol=1e-6)


def test_rates_that_hold_the_load_that_is_solved_for() -> None:
    """The filter sees the force F that moves the cart: ``T z' + z = F`` with ``F = m x'' + c z``."""
    equations = lagging((F - z) / T, F)
    result = inverse_dynamics(equations, {x: sin(w * time)}, VALUES, (0, 2), unknowns=[F], initial={z: 0.1})
    rate = (VALUES[c] - 1) / VALUES[T]
    drive = -VALUES[m] * VALUES[w] ** 2 / VALUES[T]
    # z' = rate z + drive sin(w t)
    size, wt = rate**2 + VALUES[w] ** 2, VALUES[w] * result.t
    steady = -drive * (rate * np.sin(wt) + VALUES[w] * np.cos(wt)) / size
    expected = steady + (0.1 + drive * VALUES[w] / size) * np.exp(rate * result.t)
    assert_allclose(result[z], expected, atol=1e-8)
    assert_allclose(result.forces[F], -VALUES[m] * 9 * np.sin(wt) + VALUES[c] * expected, atol=1e-8)


def test_a_state_that_is_solved_for() -> None:
    """The current of a motor that moves a pendulum as prescribed, and the voltage that follows from its equation."""
    equations, p = motor_pendulum()
    names = {each.name: value for each, value in p.items()}
    angle = sin(2 * time) / 2
    result = inverse_dynamics(equations, {theta: angle}, p, (0, 2), unknowns=[current])
    inertia = names["m"] * names["l"] ** 2
    weight = names["m"] * names["g"] * names["l"] * np.sin(result[theta])
    torque = inertia * result[time_derivative(theta, 2)] + weight
    assert_allclose(result.forces[current], torque / names["kt"], atol=1e-12)
    power = names["U"] * torque / names["kt"] - names["R"] * (torque / names["kt"]) ** 2
    assert_allclose(np.gradient(result[heat], result.t)[1:-1], power[1:-1], atol=1e-3 * np.abs(power).max())


@pytest.mark.parametrize("model", [controlled_cart, motor_pendulum])
def test_a_simulated_motion_needs_no_more_forces(model: Callable[[], tuple[Equations, dict]]) -> None:
    equations, p = model()
    q = equations.coordinates[0]
    motion = simulate(equations, p, {q: 0.3, equations.states[0]: 0.2}, t=(0, 3), rtol=1e-10, atol=1e-10)
    result = inverse_dynamics(equations, motion)
    assert_allclose(result.forces[q], 0, atol=1e-8)
    for state in equations.states:
        assert_allclose(result[state], motion[state], atol=1e-14)
    # prescribed by its samples, with the states integrated anew
    start = {state: motion[state][0] for state in equations.states}
    again = inverse_dynamics(equations, {q: motion[q]}, p, motion.t, initial=start)
    assert_allclose(again.forces[q], 0, atol=1e-4)
    assert_allclose(again[equations.states[0]], motion[equations.states[0]], atol=1e-6)


def test_mechanisms_with_coordinates_that_follow() -> None:
    """A pendulum in Cartesian coordinates with a lagging drag on x, whose y follows from the rod."""
    bob = Body(translate(x, y, 0), m)
    drag = Force(ground, -c * z, 0, 0, at=bob.center_of_mass, on=bob)
    rod = Constraint((x**2 + y**2 - 1) / 2)
    pendulum = newton_euler(System([bob], [drag], [x, y], [rod], states={z: (dx - z) / T}))
    path = sin(w * time) / 2
    result = inverse_dynamics(pendulum, {x: path}, VALUES, (0, 2), guess={y: -1})
    assert_allclose(result[z], filtered(0, VALUES[w] / 2, result.t, 0), atol=1e-8)
    left = VALUES[m] * result[time_derivative(x, 2)] + VALUES[c] * result[z] - result[lam] * result[x]
    assert_allclose(result.forces[x], left, atol=1e-8)


def test_rates_that_hold_multipliers() -> None:
    """A filter of the reaction of a wall that holds y: ``lambda = m y'' + c z`` with ``y = sin(w t)``."""
    body = Body(translate(x, y, 0), m)
    drag = Force(ground, 0, -c * z, 0, at=body.center_of_mass, on=body)
    driven = Constraint(y - sin(w * time))
    held = newton_euler(System([body], [drag], [x, y], [driven], states={z: (lam - z) / T}))
    result = inverse_dynamics(held, {x: 0 * time}, VALUES, (0, 2))
    motion = simulate(held, VALUES, consistent_state(held, VALUES, {}), t=result.t, rtol=1e-10, atol=1e-10)
    assert_allclose(result[z], motion[z], atol=1e-7)
    assert_allclose(result[lam], motion[lam], atol=1e-7)


def test_states_in_constraints() -> None:
    equations = belt()
    result = inverse_dynamics(equations, {y: 0.1 * sin(time)}, BELT, np.linspace(0, 2, 21), initial={z: 0.2})
    speed, place, force = belt_motion(result.t, 0.2)
    assert_allclose(result[z], speed, atol=1e-9)
    assert_allclose(result[x], place, atol=1e-9)
    assert_allclose(result[lam], force, atol=1e-8)
    across = (BELT[k] - BELT[m]) * 0.1 * np.sin(result.t)
    assert_allclose(result.forces[y], across, atol=1e-9)


def test_a_gear_with_a_prescribed_rotor() -> None:
    J, rate = symbols("J c")
    result = inverse_dynamics(
        gear(), {y: time**2}, {J: 0.7, k: 1.9, rate: 0.8}, np.linspace(0, 2, 21), initial={z: 0.5}
    )
    ratio = 0.5 + 0.8 * result.t
    turning = 2 * result.t
    assert_allclose(result[dx], ratio * turning, atol=1e-9)
    torque = 1.9 * 2 + ratio * 0.7 * (ratio * 2 + 0.8 * turning)
    assert_allclose(result.forces[y], torque, atol=1e-8)


def test_kinematics_that_hold_a_state() -> None:
    """The belt embedded: x follows the state, and isn't prescribed."""
    body = Body(translate(x, y, 0), m)
    led = newton_euler(System([body], (), [x, y], kinematics={dx: z}, states={z: (r - z) / T}))
    values = {m: 2.0, T: BELT[T], r: BELT[r]}
    result = inverse_dynamics(led, {y: time**2}, values, (0, 2), initial={z: 0.2})
    speed, place, _ = belt_motion(result.t, 0.2)
    assert_allclose(result[z], speed, atol=1e-9)
    assert_allclose(result[x], place, atol=1e-9)
    assert_allclose(result.forces[y], 4.0, atol=1e-9)


def test_one_instant_and_tables() -> None:
    result = inverse_dynamics(lagging((dx - z) / T), {x: time}, CART, [0.0], initial={z: 0.7})
    assert result[z] == pytest.approx([0.7])
    assert result._repr_html_().count(">0.7</td>") == 4  # the state: first, least, largest and last


MISTAKES: list[tuple[type[SymbodyError], Callable[[], object], str]] = [
    (
        ParameterError,
        lambda: inverse_dynamics(lagging(dx - z), {x: time}, CART, (0, 1), initial={x: 1}),
        ("inverse_dynamics, initial: x is not a state of this system that is integrated; expected one of z"),
    ),
    (
        ModelError,
        lambda: inverse_dynamics(belt(), {y: time}, BELT, (0, 1), unknowns=[z]),
        (
            "inverse_dynamics, unknowns: z isn't in the equations of motion; expected symbols or functions of time in "
            "the loads: T, k, m, r"
        ),
    ),
    (
        ConstraintError,
        lambda: inverse_dynamics(
            lagging((dx - z) / T), simulate(lagging((dx - z) / T), CART, {dx: 1}, t=(0, 1)), {T: 2}
        ),
        (
            "inverse_dynamics, parameters: T = 2 is in the rate of a state, but the motion has T = 0.4; simulate it "
            "with the same value"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(SymbodyError) as caught:
        mistake()
    assert str(caught.value) == message
    assert type(caught.value) is kind
