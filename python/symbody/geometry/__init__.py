"""Frames, points and vectors, their velocities and accelerations."""

from .elementary import floating_frame, moving_frame, rotate, translate
from .frame import Frame, ground
from .point import Point, origin
from .project import project
from .triple import Scalar, Triple
from .vector import Vector, cross, dot
from .velocity import acceleration, angular_velocity, frozen_velocity, velocity

__all__ = [
    "Frame",
    "Point",
    "Scalar",
    "Triple",
    "Vector",
    "acceleration",
    "angular_velocity",
    "cross",
    "dot",
    "floating_frame",
    "frozen_velocity",
    "ground",
    "moving_frame",
    "origin",
    "project",
    "rotate",
    "translate",
    "velocity",
]
