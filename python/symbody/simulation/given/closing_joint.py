"""Coordinates of joints that close loops, where they have none, in place of those of the tree."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from symbody.multibody import System, Variables
from symbody.symbolic import time_derivative

if TYPE_CHECKING:
    from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["closing_joint", "measured_note"]


def closing_joint(system: Variables | None, name: object) -> PlacedJoint | None:
    """Return the joint that closes a loop and whose coordinate, or the rate of one, a name would be."""
    joints: Sequence[PlacedJoint] = system.joints if isinstance(system, System) else ()
    for joint in joints:
        coordinates = () if joint.opens else joint.joint.coordinates
        if name in (*coordinates, *map(time_derivative, coordinates)):
            return joint
    return None


def measured_note(system: Variables | None, names: Iterable[object]) -> str:
    """Return how to evaluate what is asked for by the coordinate of a joint that closes a loop; else the empty text."""
    joint = next((found for name in names if (found := closing_joint(system, name))), None)
    if joint is None:
        return ""
    return (
        f"; {joint} closes a loop, and has no coordinate: mechanism.joint({joint.name!r}).freedom(...).value tells "
        "what it would be"
    )
