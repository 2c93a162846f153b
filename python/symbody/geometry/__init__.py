"""Frames, points and vectors, their velocities and accelerations."""

from symbody.geometry.component.triple import Scalar, Triple
from symbody.geometry.frame.constructors import floating_frame, moving_frame, rotate, translate
from symbody.geometry.frame.frame import Frame, ground
from symbody.geometry.point.point import Point, origin
from symbody.geometry.point.project import project
from symbody.geometry.point.vector import Vector, cross, dot
from symbody.geometry.point.velocity import acceleration, angular_velocity, frozen_velocity, velocity

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
