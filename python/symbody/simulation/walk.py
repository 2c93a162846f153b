"""Walks along a mechanism: positions that it reaches from one, and the derivatives of its constraints there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr

from .consistent import Positions
from .kinematics import Kinematics

__all__ = ["CANCELLED", "scaled", "walk"]

Array = NDArray[np.float64]

CANCELLED = 1e-7
"""The part of the gradients that may be left of a combination that cancels, at positions right to ten digits."""
STEP = 0.05
"""How far positions are apart, in rad or in parts of the lengths."""


def walk(
    kinematics: Kinematics, p: Array, t: float, begin: Array, steps: int, held: Sequence[Expr] = ()
) -> Iterator[Array]:
    """Yield the derivatives of the constraints by the speeds where a mechanism gets to, both ways.

    Behind the rows of the constraints stand those of the coordinates that are held. The first position itself comes
    first in either direction.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        begin: the coordinates of the first position.
        steps: how many positions to look at in either direction.
        held: coordinates that stay where they are.
    """
    coordinates, m = kinematics.system.coordinates, len(kinematics.constraints)
    is_free = np.array([q not in held for q in coordinates])
    rows = [*range(m), *(m + int(place) for place in np.flatnonzero(~is_free))]
    for sign in (1.0, -1.0):
        q, direction = begin, np.zeros(len(kinematics.system.speeds))
        for _ in range(steps):
            with np.errstate(all="ignore"):
                A, _ = kinematics.velocity(t, q, p)
            if not np.isfinite(A).all():
                break
            yield A[rows]
            direction = _onward(A[rows], direction, sign)
            q = _moved(kinematics, p, t, q, A[m:] @ direction, is_free)
            if not len(q):
                break


def scaled(J: Array) -> Array:
    """Return the rows, each divided by its length."""
    lengths = np.linalg.norm(J, axis=1, keepdims=True)
    scaled: Array = J / np.where(lengths > CANCELLED * lengths.max(initial=0.0), lengths, 1.0)
    return scaled


def _onward(J: Array, before: Array, sign: float) -> Array:
    """Return a direction that the constraints allow: the one nearest to the direction before."""
    _, s, Vt = np.linalg.svd(scaled(J))
    free = Vt[int(np.sum(s > CANCELLED * s.max(initial=0.0))) :]
    if not len(free):
        return np.zeros(J.shape[1])
    onward = free.T @ (free @ before)
    length = np.linalg.norm(onward)
    return sign * free[-1] if length < 0.1 else np.asarray(onward / length, np.float64)


def _moved(
    kinematics: Kinematics, p: Array, t: float, q: Array, rates: Array, is_free: NDArray[np.bool_]
) -> Array:
    """Return the position a step onward, put back onto the constraints; nothing where none is found."""
    if not rates.any():
        return np.zeros(0)
    onward = q + STEP * max(1.0, float(np.abs(q).max())) * rates / np.abs(rates).max()
    problem = Positions.at(kinematics, p, t, onward)
    found = problem.solved(onward, is_free)
    return found if problem.error(found) < CANCELLED * 1e-2 else np.zeros(0)
