"""Points on curves: beads on wires, pins in curved slots."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Annotated, TypeAlias, final

from symbody.errors import JointError
from symbody.geometry import Frame, Scalar, rotate, translate
from symbody.geometry.component.triple import NULL, Triple, triple
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

from .axis import Axis
from .closure import AXES, Closure, Sides
from .joint import Angles, Joint, Loop, Part, joined, mounted
from .link import Place
from .pair import ANGLES, Pair, held_turns

Curve: TypeAlias = Annotated[
    Callable[[Expr], Sequence[Scalar]],
    "a function from the parameter to three coordinates, such as lambda s: (s, a*s**2, 0)",
]


@checked(JointError)
def point_on_curve(
    name: str,
    parent: Part,
    child: Part,
    *,
    curve: Curve,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    axes: Axis = "ZYX",
    coordinates: Angles = None,
    loop: Loop = None,
) -> Joint:
    """Return a point on a curve: a point of the child moves along a curve that is fixed in the parent.

    Its reaction is a force across the curve. Where it closes a loop, the parameter of the curve stays a coordinate,
    which three conditions hold.

    Args:
        name: the name of the joint.
        parent: what carries the curve.
        child: what carries the point.
        curve: the function from the parameter to the coordinates of the curve in the axes of `at`; its derivative must
            not vanish.
        at: the axes of the curve on the parent, in the parent's axes.
        to: the point on the child, in the child's axes.
        axes: about which the child turns, each carried by those before: three letters of a ball; one of a pin in the
            plane across it; none of a bead whose turning doesn't matter, which then stays parallel to `at`.
        coordinates: the parameter, and the angles; ``s_<name>``, ``psi_<name>``, ... by default.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, point_on_curve, symbols
    >>> a, bead = symbols("a"), Link("bead", symbols("m"))
    >>> wire = assemble([point_on_curve("W", ground, bead, curve=lambda s: (s, 0, a * s**2), axes="")])
    >>> wire.point(bead, 0, 0, 0).projected(ground).coordinates
    (s_W, 0, a*s_W**2)
    """
    where = f"point_on_curve {name}"
    letters = axes.upper()
    if len(letters) > 3 or not {*letters} <= {*AXES} or any(a == b for a, b in pairwise(letters)):
        raise JointError(
            f"{where}: unknown axes {axes!r}; expected none to three letters of X, Y and Z of which neighbours differ"
        )
    mounting = mounted("point_on_curve", name, (parent, child), at, to, loop=loop)
    joint = joined("point_on_curve", mounting, Track(letters), coordinates)
    parameter = joint.coordinates[0]
    given: object = curve
    place = given(parameter) if callable(given) else given
    if not callable(given) or not isinstance(place, Sequence) or len(place) != 3:
        raise JointError(
            f"{where}: the curve {'gives' if callable(given) else 'is'} {brief(place)}; expected a function from the "
            "parameter to three coordinates, such as lambda s: (s, a*s**2, 0)"
        )
    track = Track(letters, triple(*place), parameter)
    return Joint(joint.kind, mounting, track, joint.coordinates, joint.are_given)


@final
class Track(Pair):
    """A displacement along a curve, and rotations."""

    def __init__(self, turns: str, place: Triple = NULL, parameter: Expr | None = None) -> None:
        self.turns, self.place = turns, place
        self.names = ("s", *ANGLES[len(turns)])
        self.keeps = () if parameter is None else (parameter,)

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        frame = translate(*self.place)
        for axis, angle in zip(self.turns, coordinates[1:], strict=True):
            frame = frame * rotate(axis, angle)
        return frame

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        null = sides.of_parent(0) * 0
        held = (
            Closure("xyz"[k], sides.gap.components[k] - place, sides.point, sides.of_parent(k), null)
            for k, place in enumerate(self.place)
        )
        return *held, *held_turns(sides, self.turns)
