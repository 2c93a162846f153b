"""A planar double pendulum in natural coordinates with multipliers, and in minimal ones.

The reference's two integrations differ by 2.1e-12, but every row satisfies the equations to machine precision, so
accelerations and multipliers are compared row by row to 1e-12, relative to the largest entry of the row's vector.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from symbody import (
    Equations,
    acceleration,
    gravitational_energy,
    ground,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    newton_euler,
    origin,
    project,
    time_derivative,
)
from symbody.symbolic import t
from tests.reference.mechanisms.double_pendulum import ANGLES, GRAVITY, NATURAL, REFERENCE, minimal, natural
from tests.reference.mechanisms.double_pendulum import PARAMETERS as NUMBERS

ROWS = REFERENCE["rows"]
TOLERANCE = 1e-12

VALUES = list(NUMBERS.values())
PARAMETERS, theta = list(NUMBERS), ANGLES


def assert_close(value: ArrayLike, reference: ArrayLike) -> None:
    reference = np.asarray(reference, float)
    error = np.max(np.abs(np.asarray(value, float) - reference))
    assert error <= TOLERANCE * np.max(np.abs(reference))


def test_natural_coordinates_give_accelerations_and_multipliers() -> None:
    equations = lagrange_equations(natural())
    speeds = [q.diff(t) for q in NATURAL]
    at_rest = {q.diff(t, 2): 0 for q in NATURAL}
    curvature = [time_derivative(phi, 2).subs(at_rest) for phi in equations.constraints]
    function = lambdify(
        [NATURAL, speeds, PARAMETERS],
        [
            *equations.mass_matrix.entries,
            *equations.constraint_jacobian.entries,
            *equations.forcing,
            *curvature,
        ],
    )
    for row in ROWS:
        values = np.array(function(row["xy"], row["v"], VALUES), float)
        M, G, force, phi = np.split(values, [16, 24, 28])
        M, G = M.reshape(4, 4), G.reshape(2, 4)
        unknowns = np.linalg.solve(np.block([[M, -G.T], [G, np.zeros((2, 2))]]), [*force, *-phi])
        assert_close(unknowns[:4], row["a"])
        assert_close(unknowns[4:], row["lam"])


def test_the_residuals_vanish_at_every_row() -> None:
    equations = lagrange_equations(natural())
    speeds, accelerations = ([q.diff(t, order) for q in NATURAL] for order in (1, 2))
    function = lambdify(
        [NATURAL, speeds, accelerations, equations.multipliers, PARAMETERS],
        [*equations.residuals, *equations.baumgarte(0, 0), *equations.constraints],
    )
    for row in ROWS:
        residuals = function(row["xy"], row["v"], row["a"], row["lam"], VALUES)
        assert np.max(np.abs(residuals)) <= TOLERANCE * np.max(np.abs(row["a"]))


def forward_dynamics(equations: Equations) -> tuple[np.ndarray, ...]:
    """Return the angular accelerations of all rows."""
    speeds = [q.diff(t) for q in theta]
    function = lambdify([theta, speeds, PARAMETERS], [*equations.mass_matrix.entries, *equations.forcing])
    rows = (np.array(function(row["theta"], row["thetad"], VALUES), float) for row in ROWS)
    return tuple(np.linalg.solve(values[:4].reshape(2, 2), values[4:]) for values in rows)


@pytest.mark.parametrize("formalism", [newton_euler, lagrange_equations])
def test_minimal_coordinates_give_the_same_accelerations(formalism: type[Equations]) -> None:
    system = minimal()
    points = [
        component
        for body in system.bodies
        for component in project(acceleration(origin(body.frame)), ground).components[:2]
    ]
    derivatives = [[q.diff(t, order) if order else q for q in theta] for order in range(3)]
    function = lambdify([*derivatives, PARAMETERS], points)
    for row, angular in zip(ROWS, forward_dynamics(formalism(system)), strict=True):
        assert_close(function(row["theta"], row["thetad"], angular, VALUES), row["a"])


def test_energy_and_motion() -> None:
    system = minimal()
    speeds = [q.diff(t) for q in theta]
    energy = sum(kinetic_energy(body) + gravitational_energy(body, GRAVITY) for body in system.bodies)
    total = lambdify([theta, speeds, PARAMETERS], [energy])
    equations = newton_euler(system)
    function = lambdify([theta, speeds, PARAMETERS], [*equations.mass_matrix.entries, *equations.forcing])

    def rate(_: float, state: np.ndarray) -> np.ndarray:
        values = np.array(function(state[:2], state[2:], VALUES), float)
        return np.concatenate([state[2:], np.linalg.solve(values[:4].reshape(2, 2), values[4:])])

    start = [*REFERENCE["initial"]["theta"], *REFERENCE["initial"]["thetad"]]
    times = [row["t"] for row in ROWS]
    motion = solve_ivp(rate, (0, times[-1]), start, method="DOP853", t_eval=times, rtol=1e-13, atol=1e-13)
    for row, state in zip(ROWS, motion.y.T, strict=True):
        (value,) = total(row["theta"], row["thetad"], VALUES)
        assert abs(value - row["E"]) <= TOLERANCE * abs(row["E"])
        # The motion is chaotic: both integrations' errors of 1e-12 have grown in five seconds.
        assert np.max(np.abs(state - [*row["theta"], *row["thetad"]])) < 1e-9
