"""Nonlinear equations of any rank: damped Gauss-Newton steps, that is, the Levenberg-Marquardt method."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["Linearization", "gauss_newton"]

Array = NDArray[np.float64]
Linearization = Callable[[Array], tuple[Array, Array]]
"""Returns values and their Jacobian, which need not be finite."""

_STEPS = 200
_LARGEST_DAMPING = 1e12
_ROUNDING = 4e-16
"""A value that counts as zero."""
_NEARLY = 1e-11
"""A value below which a step that hardly improves it is the last one: rounding errors dominate."""


def gauss_newton(linearization: Linearization, start: Array, most: int = _STEPS) -> Array:
    """Return the point near a start that satisfies the equations as well as possible.

    Minimum-norm steps, ``min |F + J d|^2 + mu |d|^2`` with ``mu`` proportional to ``|F|^2``, converge quadratically
    near solutions, even if equations are dependent or solutions are not isolated [Yamashita & Fukushima 2001; Fan &
    Yuan 2005]. A step without improvement is repeated with more damping [More 1978].

    Args:
        linearization: the values and their Jacobian, scaled such that 1 is a large value.
        start: the start, shape (n,).
        most: the largest number of steps.
    """
    x, damping = np.array(start, dtype=np.float64), 1e-2
    F, J = linearization(x)
    for _ in range(most):
        error = float(F @ F)
        if not np.isfinite(error) or not np.isfinite(J).all() or damping > _LARGEST_DAMPING:
            break
        if error <= len(F) * _ROUNDING**2:
            break
        step = _damped_step(F, J, damping * error)
        expected = error - float(np.sum((F + J @ step) ** 2))
        if expected <= 1e-16 * error or np.abs(step).max() <= 1e-16 * np.abs(x).max():
            break
        F_next, J_next = linearization(x + step)
        gain = (error - float(F_next @ F_next)) / expected
        if gain > 1e-4:
            x, F, J = x + step, F_next, J_next
        if gain < 0.5 and error <= len(F) * _NEARLY**2:
            break
        damping = max(damping / 5, 1e-8) if gain > 0.75 else damping if gain > 0.25 else 4 * damping
    return x


def _damped_step(F: Array, J: Array, mu: float) -> Array:
    """Return ``d = -J^T (J J^T + mu 1)^-1 F``, without singular values that are rounding errors."""
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    kept = s > 1e-13 * s.max(initial=0.0)
    s, U, Vt = s[kept], U[:, kept], Vt[kept]
    step: Array = -(Vt.T @ (s / (s * s + mu) * (U.T @ F)))
    return step
