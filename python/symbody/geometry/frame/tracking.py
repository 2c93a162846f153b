"""Tracking equations: the rates of a pose's coordinates by the velocities in its own axes.

If a pose has fewer than six coordinates, the six velocities are redundant, and the rates can be written in several
ways: by some of the velocities, or by the least squares of all, ``A^T A q' = A^T v``, which divide by zero only where a
coordinate moves nothing. All ways have the same value; the most regular one is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

from symbody.errors import ExpressionError, FrameError
from symbody.geometry.component.triple import Triple
from symbody.geometry.component.twist import Twist
from symbody.geometry.motion.floating import Floating
from symbody.geometry.motion.placement import Placement
from symbody.symbolic import (
    ENERGY,
    Expr,
    derivation,
    matvec3,
    time_derivative,
    time_derivatives,
)
from symbody.symbolic.given.arguments import brief

from .frame import Frame, ground
from .frame_velocity import twist
from .regular_rates import normal_equations, regular_rates


def tracking(pose: Frame, velocities: Twist) -> Floating:
    """Return the motion that has the pose of a frame, and velocities of its own in its axes.

    The coordinates are the functions of time in the pose. The twist of the pose is linear in their rates, and is solved
    for them. The pose must be able to follow the velocities: a pose in a plane has no rates for a velocity across it.
    """
    if pose.ancestor != ground or not pose.is_rigid or pose.coordinate_rates:
        raise FrameError(
            f"moving_frame: the pose {brief(pose)}; expected a frame of translations and rotations away from ground"
        )
    with derivation(order=ENERGY):
        rows, origin = pose.pose
        placement = Placement(rows, origin)
        placement.to_parent(velocities.linear)  # the rates of the origin, in the form that they are to take
        return Floating(placement, velocities, _rates(pose, velocities))


def _rates(pose: Frame, velocities: Twist) -> dict[Expr, Expr]:
    coordinates = _coordinates(pose)
    rates = [time_derivative(x) for x in coordinates]
    turning, moving = (_less(*parts) for parts in zip(twist(pose), velocities, strict=True))
    others = _other_ways(turning, _along_ground(pose, velocities), rates) if len(rates) < _ALL else []
    try:
        found = regular_rates([[*moving, *turning], *others], rates, coordinates)
    except ExpressionError as failure:
        listed = brief(", ".join(map(str, coordinates)))
        raise FrameError(
            f"moving_frame: the pose by {listed} can't follow the velocities: {failure}"
        ) from failure
    return dict(zip(coordinates, found.values(), strict=True))


_ALL = 6
"""Coordinates that need all velocities."""


def _less(a: Triple, b: Triple) -> Triple:
    """Return the difference of the unknown side of an equation and the given one."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _along_ground(pose: Frame, velocities: Twist) -> Triple:
    """Return the equations of the origin's rates in the axes of ground: ``p' - R v = 0``."""
    (x, y, z), origin = pose.pose
    p, q, r = time_derivatives(origin)
    return _less((p, q, r), matvec3((*x, *y, *z), velocities.linear))


def _other_ways(turning: Triple, moving: Triple, rates: Sequence[Expr]) -> list[list[Expr]]:
    """Return equations of the same rates: angular velocities first, in all orders; and least squares."""
    orders = [[*order, *moving] for order in permutations(turning)]
    squares = [
        [*normal_equations(turning, rates), *moving],
        [*turning, *normal_equations(moving, rates)],
        normal_equations([*turning, *moving], rates),
    ]
    return [*orders, *squares]


def _coordinates(pose: Frame) -> list[Expr]:
    """Return the functions of time in a pose: motion by motion, those of one by name."""
    found: dict[Expr, None] = {}
    for motion in pose.motions:
        functions = (leaf for leaf in motion.leaves if leaf.kind == "time_function")
        found |= dict.fromkeys(sorted(functions, key=lambda leaf: (leaf.name, leaf.order)))
    return list(found)
