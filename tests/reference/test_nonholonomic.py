"""Rolling and skating by constraints on velocities: closed forms, without projections made by hand.

Neimark & Fufaev, Dynamics of nonholonomic systems, 1972; Bloch, Nonholonomic mechanics and control, 2003.
"""

from __future__ import annotations

from math import cos as cosine
from math import pi
from math import sin as sine

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    System,
    Vector,
    angular_velocity,
    center_of_mass,
    consistent_state,
    cos,
    cross,
    functions_of_time,
    ground,
    newton_euler,
    project,
    rotate,
    simulate,
    sin,
    time_derivative,
    translate,
    velocity,
)
from tests.reference.mechanisms.problem import reference

NUMBERS = reference("nonholonomic")
DISC = reference("rolling_disc")


def test_knife_edge_on_an_incline() -> None:
    numbers = NUMBERS["knife_edge"]
    p = numbers["parameters"]
    x, y, theta = functions_of_time("x y theta")
    blade = Body(translate(x, y, 0) * rotate("Z", theta), p["m"], Iz=p["J"])
    sideways = time_derivative(y) * cos(theta) - time_derivative(x) * sin(theta)
    weight = Vector(ground, p["g"] * sine(p["incline"]), 0, -p["g"] * cosine(p["incline"]))
    equations = newton_euler(System([blade], (), [x, y, theta], [sideways], weight))
    t, *columns = np.array(numbers["rows"]).T
    initial = {
        x: 0,
        y: 0,
        theta: 0,
        time_derivative(x): 0,
        time_derivative(y): 0,
        time_derivative(theta): p["omega"],
    }
    motion = simulate(equations, {}, initial, t, rtol=1e-12, atol=1e-12)
    for coordinate, expected in zip((x, y, theta), columns, strict=True):
        assert_allclose(motion[coordinate], expected, atol=1e-10)


def rolling_disc(m: float, r: float, A: float, C: float, g: float) -> tuple[Equations, tuple[Expr, ...]]:
    """Return a disc on the x-y plane that rolls; the coordinates are of the contact, heading, lean and spin."""
    x, y, psi, th, ph = q = functions_of_time("x y psi th ph")
    plane = translate(x, y, 0) * rotate("Z", psi) * rotate("X", -th) * translate(0, 0, r)
    disc = Body(plane * rotate("Y", ph), m, A, C, A)
    slip = velocity(center_of_mass(disc)) + cross(angular_velocity(disc.frame), Vector(plane, 0, 0, -r))
    vx, vy, _ = project(slip, ground).components
    return newton_euler(System([disc], (), q, [vx, vy], Vector(ground, 0, 0, -g))), q


def test_vertical_disc() -> None:
    numbers = NUMBERS["vertical_disc"]
    R, spin, yaw = (numbers["parameters"][name] for name in ("R", "spin", "yaw"))
    equations, (x, y, psi, th, ph) = rolling_disc(1.3, R, 0.3, 0.5, 0.0)
    t, *columns = np.array(numbers["rows"]).T
    # Without weight, upright rolling is a motion: the turning disc needs a moment of inertia alone that is balanced.
    initial = consistent_state(
        equations,
        {},
        dict.fromkeys((x, y, psi, th, ph), 0)
        | {time_derivative(ph): spin, time_derivative(psi): yaw, time_derivative(th): 0},
    )
    upright = newton_euler(
        System(equations.system.bodies, (), (x, y, psi, th, ph), [*equations.constraints, th])
    )
    motion = simulate(upright, {}, initial, t, rtol=1e-12, atol=1e-12)
    for coordinate, expected in zip((x, y, ph, psi), columns, strict=True):
        assert_allclose(motion[coordinate], expected, atol=1e-10)


@pytest.mark.parametrize("turn", DISC["steady_turns"])
def test_steady_turns_of_a_disc(turn: dict[str, float]) -> None:
    p = DISC["parameters"]
    equations, (x, y, psi, th, ph) = rolling_disc(p["m"], p["r"], p["A"], p["C"], p["g"])
    lean, yaw, spin = turn["lean"], turn["yaw_rate"], turn["spin_rate"]
    rates = {time_derivative(psi): yaw, time_derivative(th): 0, time_derivative(ph): spin}
    initial = consistent_state(equations, {}, {x: 0, y: 0, psi: 0, th: lean, ph: 0} | rates)
    period = 2 * pi / abs(yaw)
    motion = simulate(equations, {}, initial, t=np.linspace(0, period / 2, 50), rtol=1e-12, atol=1e-12)
    assert_allclose(motion[th], lean, atol=1e-8)
    assert_allclose(motion[time_derivative(ph)], spin, rtol=1e-8)
    across = np.hypot(motion[x][-1] - motion[x][0], motion[y][-1] - motion[y][0])
    assert_allclose(across, 2 * turn["contact_circle_radius"], rtol=1e-8)
