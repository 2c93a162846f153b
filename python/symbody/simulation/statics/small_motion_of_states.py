"""Small motions with states beside the mechanics: linear equations of first order in positions, speeds and states."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .small_motion import SmallMotion, pencil_eigenvalues

__all__ = ["SmallMotionOfStates", "StatesAlong"]

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
class SmallMotionOfStates:
    """The linear equations ``M x'' + C x' + S x + S_z z = 0`` of the mechanics, and those of the states z.

    Attributes:
        mechanical: M, C and S.
        states: how the states act, and what they follow.
    """

    mechanical: SmallMotion
    states: StatesAlong

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the s of the motions ``(x, x', z) exp(s t)``, in 1/s, the fastest growing first."""
        return pencil_eigenvalues(*self.pencil)

    @property
    def pencil(self) -> tuple[Array, Array]:
        """A and E of ``E y' = A y`` with ``y = (x, x', z)``."""
        M, C, S = self.mechanical.inertia, self.mechanical.damping, self.mechanical.stiffness
        z, n, k = self.states, len(self.mechanical.inertia), len(self.states.rate)
        none, beside = np.zeros((n, n)), np.zeros((n, k))
        left = np.block([[none, np.eye(n), beside], [-S, -C, -z.force], [z.stiffness, z.damping, z.rate]])
        right = np.block([[np.eye(n), none, beside], [none, M, beside], [beside.T, -z.inertia, np.eye(k)]])
        return left, right
