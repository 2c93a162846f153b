"""Spherical joints: balls in sockets."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axes, sequence
from .joint import Coordinates, Joint, Loop, Part, joined, mounted
from .limit import CONE, LimitsByName
from .link import Place
from .pair import Pair, SlideAndTurn
from .quaternion import Ball, check_own_coordinates


@checked(JointError)
def spherical(
    name: str,
    parent: Part,
    child: Part,
    *,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axes: Axes | None = None,
    coordinates: Coordinates = None,
    limits: LimitsByName = None,
    quaternion: bool = False,
    loop: Loop = None,
) -> Joint:
    """Return a spherical joint: a point of the child stays at a point of the parent, and the child turns freely.

    Its reaction is a force. Euler angles about three different axes are singular at right angles of the second one,
    those as of "ZXZ" at its zero; a quaternion never is.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axes: of the Euler angles, each carried by those before; "ZYX" by default.
        coordinates: the Euler angles; ``psi_<name>``, ``theta_<name>`` and ``phi_<name>`` by default.
        quaternion: whether Euler parameters ``e0_<name>``, ... are the coordinates, and the angular velocity
            ``p_<name>``, ``q_<name>``, ``r_<name>`` in the axes of the child the speeds.
        limits: the least and the largest values by names, such as ``{"cone": (None, 0.5)}``; see `stops`. The cone is
            the angle between the z axes of `at` and `to`; the other names are those of the Euler angles.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, spherical
    >>> assemble([spherical("O", ground, Link("top", 1, 1, 1, 1), axes="ZXZ")]).coordinates
    (psi_O, theta_O, phi_O)
    """
    mounting = mounted("spherical", name, (parent, child), at, to, loop=loop)
    letters = sequence("ZYX" if axes is None else axes, f"spherical {name}", 3)
    if not quaternion:
        pair = SlideAndTurn(turns=letters)
        return joined("spherical", mounting, pair, coordinates, limits, limited=(*pair.names, CONE))
    check_own_coordinates(f"spherical {name}", coordinates, axes)
    ball: Pair = Ball(name)
    return joined("spherical", mounting, ball, limits=limits, limited=[CONE])
