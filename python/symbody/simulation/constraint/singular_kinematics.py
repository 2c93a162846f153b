"""Singular kinematics: positions at which speeds and rates of coordinates hardly determine each other.

In ``q' = K(q, t) u + k`` the entries of K have any units, so K is measured by its own values at neighbouring positions:
its rows and columns are scaled by the sizes that balance those [Ruiz 2001]. Singular values far from 1 then mean that
rates belong to vanishing speeds, as where ``u = q1' cos(q2)`` has cos(q2) = 0, or that speeds nearly depend on each
other everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr, time_derivative
from symbody.symbolic.given.arguments import brief

from .consistent_position import listed_values
from .kinematics import Kinematics

__all__ = ["another_choice", "singular_kinematics"]

Array = NDArray[np.float64]

ILL = 1e8
"""The ratio of a speed to a rate, beside usual ones, from which on half of the digits are lost."""
_HARMLESS = 1e3
"""The ratio up to which K is not examined further."""
_PLACES = 4
_ASIDE = 0.1
"""How far neighbouring positions are, relative to the largest coordinate, or to 1."""
_SHARE = 0.1
"""The share of the largest that a speed or rate has in a combination that names it."""


def singular_kinematics(kinematics: Kinematics, p: Array, t: float, q: Array) -> str:
    """Return which speeds and rates hardly determine each other at a position; the empty text if none.

    Args:
        kinematics: the kinematics, beside the values of their states.
        p: the values of their parameters.
        t: the time, in s.
        q: the coordinates, finite.
    """
    if kinematics.system.momenta:
        whole = kinematics.in_speeds
        return singular_kinematics(whole, kinematics.parameters_of(whole, p), t, q)
    system = kinematics.system
    if not system.has_quasi_velocities:
        return ""
    K = _slopes(kinematics, p, t, q)
    rates = [time_derivative(each) for each in system.coordinates]
    place = listed_values(system.coordinates, dict(zip(system.coordinates, q, strict=True)))
    strange = next((k for k, row in enumerate(K) if not np.isfinite(row).all()), None)
    if strange is not None:
        return f"{rates[strange]} = {brief(system.kinematics[rates[strange]])} is not finite at {place}"
    held, moving = np.abs(K).max(axis=0, initial=0.0) > 0, np.abs(K).max(axis=1, initial=0.0) > 0
    K = K[np.ix_(moving, held)]
    if not K.size or _distance(K) < _HARMLESS:
        return ""
    rows, columns = _balance(_usual(kinematics, p, t, q)[np.ix_(moving, held)])
    U, sizes, Vt = np.linalg.svd(K * rows[:, None] * columns, full_matrices=False)
    with np.errstate(divide="ignore"):
        worst = int(np.argmax(np.abs(np.log(sizes))))
    if 1 / ILL < sizes[worst] < ILL:
        return ""
    speeds = _named([u for u, is_held in zip(system.speeds, held, strict=True) if is_held], Vt[worst])
    moved = _named([rate for rate, moves in zip(rates, moving, strict=True) if moves], U[:, worst])
    only = [rate for rate in moved if rate not in speeds]
    least = max(float(sizes[worst]), np.finfo(float).eps)
    return (
        f"{_listed('speed', speeds)} and {_listed('rate', only or moved)} hardly determine each other at {place}: a "
        f"factor of {max(least, 1 / least):.1g} is between them, beside usual ones"
    )


def _listed(kind: str, names: Sequence[Expr]) -> str:
    more = ", ..." if len(names) > _MOST else ""
    return f"the {kind}{'s' if len(names) > 1 else ''} {', '.join(map(str, names[:_MOST]))}{more}"


_MOST = 6


def another_choice(kinematics: Kinematics) -> str:
    """Return the way out of singular kinematics."""
    if kinematics.system.eliminated and not kinematics.system.momenta:
        return (
            "choose other independent speeds, embedded(..., independent=[...]), or begin at another position"
        )
    return "choose other speeds or coordinates, or begin at another position"


def _slopes(kinematics: Kinematics, p: Array, t: float, q: Array) -> Array:
    with np.errstate(all="ignore"):
        A, _ = kinematics.velocity(t, q, p)
    return np.asarray(A[len(kinematics.constraints) :][: len(q)], dtype=np.float64)


def _usual(kinematics: Kinematics, p: Array, t: float, q: Array) -> Array:
    """Return the usual magnitudes of the entries of K: their medians at neighbouring positions."""
    step = _ASIDE * max(1.0, float(np.abs(q).max(initial=0.0)))
    draw = np.random.Generator(np.random.PCG64(1)).uniform(-step, step, (_PLACES, len(q)))
    beside = [np.abs(_slopes(kinematics, p, t, q + shift)) for shift in draw]
    finite = [each for each in beside if np.isfinite(each).all()] or [np.abs(_slopes(kinematics, p, t, q))]
    return np.asarray(np.median(finite, axis=0), dtype=np.float64)


def _distance(K: Array) -> float:
    """Return how far the singular values of K are from 1, as a ratio."""
    sizes = np.linalg.svd(K, compute_uv=False)
    least = float(sizes.min())
    return max(float(sizes.max()), 1 / least if least > 0 else np.inf)


def _balance(usual: Array) -> tuple[Array, Array]:
    """Return factors of rows and columns that bring the largest entry of each to 1."""
    rows, columns = np.ones(usual.shape[0]), np.ones(usual.shape[1])
    for _ in range(_SWEEPS):
        scaled = usual * rows[:, None] * columns
        rows = rows / np.sqrt(_or_one(scaled.max(axis=1)))
        columns = columns / np.sqrt(_or_one(scaled.max(axis=0)))
    return rows, columns


_SWEEPS = 12


def _or_one(sizes: Array) -> Array:
    return np.where(sizes > 0, sizes, 1.0)


def _named(names: Sequence[Expr], weights: Array) -> list[Expr]:
    share = np.abs(weights)
    return [name for name, own in zip(names, share, strict=True) if own > _SHARE * share.max()]
