"""Prismatic joints: slides."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axis, principal
from .joint import Coordinate, Joint, Loop, Part, joined, mounted
from .limit import Limits
from .link import Place
from .pair import SlideAndTurn


@checked(JointError)
def prismatic(
    name: str,
    parent: Part,
    child: Part,
    *,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axis: Axis = "X",
    coordinate: Coordinate = None,
    limits: Limits = None,
    loop: Loop = None,
) -> Joint:
    """Return a prismatic joint: the child slides along an axis that is fixed in both bodies, and doesn't turn.

    Its reaction is a force across the axis, and a moment.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axis: of the joint, in the axes of `at` and `to`.
        coordinate: the displacement; ``s_<name>`` by default. An expression of functions of time couples or drives it.
        limits: the least and the largest displacement; see `stops`.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, prismatic, symbols
    >>> cart = Link("cart", symbols("m"))
    >>> rail = assemble([prismatic("rail", ground, cart, axis="X")])
    >>> rail.point(cart, 0, 0, 0).projected(ground).coordinates
    (s_rail, 0, 0)
    """
    mounting = mounted("prismatic", name, (parent, child), at, to, loop=loop)
    pair = SlideAndTurn(slides=principal(axis, f"prismatic {name}"))
    return joined("prismatic", mounting, pair, coordinate, limits)
