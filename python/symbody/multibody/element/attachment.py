"""Attachment: points and frames that are fixed in bodies, and the actions of an element on both bodies."""

from __future__ import annotations

from symbody.errors import LoadError
from symbody.geometry import Frame, Point, Scalar, Vector, origin
from symbody.geometry.component.triple import expression
from symbody.multibody.body import Body
from symbody.multibody.constant_form import constant_form
from symbody.multibody.load import Action
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief


def check_bodies(where: str, on: Body, reaction: Body | None) -> None:
    """Raise an error for an element between a body and itself."""
    if on is reaction:
        raise LoadError(
            f"{where}: acts and reacts on the same body {brief(on)}; name two bodies, or leave reaction out"
        )


def check_fixed(where: str, what: str, place: Point | Frame, body: Body | None) -> None:
    """Raise an error for a place that moves in its body; the law of the element holds for fixed ones.

    Args:
        where: the function that the user called.
        what: the argument.
        place: the point or frame that is given.
        body: the body in which it is fixed; None for a place on no body, which may move as it likes.
    """
    if body is None or is_fixed(place, body):
        return
    raise LoadError(
        f"{where}: {what} = {brief(place)} moves in the body {brief(body)}; expected a place that is fixed in it, "
        "built on its frame; if it slides there, give it a body of its own, such as Body(frame, 0)"
    )


def check_apart(where: str, to: Point, on: Body, reaction: Body | None) -> None:
    """Raise an error for an element between two points of one body, which would push that body by itself."""
    if reaction is None and is_fixed(to, on):
        raise LoadError(
            f"{where}: to = {brief(to)} has a constant place in the body {brief(on)}, on which the element acts: it is "
            "fixed there, or lies on the axis about which the body turns, so that nothing changes the length; expected "
            "a point of another body, with reaction=that body, or of the ground, off that axis"
        )


def check_acts(where: str, *resisting: Expr) -> None:
    """Raise an error for an element whose stiffness and damping are zero."""
    if all(each.is_zero for each in resisting):
        raise LoadError(f"{where}: neither stiffness nor damping; expected at least one of them")


def is_fixed(place: Point | Frame, body: Body) -> bool:
    """Return whether a place doesn't move in a body."""
    return all(constant_form(value) is not None for value in _seen(place, body.frame))


def _seen(place: Point | Frame, frame: Frame) -> list[Expr]:
    """Return the coordinates of a place in a frame; of a frame also the components of its axes."""
    if isinstance(place, Point):
        return [*place.projected(frame).coordinates]
    axes = (Vector(place, 1, 0, 0), Vector(place, 0, 1, 0))
    components = (component for axis in axes for component in axis.projected(frame).components)
    return [*origin(place).projected(frame).coordinates, *components]


def forces(
    vector: Vector, at: Point, on: Body, reaction: Body | None, back: Point | None = None
) -> list[Action]:
    """Return a force on a body, and the opposite force on the body that reacts.

    Args:
        vector: the force.
        at: where it acts.
        on: the body on which it acts.
        reaction: the body on which the opposite force acts, if there is one.
        back: where the opposite force acts; by default at the same place.
    """
    direct = Action(on, vector, at)
    return [direct] if reaction is None else [direct, Action(reaction, -vector, back or at)]


def torques(vector: Vector, on: Body, reaction: Body | None) -> list[Action]:
    """Return a torque on a body, and the opposite torque on the body that reacts."""
    direct = Action(on, vector)
    return [direct] if reaction is None else [direct, Action(reaction, -vector)]


def not_negative(where: str, **values: Scalar | None) -> dict[str, Expr]:
    """Return sizes and resistances by the names of the arguments; those left out, and numbers, are not among them.

    Raises:
        LoadError: a number is negative. Values of symbols are checked when a simulation begins.
    """
    given = {name: expression(value) for name, value in values.items() if value is not None}
    for name, value in given.items():
        if value.is_constant and float(value) < 0:
            raise LoadError(f"{where}: {negative_fault(name, value)}")
    return {name: value for name, value in given.items() if not value.is_constant}


def zero_fault(name: str) -> str:
    """Return what is wrong with a size that is zero, by which a law divides."""
    return f"{name} = 0; expected a positive number, by which the law divides"


def negative_fault(name: str, value: Expr | float) -> str:
    """Return what is wrong with a size or a resistance that is negative."""
    shown = f"{value:.6g}" if isinstance(value, float) else brief(value)
    return f"{name} = {shown}; expected a number that isn't negative, as a size or a resistance is"
