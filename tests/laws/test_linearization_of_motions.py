"""Linear models about steady motions are tangents of the nonlinear equations: rolling, spinning, cornering, driven."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Linear,
    Point,
    System,
    Vector,
    embedded,
    equilibrium,
    functions_of_time,
    ground,
    kane,
    linearize,
    newton_euler,
    rotate,
    state_space,
    steady,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.models import bicycle, four_bar, n_pendulum, rolling_disc, single_track_car, slider_crank
from symbody.models.classic_system import ClassicSystem
from tests.laws.finite_differences import assert_tangent
from tests.reference.mechanisms.problem import reference
from tests.repeated import repeated

Y, s, v, th = symbols("Y s v th")


def values_of(linear: Linear, parameters: Mapping[Expr, float]) -> dict[Expr, float]:
    """Return the values of all variables in the steady motion."""
    return {
        name: value.evaluate({each: parameters[each] for each in value.free_symbols})
        for name, value in linear.about.items()
    }


@pytest.mark.parametrize(
    "turn", reference("rolling_disc")["steady_turns"], ids=lambda turn: f"lean {turn['lean']}"
)
def test_disc_in_a_turn(turn: dict[str, float]) -> None:
    """A disc that rolls in a circle: the lean, the rate of turn and the spin are those of the reference."""
    model = rolling_disc()
    psi, theta, phi = (model[name] for name in ("psi", "theta", "phi"))
    eqs = newton_euler(model.system)
    about = {theta: th, time_derivative(psi): Y, time_derivative(phi): s}
    linear = linearize(eqs, about, keep_ignorable=False)
    assert linear.states == (theta, *map(time_derivative, (psi, theta, phi)))
    parameters = {**model.parameters, th: -turn["lean"], Y: turn["yaw_rate"], s: turn["spin_rate"]}
    assert_tangent(eqs, linear, parameters, values_of(linear, parameters))


def _embedded(system: System) -> Equations:
    speeds = [u for u in system.speeds if str(u) in ("lean'", "steer'", "rear_angle'")]
    return embedded(newton_euler(system), speeds)


@pytest.mark.parametrize("derive", [newton_euler, _embedded, *repeated([kane])])
def test_bicycle_at_speed(derive: Callable[[System], Equations]) -> None:
    model = bicycle()
    eqs = derive(model.system)
    about = {time_derivative(model["rear_angle"]): -v / model["rR"]}
    if not eqs.constraints:
        about = {
            u: v if str(u) == "x'" else -v / model["rR"] if str(u) == "rear_angle'" else 0 for u in eqs.speeds
        }
    linear = linearize(eqs, about, outputs=[time_derivative(model["lean"], 2)])
    parameters = {**model.parameters, v: 3.0}
    reference = values_of(linear, parameters)
    assert_tangent(eqs, linear, parameters, reference, [time_derivative(model["lean"], 2)])


def test_bicycle_in_a_turn() -> None:
    """A motion that `steady` found: speeds that constraints determine follow at any heading, not up to rounding."""
    model = bicycle()
    eqs = newton_euler(model.system)
    spin, lean, torque = time_derivative(model["rear_angle"]), model["lean"], model["T_steer"]
    found = steady(
        eqs,
        model.parameters,
        given={lean: 0.2, spin: -4.0 / 0.3},
        guess={time_derivative(model["yaw"]): 0.5, model["steer"]: 0.1},
        inputs={model["T_lean"]: 0.0},
        unknown=[torque],
    )
    linear = linearize(eqs, found, keep_ignorable=False, independent=[lean, model["steer"]])
    reference = {**found, **{name: float(value) for name, value in found.inputs.items()}}
    assert_tangent(eqs, linear, found.parameters, reference)


def test_car_in_a_turn() -> None:
    car = single_track_car()
    eqs = newton_euler(car.system)
    found = steady(eqs, car.parameters, given={car["r"]: 0.25}, unknown=[car["delta"]])
    linear = linearize(
        eqs, found, keep_ignorable=False, outputs={"lateral acceleration": time_derivative(car["v"])}
    )
    parameters = found.parameters
    reference = values_of(linear, parameters)
    assert_tangent(eqs, linear, parameters, reference, [time_derivative(car["v"])])


def test_pendulum_on_a_cart_that_is_driven() -> None:
    """An input in a constraint comes with its rates: x = r(t) pushes the pendulum by r''."""
    x, theta, r = functions_of_time("x theta r")
    M, m, l, g, c = symbols("M m l g c")
    cart = Body(translate(x, 0, 0), M)
    bob = Body(translate(x, 0, 0) * rotate("Y", theta) * translate(0, 0, l), m)
    damper = Force(ground, -c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    system = System(
        [cart, bob],
        [damper],
        coordinates=[x, theta],
        constraints=[x + theta * x / 5 - r],
        gravity=Vector(ground, 0, 0, g),
        inputs=[r],
    )
    eqs = newton_euler(system)
    linear = linearize(eqs, independent=[theta], outputs=[eqs.multipliers[0]])
    assert linear.inputs == (r, time_derivative(r), time_derivative(r, 2))
    assert linear.A.tolist() == [[0, 1], [-g / l, 0]]
    assert linear.B.tolist() == [[0, 0, 0], [0, 0, -1 / l]]
    assert linear.D.tolist() == [[0, c, M]]


def test_moving_course() -> None:
    """A wagon that runs at the given speed V, as x = V t, and a pendulum on it in a wind."""
    x, theta = functions_of_time("x theta")
    m, l, g, V, c = symbols("m l g V c")
    frame = translate(x, 0, 0) * rotate("Y", theta) * translate(0, 0, l)
    bob = Body(Point(frame, 0, 0, 0), m)
    wind = Force(ground, -c * (time_derivative(x) - V), 0, 0, at=bob.center_of_mass, on=bob)
    eqs = newton_euler(System([bob], [wind], coordinates=[x, theta], gravity=Vector(ground, 0, 0, g)))
    linear = linearize(eqs, {x: V * t})
    assert linear.about[time_derivative(x)] == V
    assert linear.K.tolist() == [[0, 0], [0, g * l * m]]
    assert linear.second_order.C.tolist() == [[c, 0], [c * l, 0]]


@pytest.mark.parametrize("make", [four_bar, slider_crank, lambda: n_pendulum(3)])
def test_eigenvalues_at_rest_are_those_of_the_equilibrium(make: Callable[[], ClassicSystem]) -> None:
    model = make()
    eqs = newton_euler(model.system)
    inputs = dict.fromkeys(eqs.inputs, 0.0)
    guess = {q: value for q, value in {**model.guess, **model.initial}.items() if q in eqs.coordinates}
    found = equilibrium(eqs, model.parameters, guess=guess, inputs=inputs)
    linear = linearize(eqs, found.coordinates)
    values = np.linalg.eigvals(state_space(linear, model.parameters).A)
    order = [np.lexsort((each.imag, each.real.round(6))) for each in (values, found.eigenvalues)]
    size = np.abs(found.eigenvalues).max()
    assert_allclose(values[order[0]], found.eigenvalues[order[1]], rtol=0, atol=1e-7 * size)
