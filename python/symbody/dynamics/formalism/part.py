"""Parts of a system that are cut off: their bodies, and the joints at the cuts."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import Any

from symbody.errors import ModelError
from symbody.multibody import Body, Link, System
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic.given.arguments import brief

__all__ = ["body_of", "cut_joints", "things_of"]


def things_of(part: Any) -> list[Any]:
    """Return what a user gave as a part, one or several bodies, links or names, as a list."""
    return list(part) if isinstance(part, Iterable) and not isinstance(part, str) else [part]


def body_of(system: System, thing: Any, where: str) -> Body | None:
    """Return the body that is given by itself, by its link or by its name; None if the system has none.

    Args:
        system: the system.
        thing: what the user gave.
        where: the function that the user called.

    Raises:
        ModelError: several bodies have this name.
    """
    if not isinstance(thing, Body | Link | str):
        return None
    if any(body is thing for body in system.bodies):
        return thing if isinstance(thing, Body) else None
    name = thing if isinstance(thing, str) else thing.name
    found = [body for body in system.bodies if name and body.name == name]
    if len(found) > 1:
        raise ModelError(
            f"{where}: {len(found)} bodies of {brief(system)} are called {name}; expected the body itself, or names of "
            "their own"
        )
    return found[0] if found else None


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
