"""Limits of joints along a motion: which ones it passes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from symbody.codegen import lambdify
from symbody.symbolic import Expr, free_symbols, t

from .integrated import Integrated

if TYPE_CHECKING:
    from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["Passed", "passed_limits", "unknown_limits"]

LIMIT = 1e-6
"""How far beyond its limit a joint is reported, relative to the largest coordinate; events are located more closely."""


class Passed(NamedTuple):
    """A joint beyond its limit: the most, and since when."""

    joint: str
    size: float
    t: float


def passed_limits(motion: Integrated) -> Iterator[Passed]:
    """Yield the joints that are beyond their limits at some instant of a motion."""
    model = motion.task.model
    names = _names(motion)
    states = np.array(motion.outcome.states)[:, : len(model.coordinates)]
    instants = motion.task.instants[: len(states)]
    for joint, excess in _excesses(motion):
        if free_symbols(list(excess)) <= {*names}:
            values = lambdify([*names], [*excess])(*states.T, instants, *motion.parameters.values())
            most = np.max([np.broadcast_to(value, instants.shape) for value in values], axis=0)
            beyond = most > LIMIT * (1 + np.abs(states).max(axis=1))
            if beyond.any():
                yield Passed(joint, float(most.max()), float(instants[np.argmax(beyond)]))


def unknown_limits(motion: Integrated) -> Iterator[str]:
    """Yield the joints whose limits hold symbols without a value, with these symbols."""
    for joint, excess in _excesses(motion):
        unknown = free_symbols(list(excess)) - {*_names(motion)}
        if unknown:
            yield f"{joint} hold {', '.join(sorted(map(str, unknown)))}"


def _names(motion: Integrated) -> tuple[Expr, ...]:
    return *motion.task.model.coordinates, t, *motion.parameters


def _excesses(motion: Integrated) -> Iterator[tuple[str, tuple[Expr, ...]]]:
    """Yield each joint with limits, and what is positive beyond them."""
    model = motion.task.model
    joints: tuple[PlacedJoint, ...] = getattr(model.system, "joints", ())
    for joint in joints:
        value, (low, high) = joint.measured, joint.limits
        if value is not None and (low, high) != (None, None):
            below = () if low is None else (low - value,)
            above = () if high is None else (value - high,)
            yield str(joint), model.with_inputs((*below, *above))
