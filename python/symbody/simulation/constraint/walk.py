"""Walks along a mechanism: positions that it reaches from another, and the derivatives of its constraints there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr

from .consistent import Positions
from .kinematics import Kinematics

__all__ = ["CANCELLED", "Footing", "free_directions", "scaled", "walk"]

Array = NDArray[np.float64]

CANCELLED = 1e-7
"""The part of the gradients that may be left of a combination that cancels, at positions right to ten digits."""
BACK = 40
"""Steps of Gauss and Newton that lead back onto the constraints, at most; each one halves what is off, or more."""
STEP = 0.05
"""How far positions are apart, in rad or in parts of the lengths."""


def walk(kinematics: Kinematics, p: Array, t: float, begin: Array, steps: int) -> Iterator[Array]:
    """Yield the derivatives of the constraints by the speeds where a mechanism gets to, both ways.

    The first position itself comes first in either direction.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        begin: the coordinates of the first position.
        steps: how many positions to look at in either direction.
    """
    ground = Footing(kinematics, p, t)
    for sign in (1.0, -1.0):
        q, direction = begin, np.zeros(len(kinematics.system.speeds))
        for _ in range(steps):
            J, K = ground.slopes(q)
            if not np.isfinite(J).all():
                break
            yield J
            direction = _onward(J, direction, sign)
            q = ground.moved(q, K @ direction)
            if not len(q):
                break


@dataclass(frozen=True, eq=False)
class Footing:
    """Where positions are looked at.

    Attributes:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        held: coordinates that stay where they are.
    """

    kinematics: Kinematics
    p: Array
    t: float
    held: Sequence[Expr] = ()

    @cached_property
    def _is_free(self) -> NDArray[np.bool_]:
        return np.array([q not in self.held for q in self.kinematics.system.coordinates])

    def slopes(self, q: Array) -> tuple[Array, Array]:
        """Return the derivatives by the speeds of constraints and coordinates that are held, and of all coordinates."""
        m = len(self.kinematics.constraints)
        with np.errstate(all="ignore"):
            A, _ = self.kinematics.velocity(self.t, q, self.p)
        return np.vstack([A[:m], A[m:][~self._is_free]]), A[m:]

    def moved(self, q: Array, rates: Array) -> Array:
        """Return the position a step onward, put back onto the constraints; nothing where none is found."""
        if not rates.any():
            return np.zeros(0)
        onward = q + STEP * max(1.0, float(np.abs(q).max())) * rates / np.abs(rates).max()
        problem = Positions.at(self.kinematics, self.p, self.t, onward)
        found = problem.solved(onward, self._is_free, BACK)
        return found if problem.error(found) < CANCELLED * 1e-2 else np.zeros(0)

    def around(self, q: Array, count: int) -> Iterator[Array]:
        """Yield derivatives of the constraints where steps lead that they allow to first order, in some directions.

        Where several motions go on, most of these directions are of none of them, and lead to one none the less.
        """
        J, K = self.slopes(q)
        if not np.isfinite(J).all():
            return
        free = free_directions(J)
        draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (count, len(free)))
        for direction in draw @ free:
            found = self.moved(q, K @ direction)
            if len(found) and np.abs(found - q).max() > 1e-2 * STEP:
                yield self.slopes(found)[0]


def scaled(J: Array) -> Array:
    """Return the rows, each divided by its length."""
    lengths = np.linalg.norm(J, axis=1, keepdims=True)
    scaled: Array = J / np.where(lengths > CANCELLED * lengths.max(initial=0.0), lengths, 1.0)
    return scaled


def free_directions(J: Array) -> Array:
    """Return directions of the speeds that the constraints allow, orthonormal, a row each."""
    _, s, Vt = np.linalg.svd(scaled(J))
    return Vt[int(np.sum(s > CANCELLED * s.max(initial=0.0))) :]


def _onward(J: Array, before: Array, sign: float) -> Array:
    """Return a direction that the constraints allow: the one nearest to the direction before."""
    free = free_directions(J)
    if not len(free):
        return np.zeros(J.shape[1])
    onward = free.T @ (free @ before)
    length = np.linalg.norm(onward)
    return sign * free[-1] if length < 0.1 else np.asarray(onward / length, np.float64)
