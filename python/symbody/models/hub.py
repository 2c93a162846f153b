"""The hub of a wheel that rolls by the choice of its speeds, without multipliers."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.geometry import Frame, moving_frame, rotate, translate
from symbody.symbolic import Expr, cos, functions_of_time, sin

__all__ = ["HUB_SPEEDS", "hub"]

HUB_SPEEDS = functions_of_time("omega_yaw omega_lean")
"""The speeds of a wheel beside that of its spin."""


def hub(pose: Sequence[Expr], height: Expr, spin: Expr) -> Frame:
    """Return the frame at the centre of a wheel on the plane z = 0, which leans with the wheel, and doesn't spin.

    The material point at the contact is at rest, so that the velocity of the centre is ``omega x (0, 0, height)``, with
    the angular velocity omega of the wheel.

    Args:
        pose: the contact at x and y, the yaw about z, and the lean about the x axis of the heading.
        height: of the centre above the contact, along the z axis of the frame: negative where z points down.
        spin: the rate of the wheel about the y axis of this frame.
    """
    x, y, yaw, lean = pose
    turning, leaning = HUB_SPEEDS
    across, upright = turning * sin(lean), turning * cos(lean)
    placed = translate(x, y, 0) * rotate("Z", yaw) * rotate("X", lean) * translate(0, 0, height)
    forward, sideways = height * (across + spin), -height * leaning
    return moving_frame(forward, sideways, 0, leaning, across, upright, pose=placed)
