"""Screw joints: nuts on threads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import final

from symbody.errors import JointError
from symbody.geometry import Frame, Scalar, rotate, translate
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, cos, pi, sin
from symbody.symbolic.given.arguments import brief

from .axis import Axis, principal
from .closure import AXES, Closure, Sides, along
from .joint import Coordinate, Joint, Loop, Part, joined, mounted
from .limit import Limits
from .link import Place
from .pair import Pair, Size, Travel, held_senses, held_turns, whole_angle


@checked(JointError)
def screw(
    name: str,
    parent: Part,
    child: Part,
    *,
    pitch: Scalar,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axis: Axis = "Z",
    coordinate: Coordinate = None,
    limits: Limits = None,
    loop: Loop = None,
) -> Joint:
    """Return a screw joint: the child turns about an axis by an angle phi, and slides along it by pitch * phi.

    Its reaction is a force and a moment; along the axis, the moment is -pitch times the force.

    Args:
        name: the name of the joint.
        parent: a link, or a frame such as ground.
        child: a link; or a frame, if the parent is a link.
        pitch: the displacement per radian, as in the theory of screws: the lead of a thread divided by 2 pi; positive
            for a right-handed thread.
        at: where the joint is on the parent, in the parent's axes: a point, or a frame there.
        to: where it is on the child, in the child's axes.
        axis: of the screw, in the axes of `at` and `to`.
        coordinate: the angle; ``phi_<name>`` by default.
        limits: the least and the largest angle; see `stops`.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, screw, symbols
    >>> nut, h = Link("nut", symbols("m"), Iz=symbols("I")), symbols("h")
    >>> thread = assemble([screw("S", ground, nut, pitch=h)])
    >>> thread.point(nut, 0, 0, 0).projected(ground).coordinates
    (0, 0, h*phi_S)
    """
    where = f"screw {name}"
    h = expression(pitch)
    if h.is_zero or h.depends_on_time:
        raise JointError(
            f"{where}: pitch = {h}; expected a constant that isn't zero; a screw that doesn't advance is revolute"
        )
    mounting = mounted("screw", name, (parent, child), at, to, loop=loop)
    return joined("screw", mounting, Thread(principal(axis, where), h), coordinate, limits)


@final
class Thread(Pair):
    """A rotation, and a displacement along its axis in proportion to the angle."""

    names = ("phi",)
    turning = ("phi",)

    def __init__(self, axis: str, pitch: Expr) -> None:
        self.axis, self.pitch = axis, pitch

    @property
    def sizes(self) -> tuple[Size, ...]:
        """The pitch: positive or negative."""
        return (Size("pitch", self.pitch, least=None),)

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        (angle,) = coordinates
        shift = (self.pitch * angle if axis == self.axis else 0 for axis in AXES)
        return translate(*shift) * rotate(self.axis, angle)

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        """Return the closures of a shaft in a bush, and ``d - h phi = 0``.

        Where the angle phi is known up to whole turns, that is ``h sin(d/h - phi) = 0``, which is regular at each of
        them.
        """
        k = AXES.index(self.axis)
        i, j = (k + 1) % 3, (k + 2) % 3
        angle = whole_angle(sides, self.axis)
        if angle is None:
            turn = sides.gap.components[k] / self.pitch
            condition = self.pitch * (sin(turn) * sides.entry(i, i) - cos(turn) * sides.entry(j, i))
        else:
            condition = sides.gap.components[k] - self.pitch * angle
        e = sides.of_parent(k)
        thread = Closure("thread", condition, sides.point, e, -self.pitch * e)
        return along(sides, i), along(sides, j), thread, *held_turns(sides, self.axis)

    def senses(self, sides: Sides) -> Mapping[str, Expr]:
        """Return that of the axis, and ``cos(d/h - phi)``: its sine is zero also half a turn away from the thread."""
        if whole_angle(sides, self.axis) is not None:
            return held_senses(sides, self.axis)
        k = AXES.index(self.axis)
        i, j = (k + 1) % 3, (k + 2) % 3
        turn = sides.gap.components[k] / self.pitch
        across = cos(turn) * sides.entry(i, i) + sin(turn) * sides.entry(j, i)
        return {**held_senses(sides, self.axis), AXES[i].lower(): across}

    def unknown(self, sides: Sides) -> str:
        """Return that whole turns are, by each of which the nut could be farther along the thread."""
        if whole_angle(sides, self.axis) is not None:
            return ""
        return f"its angle only up to whole turns, of {brief(abs(2 * pi * self.pitch))} along the axis each"

    def measured(self, sides: Sides) -> Mapping[str, Expr]:
        return {"phi": sides.gap.components[AXES.index(self.axis)] / self.pitch}

    def travel(self, sides: Sides, name: str) -> Travel | None:
        del name
        return Travel(sides.of_parent(AXES.index(self.axis)), is_rotation=True)
