"""Fixed joints: welds and clamps."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .joint import Joint, Loop, Part, joined, mounted
from .link import Place
from .pair import SlideAndTurn


@checked(JointError)
def fixed(
    name: str,
    parent: Part,
    child: Part,
    *,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    loop: Loop = None,
) -> Joint:
    """Return a fixed joint: the places on both bodies coincide, with their axes.

    Its reaction is a force and a moment. In a tree, it serves to find them where a body is cut in two.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, fixed, ground, revolute
    >>> beam, tip = Link("beam", 2), Link("tip", 1)
    >>> arm = assemble([revolute("A", ground, beam), fixed("B", beam, tip, at=(3, 0, 0))])
    >>> (arm.point(tip, 0, 0, 0) - arm.point(beam, 0, 0, 0)).projected(arm.frame(beam)).components
    (3, 0, 0)
    """
    return joined("fixed", mounted("fixed", name, (parent, child), at, to, loop=loop), SlideAndTurn())
