"""Sizes and resistances of elements that depend on the state, and are negative at some instants of a motion."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from symbody.codegen import lambdify
from symbody.multibody import Element, System
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, free_symbols, t
from symbody.symbolic.given.arguments import brief

from .integrated import Integrated

__all__ = ["NegativeSize", "has_varying_sizes", "negative_sizes"]

_LOAD = "load"
"""That of a tyre, of which laws take none where it pulls."""


class NegativeSize(NamedTuple):
    """A size of a load that is negative: how far below zero at most, and since when."""

    name: str
    load: str
    depth: float
    t: float


def has_varying_sizes(model: Model) -> bool:
    """Return whether a size of an element depends on the state or the time; parameters are checked at the start."""
    return any(_varying(model))


def negative_sizes(motion: Integrated) -> Iterator[NegativeSize]:
    """Yield the sizes of elements that are negative at some instant of a motion."""
    model = motion.task.model
    varying = [*_varying(model)]
    if not varying:
        return
    names = (*model.state, t, *motion.parameters)
    states = np.array(motion.outcome.states)[:, : len(model.state)]
    instants = motion.task.instants[: len(states)]
    for load, name, size in varying:
        (inserted,) = model.with_inputs((size,))
        if free_symbols([inserted]) <= {*names}:
            found = lambdify([*names], [inserted])(*states.T, instants, *motion.parameters.values())[0]
            values = np.broadcast_to(found, instants.shape)
            if (values < 0).any():
                first = float(instants[int(np.argmax(values < 0))])
                yield NegativeSize(name, brief(load), -float(values.min()), first)


def _varying(model: Model) -> Iterator[tuple[Element, str, Expr]]:
    """Yield the elements with sizes that vary along a motion, the names of these, and their expressions."""
    loads = model.system.loads if isinstance(model.system, System) else ()
    for load in (each for each in loads if isinstance(each, Element)):
        for name, size in load.sizes.items():
            if name != _LOAD and any(leaf.depends_on_time or leaf == t for leaf in free_symbols([size])):
                yield load, name, size
