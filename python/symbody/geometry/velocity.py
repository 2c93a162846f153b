"""Velocities and accelerations as a user asks for them: seen from a frame, with components in that frame."""

from __future__ import annotations

from symbody.errors import FrameError
from symbody.symbolic import add3, cross3, derivation

from .argument import checked
from .floating import rate_by
from .frame import Frame
from .kinematics import material_velocity, spin
from .point import Point
from .triple import Triple, rates
from .vector import Vector


@checked(FrameError)
def velocity(thing: Point | Vector, frame: Frame | None = None) -> Vector:
    """Return the velocity of a point, or the rate of a vector, as seen from a frame and in its axes.

    Args:
        thing: point or vector.
        frame: who looks; by default the root of the thing's own frame: ground, or the moving master frame, whose own
            motion is then included.

    >>> from symbody import Point, functions_of_time, ground, velocity
    >>> x, y = functions_of_time("x y")
    >>> velocity(Point(ground, x, 2 * y, 0))
    Vector(ground, x', 2*y', 0)
    """
    observer = thing.frame.ancestor if frame is None else frame
    with derivation():
        return Vector(observer, *_velocity(thing, observer))


@checked(FrameError)
def acceleration(thing: Point | Vector, frame: Frame | None = None) -> Vector:
    """Return the acceleration of a point, or the second rate of a vector, as seen from a frame and in its axes."""
    observer = thing.frame.ancestor if frame is None else frame
    with derivation():
        return Vector(observer, *_rate(_velocity(thing, observer), observer, thing.frame))


def _velocity(thing: Point | Vector, observer: Frame) -> Triple:
    seen = thing.projected(observer)
    if isinstance(seen, Vector):
        return _rate(seen.components, observer, thing.frame)
    own = _rate(seen.coordinates, observer, thing.frame)
    return own if observer.carrier is None else add3(own, observer.carrier.linear)


def _rate(components: Triple, observer: Frame, frame: Frame) -> Triple:
    """Return the rate of components; a moving master frame stands for ground, so that its turning counts."""
    change = rates(components, rate_by(observer.kinematics | frame.kinematics))
    return change if observer.carrier is None else add3(change, cross3(observer.carrier.angular, components))


@checked(FrameError)
def angular_velocity(frame: Frame) -> Vector:
    """Return the angular velocity of a frame, in its own axes.

    >>> from symbody import angular_velocity, functions_of_time, rotate
    >>> angular_velocity(rotate("X", functions_of_time("phi"))).components
    (phi', 0, 0)
    """
    return Vector(frame, *spin(frame))


@checked(FrameError)
def frozen_velocity(point: Point, frame: Frame) -> Vector:
    """Return the velocity of the material point of a frame that coincides with a point, in the root's axes."""
    with derivation():
        components, axes = material_velocity(point.projected(frame).coordinates, frame)
        return Vector(axes, *components).projected(frame.ancestor)
