"""Walks through the configuration space of a mechanism, with the Jacobian of its constraints at each position."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr

from .consistent_position import Positions
from .gauss_newton import gauss_newton
from .kinematics import Kinematics
from .vanishing_combinations import vanishing_combinations

__all__ = ["CANCELLED", "ConfigurationSpace", "free_directions", "scaled", "walk_configurations"]

Array = NDArray[np.float64]

CANCELLED = 1e-7
"""The relative size of a combination of gradients that counts as zero, at positions accurate to ten digits."""
SURE = 1e-3
"""The same at positions with half as many accurate digits, as solutions next to singular positions are."""
BACK = 40
"""The most Gauss-Newton steps that lead back onto the constraints; each of them halves the violation, or better."""
STEP = 0.05
"""The distance between positions, in rad or relative to the lengths."""
AWAY = 0.2
"""The distance of neighbouring positions, in the same units."""
MOST_FREEDOMS = 4
"""The most freedoms along which walks go from one position."""
TRIES, DEPARTURES = 48, 12
"""The number of directions in which a walk may start, and the number of successful ones that is enough."""


def walk_configurations(
    kinematics: Kinematics, p: Array, t: float, begin: Array, steps: int
) -> Iterator[Array]:
    """Yield the Jacobian of the constraints with respect to the speeds at positions that a mechanism reaches.

    Walks go from the first position along each freedom, to both sides. If that is singular, they start at neighbouring
    positions instead, where most constraints are independent: one of these for each set of dependent constraints.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        begin: the coordinates of the first position.
        steps: the number of positions of each walk.
    """
    space = ConfigurationSpace(kinematics, p, t)
    for first in _departures(space, begin):
        for direction in _freedoms(space.slopes(first)[0]):
            for sign in (1.0, -1.0):
                yield from _walked(space, first, sign * direction, steps)


def _walked(space: ConfigurationSpace, begin: Array, direction: Array, steps: int) -> Iterator[Array]:
    q = begin
    for _ in range(steps):
        J, K = space.slopes(q)
        if not np.isfinite(J).all():
            break
        yield J
        direction = _onward(J, direction)
        q = space.step(q, K @ direction)
        if not len(q):
            break


def _departures(space: ConfigurationSpace, begin: Array) -> list[Array]:
    """Return the position, or neighbours on different branches if more constraints are independent there."""
    found, rank = [begin], _rank(space.slopes(begin)[0])
    while True:
        places = islice(space.neighbours(found[0], TRIES, SURE), DEPARTURES)
        beside = [(q, space.slopes(q)[0]) for q in places]
        movable = [(q, J, _rank(J)) for q, J in beside if _rank(J) < J.shape[1]]
        higher = max((other for _, _, other in movable), default=0)
        if higher <= rank:
            return found
        found = list({_dependence(J): q for q, J, other in movable if other == higher}.values())
        rank = higher


def _rank(J: Array) -> int:
    """Return how many constraints are certainly independent."""
    return J.shape[1] - len(free_directions(J, SURE)) if np.isfinite(J).all() else 0


def _dependence(J: Array) -> tuple[tuple[int, ...], ...]:
    """Return which constraints are dependent, by groups."""
    return tuple(tuple(np.flatnonzero(y).tolist()) for y in vanishing_combinations(scaled(J), CANCELLED))


@dataclass(frozen=True, eq=False)
class ConfigurationSpace:
    """The positions that satisfy the constraints at an instant.

    Attributes:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        held: the coordinates that are held.
    """

    kinematics: Kinematics
    p: Array
    t: float
    held: Sequence[Expr] = ()

    @cached_property
    def _is_free(self) -> NDArray[np.bool_]:
        return np.array([q not in self.held for q in self.kinematics.system.coordinates])

    def slopes(self, q: Array) -> tuple[Array, Array]:
        """Return the Jacobian of constraints and held coordinates, and that of all coordinates, for the speeds."""
        m = len(self.kinematics.constraints)
        with np.errstate(all="ignore"):
            A, _ = self.kinematics.velocity(self.t, q, self.p)
        return np.vstack([A[:m], A[m:][~self._is_free]]), A[m:]

    def step(self, q: Array, rates: Array) -> Array:
        """Return the position after a step, put back onto the constraints; an empty array if there is none."""
        if not rates.any():
            return np.zeros(0)
        onward = q + STEP * max(1.0, float(np.abs(q).max())) * rates / np.abs(rates).max()
        problem = Positions.at(self.kinematics, self.p, self.t, onward)
        found = problem.solution(onward, self._is_free, BACK)
        return found if problem.error(found) < CANCELLED * 1e-2 else np.zeros(0)

    def neighbours(self, q: Array, count: int, near: float = CANCELLED) -> Iterator[Array]:
        """Yield positions at a distance, near directions that the constraints allow to first order.

        At a singular position, most of these directions belong to no motion. So ``phi = 0`` is solved together with
        ``|q - q0| = r``, and the search cannot end where it started.
        """
        J, K = self.slopes(q)
        if not np.isfinite(J).all():
            return
        free = free_directions(J, near)
        draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (count, len(free)))
        for direction in draw @ free:
            found = self._at_distance(q, K @ direction)
            if len(found):
                yield found

    def _at_distance(self, q: Array, rates: Array) -> Array:
        """Return a position at the distance `AWAY`, near a direction; an empty array if there is none."""
        r = AWAY * max(1.0, float(np.abs(q).max()))
        if not rates.any():
            return np.zeros(0)
        found = q + r * rates / np.linalg.norm(rates)
        problem = Positions.at(self.kinematics, self.p, self.t, found)

        def on_sphere(free: Array) -> tuple[Array, Array]:
            found[self._is_free] = free
            phi, J = problem.linearization(found, self._is_free)
            away = (found - q) / r
            return np.append(phi / r**2, (away @ away - 1) / 2), np.vstack(
                [J / r**2, away[self._is_free] / r]
            )

        found[self._is_free] = gauss_newton(on_sphere, found[self._is_free])
        is_away = float(np.linalg.norm(found - q)) > r / 2
        return found if is_away and problem.error(found) < CANCELLED * 1e-2 else np.zeros(0)


def scaled(J: Array, near: float = CANCELLED) -> Array:
    """Divide each row by its length, unless that is at most the given part of the longest one."""
    lengths = np.linalg.norm(J, axis=1, keepdims=True)
    scaled: Array = J / np.where(lengths > near * lengths.max(initial=0.0), lengths, 1.0)
    return scaled


def free_directions(J: Array, near: float = CANCELLED) -> Array:
    """Return an orthonormal basis of the speeds that the constraints allow, one row for each.

    Args:
        J: the derivatives of the constraints by the speeds.
        near: the ratio to the largest singular value up to which one counts as zero.
    """
    _, s, Vt = np.linalg.svd(scaled(J, near))
    return Vt[int(np.sum(s > near * s.max(initial=0.0))) :]


def _freedoms(J: Array) -> list[Array]:
    """Return directions that span what the constraints allow, each mostly along one speed; zero if they allow none.

    By Gram-Schmidt elimination with pivots, so that they don't depend on the basis of the null space.
    """
    left = free_directions(J).T if np.isfinite(J).all() else np.zeros((J.shape[1], 0))
    found: list[Array] = []
    for _ in range(min(left.shape[1], MOST_FREEDOMS)):
        sizes = np.linalg.norm(left, axis=1)
        first = int(np.flatnonzero(sizes >= (1 - SURE) * sizes.max())[0])
        share = left[first] / sizes[first]
        found.append(left @ share)
        left = left - np.outer(left @ share, share)
    return found or [np.zeros(J.shape[1])]


def _onward(J: Array, before: Array) -> Array:
    """Return the direction that the constraints allow and that is nearest to the previous one; zero if none is near."""
    free = free_directions(J)
    onward = free.T @ (free @ before)
    length = np.linalg.norm(onward)
    return np.asarray(onward / length, np.float64) if length >= 0.1 else np.zeros(J.shape[1])
