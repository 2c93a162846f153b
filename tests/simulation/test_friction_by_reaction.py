"""Dry friction by the force in the joint itself, which a state follows with a short lag."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from symbody import (
    Link,
    Vector,
    assemble,
    friction,
    functions_of_time,
    ground,
    newton_euler,
    reaction,
    revolute,
    simulate,
    sqrt,
)
from symbody.errors import ModelError

MASS, INERTIA, ARM, G = 2.0, 0.1, 0.3, 9.81
MU_R, CREEP = 0.004, 1e-2


def pin_friction(w: float, alpha: float, phi: float) -> float:
    """mu r |F| tanh(w/w0), with the force in the pin by Newton's law."""
    ax = ARM * (-alpha * np.sin(phi) - w**2 * np.cos(phi))
    ay = ARM * (alpha * np.cos(phi) - w**2 * np.sin(phi))
    return MU_R * MASS * np.hypot(ax, ay + G) * np.tanh(w / CREEP)


def rates(_: float, y: np.ndarray) -> list[float]:
    """Euler's law about the pin, solved for the acceleration that it contains on both sides."""
    phi, w = y

    def excess(alpha: float) -> float:
        turning = -MASS * G * ARM * np.cos(phi) - pin_friction(w, alpha, phi)
        return (INERTIA + MASS * ARM**2) * alpha - turning

    return [w, brentq(excess, -1e3, 1e3, xtol=1e-12)]


def test_a_pendulum_with_friction_by_the_force_in_its_pin():
    bob = Link("bob", MASS, Iz=INERTIA, center=(ARM, 0, 0))
    pin = revolute("A", ground, bob)
    mechanism, F = assemble([pin]), functions_of_time("F")
    rubs = friction(pin.coordinate, on=mechanism.body(bob), coulomb=MU_R * F, creep_speed=CREEP)
    weight = Vector(ground, 0, -G, 0)
    known = newton_euler(mechanism.system([rubs], gravity=weight, inputs=[F]))
    x, y, _ = reaction(known, pin).force.components
    size = sqrt(x**2 + y**2)
    equations = newton_euler(mechanism.system([rubs], gravity=weight, states={F: (size - F) / 1e-5}))
    motion = simulate(
        equations, {}, {pin.coordinate: 0.2, F: 10}, t=(0, 1), method="bdf", rtol=1e-9, atol=1e-11
    )
    expected = solve_ivp(rates, (0, 1), [0.2, 0.0], method="Radau", rtol=1e-9, atol=1e-11)
    assert motion[pin.coordinate][-1] == pytest.approx(expected.y[0, -1], abs=2e-6)
    frictionless = solve_ivp(
        lambda _, y: [y[1], -MASS * G * ARM * np.cos(y[0]) / (INERTIA + MASS * ARM**2)],
        (0, 1),
        [0.2, 0.0],
        rtol=1e-9,
    )
    assert abs(frictionless.y[0, -1] - expected.y[0, -1]) > 1e-3


def test_multipliers_of_equations_that_were_derived_before_are_told():
    parts = [Link(name, 1, Iz=1, center=(0.5, 0, 0)) for name in ("one", "two", "three")]
    one, two, three = parts
    pins = [
        revolute("A", ground, one),
        revolute("B", one, two, at=(1, 0, 0)),
        revolute("D", ground, three, at=(1, 0, 0)),
        revolute("C", two, three, at=(1, 0, 0), to=(1, 0, 0)),
    ]
    mechanism = assemble(pins)
    force = reaction(newton_euler(mechanism.system()), pins[3]).force.components[0]
    rubs = friction(pins[0].coordinate, on=mechanism.body(one), coulomb=force**2, creep_speed=0.1)
    with pytest.raises(ModelError) as caught:
        simulate(newton_euler(mechanism.system([rubs])))
    held = ", ".join(sorted(leaf.name for leaf in force.free_symbols if leaf.name.startswith("lambda")))
    assert str(caught.value) == (
        f"simulate: the equations contain {held}, which they don't determine: multipliers of equations that were "
        "derived before, in a load or a constraint of this system; a load by reactions, such as a friction mu*N, takes "
        "a state that follows N with a short lag tau, as in System(..., states={Nf: (N - Nf)/tau})"
    )
