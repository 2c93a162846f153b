"""The relative motion of two bodies along a joint coordinate: about one axis, or along it."""

from __future__ import annotations

from typing import NamedTuple

from symbody.errors import LoadError
from symbody.geometry import Frame, Triple, Vector, origin
from symbody.geometry.component.triple import is_null
from symbody.geometry.frame.coordinates import vector_components
from symbody.geometry.frame.frame_velocity import Seen, material_velocity, origin_velocity, spin
from symbody.geometry.motion.floating import rate_by
from symbody.multibody.body import Body
from symbody.multibody.load import Action
from symbody.symbolic import Expr, derivation, diff, dot3, scale3, sub3
from symbody.symbolic.given.arguments import brief

from .attachment import check_bodies, forces, torques


class JointMotion(NamedTuple):
    """How one body moves relative to another along a coordinate.

    Attributes:
        axis: the vector whose product with the rate of the coordinate is the relative velocity, by its square.
        is_rotation: whether the velocity is angular.
        rate: the rate of the coordinate.
        on: the body that moves.
        reaction: the other body; None for the ground, or the moving master frame.
    """

    axis: Vector
    is_rotation: bool
    rate: Expr
    on: Body
    reaction: Body | None

    def actions(self, effort: Expr) -> list[Action]:
        """Return the torques or forces whose power is the effort times the rate of the coordinate."""
        vector = self.axis * effort
        if self.is_rotation:
            return torques(vector, self.on, self.reaction)
        return forces(vector, self.on.center_of_mass, self.on, self.reaction)


def joint_motion(coordinate: Expr, on: Body, reaction: Body | None, where: str) -> JointMotion:
    """Return the relative motion of two bodies along a coordinate, or a sum of coordinates such as ``q2 - q1``.

    Args:
        coordinate: a coordinate of the joint between the bodies, or an expression of the coordinates.
        on: the body that moves.
        reaction: the other body; None for the ground.
        where: the function that the user called.

    Raises:
        LoadError: the relative motion is none about or along one axis, at the rate of the coordinate.
    """
    check_bodies(where, on, reaction)
    base = on.frame.ancestor if reaction is None else reaction.frame
    with derivation():
        known = rate_by({**on.frame.coordinate_rates, **base.coordinate_rates})
        (rate,) = known((coordinate,))
        angular = _relative(Seen(spin(on.frame), on.frame), Seen(spin(base), base), on.frame)
        linear = _relative(origin_velocity(on.frame), _carried(on.frame, base), on.frame)
        relative = linear if is_null(angular) else angular
        direction = _direction(relative, rate)
    if direction is None:
        other = base if reaction is None else reaction
        raise LoadError(
            f"{where}: {brief(on)} doesn't move against {brief(other)} about or along one axis at the rate of "
            f"{brief(coordinate)}; expected the coordinate of a hinge or a slide between them, or the difference of "
            "absolute ones; if several joints are between them, put massless bodies there: Body(frame, 0)"
        )
    return JointMotion(Vector(on.frame, *direction), not is_null(angular), rate, on, reaction)


def _carried(frame: Frame, base: Frame) -> Seen:
    """Return the velocity of the point of the base that is at the origin of a frame."""
    return material_velocity(origin(frame).projected(base).coordinates, base)


def _relative(one: Seen, other: Seen, axes: Frame) -> Triple:
    return sub3(
        vector_components(one.components, one.axes, axes),
        vector_components(other.components, other.axes, axes),
    )


def _direction(velocity: Triple, rate: Expr) -> Triple | None:
    """Return ``e/|e|^2`` where the velocity is e times the rate; None if it isn't, or if there is none."""
    leaf = min((leaf for leaf in rate.free_symbols if leaf.kind == "time_function"), key=str, default=None)
    if leaf is None or is_null(velocity):
        return None
    slope = diff(rate, leaf)
    if slope.is_zero:
        return None
    x, y, z = (diff(component, leaf) / slope for component in velocity)
    e = (x, y, z)
    if not is_null(sub3(velocity, scale3(rate, e))) or is_null(e):
        return None
    square = dot3(e, e)
    return e if square == 1 else scale3(1 / square, e)
