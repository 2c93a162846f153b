"""Twists: the motion of a rigid frame at an instant."""

from __future__ import annotations

from typing import NamedTuple

from .triple import Triple


class Twist(NamedTuple):
    """The velocity field of a rigid frame: angular velocity, and velocity of the origin."""

    angular: Triple
    linear: Triple
