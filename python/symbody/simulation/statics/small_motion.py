"""Small motions about an equilibrium: whether one of them grows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["SmallMotion"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SmallMotion:
    """The linear equations ``M x'' + C x' + S x = 0`` of motions that the constraints allow.

    Attributes:
        inertia: M.
        damping: C, with gyroscopic terms.
        stiffness: S, of loads, weight and the multipliers' forces.
    """

    inertia: Array
    damping: Array
    stiffness: Array

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the s of the motions ``x exp(s t)``, in 1/s, the fastest growing first.

        Conservative systems have the squares of frequencies as the eigenvalues of a symmetric pencil: these are
        found without the loss of digits that a double zero has in the general one.
        """
        from scipy.linalg import eig, eigh  # noqa: PLC0415 - slow to load, and simulations need none

        if self.is_conservative:
            try:
                squares = eigh(self.stiffness, self.inertia, eigvals_only=True)
                roots = np.sqrt(-_without_rounding(squares) + 0j)
                return _sorted(np.concatenate([roots, -roots]))
            except np.linalg.LinAlgError:
                pass
        n = len(self.inertia)
        right = np.block([[np.eye(n), np.zeros((n, n))], [np.zeros((n, n)), self.inertia]])
        left = np.block([[np.zeros((n, n)), np.eye(n)], [-self.stiffness, -self.damping]])
        values = eig(left, right, right=False)
        return _sorted(values[np.isfinite(values)])

    @property
    def is_conservative(self) -> bool:
        """Whether nothing damps or turns, and the stiffness is symmetric."""
        S, size = self.stiffness, np.abs(self.stiffness).max(initial=0.0)
        return not self.damping.any() and bool(np.abs(S - S.T).max(initial=0.0) <= 1e-9 * size)


def _without_rounding(squares: Array) -> Array:
    """Return the values with those that are zero but for rounding as zero."""
    size = np.abs(squares).max(initial=0.0)
    return np.where(np.abs(squares) <= 1e-11 * size, 0.0, squares)


def _sorted(values: NDArray[np.complex128]) -> NDArray[np.complex128]:
    order = np.lexsort((values.imag, -np.round(values.real, 9)))
    ordered: NDArray[np.complex128] = values[order] + 0.0
    return ordered
