"""Universal joints: Cardan's."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axes, sequence
from .joint import Coordinates, Joint, Loop, Part, joined, mounted
from .limit import LimitsByName
from .link import Place
from .pair import SlideAndTurn


@checked(JointError)
def universal(
    name: str,
    parent: Part,
    child: Part,
    *,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axes: Axes = "XY",
    coordinates: Coordinates = None,
    limits: LimitsByName = None,
    loop: Loop = None,
) -> Joint:
    """Return a universal joint: the child turns about an axis of the parent, and about one of its own across it.

    Its reaction is a force, and a moment across both axes.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axes: the one of the parent, then that of the child.
        coordinates: the angles about them; ``phi_<name>`` and ``theta_<name>`` by default.
        limits: the least and the largest values of coordinates by their names, such as ``{"phi": (-1, 1)}``; see
            `stops`.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, universal
    >>> assemble([universal("U", ground, Link("shaft", 1))]).coordinates
    (phi_U, theta_U)
    """
    mounting = mounted("universal", name, (parent, child), at, to, loop=loop)
    pair = SlideAndTurn(turns=sequence(axes, f"universal {name}", 2))
    return joined("universal", mounting, pair, coordinates, limits)
