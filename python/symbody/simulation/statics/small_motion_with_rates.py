"""Small motions with constraints on velocities that depend on the position or on states: ``A x' + B x + D z = 0``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.least_norm import least_norm

from .small_motion import SmallMotion, pencil_eigenvalues
from .small_motion_of_states import StatesAlong

__all__ = ["Rates", "SmallMotionWithRates"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Rates:
    """The constraints ``A x' + B x + D z = 0`` on small motions x that the other constraints allow.

    Attributes:
        velocity: A.
        position: B.
        states: D.
    """

    velocity: Array
    position: Array
    states: Array


@dataclass(frozen=True, eq=False)
class SmallMotionWithRates:
    """Small motions x, in which speeds v are free: ``x' = W v - A^+ (B x + D z)`` with ``A W = 0``.

    The equations of motion along W, and those of the states z, are of first order in ``y = (x, v, z)``. Each of these
    constraints has an eigenvalue of its own: ``x' + a x = 0`` has -a.

    Attributes:
        mechanical: M, C and S of ``M x'' + C x' + S x + S_z z = 0``, but for the forces of these constraints.
        states: how states act, and what they follow.
        rates: the constraints.
    """

    mechanical: SmallMotion
    states: StatesAlong
    rates: Rates

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the s of the motions ``y exp(s t)``, in 1/s, the fastest growing first."""
        return pencil_eigenvalues(*self.pencil)

    @property
    def pencil(self) -> tuple[Array, Array]:
        """F and E of ``E y' = F y``."""
        M, C, S = self.mechanical.inertia, self.mechanical.damping, self.mechanical.stiffness
        z, inverse = self.states, np.linalg.pinv(self.rates.velocity)
        _, W = least_norm(self.rates.velocity, np.zeros(len(self.rates.velocity)))
        x, v, k = len(M), W.shape[1], len(z.rate)
        # x' = Y y, so that x'' = Y y'
        Y = np.hstack([-inverse @ self.rates.position, W, -inverse @ self.rates.states])
        along, none = np.hstack([np.eye(x), np.zeros((x, v + k))]), np.zeros((k, x + v))
        right = np.vstack([along, W.T @ (M @ Y + C @ along), np.hstack([none, np.eye(k)]) - z.inertia @ Y])
        forces = np.hstack([-W.T @ S, np.zeros((v, v)), -W.T @ z.force])
        follow = np.hstack([z.stiffness, np.zeros((k, v)), z.rate]) + z.damping @ Y
        return np.vstack([Y, forces, follow]), right
