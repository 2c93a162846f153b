"""Small motions about an equilibrium: the eigenvalues of linear equations of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["SmallMotion", "pencil_eigenvalues"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SmallMotion:
    """The linear equations ``M x'' + C x' + S x = 0`` of motions that the constraints allow.

    Attributes:
        inertia: M.
        damping: C, with gyroscopic terms.
        stiffness: S, of loads, weight and multipliers.
    """

    inertia: Array
    damping: Array
    stiffness: Array

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the s of the motions ``x exp(s t)``, in 1/s, the fastest growing first.

        For conservative systems the squares of s are the eigenvalues of a symmetric pencil. This avoids the loss of
        digits that a double eigenvalue zero has in the general problem.
        """
        from scipy.linalg import eigh  # noqa: PLC0415 - slow to load, and not needed by simulations

        if self.is_conservative:
            try:
                squares = eigh(self.stiffness, self.inertia, eigvals_only=True)
                roots = np.sqrt(-_without_rounding(squares) + 0j)
                return _ordered(np.concatenate([roots, -roots]))
            except np.linalg.LinAlgError:
                pass
        n = len(self.inertia)
        right = np.block([[np.eye(n), np.zeros((n, n))], [np.zeros((n, n)), self.inertia]])
        left = np.block([[np.zeros((n, n)), np.eye(n)], [-self.stiffness, -self.damping]])
        return pencil_eigenvalues(left, right)

    @property
    def is_conservative(self) -> bool:
        """Whether there is no damping and no gyroscopic term, and the stiffness is symmetric."""
        S, size = self.stiffness, np.abs(self.stiffness).max(initial=0.0)
        return not self.damping.any() and bool(np.abs(S - S.T).max(initial=0.0) <= 1e-9 * size)


def _without_rounding(squares: Array) -> Array:
    """Replace values that are zero but for rounding by zero."""
    size = np.abs(squares).max(initial=0.0)
    return np.where(np.abs(squares) <= 1e-11 * size, 0.0, squares)


def pencil_eigenvalues(left: Array, right: Array) -> NDArray[np.complex128]:
    """Return the s of ``right s y = left y``, the fastest growing first, without those at infinity."""
    from scipy.linalg import eig  # noqa: PLC0415 - slow to load, and not needed by simulations

    values = np.asarray(eig(left, right, right=False), np.complex128)
    return _ordered(values[np.isfinite(values)])


def _ordered(values: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return eigenvalues, the fastest growing first."""
    order = np.lexsort((values.imag, -np.round(values.real, 9)))
    found: NDArray[np.complex128] = values[order] + 0.0
    return found
