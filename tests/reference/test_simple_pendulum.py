"""IFToMM benchmark A01: a point mass on a massless rod, against its exact motion."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from symbody import cos, lagrange_equations, lambdify, newton_euler
from symbody.symbolic import t
from tests.reference.mechanisms.problem import reference
from tests.reference.mechanisms.simple_pendulum import PARAMETERS, L, g, m, mass_on_a_circle, rod, theta, x, y

ROWS = np.array(reference("simple_pendulum")["rows"])

VALUES = [PARAMETERS[symbol] for symbol in (m, L, g)]


def test_equation_of_motion() -> None:
    expected = m * L**2 * theta.diff(t, 2) + m * g * L * cos(theta)
    for formalism in (newton_euler, lagrange_equations):
        (residual,) = formalism(rod()).residuals
        assert residual == expected


def test_motion_is_the_exact_one() -> None:
    equations = lagrange_equations(rod())
    function = lambdify([theta, theta.diff(t), m, L, g], [equations.mass_matrix[0, 0], equations.forcing[0]])

    def rate(_: float, state: np.ndarray) -> tuple[float, float]:
        mass, force = function(*state, *VALUES)
        return state[1], force / mass

    at_rest = (np.pi, 0.0)
    motion = solve_ivp(
        rate, (0, ROWS[-1, 0]), at_rest, method="DOP853", t_eval=ROWS[:, 0], rtol=1e-13, atol=1e-14
    )
    angle, speed = motion.y
    # Ten seconds are four periods; the integrator's errors of 1e-13 a step add up to less than 1e-10.
    assert_allclose(np.cos(angle), ROWS[:, 1], atol=1e-10)
    assert_allclose(np.sin(angle), ROWS[:, 2], atol=1e-10)
    assert_allclose(speed, ROWS[:, 3], atol=1e-9)


def test_natural_coordinates_and_the_tension() -> None:
    equations = lagrange_equations(mass_on_a_circle())
    (multiplier,) = equations.multipliers
    accelerations = [x.diff(t, 2), y.diff(t, 2)]
    unknowns = [*accelerations, multiplier]
    rows = [*equations.residuals, *equations.baumgarte(0, 0)]
    function = lambdify([[x, y], [x.diff(t), y.diff(t)], unknowns, [m, L, g]], rows)
    for _, px, py, speed in ROWS:
        angular_acceleration = -VALUES[2] / VALUES[1] * px
        exact = [
            -py * angular_acceleration - px * speed**2,
            px * angular_acceleration - py * speed**2,
            # M q'' = Q + 2 r lambda: the rod pulls with -2 L lambda = m (L theta'^2 - g sin theta)
            -VALUES[0] * (VALUES[1] * speed**2 - VALUES[2] * py / VALUES[1]) / (2 * VALUES[1]),
        ]
        assert_allclose(function([px, py], [-py * speed, px * speed], exact, VALUES), 0, atol=1e-12 * 30)
