"""Arrows of forces and torques: their lengths are proportional to the magnitudes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.geometry import Point, Vector
from symbody.multibody import Load
from symbody.view.attachment import Thread
from symbody.view.drawable_motion import DrawableMotion
from symbody.view.pose import arrows, paths, rounded

Array = NDArray[np.float64]

LONGEST = 0.45
"""The length of the longest arrow of each kind, in radii of the picture."""


@dataclass(frozen=True)
class Arrow:
    """A vector at a point: a force, a torque, or the force of a constraint (a reaction)."""

    name: str
    kind: str
    at: Point
    vector: Vector


def load_arrows(loads: Iterable[Load]) -> list[Arrow]:
    """Return the arrows of loads; a torque is drawn at the centre of mass of its body."""
    return [
        Arrow(
            load.name,
            "force" if action.is_force else "torque",
            action.point or action.body.center_of_mass,
            action.vector,
        )
        for load in loads
        for action in load.actions
    ]


def reaction_arrows(threads: Iterable[Thread]) -> list[Arrow]:
    """Return the arrows of the forces of threads."""
    return [Arrow("", "reaction", thread.start, thread.force) for thread in threads]


def arrow_entries(
    motion: DrawableMotion, given: Sequence[Arrow], radius: float
) -> tuple[dict[str, Any], Array]:
    """Return the entries of the page, which are the arrows and the largest magnitude of each kind; and the tips."""
    places = paths(motion, [arrow.at for arrow in given])
    vectors = arrows(motion, [arrow.vector for arrow in given])
    sizes = np.linalg.norm(vectors, axis=2).max(axis=1, initial=0)
    largest = dict.fromkeys((arrow.kind for arrow in given), 0.0)
    for arrow, size in zip(given, sizes, strict=True):
        largest[arrow.kind] = max(largest[arrow.kind], float(size))
    scales = np.array([LONGEST * radius / (largest[arrow.kind] or 1.0) for arrow in given])
    drawn = vectors * scales[:, None, None]
    entries = [
        {"name": arrow.name, "kind": arrow.kind, "at": rounded(place), "vector": rounded(vector)}
        for arrow, place, vector in zip(given, places, drawn, strict=True)
    ]
    most = {kind: float(f"{size:.3g}") for kind, size in largest.items()}
    return {"arrows": entries, "largest": most}, places + drawn
