"""Kinematic pairs: how the child's side of a joint may move relative to the parent's."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar, final

from symbody.geometry import Frame, ground, rotate, translate
from symbody.symbolic import Expr, atan2, number

from .closure import AXES, Closure, Sides, along, held_point, perpendicular

__all__ = ["Pair", "SlideAndTurn", "held_turns", "turned"]


class Pair(ABC):
    """What a kind of joint allows, in two forms: a motion by coordinates, and the conditions that are left.

    A new kind of joint is one file with a function that returns a `Joint` of a `SlideAndTurn`, or of a final subclass
    of this class (docs/extending.md).
    """

    names: tuple[str, ...]
    """The names of the coordinates, to which that of the joint is added."""
    rolls: ClassVar[bool] = False
    """Whether conditions on velocities remain where the joint opens a tree."""
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

    def measured(self, sides: Sides) -> Expr | None:
        """Return the value of the one coordinate between any two frames; None for pairs that have several."""
        del sides
        return None


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

    def measured(self, sides: Sides) -> Expr | None:
        if len(self.slides) + len(self.turns) != 1:
            return None
        if self.slides:
            return sides.gap.components[AXES.index(self.slides)]
        axis = AXES.index(self.turns)
        return turned(sides, axis)


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


ANGLES = {0: (), 1: ("phi",), 2: ("phi", "theta"), 3: ("psi", "theta", "phi")}


def turned(sides: Sides, axis: int) -> Expr:
    """Return the angle, from -pi to pi, by which C is turned about a common axis of P and C."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    return atan2(sides.entry(j, i), sides.entry(i, i))
