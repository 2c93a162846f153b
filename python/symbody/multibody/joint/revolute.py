"""Revolute joints: pins and hinges."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axis, principal
from .joint import Coordinate, Joint, Loop, Part, joined, mounted
from .limit import Limits
from .link import Place
from .pair import SlideAndTurn


@checked(JointError)
def revolute(
    name: str,
    parent: Part,
    child: Part,
    *,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axis: Axis = "Z",
    coordinate: Coordinate = None,
    limits: Limits = None,
    loop: Loop = None,
) -> Joint:
    """Return a revolute joint: the child turns about an axis that is fixed in both bodies.

    Its reaction is a force, and a moment across the axis.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axis: of the rotation, in the axes of `at` and `to`.
        coordinate: the angle; ``phi_<name>`` by default. An expression of functions of time couples or drives it.
        limits: the least and the largest angle; see `stops`.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, revolute, symbols
    >>> m, l = symbols("m l")
    >>> bob = Link("bob", m, center=(0, -l, 0))
    >>> pendulum = assemble([revolute("A", ground, bob)])
    >>> pendulum.coordinates, pendulum.frame(bob)
    ((phi_A,), bob)
    """
    mounting = mounted("revolute", name, (parent, child), at, to, loop=loop)
    pair = SlideAndTurn(turns=principal(axis, f"revolute {name}"))
    return joined("revolute", mounting, pair, coordinate, limits)
