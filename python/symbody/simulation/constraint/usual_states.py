"""Consistent states of many motions at once, in the usual case.

The case is usual where the iteration from the guess ends on the constraints, all of these are independent there, and
speeds, not other rates, are given. The steps are those of `consistent_position` and `consistent_velocity`, which look
further where a case is not usual, and which explain why there is no state. No arithmetic crosses motions: a state does
not depend on the others.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr, time_derivative

from .consistent_position import APPROACHES, EXACT, term_sizes_of_many
from .gauss_newton import gauss_newton_of_many
from .kinematics import Kinematics, neutral_position
from .least_norm import RANK, row_sizes
from .many_systems import added, least_ratios, shortest_solutions, within_kernels
from .opposite_axes import are_turned

__all__ = ["UsualStates", "usual_states"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_STEPS = 30
"""The most steps of an iteration in the usual case."""


@dataclass(frozen=True, eq=False)
class UsualStates:
    """States of k motions.

    Attributes:
        q: the coordinates, shape (k, n_q).
        u: the speeds, shape (k, n).
        are_found: where they are known, shape (k,); elsewhere the case is not usual.
    """

    q: Array
    u: Array
    are_found: Flags


def usual_states(
    kinematics: Kinematics, p: Array, t: float, fixed: Mapping[Expr, Array], guess: Mapping[Expr, float]
) -> UsualStates:
    """Return the states of `consistent_state` for k motions, where these are usual.

    Args:
        kinematics: the constraints and the kinematics.
        p: the values of their parameters, shape (k, parameters).
        t: the time, in s.
        fixed: the given values of coordinates and speeds, each of shape (k,).
        guess: the values near which the others should be.
    """
    count, system = len(p), kinematics.system
    if not _may_be_usual(kinematics, fixed, guess):
        empty = (
            np.full((count, len(system.coordinates)), np.nan),
            np.full((count, len(system.speeds)), np.nan),
        )
        return UsualStates(*empty, np.zeros(count, dtype=bool))
    columns = np.ascontiguousarray(p.T)
    with np.errstate(all="ignore"):
        q, are_closed = _positions(kinematics, columns, t, fixed, guess)
        are_closed &= ~are_turned(kinematics, p, t, q.T)
        u, are_kept = _velocities(kinematics, columns, t, q, fixed, guess)
    return UsualStates(q.T, u.T, are_closed & are_kept)


def _may_be_usual(kinematics: Kinematics, fixed: Mapping[Expr, Array], guess: Mapping[Expr, float]) -> bool:
    """Return whether a case can be usual: no momenta, eliminated speeds or states, and no rates for speeds."""
    system = kinematics.system
    if system.momenta or kinematics.eliminated or kinematics.has_states or not kinematics.constraints:
        return False
    rates = {time_derivative(q) for q in system.coordinates} - {*system.speeds}
    return rates.isdisjoint(fixed) and rates.isdisjoint(guess)


def _positions(
    kinematics: Kinematics, p: Array, t: float, fixed: Mapping[Expr, Array], guess: Mapping[Expr, float]
) -> tuple[Array, Flags]:
    """Return the coordinates (n_q, k) nearest to their guess, and where they satisfy the constraints.

    Args:
        kinematics: the coordinates and constraints.
        p: the values of the parameters, a column for each case.
        t: the time.
        fixed: coordinates that are given, a value for each case.
        guess: where to look for the others.
    """
    coordinates, neutral = kinematics.system.coordinates, neutral_position(kinematics.system)
    start = np.empty((len(coordinates), p.shape[1]))
    for row, name, zero in zip(start, coordinates, neutral, strict=True):
        row[:] = fixed.get(name, guess.get(name, zero))
    free = np.array([name not in fixed for name in coordinates])
    if not kinematics.position_constraints:
        return start, np.asarray(np.isfinite(start).all(axis=0))
    problem = _Positions.at(kinematics, p, t, start, free)
    everyone = np.arange(p.shape[1])
    found = problem.solution(start, everyone)
    are_closed: Flags = np.asarray(problem.error(found, everyone) <= EXACT)
    problem.approach(found, start, np.flatnonzero(are_closed))
    return found, are_closed


@dataclass(frozen=True, eq=False)
class _Positions:
    """The equations ``phi(q, t) = 0`` of k motions for the free coordinates, relative to the sizes of their terms."""

    kinematics: Kinematics
    p: Array
    t: float
    scale: Array
    free: Flags

    @classmethod
    def at(cls, kinematics: Kinematics, p: Array, t: float, q: Array, free: Flags) -> _Positions:
        """Return the equations with the sizes of their terms at the start.

        Args:
            kinematics: the coordinates and constraints.
            p: the values of the parameters, a column for each case.
            t: the time.
            q: the coordinates at the start, a column for each case.
            free: which coordinates are not given.
        """
        _, phi_q, sizes = kinematics.position_of_many(t, q, p)
        return cls(kinematics, p, t, term_sizes_of_many(q, phi_q, sizes), free)

    def linearization(self, q: Array, which: NDArray[np.intp]) -> tuple[Array, Array]:
        """Return the scaled constraints (m, k), and their derivatives by the free coordinates (m, n, k)."""
        phi, phi_q, _ = self.kinematics.position_of_many(self.t, q, self.p[:, which])
        scale = self.scale[:, which]
        return phi / scale, phi_q[:, self.free] / scale[:, None]

    def error(self, q: Array, which: NDArray[np.intp]) -> Array:
        """Return the largest relative violation of each motion; infinity if a constraint is not finite."""
        phi, phi_q, sizes = self.kinematics.position_of_many(self.t, q, self.p[:, which])
        error = (np.abs(phi) / term_sizes_of_many(q, phi_q, sizes)).max(axis=0, initial=0.0)
        return np.asarray(np.where(np.isfinite(error), error, np.inf))

    def solution(self, q: Array, which: NDArray[np.intp]) -> Array:
        """Return the positions of some motions after Gauss-Newton steps of the free coordinates."""
        found = q.copy()
        if not self.free.any():
            return found

        def of_free(x: Array, some: NDArray[np.intp]) -> tuple[Array, Array]:
            at = q[:, some]
            at[self.free] = x
            return self.linearization(at, which[some])

        found[self.free] = gauss_newton_of_many(of_free, q[self.free], _STEPS)
        return found

    def approach(self, found: Array, start: Array, which: NDArray[np.intp]) -> None:
        """Move the positions of some motions on the constraints to those nearest to the start.

        Each step projects the difference to the start onto the tangent space, and then returns to the constraints.
        """
        share = np.ones(start.shape[1])
        for _ in range(APPROACHES):
            if not (len(which) and self.free.any()):
                return
            at = found[:, which]
            back = self._back(at, start[:, which], which)
            is_far = np.abs(back).max(axis=0) > 1e-10 * (1 + np.abs(at).max(axis=0))
            which, back, at = which[is_far], back[:, is_far], at[:, is_far]
            if not len(which):
                return
            nearer = self.solution(at + share[which] * back, which)
            is_better = self.error(nearer, which) <= EXACT
            is_better &= _distance(nearer, start[:, which]) < _distance(at, start[:, which])
            found[:, which] = np.where(is_better, nearer, at)
            goes_on = is_better | (share[which] > 1e-3)
            share[which] = np.where(is_better, np.minimum(1.0, 2 * share[which]), share[which] / 4)
            which = which[goes_on]

    def _back(self, found: Array, start: Array, which: NDArray[np.intp]) -> Array:
        """Return the differences to the start along the constraints."""
        _, J = self.linearization(found, which)
        back = np.zeros_like(found)
        back[self.free] = within_kernels(J, (start - found)[self.free])
        return back


def _distance(a: Array, b: Array) -> Array:
    return np.asarray(np.sqrt(added((a - b) ** 2, 0)))


def _velocities(
    kinematics: Kinematics,
    p: Array,
    t: float,
    q: Array,
    fixed: Mapping[Expr, Array],
    guess: Mapping[Expr, float],
) -> tuple[Array, Flags]:
    """Return the speeds (n, k) nearest to their guess, and where they satisfy the constraints, which are independent.

    Args:
        kinematics: the constraints and the kinematics.
        p: the values of their parameters, shape (parameters, k).
        t: the time, in s.
        q: the coordinates, shape (n_q, k).
        fixed: the given values, each of shape (k,).
        guess: the values near which the others should be.
    """
    speeds, m = kinematics.system.speeds, len(kinematics.constraints)
    slopes, drifts = kinematics.velocity_of_many(t, q, p)
    A, b = slopes[:m], -drifts[:m]
    u = np.empty((len(speeds), p.shape[1]))
    for row, name in zip(u, speeds, strict=True):
        row[:] = fixed.get(name, guess.get(name, 0.0))
    free = np.array([name not in fixed for name in speeds])
    is_finite = np.isfinite(A).all(axis=(0, 1)) & np.isfinite(b).all(axis=0) & np.isfinite(u).all(axis=0)
    A, b, u = (np.where(is_finite, x, 0.0) for x in (A, b, u))
    if free.any():
        u[free] += shortest_solutions(A[:, free], b - added(A * u, 1))
    are_kept = is_finite & (_violations(kinematics, p, t, q, (A, b, u)) <= EXACT).all(axis=0)
    return u, are_kept & _are_regular(kinematics, A)


def _violations(
    kinematics: Kinematics, p: Array, t: float, q: Array, equations: tuple[Array, Array, Array]
) -> Array:
    """Return the residuals of ``A u = b`` relative to the sizes of their terms, shape (m, k).

    Args:
        kinematics: the coordinates and constraints.
        p: the values of the parameters, a column for each case.
        t: the time.
        q: the coordinates, a column for each case.
        equations: A, b and u.
    """
    A, b, u = equations
    sizes = kinematics.position_of_many(t, q, p)[2]
    usual = np.zeros(b.shape)
    where = list(kinematics.system.holonomic)
    of_joints = np.where(np.isfinite(sizes), sizes, 0.0) / np.abs(q).max(axis=0, initial=1.0)
    usual[where] = of_joints[: len(where)]
    size = np.maximum(added(np.abs(A), 1), usual) * np.abs(u).max(axis=0, initial=0.0) + np.abs(b)
    return np.asarray(np.abs(added(A * u, 1) - b) / np.where(size > 0, size, 1))


def _are_regular(kinematics: Kinematics, A: Array) -> Flags:
    """Return where all constraints are independent, and leave a motion, shape (k,)."""
    m, n, count = A.shape
    if kinematics.rank < m or m > n or (m == n and not kinematics.is_rheonomic):
        return np.zeros(count, dtype=bool)
    scaled = A / row_sizes(np.moveaxis(A, -1, 0)).T.reshape(m, 1, count)
    are_regular = np.zeros(count, dtype=bool) if count <= _FEW else least_ratios(scaled) > RANK
    if not are_regular.all():
        s = np.linalg.svd(np.moveaxis(scaled[..., ~are_regular], -1, 0), compute_uv=False)
        are_regular[~are_regular] = s[:, -1] > RANK * s[:, 0]
    return are_regular


_FEW = 8
"""The number of matrices up to which their singular values take less time than bounds of these."""
