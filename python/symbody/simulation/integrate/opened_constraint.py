"""Constraints that were left out as redundant: whether a motion keeps them at all instants.

They follow from the others on the branch where the motion begins. On another branch, which an integrator may take at a
singular position, they need not hold: the mechanism comes apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.multibody.named_constraint import named_constraints
from symbody.simulation.constraint.consistent_position import term_sizes_of_many
from symbody.simulation.constraint.kinematics import kinematics_in

from .integrated import Integrated

__all__ = ["LEFT", "Opened", "opened_constraints"]

Array = NDArray[np.float64]

LEFT = 1e-3
"""The relative violation above which a motion has left a constraint: unconstrained drift is smaller."""


class Opened(NamedTuple):
    """A constraint that a motion leaves: its name, the largest violation relative to its terms, and since when."""

    name: str
    size: float
    t: float


def opened_constraints(motion: Integrated) -> Iterator[Opened]:
    """Yield the constraints on positions that were left out, and that do not hold at some instant of a motion."""
    left_out = motion.task.model.system.left_out
    if not left_out or motion.outcome.failure is not None:
        return
    system = motion.task.model.system.whole
    places = [system.multipliers.index(multiplier) for multiplier in left_out]
    instants, off = _violations(motion)
    for row, place in enumerate(system.holonomic):
        beyond = off[row] > LEFT
        if place in places and beyond.any():
            (name,) = named_constraints(system.conditions, [place])
            yield Opened(name, float(off[row].max()), float(instants[int(np.argmax(beyond))]))


def _violations(motion: Integrated) -> tuple[Array, Array]:
    """Return the instants, and the constraints on positions relative to their terms, shape (m, instants)."""
    model, outcome = motion.task.model, motion.outcome
    kinematics = kinematics_in(model.system.whole, dict(model.inputs))
    states = np.vstack([outcome.states[:, : len(model.state)], outcome.end[1][: len(model.state)]])
    instants = np.append(motion.task.instants[: len(states) - 1], outcome.end[0])
    q = states[:, : len(model.coordinates)].T
    p = np.array([motion.parameters[name] for name in kinematics.parameters])
    columns = np.repeat(p[:, None], q.shape[1], axis=1)
    with np.errstate(all="ignore"):
        phi, phi_q, sizes = kinematics.position_of_many(instants, q, columns)
        return instants, np.abs(phi) / term_sizes_of_many(q, phi_q, sizes)
