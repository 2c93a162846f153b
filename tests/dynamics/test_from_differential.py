"""Differential equations as they stand give the motion of the system from which they were derived."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    System,
    Vector,
    consistent_state,
    equations_from_differential,
    functions_of_time,
    ground,
    newton_euler,
    simulate,
    symbols,
    translate,
)
from symbody import (
    time_derivative as d,
)
from symbody.errors import ModelError

x, y, lam, gamma = functions_of_time("x y lam gamma")
m, g, l = symbols("m g l")
NUMBERS = {m: 1.3, g: 9.81, l: 1}
LOOP = x**2 + y**2 - l**2
FORCES = [m * d(x, 2) - 2 * x * lam, m * d(y, 2) + m * g - 2 * y * lam]


def expected() -> np.ndarray:
    """Return x of a pendulum that symbody derives."""
    bob = Body(translate(x, y, 0), m)
    system = System([bob], coordinates=[x, y], gravity=Vector(ground, 0, -g, 0), constraints=[LOOP])
    equations = newton_euler(system)
    start = consistent_state(equations, NUMBERS, {x: 0.6}, guess={y: -0.8})
    return simulate(equations, NUMBERS, start, t=(0, 2), rtol=1e-10, atol=1e-10)[x]


def test_multipliers_are_forces_of_constraints() -> None:
    equations = equations_from_differential([*FORCES, LOOP], [x, y, lam])
    start = consistent_state(equations, NUMBERS, {x: 0.6}, guess={y: -0.8})
    found = simulate(equations, NUMBERS, start, t=(0, 2), rtol=1e-10, atol=1e-10)[x]
    assert np.allclose(found, expected(), atol=1e-7)


def test_multipliers_have_any_order_sign_and_factor() -> None:
    pushed = [each.subs({lam: -lam / 2}) for each in FORCES]
    equations = equations_from_differential([LOOP, *reversed(pushed)], [x, y, lam])
    start = consistent_state(equations, NUMBERS, {x: 0.6}, guess={y: -0.8})
    motion = simulate(equations, NUMBERS, start, t=(0, 2), rtol=1e-10, atol=1e-10)
    assert np.allclose(motion[x], expected(), atol=1e-7)
    assert np.allclose(motion[pushed[1]], 0, atol=1e-6)


def test_constraints_that_were_differentiated_twice() -> None:
    tau, omega = symbols("tau omega")
    force = gamma + tau * d(gamma)
    stabilised = omega**2 * LOOP + 2 * omega * d(LOOP) + d(LOOP, 2)
    residuals = [each.subs({lam: force}) for each in FORCES]
    equations = equations_from_differential([*residuals, stabilised], [x, y, gamma])
    found = simulate(
        equations, {**NUMBERS, tau: 0.1, omega: 10}, {x: 0.6, y: -0.8}, t=(0, 2), rtol=1e-10, atol=1e-10
    )[x]
    assert np.allclose(found, expected(), atol=1e-6)


@pytest.mark.parametrize(
    ("residuals", "unknowns", "message"),
    [
        ([d(x, 3) - x], [x], "derivative of x of order 3"),
        ([d(x) ** 2 - x], [x], "not linear in x'"),
        ([d(x) - y], [x, y], "expected as many"),
        ([d(x) - x], [x, y], "y is in none of the equations"),
        ([m * d(x, 2) + x * lam, m * d(y, 2), LOOP], [x, y, lam], "along the gradient of no constraint"),
    ],
)
def test_what_cannot_be_taken_is_named(residuals: list[object], unknowns: list[object], message: str) -> None:
    with pytest.raises(ModelError, match=message):
        equations_from_differential(residuals, unknowns)  # type: ignore[arg-type]
