"""Limits of joints along a motion: which ones it passes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.watched_limit import LIMIT, WatchedLimit, watched_limits
from symbody.symbolic import Expr, free_symbols, t

from .integrated import Integrated

__all__ = ["Passed", "passed_limits", "strange_limits", "unknown_limits"]

Array = NDArray[np.float64]

_TOO_WIDE = (
    "are a turn apart or more, and can't be checked: it closes a loop in space, where its angle is known up to whole "
    "turns; let another joint close the loop by loop=True"
)


class Passed(NamedTuple):
    """A joint beyond its limit: the most, and since when."""

    joint: str
    size: float
    t: float


def passed_limits(motion: Integrated) -> Iterator[Passed]:
    """Yield the joints that are beyond their limits at some instant of a motion."""
    known = _known(motion)
    if not known:
        return
    states, instants = _states(motion)
    strange = {joint for joint, _ in strange_limits(motion)}
    for watched in known:
        if watched.joint not in strange:
            most = np.max(_excesses(motion, watched), axis=0)
            beyond = most > LIMIT * (1 + np.abs(states).max(axis=1))
            if beyond.any():
                yield Passed(watched.joint, float(most.max()), float(instants[np.argmax(beyond)]))


def unknown_limits(motion: Integrated) -> Iterator[str]:
    """Yield the joints whose limits hold symbols without a value, with these symbols."""
    for watched in _watched(motion):
        unknown = free_symbols(list(watched.excess)) - {*_names(motion)}
        if unknown:
            yield f"{watched.joint} hold {', '.join(sorted(map(str, unknown)))}"


def strange_limits(motion: Integrated) -> Iterator[tuple[str, str]]:
    """Yield the joints whose limits have values that can't be limits, and what is wrong with these."""
    for watched in _known(motion):
        excess = _excesses(motion, watched)
        if len(excess) < 2:
            continue
        width = -float(excess[0][0] + excess[1][0])
        if width <= 0:
            yield (
                watched.joint,
                "have the least value above the largest one, so that no position is within them",
            )
        elif watched.limit.is_within_a_turn and width >= 2 * np.pi:
            yield watched.joint, _TOO_WIDE


def _excesses(motion: Integrated, watched: WatchedLimit) -> list[Array]:
    """Return how far a joint is beyond its limits at all instants."""
    states, instants = _states(motion)
    return watched.excesses(
        dict(zip(_names(motion), (*states.T, instants, *motion.parameters.values()), strict=True))
    )


def _states(motion: Integrated) -> tuple[Array, Array]:
    """Return the coordinates at the instants that were reached, and these."""
    states = np.array(motion.outcome.states)[:, : len(motion.task.model.coordinates)]
    return states, motion.task.instants[: len(states)]


def _names(motion: Integrated) -> tuple[Expr, ...]:
    return *motion.task.model.coordinates, t, *motion.parameters


def _known(motion: Integrated) -> list[WatchedLimit]:
    """Return the joints whose limits have values."""
    all_watched = [*_watched(motion)]
    names = {*_names(motion)} if all_watched else set()
    return [each for each in all_watched if free_symbols(list(each.excess)) <= names]


def _watched(motion: Integrated) -> Iterator[WatchedLimit]:
    """Yield each joint with limits."""
    model = motion.task.model
    return watched_limits(model.system, model.with_inputs)
