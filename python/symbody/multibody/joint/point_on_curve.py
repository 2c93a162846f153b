"""Points on curves: beads on wires, pins in curved slots."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, TypeAlias, final

from symbody.errors import ExpressionError, JointError, ParameterError
from symbody.geometry import Frame, Scalar, Vector, rotate, translate
from symbody.geometry.component.triple import NULL, Triple, triple
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, diff, dot3, subs, symbols
from symbody.symbolic.given.arguments import brief, described

from .axis import Axes
from .closure import AXES, Closure, Sides
from .joint import Coordinates, Joint, Loop, Part, joined, mounted
from .joint_angle import angles, turning_axis
from .limit import LimitsByName
from .link import Place
from .pair import ANGLES, Pair, Travel, held_senses, held_turns, turns_back

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
    axes: Axes = "ZYX",
    coordinates: Coordinates = None,
    limits: LimitsByName = None,
    loop: Loop = None,
) -> Joint:
    """Return a point on a curve: a point of the child moves along a curve that is fixed in the parent.

    Its reaction is a force across the curve. Where it closes a loop, the parameter of the curve stays a coordinate,
    which three conditions hold; friction along the curve then takes ``mechanism.joint(name).freedom("s")``.

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
        limits: the least and the largest values of coordinates by their names, such as ``{"s": (0, 1)}``; see `stops`.
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
    joint = joined("point_on_curve", mounting, Track(letters), coordinates, limits)
    parameter = joint.coordinates[0]
    variable = parameter if parameter.is_variable else symbols(f"s_{name}")
    given: object = curve
    place = _point_of(where, given, variable) if callable(given) else given
    if not callable(given) or not isinstance(place, Sequence) or len(place) != 3:
        found = f"the curve gives {brief(place)}" if callable(given) else f"curve = {described(place)}"
        raise JointError(
            f"{where}: {found}; expected a function from the parameter to three coordinates, such as "
            "lambda s: (s, a*s**2, 0)"
        )
    place = triple(*place)
    slope = triple(*(diff(each, variable) for each in place))
    if all(each.is_zero for each in slope):
        raise JointError(
            f"{where}: the curve {brief(place)} doesn't depend on its parameter {variable}; expected a function of "
            "it, such as lambda s: (s, a*s**2, 0)"
        )
    at_parameter = {variable: parameter}
    track = Track(letters, subs(place, at_parameter), subs(slope, at_parameter), parameter)
    return replace(joint, pair=track)


def _point_of(where: str, curve: Callable[..., object], parameter: Expr) -> object:
    """Return the point of a curve at a symbol.

    Raises:
        JointError: the function takes no parameter, or computes with numbers alone.
    """
    try:
        place = curve(parameter)
        return triple(*place) if isinstance(place, Sequence) and len(place) == 3 else place
    except (TypeError, ArithmeticError, ExpressionError, ParameterError) as fault:
        raise JointError(
            f"{where}: the curve fails at {parameter}: {fault}; expected a function of one parameter that takes "
            "symbols, such as lambda s: (s, symbody.sin(s), 0), with sin of symbody, not of math or numpy"
        ) from fault


@final
class Track(Pair):
    """A displacement along a curve, and rotations."""

    def __init__(
        self, turns: str, place: Triple = NULL, slope: Triple = NULL, parameter: Expr | None = None
    ) -> None:
        self.turns, self.place, self.slope = turns, place, slope
        self.names = ("s", *ANGLES[len(turns)])
        self.keeps = () if parameter is None else (parameter,)

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        frame = translate(*self.place)
        for axis, angle in zip(self.turns, coordinates[1:], strict=True):
            frame = frame * rotate(axis, angle)
        return frame

    def measured(self, sides: Sides) -> Mapping[str, Expr]:
        return dict(zip(self.names, (*self.keeps, *angles(self.turns, sides.entry)), strict=True))

    def travel(self, sides: Sides, name: str) -> Travel | None:
        if name == "s":
            return Travel(self._along(sides), is_rotation=False)
        axis = turning_axis(sides, self.turns, self.names.index(name) - 1)
        return Travel(axis, is_rotation=True, jumps=not turns_back(self.turns, name))

    def _along(self, sides: Sides) -> Vector:
        """Return the vector whose product with the velocity of the point is s': the tangent r', by its square."""
        square = dot3(self.slope, self.slope)
        axes = (sides.of_parent(k) * (each / square) for k, each in enumerate(self.slope))
        return sum(axes, start=sides.of_parent(0) * 0)

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        null = sides.of_parent(0) * 0
        held = (
            Closure("xyz"[k], sides.gap.components[k] - place, sides.point, sides.of_parent(k), null)
            for k, place in enumerate(self.place)
        )
        return *held, *held_turns(sides, self.turns)

    def senses(self, sides: Sides) -> Mapping[str, Expr]:
        return held_senses(sides, self.turns)
