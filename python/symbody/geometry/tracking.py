"""Tracking equations: the rates of a pose's coordinates by the velocities in its own axes."""

from __future__ import annotations

from symbody.errors import ExpressionError, FrameError
from symbody.symbolic import Expr, derivation, solve, time_derivative
from symbody.symbolic.arguments import brief

from .floating import Floating
from .frame import Frame, ground
from .kinematics import twist
from .placement import Placement
from .twist import Twist


def tracking(pose: Frame, velocities: Twist) -> Floating:
    """Return the motion that has the pose of a frame, and velocities of its own in its axes.

    The coordinates are the functions of time in the pose; the twist of the pose, linear in their rates, is solved for
    these. The frame's own speeds must be able to follow: a pose in a plane has no rates for a velocity across it.
    """
    if pose.ancestor != ground or not pose.is_rigid or pose.kinematics:
        raise FrameError(
            f"moving_frame: the pose {brief(pose)}; expected a frame of translations and rotations away from ground"
        )
    with derivation():
        rows, origin = pose.pose
        placement = Placement(rows, origin)
        placement.to_parent(velocities.linear)  # the rates of the origin, in the form that they are to take
        return Floating(placement, velocities, _rates(pose, velocities))


def _rates(pose: Frame, velocities: Twist) -> dict[Expr, Expr]:
    (a, b, c), (d, e, f) = twist(pose)
    (p, q, r), (u, v, w) = velocities
    coordinates = _coordinates(pose)
    try:
        rates = solve([d - u, e - v, f - w, a - p, b - q, c - r], [time_derivative(x) for x in coordinates])
    except ExpressionError as failure:
        listed = brief(", ".join(map(str, coordinates)))
        raise FrameError(
            f"moving_frame: the pose by {listed} can't follow the velocities: {failure}"
        ) from failure
    return dict(zip(coordinates, rates.values(), strict=True))


def _coordinates(pose: Frame) -> list[Expr]:
    """Return the functions of time in a pose: motion by motion, those of one by name."""
    found: dict[Expr, None] = {}
    for motion in pose.motions:
        functions = (leaf for leaf in motion.leaves if leaf.kind == "time_function")
        found |= dict.fromkeys(sorted(functions, key=lambda leaf: (leaf.name, leaf.order)))
    return list(found)
