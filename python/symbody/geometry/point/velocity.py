"""Velocities and accelerations as seen from a frame, with components in this frame."""

from __future__ import annotations

from symbody.errors import FrameError
from symbody.geometry.component.triple import Triple, rates
from symbody.geometry.frame.acceleration_field import AccelerationField
from symbody.geometry.frame.frame import Frame
from symbody.geometry.frame.frame_velocity import material_velocity, spin, twist
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.floating import rate_by
from symbody.symbolic import ENERGY, add3, cross3, derivation, matvec3, number, scale3

from .point import Point
from .vector import Vector


@checked(FrameError)
def velocity(thing: Point | Vector, frame: Frame | None = None) -> Vector:
    """Return the velocity of a point, or the rate of a vector, as seen from a frame and in its axes.

    Args:
        thing: point or vector.
        frame: the observer; by default the root of the thing's own frame: ground, or the moving master frame, whose own
            motion is then included.

    >>> from symbody import Point, functions_of_time, ground, velocity
    >>> x, y = functions_of_time("x y")
    >>> velocity(Point(ground, x, 2 * y, 0))
    Vector(ground, x', 2*y', 0)
    """
    observer = thing.frame.ancestor if frame is None else frame
    with derivation(order=ENERGY):
        if _floats(thing.frame, observer):
            return Vector(thing.frame, *_first_rate(thing)).projected(observer)
        return Vector(observer, *_velocity(thing, observer))


@checked(FrameError)
def acceleration(thing: Point | Vector, frame: Frame | None = None) -> Vector:
    """Return the acceleration of a point, or the second rate of a vector, as seen from a frame and in its axes.

    Args:
        thing: point or vector.
        frame: the observer; by default the root of the thing's own frame: ground, or the moving master frame, whose own
            motion is then included.

    >>> from symbody import Point, acceleration, functions_of_time, rotate, symbols
    >>> r, phi = symbols("r"), functions_of_time("phi")
    >>> acceleration(Point(rotate("Z", phi), r, 0, 0)).components[0]
    -r*(sin(phi)*phi'' + cos(phi)*phi'**2)
    """
    observer = thing.frame.ancestor if frame is None else frame
    with derivation(order=ENERGY):
        if _floats(thing.frame, observer):
            return Vector(thing.frame, *_second_rate(thing)).projected(observer)
        return Vector(observer, *_rate(_velocity(thing, observer), observer, thing.frame))


def _floats(frame: Frame, observer: Frame) -> bool:
    """Return whether a frame floats as seen from its root, so that the speeds give its velocities."""
    return observer == frame.ancestor and bool(frame.coordinate_rates) and frame.is_rigid


def _first_rate(thing: Point | Vector) -> Triple:
    """Return ``w x p + p'`` for components p; for a point, plus the velocity of the origin."""
    angular, linear = twist(thing.frame)
    p, drift = _components(thing)
    turned = add3(cross3(angular, p), drift)
    return add3(linear, turned) if isinstance(thing, Point) else turned


def _second_rate(thing: Point | Vector) -> Triple:
    """Return ``F p + 2 w x p' + p''``; for a point, plus the acceleration of the origin."""
    turning, linear = AccelerationField()(thing.frame)
    p, drift = _components(thing)
    coriolis = scale3(number(2), cross3(turning.velocity, drift))
    turned = add3(
        matvec3(turning.field, p), add3(coriolis, rates(drift, rate_by(thing.frame.coordinate_rates)))
    )
    return add3(linear, turned) if isinstance(thing, Point) else turned


def _components(thing: Point | Vector) -> tuple[Triple, Triple]:
    """Return the components of a thing in its frame, and their rates."""
    p = thing.coordinates if isinstance(thing, Point) else thing.components
    return p, rates(p, rate_by(thing.frame.coordinate_rates))


def _velocity(thing: Point | Vector, observer: Frame) -> Triple:
    seen = thing.projected(observer)
    if isinstance(seen, Vector):
        return _rate(seen.components, observer, thing.frame)
    own = _rate(seen.coordinates, observer, thing.frame)
    return own if observer.carrier is None else add3(own, observer.carrier.linear)


def _rate(components: Triple, observer: Frame, frame: Frame) -> Triple:
    """Return the rate of components; in a moving master frame, the one that ground sees, with its rotation."""
    change = rates(components, rate_by(observer.coordinate_rates | frame.coordinate_rates))
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
def frozen_velocity(point: Point, frame: Frame, *, axes: Frame | None = None) -> Vector:
    """Return the velocity of the material point of a frame that coincides with a point.

    Args:
        point: the place.
        frame: the frame whose material point is wanted.
        axes: the frame in whose axes the components are, such as ``frame`` itself; by default the root: ground, or the
            moving master frame.

    >>> from symbody import Point, functions_of_time, ground, rotate, symbols
    >>> r, phi = symbols("r"), functions_of_time("phi")
    >>> disc = rotate("Z", phi)
    >>> frozen_velocity(Point(disc, r, 0, 0), disc, axes=disc).components
    (0, r*phi', 0)
    """
    with derivation(order=ENERGY):
        components, own = material_velocity(point.projected(frame).coordinates, frame)
        return Vector(own, *components).projected(frame.ancestor if axes is None else axes)
