"""Rigid displacements of points, vectors, bodies and loads."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

from symbody.errors import ModelError, notify
from symbody.geometry import Frame, Point, Vector
from symbody.geometry.frame.coordinates import path
from symbody.geometry.given.argument import checked
from symbody.symbolic.given.arguments import brief

from .body import Body
from .element.element import Element, is_along_line
from .load import Action, Force, Load, Torque, power

Thing = TypeVar("Thing", bound=Point | Vector | Body | Load)


@checked(ModelError)
def displaced(thing: Thing, motion: Frame, *, frame: Frame | None = None) -> Thing:
    """Return a point, vector, body or load after a rigid displacement, as if it were fixed in a displaced frame.

    Args:
        thing: the point, vector, body or load. A load acts on the same bodies afterwards, elsewhere and in another
            direction. An element keeps its potential energy if the power of its actions stays the same, as that of a
            torque which is shifted; otherwise a notice says that it has none any more.
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
            return thing.with_values(_carried(thing.frame, motion, frame), *values)  # type: ignore[return-value]
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
    if isinstance(load, Element):
        return _element(load, actions)
    return load.acting(actions, "displace")


def _element(element: Element, actions: Sequence[Action]) -> Element:
    """Return an element with displaced actions; its potential is that of the actions where they were.

    So is the law of a force along a line, which is another line afterwards.
    """
    more: dict[str, Any] = {
        "states": element.states,
        "quantities": element.quantities,
        "name": element.name,
        "undefined": element.undefined,
        "jumping": element.jumping,
        "sizes": element.sizes,
        "positive": element.positive,
        "is_along_freedom": element.is_along_freedom,
        "expected": element.expected,
        "far_end": element.far_end,
    }
    moved = Element(element.kind, actions, **more)
    keeps_power = power(moved) == power(element)
    if keeps_power or not is_along_line(element):
        more["law"] = element.law
        moved = Element(element.kind, actions, **more)
    if element.potential is None:
        return moved
    if keeps_power:
        return Element(element.kind, actions, potential=element.potential, **more)
    notify(
        f"displaced: {brief(element)} has no potential energy any more, as its actions have another power where they "
        "are now, so that energies leave it out; to keep it, make the element of displaced points or frames"
    )
    return moved


def _action(action: Action, motion: Frame, axes: Frame) -> Action:
    point = None if action.point is None else _point(action.point, motion, axes)
    return Action(action.body, _vector(action.vector, motion, axes), point)
