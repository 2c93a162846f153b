"""The angle between the sides of a joint where all coordinates are zero: a sum of the turns that lead there."""

from __future__ import annotations

from math import pi as half_turn
from typing import NamedTuple

from symbody.geometry import Frame, Vector, dot
from symbody.symbolic import Expr, atan2, cos, number, pi, sin, substitute

from .closure import Sides

__all__ = ["constant_angle"]


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
    sine, cosine = _at_zero(sine), _at_zero(cosine)
    shared = sides.of_parent(axis)
    turns = [_along(turn, shared) for turn in _turns(sides.child)]
    back = [_along(turn, shared) for turn in _turns(sides.parent)]
    total = sum(turns, start=number(0)) - sum(back, start=number(0))
    for quarter in range(4):
        angle = total + quarter * pi / 2
        if (sin(angle) - sine).is_zero and (cos(angle) - cosine).is_zero:
            return _within_a_turn(angle)
    return atan2(sine, cosine)


class _Turn(NamedTuple):
    axis: Vector
    angle: Expr


def _turns(frame: Frame) -> list[_Turn]:
    """Return the turns about principal axes in the chain of a frame, by constant angles."""
    return [
        _Turn(
            Vector(each, *(int(k == each.motion.turn_axis) for k in range(3))),
            _at_zero(each.motion.turn_angle),
        )
        for each in frame.chain
        if each.motion is not None and each.motion.turn_angle is not None
    ]


def _along(turn: _Turn, shared: Vector) -> Expr:
    """Return the angle of a turn, with the sense in which it is about an axis; zero about any other axis."""
    cosine = _at_zero(dot(shared, turn.axis))
    return turn.angle * cosine if (cosine**2 - 1).is_zero else number(0)


def _at_zero(value: Expr) -> Expr:
    """Return a value where all that moves is zero."""
    return substitute([value], {each: number(0) for each in value.free_symbols if each.depends_on_time})[0]


def _within_a_turn(angle: Expr) -> Expr:
    """Return an angle from -pi to pi that differs from a given one by whole turns."""
    if not angle.is_constant:
        return atan2(sin(angle), cos(angle))
    turns = round(float(angle) / (2 * half_turn))
    return angle - 2 * turns * pi
