"""Free joints: none at all, but coordinates."""

from __future__ import annotations

from symbody.errors import JointError
from symbody.geometry.given.argument import checked

from .axis import Axes, sequence
from .closure import AXES
from .joint import Coordinates, Joint, Part, joined, mounted
from .limit import LimitsByName
from .link import Place
from .pair import SlideAndTurn
from .quaternion import Floater, check_own_coordinates


@checked(JointError)
def free(
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
) -> Joint:
    """Return a free joint: the child moves as it will, and the coordinates tell where it is. It has no reaction.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        at: the frame from which the coordinates are measured, in the parent's axes.
        to: the frame that they place, in the child's axes.
        axes: of the Euler angles, each carried by those before; "ZYX" by default.
        coordinates: the displacements along x, y, z of the parent, then the Euler angles; ``x_<name>``, ``y_<name>``,
            ``z_<name>``, ``psi_<name>``, ``theta_<name>`` and ``phi_<name>`` by default.
        quaternion: whether Euler parameters are the coordinates beside x, y and z, and velocities in the child's axes
            the speeds, as those of a `floating_frame`.
        limits: the least and the largest values of coordinates by their names, such as ``{"z": (0, None)}``; see
            `stops`.

    >>> from symbody import Link, assemble, free, ground
    >>> assemble([free("base", ground, Link("robot", 1, 1, 1, 1))]).coordinates
    (x_base, y_base, z_base, psi_base, theta_base, phi_base)
    """
    mounting = mounted("free", name, (parent, child), at, to)
    letters = sequence("ZYX" if axes is None else axes, f"free {name}", 3)
    if not quaternion:
        return joined("free", mounting, SlideAndTurn(AXES, letters), coordinates, limits)
    check_own_coordinates(f"free {name}", coordinates, axes)
    return joined("free", mounting, Floater(name), limits=limits)
