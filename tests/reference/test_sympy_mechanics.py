"""SymPy's expectations of its own mechanics, at random points: constraints with multipliers.

Those of the rolling disc by LagrangesMethod are left out: they follow from a Lagrangian into which the rolling was
substituted, which is no principle of mechanics. Upright rolling has ``psi'' = -(C/A) phi' theta'``, -2 phi' theta'
for a thin disc, and not -6. `test_nonholonomic.py` has the disc.
Only relations that don't depend on the order and signs of equations are compared: accelerations and multipliers.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    System,
    Vector,
    forward_dynamics,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    sin,
    substitute,
    symbols,
    time_derivative,
    translate,
)
from tests.reference.mechanisms.problem import reference

TESTS = {test["id"]: test["quantities"] for test in reference("sympy_mechanics")["tests"]}


def quantity(test: str, name: str) -> tuple[dict[str, float], np.ndarray]:
    """Return the point and the values of an expectation."""
    found: dict[str, Any] = TESTS[test][name]
    return found["params"], np.array(found["values"]).reshape(found["shape"])


def test_disc_on_an_incline() -> None:
    p, rhs = quantity("test_lagrange::test_disc_on_an_incline_plane", "rhs")
    y, theta = functions_of_time("y theta")
    names = m, R, g, alpha = symbols("m R g alpha")
    disc = Body(translate(0, y, 0) * rotate("Z", theta), m, Iz=m * R**2 / 2)
    rolling = [y - R * theta]
    weight = Vector(ground, 0, g * sin(alpha), 0)
    solution = forward_dynamics(newton_euler(System([disc], (), [y, theta], rolling, weight)))
    values = substitute(
        [*solution.accelerations, *solution.multipliers], {name: p[name.name] for name in names}
    )
    assert_allclose([float(value) for value in values], rhs[2:, 0], rtol=1e-12)


@pytest.mark.parametrize("form", ["positions", "velocities"])
def test_pendulum_with_a_multiplier(form: str) -> None:
    p, multiplier = quantity("test_lagrange::test_nonminimal_pendulum", "lam_sol")
    a, b, m = *functions_of_time("q1 q2"), symbols("m")
    length = a**2 + b**2 - symbols("L") ** 2
    condition = length if form == "positions" else time_derivative(a) * 2 * a + time_derivative(b) * 2 * b
    bob = Body(translate(a, b, 0), m)
    equations = newton_euler(System([bob], (), [a, b], [condition], Vector(ground, 9.8, 0, 0)))
    state = {
        a: p["q1"],
        b: p["q2"],
        time_derivative(a): p["q1_dot"],
        time_derivative(b): p["q2_dot"],
        m: p["m"],
    }
    (value,) = substitute(forward_dynamics(equations).multipliers, state)
    assert_allclose(-float(value), multiplier.item(), rtol=1e-12)
