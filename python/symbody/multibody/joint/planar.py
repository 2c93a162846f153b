"""Planar joints: a body on a plane."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axis, principal
from .closure import AXES
from .joint import Coordinates, Joint, Loop, Part, joined, mounted
from .limit import LimitsByName
from .link import Place
from .pair import SlideAndTurn


@checked(JointError)
def planar(
    name: str,
    parent: Part,
    child: Part,
    *,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axis: Axis = "Z",
    coordinates: Coordinates = None,
    limits: LimitsByName = None,
    loop: Loop = None,
) -> Joint:
    """Return a planar joint: the child slides along a plane that is fixed in both bodies, and turns about its normal.

    Its reaction is a force along the normal, and a moment across it.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axis: normal to the plane, in the axes of `at` and `to`.
        coordinates: the two displacements and the angle; ``x_<name>``, ``y_<name>`` and ``phi_<name>`` by default for
            the normal Z.
        limits: the least and the largest values of coordinates by their names, such as ``{"x": (-1, 1)}``; see `stops`.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, planar, symbols
    >>> puck = Link("puck", symbols("m"), Iz=symbols("I"))
    >>> assemble([planar("table", ground, puck)]).coordinates
    (x_table, y_table, phi_table)
    """
    mounting = mounted("planar", name, (parent, child), at, to, loop=loop)
    normal = principal(axis, f"planar {name}")
    pair = SlideAndTurn("".join(each for each in AXES if each != normal), normal)
    return joined("planar", mounting, pair, coordinates, limits)
