"""What a joint that closes a loop holds of the force of teeth on its child.

In the equations, a mesh acts along the coordinates of the two joints that it couples. The coordinate of a joint that
closes a loop is a combination of those of the tree: along them, the mesh gives a torque about its axis, or a force
along it, and nothing else. But the teeth push at the pitch point, with the wrench W. The joint holds the rest beside
its multipliers: ``sum(lambda f) - (W - n (n . W))``, where n is the axis of its freedom.
"""

from __future__ import annotations

from collections.abc import Iterator

from symbody.geometry import Vector, dot
from symbody.multibody import System
from symbody.multibody.joint.closure import AXES
from symbody.multibody.joint.pair import SlideAndTurn
from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["meshes_of", "without_freedom"]


def meshes_of(system: System, placed: PlacedJoint) -> Iterator[tuple[PlacedJoint, bool]]:
    """Yield the gears and racks that couple a joint, and whether its child is the one that their reactions act on."""
    for mesh in system.joints:
        coupled = mesh.joint.pair.coupled
        if placed.joint in coupled:
            yield mesh, placed.joint is coupled[1]


def without_freedom(placed: PlacedJoint, force: Vector, moment: Vector) -> tuple[Vector, Vector]:
    """Return a force and a moment without the component along the freedom of a revolute or prismatic joint."""
    pair = placed.joint.pair
    assert isinstance(pair, SlideAndTurn)
    axis = placed.sides.of_parent(AXES.index(pair.slides or pair.turns))
    if pair.slides:
        return force - dot(axis, force) * axis, moment
    return force, moment - dot(axis, moment) * axis
