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

__all__ = [
    "CANCELLED",
    "SURE",
    "TRIES",
    "ConfigurationSpace",
    "free_directions",
    "scaled",
    "time_goes_on",
    "walk_configurations",
]

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
SHORT = (1e-4, 1e-6)
"""Distances along a direction that show whether it is that of a motion; the second one if paths are much curved."""
ASIDE = 0.03
"""The part of such a distance by which a motion may leave its direction."""
DRAWN = 3
"""The number of directions that are tried."""


def walk_configurations(
    kinematics: Kinematics, p: Array, t: float, begin: Array, steps: int
) -> Iterator[Array]:
    """Yield the Jacobian of the constraints with respect to the speeds at positions that a mechanism reaches.

    Walks go from the first position along each freedom, to both sides. If that is singular, they start at neighbouring
    positions instead, where most constraints are independent: one of these for each set of dependent constraints. If
    constraints hold the time, it is one more coordinate, and b of ``A u + b`` the last column.

    There is no walk from a position where fewer constraints are independent than at almost every other, and where
    speeds that they allow don't lead along a motion, such as those across a straight truss of two bars: what is
    dependent there is so at no position nearby.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        begin: the coordinates of the first position.
        steps: the number of positions of each walk.
    """
    space = ConfigurationSpace(kinematics, p, t, follows_time=kinematics.is_rheonomic)
    for first in _departures(space, np.append(begin, t) if kinematics.is_rheonomic else begin):
        if not space.is_regular(first):
            continue
        for direction in _freedoms(space.slopes(first)[0]):
            for sign in (1.0, -1.0):
                yield from _walked(space, first, sign * direction, steps)


