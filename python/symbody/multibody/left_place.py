"""Forces at places that their bodies leave: at rest, or on another body."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from symbody.geometry import Frame, Point
from symbody.geometry.frame.coordinates import path
from symbody.symbolic import dot3
from symbody.symbolic.given.arguments import brief

from .body import Body
from .constant_form import constant_form
from .load import Force, Load

__all__ = ["are_joined", "left_place_notice", "left_places"]


def left_places(bodies: Collection[Body], loads: Iterable[Load]) -> Iterator[tuple[Force, str]]:
    """Return the forces whose point is at rest or on another body, from which their body moves away; and where it is.

    Such a force acts on one material point of its body after another, as that of a jet at rest does. It is meant if
    the point is fixed in the body that exerts it, which ``reaction`` names. A point at a constant distance from the
    centre of mass is not reported: it may be that of a wheel or of a joint.

    Args:
        bodies: the bodies of a system.
        loads: its loads.
    """
    for load in loads:
        if isinstance(load, Force) and load.on in bodies and not _is_held(load):
            where = _carrier(load, bodies)
            if where is not None and _leaves(load.on, load.at):
                yield load, where


def _is_held(force: Force) -> bool:
    """Whether the point of a force is fixed in the body on which it acts, or in that which reacts."""
    return any(
        body is not None and are_joined(force.at.frame, body.frame) for body in (force.on, force.reaction)
    )


def are_joined(one: Frame, other: Frame) -> bool:
    """Return whether two frames are fixed in each other."""
    return one.ancestor == other.ancestor and all(
        motion.is_constant for motions in path(one, other) for motion in motions
    )


def _carrier(force: Force, bodies: Iterable[Body]) -> str | None:
    """Return in words what carries the point of a force: the ground, or another body; None if it moves by itself."""
    point = force.at
    if any(value.depends_on_time for value in point.coordinates):
        return None
    if all(motion.is_constant for motion in point.frame.motions) and point.frame.ancestor.carrier is None:
        return "a place at rest"
    other = next((body for body in bodies if are_joined(point.frame, body.frame)), None)
    return None if other is None else f"a place on {other}"


def _leaves(body: Body, point: Point) -> bool:
    """Whether the distance of a point from the centre of mass changes."""
    arm = point.projected(body.frame).coordinates
    return constant_form(dot3(arm, arm)) is None


def left_place_notice(force: Force, where: str) -> str:
    """Return the notice of a force that its body leaves, at a place in words."""
    body, exerting = force.on, "reaction=that body"
    if where == "a place at rest":
        exerting = "reaction=Body(ground, 0, name='jet'), which is one of the bodies"
    return (
        f"{brief(force)} acts on {brief(body)} at {brief(force.at)}, {where}, from which the body moves away; expected "
        "a point of the body, such as Point(body.frame, x, y, z); if the force shall stay there, give what exerts it: "
        f"{exerting}"
    )
