"""Gears: pairs of toothed wheels."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from symbody.errors import JointError
from symbody.geometry import Scalar
from symbody.geometry.given.argument import checked

from .joint import Joint
from .mesh import Mesh, check_coupled, coupling, pitch_radius

Coupled: TypeAlias = Annotated[Joint, "a joint, such as revolute('A', carrier, wheel)"]


@checked(JointError)
def gear(
    name: str, first: Coupled, second: Coupled, radius1: Scalar, radius2: Scalar, *, internal: bool = False
) -> Joint:
    """Return a pair of gears: the children of two revolute joints roll on each other, ``r1 q1 + r2 q2 = 0``.

    Both wheels turn against one parent, the carrier or the gearbox, about parallel axes whose distance is r1 + r2, or,
    as bevel gears, about axes that meet in one point: each points from there to its wheel, and the pitch circles
    are where r1 and r2 fit the angle of the axes. The reaction is the force of the first wheel on the second one
    along the pitch circles. It acts in the plane of the first place, if the places are apart along parallel axes:
    give both in the middle of the teeth. The teeth of both wheels fit where both angles are zero. A joint that
    closes a loop may be one of both if its angle counts all turns, as in the plane.

    Args:
        name: the name of the gear.
        first: the revolute joint of one wheel; its parent is the carrier.
        second: that of the other wheel.
        radius1: the radius of the pitch circle of the first wheel.
        radius2: that of the second wheel.
        internal: whether one is an internal gear, around the other: ``r1 q1 - r2 q2 = 0``, and the distance of the
            axes is the difference of the radii.

    >>> from symbody import Link, assemble, gear, ground, revolute, symbols
    >>> r1, r2, I1, I2 = symbols("r1 r2 I1 I2")
    >>> A = revolute("A", ground, Link("pinion", Iz=I1))
    >>> B = revolute("B", ground, Link("wheel", Iz=I2), at=(r1 + r2, 0, 0))
    >>> assemble([A, B, gear("G", A, B, r1, r2)]).constraints
    (Constraint(G.mesh, r1*phi_A + r2*phi_B = 0),)
    """
    where = f"gear {name}"
    check_coupled(where, first, second, ("revolute", "revolute"))
    r1, r2 = pitch_radius(where, radius1), pitch_radius(where, radius2)
    return coupling("gear", name, Mesh(first, second, (r1, -r2 if internal else r2), internal=internal))