def time_goes_on(kinematics: Kinematics, p: Array, t: float, begin: Array) -> bool:
    """Return whether the constraints can be satisfied a step later, along the direction nearest to that of the time.

    Args:
        kinematics: the constraints, some of which hold the time.
        p: the values of their parameters.
        t: the time, in s.
        begin: the coordinates of the position.
    """
    space, place = ConfigurationSpace(kinematics, p, t, follows_time=True), np.append(begin, t)
    J, K = space.slopes(place)
    if not np.isfinite(J).all():
        return False
    free = free_directions(J)
    return bool(len(space.step(place, K @ (free.T @ free[:, -1]))))


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
    """The positions that satisfy the constraints at an instant, or at all of them: then time is the last coordinate.

    Attributes:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        held: the coordinates that are held.
        follows_time: whether time is a coordinate.
    """

    kinematics: Kinematics
    p: Array
    t: float
    held: Sequence[Expr] = ()
    follows_time: bool = False

    @cached_property
    def _is_free(self) -> NDArray[np.bool_]:
        return np.array([q not in self.held for q in self.kinematics.system.coordinates])

    @property
    def _may_vary(self) -> NDArray[np.bool_]:
        return np.append(self._is_free, True) if self.follows_time else self._is_free

    def _parts(self, place: Array) -> tuple[Array, float]:
        """Return the coordinates without the time, and the time."""
        return (place[:-1], float(place[-1])) if self.follows_time else (place, self.t)

    def slopes(self, place: Array) -> tuple[Array, Array]:
        """Return the Jacobian of constraints and held coordinates, and that of all coordinates, for the speeds."""
        m, (q, t) = len(self.kinematics.constraints), self._parts(place)
        with np.errstate(all="ignore"):
            A, b = self.kinematics.velocity(t, q, self.p)
        if self.follows_time:
            A = np.vstack([np.column_stack([A, b]), np.eye(1, A.shape[1] + 1, A.shape[1])])
        return np.vstack([A[:m], A[m:][~self._may_vary]]), A[m:]

    def step(self, place: Array, rates: Array) -> Array:
        """Return the position after a step, put back onto the constraints; an empty array if there is none."""
        if not rates.any():
            return np.zeros(0)
        found = place + STEP * max(1.0, float(np.abs(place).max())) * rates / np.abs(rates).max()
        q, t = self._parts(found)
        problem = Positions.at(self.kinematics, self.p, t, q)
        found[: len(q)] = problem.solution(q, self._is_free, BACK)
        return found if self._is_on(problem, found) else np.zeros(0)

    def _is_on(self, problem: Positions, place: Array) -> bool:
        return problem.error(self._parts(place)[0]) < CANCELLED * 1e-2

    def is_regular(self, place: Array) -> bool:
        """Return whether the speeds that the constraints allow at a position are those of motions.

        They are where as many constraints are independent as at almost every position. Elsewhere the constraints may
        leave them a displacement of second order alone; directions are drawn, and tried.
        """
        J, K = self.slopes(place)
        if not np.isfinite(J).all():
            return True  # a walk ends there
        free = free_directions(J)
        if J.shape[1] - len(free) >= self.kinematics.rank:
            return True
        draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (DRAWN, len(free)))
        return all(self._leads_along(place, K @ direction) for direction in draw @ free)

    def _leads_along(self, place: Array, rates: Array) -> bool:
        """Return whether a motion leads along rates of the coordinates, by short steps that are put back."""
        if not rates.any():
            return True
        return any(self._aside(place, size * rates / np.linalg.norm(rates)) < ASIDE for size in SHORT)

    def _aside(self, place: Array, step: Array) -> float:
        """Return by how much constraints change a step from a position, relative to its length."""
        away = step * max(1.0, float(np.abs(place).max()))
        found = place + away
        q, t = self._parts(found)
        scale = Positions.at(self.kinematics, self.p, t, q).scale

        def of_free(free: Array) -> tuple[Array, Array]:
            found[self._may_vary] = free
            return self._linearization(found, scale)

        found[self._may_vary] = gauss_newton(of_free, found[self._may_vary], BACK)
        return float(np.linalg.norm(found - place - away) / np.linalg.norm(away))

    def neighbours(self, place: Array, count: int, near: float = CANCELLED) -> Iterator[Array]:
        """Yield positions at a distance, near directions that the constraints allow to first order.

        At a singular position, most of these directions belong to no motion. So ``phi = 0`` is solved together with
        ``|q - q0| = r``, and the search cannot end where it started.
        """
        J, K = self.slopes(place)
        if not np.isfinite(J).all():
            return
        free = free_directions(J, near)
        draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (count, len(free)))
        for direction in draw @ free:
            found = self._at_distance(place, K @ direction)
            if len(found):
                yield found

    def _at_distance(self, place: Array, rates: Array) -> Array:
        """Return a position at the distance `AWAY`, near a direction; an empty array if there is none."""
        r = AWAY * max(1.0, float(np.abs(place).max()))
        if not rates.any():
            return np.zeros(0)
        found = place + r * rates / np.linalg.norm(rates)
        q, t = self._parts(found)
        scale = Positions.at(self.kinematics, self.p, t, q).scale

        def on_sphere(free: Array) -> tuple[Array, Array]:
            found[self._may_vary] = free
            phi, J = self._linearization(found, scale)
            away = (found - place) / r
            return np.append(phi / r**2, (away @ away - 1) / 2), np.vstack(
                [J / r**2, away[self._may_vary] / r]
            )

        found[self._may_vary] = gauss_newton(on_sphere, found[self._may_vary])
        is_away = float(np.linalg.norm(found - place)) > r / 2
        q, t = self._parts(found)
        return (
            found
            if is_away and self._is_on(Positions.at(self.kinematics, self.p, t, q), found)
            else np.zeros(0)
        )

    def _linearization(self, place: Array, scale: Array) -> tuple[Array, Array]:
        """Return the scaled constraints on positions and their derivatives with respect to what may vary."""
        q, t = self._parts(place)
        problem = Positions(self.kinematics, self.p, t, scale)
        phi, phi_q = problem.linearization(q, np.ones_like(self._is_free))
        if not self.follows_time:
            return phi, phi_q[:, self._is_free]
        m = len(self.kinematics.constraints)
        with np.errstate(all="ignore"):
            _, b = self.kinematics.velocity(t, q, self.p)
        phi_t = b[:m][[*self.kinematics.system.holonomic]] / scale - phi_q @ b[m:]
        return phi, np.column_stack([phi_q, phi_t])[:, self._may_vary]


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
