"""Kinematic pairs: how the child's side of a joint may move relative to the parent's."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, final

from symbody.geometry import Frame, Vector, ground, rotate, translate
from symbody.symbolic import Expr, number

from .closure import AXES, Closure, Sides, along, held_point, holds_by_itself, perpendicular
from .joint_angle import angles, over_all_turns, turning_axis
from .limit import Limit

__all__ = ["Pair", "Size", "SlideAndTurn", "Travel", "held_senses", "held_turns", "turns_back", "whole_angle"]


class Size(NamedTuple):
    """A dimension of a pair, of which not all values make sense.

    Attributes:
        name: the argument by which it was given.
        value: the dimension.
        least: the least value that makes sense, 0, or None if negative ones do.
        may_vanish: whether zero makes sense.
    """

    name: str
    value: Expr
    least: int | None = 0
    may_vanish: bool = False


class Travel(NamedTuple):
    """How a pair moves along one of its coordinates where it closes a loop.

    Attributes:
        axis: the vector whose product with the velocity of the child, relative to the parent, is the coordinate's rate.
        is_rotation: whether the velocity is angular.
        jumps: whether the coordinate is an angle that is known from -pi to pi alone.
    """

    axis: Vector
    is_rotation: bool
    jumps: bool = False


class Pair(ABC):
    """What a kind of joint allows, in two forms: a motion by coordinates, and the conditions that are left.

    A new kind of joint is one file with a function that returns a `Joint` of a `SlideAndTurn`, or of a final subclass
    of this class (docs/extending.md).
    """

    names: tuple[str, ...]
    """The names of the coordinates, to which that of the joint is added."""
    rolls: ClassVar[bool] = False
    """Whether conditions on velocities remain where the joint opens a tree."""
    turning: ClassVar[tuple[str, ...]] = ()
    """The angles that may count any number of turns, as that of a nut does."""
    keeps: tuple[Expr, ...] = ()
    """The coordinates that conditions hold also where the joint closes a loop."""

    @abstractmethod
    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        """Return the frame C as seen from P."""

    @abstractmethod
    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        """Return the conditions, as many as freedoms are missing to six; they are independent near every position."""

    def opened(self, sides: Sides, coordinates: Sequence[Expr]) -> tuple[Closure, ...]:
        """Return the same where the joint opens a tree, in forms that may use its coordinates."""
        del coordinates
        return self.closures(sides)

    @property
    def sizes(self) -> tuple[Size, ...]:
        """The dimensions of the pair."""
        return ()

    @property
    def coupled(self) -> tuple[Any, ...]:
        """The joints whose coordinates a mesh couples; it joins their children, and places none.

        They are of the class `Joint`, which is made of pairs and therefore unknown here.
        """
        return ()

    def meshing(
        self, where: str, sides: Mapping[Any, Sides], values: Mapping[Any, Expr]
    ) -> tuple[Closure, ...]:
        """Return the conditions on the coordinates of the coupled joints.

        Args:
            where: the joint, for messages.
            sides: those of all joints.
            values: the coordinates of the coupled joints; where they close loops, what these would be.

        Raises:
            JointError: the coupled joints don't fit each other.
        """
        del where, sides, values
        return ()

    @property
    def own_limits(self) -> tuple[Limit, ...]:
        """The limits that it has by its kind where it opens a tree, unless others are given."""
        return ()

    def measured(self, sides: Sides) -> Mapping[str, Expr]:
        """Return the values of the coordinates between any two frames, by their names; those that can be computed."""
        del sides
        return {}

    def travel(self, sides: Sides, name: str) -> Travel | None:
        """Return how the child moves along a coordinate between any two frames; None where it can't be computed."""
        del sides, name
        return None

    def unknown(self, sides: Sides) -> str:
        """Return what its conditions leave open where it closes a loop; the empty text if nothing."""
        del sides
        return ""

    def senses(self, sides: Sides) -> Mapping[str, Expr]:
        """Return cosines of angles that the closures allow to be pi, by the axes between them: 1 where it is closed.

        A product of axes is zero also where the child is turned by half a turn.
        """
        del sides
        return {}


