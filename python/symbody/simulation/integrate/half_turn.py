"""Half turns: springs on angles that are known from -pi to pi alone, along a motion that turns them further."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from symbody.codegen import lambdify
from symbody.symbolic import free_symbols, t
from symbody.symbolic.given.arguments import brief

from .integrated import Integrated

__all__ = ["HalfTurn", "half_turns"]


class HalfTurn(NamedTuple):
    """A load whose angle jumps, and about when."""

    load: str
    t: float


def half_turns(motion: Integrated) -> Iterator[HalfTurn]:
    """Yield the loads whose angle jumps from pi to -pi or back between two instants of a motion."""
    model = motion.task.model
    jumping = [
        load for load in getattr(model.system, "loads", ()) if getattr(load, "jumping", None) is not None
    ]
    if not jumping:
        return
    names = (*model.coordinates, t, *motion.parameters)
    states = np.array(motion.outcome.states)[:, : len(model.coordinates)]
    instants = motion.task.instants[: len(states)]
    for load in jumping:
        angle = load.jumping
        (inserted,) = model.with_inputs((angle,))
        if free_symbols([inserted]) <= {*names}:
            values = lambdify([*names], [inserted])(*states.T, instants, *motion.parameters.values())[0]
            jumps = np.abs(np.diff(np.broadcast_to(values, instants.shape))) > np.pi
            if jumps.any():
                yield HalfTurn(brief(load), float(instants[int(np.argmax(jumps)) + 1]))
