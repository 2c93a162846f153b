"""Racks: a pinion that drives a toothed bar."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry import Scalar
from symbody.geometry.given.argument import checked

from .gear import Coupled
from .joint import Joint
from .mesh import Mesh, check_coupled, coupling, pitch_radius


@checked(JointError)
def rack(name: str, pinion: Coupled, bar: Coupled, radius: Scalar) -> Joint:
    """Return a rack and pinion: the bar slides by the arc by which the pinion turns, ``s - r q = 0``.

    Pinion and bar move against one parent. The bar's line is the radius away from the pinion's axis; on which side it
    is decides the sign. Its reaction is the force of the pinion on the bar, along it. A joint that
    closes a loop may be one of both if its angle counts all turns, as in the plane.

    Args:
        name: the name of the rack.
        pinion: the revolute joint of the pinion; its parent is the housing.
        bar: the prismatic joint of the bar, through a point of its pitch line.
        radius: the radius of the pitch circle of the pinion.

    >>> from symbody import Link, assemble, ground, prismatic, rack, revolute, symbols
    >>> r = symbols("r")
    >>> A = revolute("A", ground, Link("pinion", Iz=1))
    >>> B = prismatic("B", ground, Link("bar", 1), at=(0, -r, 0), axis="X")
    >>> assemble([A, B, rack("R", A, B, r)]).constraints
    (Constraint(R.mesh, s_B - r*phi_A = 0),)
    """
    where = f"rack {name}"
    check_coupled(where, pinion, bar, ("revolute", "prismatic"))
    return coupling("rack", name, Mesh(pinion, bar, (pitch_radius(where, radius),)))
