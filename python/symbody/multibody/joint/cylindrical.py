"""Cylindrical joints: a shaft in a bush."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axis, principal
from .joint import Coordinates, Joint, Loop, Part, joined, mounted
from .limit import LimitsByName
from .link import Place
from .pair import SlideAndTurn


@checked(JointError)
def cylindrical(
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
    """Return a cylindrical joint: the child slides along an axis that is fixed in both bodies, and turns about it.

    Its reaction is a force and a moment across the axis.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axis: of the joint, in the axes of `at` and `to`.
        coordinates: the displacement and the angle; ``s_<name>`` and ``phi_<name>`` by default.
        limits: the least and the largest values of coordinates by their names, such as ``{"phi": (None, 2)}``; see
            `stops`.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, cylindrical, ground, symbols
    >>> shaft = Link("shaft", symbols("m"), Iz=symbols("I"))
    >>> assemble([cylindrical("bush", ground, shaft)]).coordinates
    (s_bush, phi_bush)
    """
    mounting = mounted("cylindrical", name, (parent, child), at, to, loop=loop)
    pair = SlideAndTurn(principal(axis, f"cylindrical {name}"), principal(axis, f"cylindrical {name}"))
    return joined("cylindrical", mounting, pair, coordinates, limits)
