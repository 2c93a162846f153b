"""Angles of steady motions: whole turns are taken off, and parts that are turned far from the guess are reported."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from symbody.errors import notify
from symbody.symbolic.given.wording import joined_by_and

from .steady_problem import SteadyProblem

__all__ = ["without_whole_turns"]

Array = NDArray[np.float64]

_SAME = 1e-9
"""The relative difference of conditions that are the same."""


def without_whole_turns(problem: SteadyProblem, x: Array, forces: Array) -> Array:
    """Return the variables with angles at most half a turn from where the search began, within the limits.

    A notice says which angles are more than a quarter of a turn away: the search may have found another motion than
    the one that was meant, such as that of a bicycle with its fork turned round.

    Args:
        problem: the conditions, and where the search began.
        x: the variables of a solution.
        forces: its forces.
    """
    conditions, found = problem.balance.conditions, x.copy()
    far: list[int] = []
    for k, name in enumerate(conditions.variables):
        away = found[k] - problem.start[k]
        is_free = name in problem.balance.equations.coordinates and name not in problem.balance.fixed
        if not is_free or abs(away) <= pi / 2 or name in conditions.course.ignorable:
            continue
        if not _is_angle(problem, k, x, forces):
            continue
        low, high = problem.limits[k]
        turned = found[k] - 2 * pi * round(away / (2 * pi))
        if low <= turned <= high:
            found[k] = turned
        if abs(found[k] - problem.start[k]) > pi / 2:
            far.append(k)
    if far:
        names = [str(problem.names[k]) for k in far]
        values = [f"{name} = {found[k]:.6g}" for name, k in zip(names, far, strict=True)]
        begun = [f"{problem.start[k]:.6g}" for k in far]
        notify(
            f"{problem.where}: {joined_by_and(values)} rad {'is' if len(far) == 1 else 'are'} more than a quarter of a "
            f"turn from where the search began, at {joined_by_and(begun)}: check that this is the motion that you "
            f"mean; if not, give a guess, or limits such as limits={{{names[0]}: (-1, 1)}}"
        )
    return found


def _is_angle(problem: SteadyProblem, k: int, x: Array, forces: Array) -> bool:
    """Return whether the conditions have the period of a whole turn in a variable, at points around a solution."""
    balance, draw = problem.balance, np.random.Generator(np.random.PCG64(k))
    for _ in range(2):
        here = x + draw.uniform(-0.3, 0.3, len(x)) * np.maximum(np.abs(x), 1)
        there = here.copy()
        there[k] += 2 * pi
        one, other = (balance.values(each, forces)[0] for each in (here, there))
        if not np.all(np.abs(one - other) <= _SAME * balance.scale(here, forces)):
            return False
    return True
