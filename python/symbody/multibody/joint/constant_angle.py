"""The angle between the sides of a joint where all coordinates are zero: a sum of the turns that lead there."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi as half_turn
from typing import NamedTuple

from symbody.geometry import Frame, Vector, dot
from symbody.symbolic import Expr, atan2, cos, number, pi, sin, substitute

from .closure import Sides

__all__ = ["constant_angle", "driven_angle"]


def constant_angle(sides: Sides, axis: int, sine: Expr, cosine: Expr) -> Expr:
    """Return the angle from -pi to pi with a given sine and cosine, where all coordinates are zero.

    As a sum of the turns about the axis, 0.3 is 0.3 and not ``atan2(sin(0.3), cos(0.3))``. Turns about other axes, such
    as by half a turn, add right angles. What is no such sum stays as it is.

    Args:
        sides: P and C, which share an axis.
        axis: the one that they share.
        sine: that of the angle about it.
        cosine: that of the same angle.
    """
    start = _Start(frozenset(_scalar_parts(sides.parent, sides.child)))
    sine, cosine, shared = start.of(sine), start.of(cosine), sides.of_parent(axis)
    turns = [start.along(turn, shared) for turn in _turns(sides.child)]
    back = [start.along(turn, shared) for turn in _turns(sides.parent)]
    total = sum(turns, start=number(0)) - sum(back, start=number(0))
    for quarter in range(4):
        angle = total + quarter * pi / 2
        if (sin(angle) - sine).is_zero and (cos(angle) - cosine).is_zero:
            return _within_a_turn(angle)
    return atan2(sine, cosine)


def driven_angle(sides: Sides, axis: int) -> Expr:
    """Return the angle by which expressions of time alone turn one side against the other; zero at time zero.

    Args:
        sides: P and C, which share an axis.
        axis: the one that they share.
    """
    start, shared = _Start(frozenset(_scalar_parts(sides.parent, sides.child))), sides.of_parent(axis)
    turns = [start.driven(turn, shared) for turn in _turns(sides.child)]
    back = [start.driven(turn, shared) for turn in _turns(sides.parent)]
    return sum(turns, start=number(0)) - sum(back, start=number(0))


class _Turn(NamedTuple):
    axis: Vector
    angle: Expr


class _Start(NamedTuple):
    """The position where all coordinates are zero, but for the scalar parts of quaternions, which are one."""

    scalar_parts: frozenset[Expr]

    def of(self, value: Expr) -> Expr:
        """Return a value there."""
        moving = (each for each in value.free_symbols if each.depends_on_time)
        return substitute([value], {each: number(int(each in self.scalar_parts)) for each in moving})[0]

    def along(self, turn: _Turn, shared: Vector) -> Expr:
        """Return the angle of a turn, with the sense in which it is about an axis; zero about any other axis."""
        return self.of(turn.angle) * self._sense(turn, shared)

    def driven(self, turn: _Turn, shared: Vector) -> Expr:
        """Return the part of the same angle that is an expression of time, beyond its value at time zero."""
        moving = [each for each in turn.angle.free_symbols if each.kind == "time_function"]
        by_time = substitute([turn.angle], dict.fromkeys(moving, number(0)))[0]
        return (
            (by_time - self.of(by_time)) * self._sense(turn, shared) if by_time.depends_on_time else number(0)
        )

    def _sense(self, turn: _Turn, shared: Vector) -> Expr:
        """Return 1 or -1 for a turn about an axis, and zero for one about any other."""
        cosine = self.of(dot(shared, turn.axis))
        return cosine if (cosine**2 - 1).is_zero else number(0)


def _scalar_parts(*frames: Frame) -> Iterator[Expr]:
    """Yield the first Euler parameters of the floating frames in some chains."""
    for each in (link for frame in frames for link in frame.chain):
        if each.motion is not None:
            yield from each.motion.quaternion[:1]


def _turns(frame: Frame) -> list[_Turn]:
    """Return the turns about principal axes in the chain of a frame."""
    return [
        _Turn(
            Vector(each, *(int(k == each.motion.turn_axis) for k in range(3))),
            each.motion.turn_angle,
        )
        for each in frame.chain
        if each.motion is not None and each.motion.turn_angle is not None
    ]


def _within_a_turn(angle: Expr) -> Expr:
    """Return an angle from -pi to pi that differs from a given one by whole turns."""
    if not angle.is_constant:
        return atan2(sin(angle), cos(angle))
    turns = round(float(angle) / (2 * half_turn))
    return angle - 2 * turns * pi
