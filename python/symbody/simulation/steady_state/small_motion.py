"""Small motions about an equilibrium: the eigenvalues of linear equations of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.least_norm import inverse_and_kernel

__all__ = ["Rates", "SmallMotion", "StatesAlong"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StatesAlong:
    """How states z act on small motions x, and follow them: ``z' = G_a x'' + G_u x' + G_q x + G_z z``.

    Attributes:
        force: S_z, the derivatives of the residuals by the states.
        inertia: G_a.
        damping: G_u.
        stiffness: G_q.
        rate: G_z.
    """

    force: Array
    inertia: Array
    damping: Array
    stiffness: Array
    rate: Array


@dataclass(frozen=True, eq=False)
class Rates:
    """The constraints ``A x' + B x + D z = 0`` on small motions x that the other constraints allow.

    They are constraints on velocities that depend on the position or on states.

    Attributes:
        velocity: A.
        position: B.
        states: D.
    """

    velocity: Array
    position: Array
    states: Array


@dataclass(frozen=True, eq=False)
class SmallMotion:
    """The linear equations ``M x'' + C x' + S x + S_z z = 0`` of motions x that the constraints allow.

    Constraints on velocities that depend on the position leave speeds v free: ``x' = W v - A^+ (B x + D z)`` with
    ``A W = 0``. So the equations of motion along W, and those of the states z, are of first order in ``y = (x, v, z)``.
    Each of these constraints has an eigenvalue of its own: ``x' + a x = 0`` has -a. Without such constraints, v is x';
    without states, S_z and z are empty.

    Attributes:
        inertia: M.
        damping: C, with gyroscopic terms.
        stiffness: S, of loads, weight and multipliers.
        states: how states act, and what they follow.
        rates: the constraints on velocities that depend on the position or on states.
    """

    inertia: Array
    damping: Array
    stiffness: Array
    states: StatesAlong
    rates: Rates

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the s of the motions ``y exp(s t)``, in 1/s, the fastest growing first.

        For conservative systems the squares of s are the eigenvalues of a symmetric pencil. This avoids the loss of
        digits that a double eigenvalue zero has in the general problem.
        """
        from scipy.linalg import eig, eigh  # noqa: PLC0415 - slow to load, and not needed by simulations

        if self.is_conservative:
            try:
                squares = eigh(self.stiffness, self.inertia, eigvals_only=True)
                roots = np.sqrt(-_without_rounding(squares) + 0j)
                return _ordered(np.concatenate([roots, -roots]))
            except np.linalg.LinAlgError:
                pass
        values = np.asarray(eig(*self.pencil, right=False), np.complex128)
        return _ordered(values[np.isfinite(values)])  # those at infinity belong to coordinates without mass

    @property
    def is_conservative(self) -> bool:
        """Whether there is no damping and no gyroscopic term, and the stiffness is symmetric."""
        if len(self.states.rate) or len(self.rates.velocity):
            return False
        S, size = self.stiffness, np.abs(self.stiffness).max(initial=0.0)
        return not self.damping.any() and bool(np.abs(S - S.T).max(initial=0.0) <= 1e-9 * size)

    @property
    def pencil(self) -> tuple[Array, Array]:
        """F and E of ``E y' = F y``."""
        M, C, S = self.inertia, self.damping, self.stiffness
        z, (inverse, W) = self.states, inverse_and_kernel(self.rates.velocity)
        x, v, k = len(M), W.shape[1], len(z.rate)
        # x' = Y y, so that x'' = Y y'
        Y = np.hstack([-inverse @ self.rates.position, W, -inverse @ self.rates.states])
        along, of_states = np.eye(x, x + v + k), np.eye(k, x + v + k, x + v)
        right = np.vstack([along, W.T @ M @ Y, of_states - z.inertia @ Y])
        forces = -W.T @ (C @ Y + S @ along + z.force @ of_states)
        follow = z.damping @ Y + z.stiffness @ along + z.rate @ of_states
        return np.vstack([Y, forces, follow]), right


def _without_rounding(squares: Array) -> Array:
    """Replace values that are zero up to rounding by zero."""
    size = np.abs(squares).max(initial=0.0)
    return np.where(np.abs(squares) <= 1e-11 * size, 0.0, squares)


def _ordered(values: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return eigenvalues, the fastest growing first."""
    order = np.lexsort((values.imag, -np.round(values.real, 9)))
    found: NDArray[np.complex128] = values[order] + 0.0
    return found
