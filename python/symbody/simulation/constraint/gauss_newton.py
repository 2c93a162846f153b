"""Nonlinear equations of any rank: damped Gauss-Newton steps, that is, the Levenberg-Marquardt method."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .many_systems import added, shortest_solutions

__all__ = ["Linearization", "gauss_newton", "gauss_newton_of_many"]

Array = NDArray[np.float64]
Linearization = Callable[[Array], tuple[Array, Array]]
"""Returns values and their Jacobian, which need not be finite."""

LinearizationOfMany = Callable[[Array, NDArray[np.intp]], tuple[Array, Array]]
"""The same for some of many problems: at points (n, k), and with the numbers of the problems, shape (k,)."""

_STEPS = 200
_LARGEST_DAMPING = 1e12
_ROUNDING = 4e-16
"""A value that counts as zero."""
_DEPENDENT = 1e-13
"""A part of a row, or of the singular values, that counts as a rounding error."""
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
        if expected <= 1e-16 * error or np.abs(step).max(initial=0.0) <= 1e-16 * np.abs(x).max(initial=0.0):
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
    kept = s > _DEPENDENT * s.max(initial=0.0)
    s, U, Vt = s[kept], U[:, kept], Vt[kept]
    step: Array = -(Vt.T @ (s / (s * s + mu) * (U.T @ F)))
    return step


def gauss_newton_of_many(linearization: LinearizationOfMany, start: Array, most: int) -> Array:
    """Return the points of `gauss_newton` for k problems, which do not depend on each other; shape (n, k).

    Args:
        linearization: the values (m, k) and Jacobians (m, n, k) of some problems.
        start: the starts, shape (n, k).
        most: the largest number of steps.
    """
    x, left = start.copy(), np.arange(start.shape[1])
    damping = np.full(len(left), 1e-2)
    F, J = linearization(x, left)
    m = len(F)
    for _ in range(most):
        error = added(F * F, 0)
        goes_on = np.isfinite(error) & np.isfinite(J).all(axis=(0, 1)) & (error > m * _ROUNDING**2)
        goes_on &= damping <= _LARGEST_DAMPING
        left, damping, F, J, error = _some(goes_on, left, damping, F, J, error)
        if not len(left):
            break
        step = _damped_steps(F, J, damping * error)
        expected = error - added((F + added(J * step, 1)) ** 2, 0)
        at = x[:, left]
        goes_on = (expected > 1e-16 * error) & (np.abs(step).max(axis=0) > 1e-16 * np.abs(at).max(axis=0))
        left, damping, F, J, error, step, expected, at = _some(
            goes_on, left, damping, F, J, error, step, expected, at
        )
        F_next, J_next = linearization(at + step, left)
        gain = (error - added(F_next * F_next, 0)) / expected
        is_better = gain > 1e-4
        x[:, left] = np.where(is_better, at + step, at)
        F, J = np.where(is_better, F_next, F), np.where(is_better, J_next, J)
        damping = np.where(
            gain > 0.75, np.maximum(damping / 5, 1e-8), np.where(gain > 0.25, damping, 4 * damping)
        )
        left, damping, F, J = _some(~((gain < 0.5) & (error <= m * _NEARLY**2)), left, damping, F, J)
    return x


def _some(chosen: NDArray[np.bool_], *columns: Any) -> tuple[Any, ...]:
    """Return the chosen columns of each array."""
    return columns if chosen.all() else tuple(each[..., chosen] for each in columns)


def _damped_steps(F: Array, J: Array, mu: Array) -> Array:
    """Return `_damped_step` for each problem: the shortest (d, e) with ``J d + sqrt(mu) e = -F``."""
    m, n, count = J.shape
    both = np.zeros((m, n + m, count))
    both[:, :n] = J
    for place, row in enumerate(both):
        row[n + place] = np.sqrt(mu)
    return shortest_solutions(both, -F, _DEPENDENT)[:n]