@final
class SlideAndTurn(Pair):
    """Displacements along axes of the parent, then rotations in turn: all pairs but those of threads and contacts.

    Args:
        slides: the axes along which the child slides.
        turns: the axes about which it turns, each carried by those before; none, one, two different ones, or three of
            which neighbours differ.
    """

    def __init__(self, slides: str = "", turns: str = "") -> None:
        self.slides, self.turns = slides, turns
        along = ("s",) if len(slides) == 1 else tuple(slides.lower())
        self.names = (*along, *ANGLES[len(turns)])

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        n = len(self.slides)
        d = dict(zip(self.slides, coordinates[:n], strict=True))
        frame = ground * translate(*(d.get(axis, number(0)) for axis in AXES))
        for axis, angle in zip(self.turns, coordinates[n:], strict=True):
            frame = frame * rotate(axis, angle)
        return frame

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        return *self._positions(sides), *held_turns(sides, self.turns)

    def _positions(self, sides: Sides) -> tuple[Closure, ...]:
        if not self.slides:
            return held_point(sides)
        return tuple(along(sides, k) for k, axis in enumerate(AXES) if axis not in self.slides)

    def measured(self, sides: Sides) -> Mapping[str, Expr]:
        slides = (sides.gap.components[AXES.index(axis)] for axis in self.slides)
        whole = self._over_all_turns(sides)
        turns = angles(self.turns, sides.entry) if whole is None else (whole,)
        return dict(zip(self.names, (*slides, *turns), strict=True))

    def travel(self, sides: Sides, name: str) -> Travel | None:
        which = self.names.index(name)
        if which < len(self.slides):
            return Travel(sides.of_parent(AXES.index(self.slides[which])), is_rotation=False)
        axis = turning_axis(sides, self.turns, which - len(self.slides))
        return Travel(
            axis,
            is_rotation=True,
            jumps=self._over_all_turns(sides) is None and not turns_back(self.turns, name),
        )

    def senses(self, sides: Sides) -> Mapping[str, Expr]:
        return held_senses(sides, self.turns)

    def _over_all_turns(self, sides: Sides) -> Expr | None:
        """Return the angle of a pair that turns about one axis, where it is a sum of coordinates."""
        return whole_angle(sides, self.turns) if len(self.turns) == 1 else None


def whole_angle(sides: Sides, axis: str) -> Expr | None:
    """Return the angle about an axis with all its turns, where it is a sum of coordinates; None elsewhere.

    It is where the axis keeps one direction in both bodies, as in a mechanism in a plane.
    """
    if not all(holds_by_itself(each.condition) for each in held_turns(sides, axis)):
        return None
    return over_all_turns(sides, AXES.index(axis))


def held_turns(sides: Sides, axes: str) -> tuple[Closure, ...]:
    """Return the closures of all rotations but those about given axes in turn."""
    match [AXES.index(axis) for axis in axes]:
        case []:
            return tuple(perpendicular(sides, k, (k + 2) % 3, (k + 1) % 3) for k in range(3))
        case [axis]:
            others = [k for k in range(3) if k != axis]
            return tuple(perpendicular(sides, k, 3 - axis - k, axis) for k in others)
        case [first, second]:
            return (perpendicular(sides, 3 - first - second, first, second),)
        case _:
            return ()


def held_senses(sides: Sides, axes: str) -> dict[str, Expr]:
    """Return the products of the axes that `held_turns` keeps parallel, by their names: 1, or -1 with a half turn."""
    held = {0: AXES, 1: axes}.get(len(axes), "")
    return {axis.lower(): sides.entry(AXES.index(axis), AXES.index(axis)) for axis in held}


def turns_back(turns: str, name: str) -> bool:
    """Whether a coordinate is the second of three angles, which is bounded: it turns back at a singular position."""
    return len(turns) == 3 and name == ANGLES[3][1]


ANGLES = {0: (), 1: ("phi",), 2: ("phi", "theta"), 3: ("psi", "theta", "phi")}
