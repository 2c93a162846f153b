"""The relative motion of two bodies along a joint coordinate: about one axis, or along it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, NamedTuple, TypeAlias

from symbody.errors import LoadError
from symbody.geometry import Frame, Point, Triple, Vector, origin
from symbody.geometry.component.triple import NULL, is_null
from symbody.geometry.frame.coordinates import path, vector_components
from symbody.geometry.frame.frame_velocity import Seen, material_velocity, origin_velocity, spin
from symbody.geometry.motion.floating import rate_by
from symbody.multibody.body import Body
from symbody.multibody.joint.freedom import Freedom
from symbody.multibody.load import Action
from symbody.symbolic import ENERGY, Expr, cross3, derivation, diff, dot3, functions_of_time, scale3, sub3
from symbody.symbolic.given.arguments import brief

from .attachment import check_bodies, forces, is_fixed, torques

Along: TypeAlias = Annotated[
    Expr | Freedom, "a coordinate of a joint, or a freedom of one, such as mechanism.joint('C').freedom()"
]


class JointMotion(NamedTuple):
    """How one body moves relative to another along a coordinate, and the unit wrench along it.

    Attributes:
        force: on the body, per unit of effort; null about a hinge.
        moment: on the body, beside the force.
        at: the point of the force.
        value: the coordinate.
        rate: its rate, which is the power of the unit wrench.
        on: the body that moves.
        reaction: the other body; None for the ground, or the moving master frame.
        far_end: without a reaction, the frame of the other side.
    """

    force: Vector
    moment: Vector
    at: Point
    value: Expr
    rate: Expr
    on: Body
    reaction: Body | None
    far_end: Frame | None = None

    def actions(self, effort: Expr) -> list[Action]:
        """Return the torques and forces whose power is the effort times the rate of the coordinate."""
        force, moment = self.force * effort, self.moment * effort
        found = [] if is_null(self.force.components) else forces(force, self.at, self.on, self.reaction)
        return (
            found if is_null(self.moment.components) else [*found, *torques(moment, self.on, self.reaction)]
        )


def joint_motion(coordinate: Along, on: Body, reaction: Body | None, where: str) -> JointMotion:
    """Return the relative motion of two bodies along a coordinate, or a sum of coordinates such as ``q2 - q1``.

    Args:
        coordinate: a coordinate of the joint between the bodies, or an expression of the coordinates; or a freedom.
        on: the body that moves.
        reaction: the other body; None for the ground.
        where: the function that the user called.

    Raises:
        LoadError: no force or torque between the bodies has the power of the rate of the coordinate alone.
    """
    check_bodies(where, on, reaction)
    of_one_joint = isinstance(coordinate, Freedom)
    base = on.frame.ancestor if reaction is None else reaction.frame
    if isinstance(coordinate, Freedom):
        _check_ends(coordinate, on, reaction, where)
        if coordinate.travel is not None:
            with derivation(order=ENERGY):
                return _along(coordinate, on, reaction)
        base = _moving_side(coordinate) or base
        coordinate = coordinate.value
    else:
        _check_coordinate(coordinate, where)
    with derivation(order=ENERGY):
        found = _by_coordinate(coordinate, (on, reaction), base, of_one_joint=of_one_joint)
    if found is None and not any(leaf.kind == "time_function" for leaf in coordinate.free_symbols):
        raise LoadError(
            f"{where}: the coordinate {brief(coordinate)} is known as a function of time; expected the freedom of the "
            "joint that it drives: mechanism.joint(...).freedom()"
        )
    if found is None:
        raise LoadError(
            f"{where}: {brief(on)} doesn't move against {brief(base)} about or along one axis at the rate of "
            f"{brief(coordinate)}; expected the coordinate of a joint between them, or the difference of absolute "
            "ones; if several joints are between them, put massless bodies there: Body(frame, 0); of a wheel, "
            "a joint on a frame that moves, or one that closes a loop, give mechanism.joint(...).freedom()"
        )
    return found


def _moving_side(freedom: Freedom) -> Frame | None:
    """Return the side of a joint that is on a frame with a given motion, such as the deck of a ship, or None."""
    moving = (side for side in _frames(freedom) if not all(motion.is_constant for motion in side.motions))
    return next(moving, None)


def _frames(freedom: Freedom) -> list[Frame]:
    """Return the sides of a joint that are on frames, not on links."""
    return [side for name, side in zip(freedom.ends, freedom.sides, strict=True) if not name]


def _check_coordinate(coordinate: Expr, where: str) -> None:
    """Check that a coordinate moves, and holds no rates, along which nothing acts."""
    leaves = sorted(coordinate.free_symbols, key=str)
    rate = next((leaf for leaf in leaves if leaf.kind == "time_function" and leaf.order), None)
    if rate is not None:
        raise LoadError(
            f"{where}: the coordinate {brief(coordinate)} holds the rate {rate}; expected the coordinate itself, such "
            f"as {functions_of_time(rate.name)}"
        )
    if not coordinate.depends_on_time:
        raise LoadError(
            f"{where}: the coordinate {brief(coordinate)} doesn't depend on time; expected that of a joint, such as "
            "joint.coordinate"
        )


def _check_ends(freedom: Freedom, on: Body, reaction: Body | None, where: str) -> None:
    """Raise an error for other bodies than those that the joint connects."""
    given = {on.name, "" if reaction is None or _carries(reaction, freedom) else reaction.name}
    if given != {*freedom.ends}:
        wanted = " and ".join(name or "a frame" for name in freedom.ends)
        raise LoadError(
            f"{where}: on={brief(on)}, reaction={brief(reaction)}; expected what {freedom.joint} connects, {wanted}"
        )
    bodies = {body.name: body for body in (on, reaction) if body is not None}
    for name, side in zip(freedom.ends, freedom.sides, strict=True):
        if name and not is_fixed(side, bodies[name]):
            raise LoadError(
                f"{where}: {freedom} is at a place that moves in the body {name}; expected a freedom of the mechanism "
                "that these bodies belong to, not of one that was assembled otherwise"
            )


def _carries(body: Body, freedom: Freedom) -> bool:
    """Whether the joint is on a frame, which is fixed in a body."""
    return any(is_fixed(side, body) for side in _frames(freedom))


def _along(freedom: Freedom, on: Body, reaction: Body | None) -> JointMotion:
    """Return the motion along a freedom, by the axis and the place of the joint."""
    assert freedom.travel is not None
    axis, at, rate = freedom.travel.axis, freedom.point, freedom.rate
    unit = axis if on.name == freedom.ends[1] else -axis
    none = axis * 0
    far = None if reaction else next(iter(_frames(freedom)), None)
    force, moment = (none, unit) if freedom.travel.is_rotation else (unit, none)
    return JointMotion(force, moment, at, freedom.value, rate, on, reaction, far)


class _Twist(NamedTuple):
    """The relative velocity of a point of a body, and its relative angular velocity, in the axes of the body."""

    linear: Triple
    angular: Triple

    def minus(self, other: _Twist, factor: Expr) -> _Twist:
        return _Twist(
            sub3(self.linear, scale3(factor, other.linear)), sub3(self.angular, scale3(factor, other.angular))
        )

    def per(self, leaf: Expr, slope: Expr | int = 1) -> _Twist:
        """Return the partial velocities of a rate."""
        x, y, z, a, b, c = (diff(each, leaf) / slope for each in (*self.linear, *self.angular))
        return _Twist((x, y, z), (a, b, c))

    @property
    def is_null(self) -> bool:
        return is_null(self.linear) and is_null(self.angular)

    @property
    def leaves(self) -> list[Expr]:
        """The rates in it."""
        found = {leaf for each in (*self.linear, *self.angular) for leaf in each.free_symbols}
        return sorted((leaf for leaf in found if leaf.kind == "time_function" and leaf.order), key=str)


def _by_coordinate(
    coordinate: Expr, bodies: tuple[Body, Body | None], base: Frame, *, of_one_joint: bool
) -> JointMotion | None:
    """Return the motion along a coordinate, by the twist of the body; None if no wrench has its power alone.

    Args:
        coordinate: an expression of coordinates.
        bodies: the body that moves, and the other body; None for the ground.
        base: the frame against which it moves.
        of_one_joint: whether it is known to be the freedom of one joint, as those of a wheel are about several places.
    """
    on, reaction = bodies
    (rate,) = rate_by({**on.frame.coordinate_rates, **base.coordinate_rates})((coordinate,))
    twist = _Twist(
        _relative(origin_velocity(on.frame), _carried(on.frame, base), on.frame),
        _relative(Seen(spin(on.frame), on.frame), Seen(spin(base), base), on.frame),
    )
    leaves = (leaf for leaf in rate.free_symbols if leaf.kind == "time_function" and leaf.order)
    for leaf in sorted(leaves, key=str):
        slope = diff(rate, leaf)
        own = twist.per(leaf, slope) if not slope.is_zero else _Twist(NULL, NULL)
        if own.is_null:
            continue
        others = [*_columns(twist.minus(own, rate))]
        wrench = _wrench(own, others)
        is_clear = of_one_joint or not _interferes(own, others) or _is_one_joint(on.frame, base)
        if wrench is None or not is_clear:
            continue
        force, moment = (Vector(on.frame, *each) for each in wrench)
        power = dot3(wrench[0], twist.linear) + dot3(wrench[1], twist.angular)
        if power == rate:
            return JointMotion(
                force, moment, on.center_of_mass, coordinate, rate, on, reaction, None if reaction else base
            )
    return None


def _columns(rest: _Twist) -> Iterator[_Twist]:
    """Yield the partial velocities of the other rates.

    What is left are given velocities, such as those of a turntable. No couple must cancel the power along them: the
    joint would have to carry it.
    """
    for leaf in rest.leaves:
        column = rest.per(leaf)
        if not column.is_null:
            yield column


def _interferes(own: _Twist, others: Sequence[_Twist]) -> bool:
    """Whether there are other freedoms that a force or torque along this one could drive."""
    turns = not is_null(own.angular)
    return any(not turns or not is_null(each.angular) for each in others)


def _is_one_joint(frame: Frame, base: Frame) -> bool:
    """Whether the motions between two frames follow each other with no place in between."""
    up, down = path(frame, base)
    moving = [k for k, motion in enumerate((*up, *down)) if not motion.is_constant]
    return bool(moving) and moving[-1] - moving[0] == len(moving) - 1


def _wrench(own: _Twist, others: Sequence[_Twist]) -> tuple[Triple, Triple] | None:
    """Return the force and moment whose power is one along a freedom, and zero along the others.

    Along a rotation it is a couple; along a displacement a force, with the couple that keeps it from turning the body.
    """
    turning = [each for each in others if not is_null(each.angular)]
    axes = [each.angular for each in turning]
    if not is_null(own.angular):
        moment = _dual(own.angular, axes)
        return None if moment is None else (NULL, moment)
    force = _dual(own.linear, [each.linear for each in others if is_null(each.angular)])
    if force is None:
        return None
    moment = NULL
    for k, each in enumerate(turning):
        power = dot3(force, each.linear)
        if not power.is_zero:
            couple = _dual(each.angular, [*axes[:k], *axes[k + 1 :]])
            if couple is None:
                return None
            moment = sub3(moment, scale3(power, couple))
    return force, moment


def _dual(e: Triple, others: Iterable[Triple]) -> Triple | None:
    """Return the vector whose product with e is one, and with the others zero; None if e is one of their sums."""
    basis: list[Triple] = []
    for other in others:
        if len(basis) < 2 and not (basis and is_null(cross3(basis[0], other))):
            basis.append(other)
        elif len(basis) == 2 and not dot3(cross3(*basis), other).is_zero:
            return None
    match basis:
        case []:
            n = e
        case [b]:
            along = dot3(e, b)
            n = e if along.is_zero else sub3(e, scale3(along / dot3(b, b), b))
        case _:
            n = cross3(basis[0], basis[1])
    square = dot3(n, e)
    if square.is_zero:
        return None
    return n if square == 1 else scale3(1 / square, n)


def _carried(frame: Frame, base: Frame) -> Seen:
    """Return the velocity of the point of the base that is at the origin of a frame."""
    return material_velocity(origin(frame).projected(base).coordinates, base)


def _relative(one: Seen, other: Seen, axes: Frame) -> Triple:
    return sub3(
        vector_components(one.components, one.axes, axes),
        vector_components(other.components, other.axes, axes),
    )
