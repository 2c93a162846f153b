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
    with np.errstate(all="ignore"):
        q, are_closed = _positions(kinematics, p, t, fixed, guess)
        are_closed &= ~are_turned(kinematics, p, t, q)
        u, are_kept = _velocities(kinematics, p, t, q, fixed, guess)
    return UsualStates(q, u, are_closed & are_kept)


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
    """Return the coordinates nearest to their guess, and where they satisfy the constraints.

    Args:
        kinematics: the coordinates and constraints.
        p: the values of the parameters, a row for each case.
        t: the time.
        fixed: coordinates that are given, a value for each case.
        guess: where to look for the others.
    """
    coordinates, neutral = kinematics.system.coordinates, neutral_position(kinematics.system)
    start = np.empty((len(p), len(coordinates)))
    for place, (name, zero) in enumerate(zip(coordinates, neutral, strict=True)):
        start[:, place] = fixed.get(name, guess.get(name, zero))
    free = np.array([name not in fixed for name in coordinates])
    if not kinematics.position_constraints:
        return start, np.asarray(np.isfinite(start).all(axis=1))
    problem = _Positions.at(kinematics, p, t, start, free)
    found = problem.solution(start, np.arange(len(p)))
    are_closed: Flags = np.asarray(problem.error(found, np.arange(len(p))) <= EXACT)
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
            p: the values of the parameters, a row for each case.
            t: the time.
            q: the coordinates at the start, a row for each case.
            free: which coordinates are not given.
        """
        _, phi_q, sizes = kinematics.position_of_many(t, q.T, p.T)
        return cls(kinematics, p, t, term_sizes_of_many(q.T, phi_q, sizes).T, free)

    def linearization(self, q: Array, which: NDArray[np.intp]) -> tuple[Array, Array]:
        """Return the scaled constraints (k, m), and their derivatives by the free coordinates (k, m, n)."""
        phi, phi_q, _ = self.kinematics.position_of_many(self.t, q.T, self.p[which].T)
        scale = self.scale[which]
        slopes = np.ascontiguousarray(np.moveaxis(phi_q[:, self.free], -1, 0))
        return phi.T / scale, slopes / scale[:, :, None]

    def error(self, q: Array, which: NDArray[np.intp]) -> Array:
        """Return the largest relative violation of each motion; infinity if a constraint is not finite."""
        phi, phi_q, sizes = self.kinematics.position_of_many(self.t, q.T, self.p[which].T)
        error = (np.abs(phi) / term_sizes_of_many(q.T, phi_q, sizes)).max(axis=0, initial=0.0)
        return np.asarray(np.where(np.isfinite(error), error, np.inf))

    def solution(self, q: Array, which: NDArray[np.intp]) -> Array:
        """Return the positions of some motions after Gauss-Newton steps of the free coordinates."""
        found = q.copy()
        if not self.free.any():
            return found

        def of_free(x: Array, some: NDArray[np.intp]) -> tuple[Array, Array]:
            at = q[some]
            at[:, self.free] = x
            return self.linearization(at, which[some])

        found[:, self.free] = gauss_newton_of_many(of_free, q[:, self.free], _STEPS)
        return found

    def approach(self, found: Array, start: Array, which: NDArray[np.intp]) -> None:
        """Move the positions of some motions on the constraints to those nearest to the start.

        Each step projects the difference to the start onto the tangent space, and then returns to the constraints.
        """
        share = np.ones(len(start))
        for _ in range(APPROACHES):
            if not (len(which) and self.free.any()):
                return
            back = self._back(found[which], start[which], which)
            is_far = np.abs(back).max(axis=1) > 1e-10 * (1 + np.abs(found[which]).max(axis=1))
            which, back = which[is_far], back[is_far]
            nearer = self.solution(found[which] + share[which, None] * back, which)
            is_better = self.error(nearer, which) <= EXACT
            is_better &= _distance(nearer, start[which]) < _distance(found[which], start[which])
            found[which[is_better]] = nearer[is_better]
            goes_on = is_better | (share[which] > 1e-3)
            share[which] = np.where(is_better, np.minimum(1.0, 2 * share[which]), share[which] / 4)
            which = which[goes_on]

    def _back(self, found: Array, start: Array, which: NDArray[np.intp]) -> Array:
        """Return the differences to the start along the constraints."""
        _, J = self.linearization(found, which)
        _, s, Vt = np.linalg.svd(J / row_sizes(J), full_matrices=False)
        Vt = np.where((s > RANK * s.max(axis=1, keepdims=True, initial=0.0))[:, :, None], Vt, 0.0)
        away = (start - found)[:, self.free]
        across = (Vt * away[:, None, :]).sum(axis=2)
        back = np.zeros_like(found)
        back[:, self.free] = away - (Vt * across[:, :, None]).sum(axis=1)
        return back


def _distance(a: Array, b: Array) -> Array:
    return np.asarray(np.sqrt(((a - b) ** 2).sum(axis=1)))


def _velocities(
    kinematics: Kinematics,
    p: Array,
    t: float,
    q: Array,
    fixed: Mapping[Expr, Array],
    guess: Mapping[Expr, float],
) -> tuple[Array, Flags]:
    """Return the speeds nearest to their guess, and where they satisfy the constraints, which are independent.

    Args:
        kinematics: the constraints and the kinematics.
        p: the values of their parameters, shape (k, parameters).
        t: the time, in s.
        q: the coordinates, shape (k, n_q).
        fixed: the given values, each of shape (k,).
        guess: the values near which the others should be.
    """
    speeds, m = kinematics.system.speeds, len(kinematics.constraints)
    slopes, drifts = kinematics.velocity_of_many(t, q.T, p.T)
    A, b = np.ascontiguousarray(np.moveaxis(slopes[:m], -1, 0)), -drifts[:m].T
    u = np.empty((len(p), len(speeds)))
    for place, name in enumerate(speeds):
        u[:, place] = fixed.get(name, guess.get(name, 0.0))
    free = np.array([name not in fixed for name in speeds])
    is_finite = np.isfinite(A).all(axis=(1, 2)) & np.isfinite(b).all(axis=1) & np.isfinite(u).all(axis=1)
    A, b, u = (np.where(is_finite.reshape(-1, *[1] * (x.ndim - 1)), x, 0.0) for x in (A, b, u))
    if free.any():
        u[:, free] += _least_norm(A[:, :, free], b - (A * u[:, None, :]).sum(axis=2))
    are_kept = is_finite & (_violations(kinematics, p, t, q, (A, b, u)) <= EXACT).all(axis=1)
    return u, are_kept & _are_regular(kinematics, A)


def _violations(
    kinematics: Kinematics, p: Array, t: float, q: Array, equations: tuple[Array, Array, Array]
) -> Array:
    """Return the residuals of ``A u = b`` relative to the sizes of their terms, shape (k, m).

    Args:
        kinematics: the coordinates and constraints.
        p: the values of the parameters, a row for each case.
        t: the time.
        q: the coordinates, a row for each case.
        equations: A, b and u.
    """
    A, b, u = equations
    sizes = kinematics.position_of_many(t, q.T, p.T)[2].T
    usual = np.zeros(b.shape)
    where = list(kinematics.system.holonomic)
    of_joints = np.where(np.isfinite(sizes), sizes, 0.0) / np.abs(q).max(axis=1, initial=1.0)[:, None]
    usual[:, where] = of_joints[:, : len(where)]
    size = np.maximum(np.abs(A).sum(axis=2), usual) * np.abs(u).max(axis=1, initial=0.0)[:, None] + np.abs(b)
    off: Array = np.abs((A * u[:, None, :]).sum(axis=2) - b) / np.where(size > 0, size, 1)
    return off


def _least_norm(A: Array, b: Array) -> Array:
    """Return the shortest solutions of many linear systems, as in `least_norm`."""
    size = row_sizes(A)
    U, s, Vt = np.linalg.svd(A / size, full_matrices=False)
    is_kept = s > RANK * s.max(axis=1, keepdims=True, initial=0.0)
    along = (U * (b / size[:, :, 0])[:, :, None]).sum(axis=1)
    along = np.where(is_kept, along / np.where(is_kept, s, 1.0), 0.0)
    return np.asarray((Vt * along[:, :, None]).sum(axis=1))


def _are_regular(kinematics: Kinematics, A: Array) -> Flags:
    """Return where all constraints are independent, and leave a motion, shape (k,)."""
    m, n = A.shape[1:]
    if kinematics.rank < m or m > n or (m == n and not kinematics.is_rheonomic):
        return np.zeros(len(A), dtype=bool)
    s = np.linalg.svd(A / row_sizes(A), compute_uv=False)
    return np.asarray(s[:, -1] > RANK * s[:, 0])
