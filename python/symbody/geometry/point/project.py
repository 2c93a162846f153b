"""Projection: points, vectors, forces and torques by their components in another frame."""

from __future__ import annotations

from typing import Protocol, Self, TypeVar, runtime_checkable

from symbody.errors import FrameError
from symbody.geometry.frame.frame import Frame
from symbody.geometry.given.argument import checked


@runtime_checkable
class Projectable(Protocol):
    """A point, a vector, a force or a torque."""

    def projected(self, frame: Frame) -> Self: ...


Thing = TypeVar("Thing", bound=Projectable)


@checked(FrameError)
def project(thing: Thing, frame: Frame) -> Thing:
    """Return the same point, vector, force or torque by its components in another frame.

    >>> from symbody import Vector, ground, pi, project, rotate
    >>> project(Vector(rotate("Z", pi / 2), 1, 0, 0), ground)
    Vector(ground, 0, 1, 0)
    """
    return thing.projected(frame)
