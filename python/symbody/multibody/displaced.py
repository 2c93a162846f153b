"""Rigid displacements of points, vectors, bodies and loads."""

from __future__ import annotations

from typing import TypeVar

from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Vector
from symbody.geometry.frame.coordinates import path
from symbody.geometry.given.argument import checked

from .body import Body
from .element.element import Element
from .load import Action, Force, Load, Torque

Thing = TypeVar("Thing", bound=Point | Vector | Body | Load)


@checked(ModelError)
def displaced(thing: Thing, motion: Frame, *, frame: Frame | None = None) -> Thing:
    """Return a point, vector, body or load after a rigid displacement, as if it were fixed in a displaced frame.

    Args:
        thing: the point, vector, body or load. A load acts on the same bodies afterwards, elsewhere and in another
            direction, and has no potential any more: displace the points of a spring instead.
        motion: the displacement in the axes of the frame, such as ``translate(1, 0, 0)`` or ``rotate("Z", alpha)``.
        frame: the frame that is displaced; by default that of the thing.

    >>> from symbody import Point, Vector, displaced, ground, pi, project, rotate, symbols, translate
    >>> l = symbols("l")
    >>> project(displaced(Point(ground, l, 0, 0), rotate("Z", pi / 2)), ground).coordinates
    (0, l, 0)
    >>> project(displaced(Vector(ground, l, 0, 0), translate(0, 0, 1)), ground).components
    (l, 0, 0)
    """
    match thing:
        case Point():
            return _point(thing, motion, frame)  # type: ignore[return-value]
        case Vector():
            return _vector(thing, motion, frame)  # type: ignore[return-value]
        case Body():
            values = (thing.mass, *thing.moments, *thing.products)
            return Body(_carried(thing.frame, motion, frame), *values, name=thing.name)  # type: ignore[return-value]
        case _:
            return _load(thing, motion, frame)  # type: ignore[return-value]


def _carried(moved: Frame, motion: Frame, frame: Frame | None) -> Frame:
    """Return a frame after the displacement."""
    if frame is None:
        return moved * motion
    up, down = path(frame, moved)
    result = frame * motion
    for each in up:
        for back in each.inverse():
            result = result.then(back)
    for each in down:
        result = result.then(each)
    return result


def _point(point: Point, motion: Frame, frame: Frame | None) -> Point:
    return Point(_carried(point.frame, motion, frame), *point.coordinates, name=point.name)


def _vector(vector: Vector, motion: Frame, frame: Frame | None) -> Vector:
    return Vector(_carried(vector.frame, motion, frame), *vector.components, name=vector.name)


def _load(load: Load, motion: Frame, frame: Frame | None) -> Load:
    axes = load.actions[0].vector.frame if frame is None else frame
    if isinstance(load, Force):
        vector, at = _vector(load.vector, motion, axes), _point(load.at, motion, axes)
        return Force(vector, at=at, on=load.on, reaction=load.reaction, name=load.name)
    if isinstance(load, Torque):
        return Torque(_vector(load.vector, motion, axes), on=load.on, reaction=load.reaction, name=load.name)
    actions = tuple(_action(action, motion, axes) for action in load.actions)
    if isinstance(load, Element):  # its potential is that of the forces where they were
        return Element(load.kind, actions, states=load.states, quantities=load.quantities, name=load.name)
    return load.acting(actions, "displace")


def _action(action: Action, motion: Frame, axes: Frame) -> Action:
    point = None if action.point is None else _point(action.point, motion, axes)
    return Action(action.body, _vector(action.vector, motion, axes), point)
