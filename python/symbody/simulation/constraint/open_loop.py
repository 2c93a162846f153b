"""Loops that stay open: which joints don't close at any position that was found, and how far apart their sides are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from symbody.multibody import System, Variables
from symbody.symbolic.given.arguments import brief

if TYPE_CHECKING:
    from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["open_joints"]


def open_joints(system: Variables, violated: Mapping[str, float]) -> str:
    """Return which joints stay open, and by how much; the empty text if other constraints are violated as well.

    Args:
        system: the system, whose joints may close loops.
        violated: the conditions that are not zero, by name, with their values.
    """
    joints: Sequence[PlacedJoint] = system.joints if isinstance(system, System) else ()
    own = {f"{joint.name}.{closure.name}" for joint in joints for closure in joint.active}
    if not violated or not violated.keys() <= own:
        return ""
    return "; ".join(_openings(joints, violated))


def _openings(joints: Sequence[PlacedJoint], violated: Mapping[str, float]) -> Iterator[str]:
    for joint in joints:
        gaps, angles = list[float](), list[float]()
        for closure in joint.active:
            value = violated.get(f"{joint.name}.{closure.name}", 0.0)
            (angles if closure.name.startswith("about") else gaps).append(value)
        apart, turned = float(np.linalg.norm(gaps)), float(np.linalg.norm(angles))
        found = [f"stay {apart:.3g} apart"] if apart else []
        found += [f"are turned by {np.arcsin(min(turned, 1.0)):.3g} rad"] if turned else []
        if found:
            parent, child = joint.joint.parent, joint.joint.child
            yield f"the sides of {joint} on {brief(parent)} and {brief(child)} {' and '.join(found)}"
