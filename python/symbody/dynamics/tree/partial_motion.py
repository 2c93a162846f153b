"""Partial twists: the derivatives of the twist of a motion by the speeds."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from symbody.geometry.component.triple import NULL, Rate, Triple, is_null
from symbody.geometry.component.twist import Twist
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.symbolic import Expr, jacobian


class PartialTwist(NamedTuple):
    """The twist of a child in its parent, per unit of one speed, in the child's axes."""

    spin: Triple
    drift: Triple
    """Of the child's origin."""


def partial_twists(motion: FrameMotion, coordinates: Sequence[Expr]) -> list[PartialTwist]:
    """Return the partial twists of a motion by the rate of each of the coordinates."""
    drifts = _partial_drifts(motion, coordinates)
    if not motion.rotates:
        return [PartialTwist(NULL, drift) for drift in drifts]
    spins = [motion.spin(partial(slope, q)) for q in coordinates]
    return [PartialTwist(spin, drift) for spin, drift in zip(spins, drifts, strict=True)]


def twist_of(motion: FrameMotion, rate: Rate) -> Twist:
    """Return the twist of a child in its parent, in the child's axes, with the rates of coordinates by some speeds."""
    drift = motion.to_child(motion.drift(rate))
    return Twist(motion.spin(rate) if motion.rotates else NULL, drift)


def partial_twists_by_speeds(twist: Twist, speeds: Sequence[Expr]) -> list[PartialTwist]:
    """Return the partial twists of a twist that is given by speeds."""
    slopes = jacobian((*twist.angular, *twist.linear), speeds)
    columns = zip(*(slopes.row(k) for k in range(6)), strict=True)
    return [PartialTwist((p, q, r), (u, v, w)) for p, q, r, u, v, w in columns]


def _partial_drifts(motion: FrameMotion, coordinates: Sequence[Expr]) -> list[Triple]:
    """Return the derivatives of the displacement by each of the coordinates."""
    if is_null(motion.displacement):
        return [NULL] * len(coordinates)
    slopes = jacobian(motion.displacement, coordinates)
    return [motion.to_child(d) for d in zip(slopes.row(0), slopes.row(1), slopes.row(2), strict=True)]


def slope(coordinate: Expr, values: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the partial derivatives by one coordinate."""
    return tuple(value.diff(coordinate) for value in values)
