"""Parts of a system that are cut off: their bodies, and the joints at the cuts."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import Any

from symbody.multibody import Body, Link, System
from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["body_of", "cut_joints", "things_of"]


def things_of(part: Any) -> list[Any]:
    """Return what a user gave as a part, one or several bodies, links or names, as a list."""
    return list(part) if isinstance(part, Iterable) and not isinstance(part, str) else [part]


def body_of(system: System, thing: Any) -> Body | None:
    """Return the body that is given by itself, by its link or by its name; None if the system has none."""
    if not isinstance(thing, Body | Link | str):
        return None
    name = thing if isinstance(thing, str) else thing.name
    return next((body for body in system.bodies if body is thing or (name and body.name == name)), None)


def cut_joints(system: System, names: Collection[str]) -> Iterator[tuple[PlacedJoint, bool]]:
    """Yield the joints between a part and all else, and whether the child is in the part.

    Args:
        system: the system, with its joints.
        names: those of the bodies of the part.
    """
    for joint in system.joints:
        is_parent, is_child = (name in names for name, _ in joint.ends)
        if is_parent != is_child:
            yield joint, is_child
