"""Rolling: a disc, a torus or a ball on a plane, without slip."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import final

from symbody.errors import JointError
from symbody.geometry import Frame, Scalar, Vector, angular_velocity, cross, dot, rotate, translate, velocity
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, number, pi, sqrt, time_derivatives

from .closure import Closure, Sides
from .joint import Coordinates, Joint, Loop, Part, joined, mounted
from .joint_angle import angles, turning_axis
from .limit import Limit, LimitsByName
from .link import Place
from .pair import Pair, Size, Travel, turns_back


@checked(JointError)
def rolling(
    name: str,
    parent: Part,
    child: Part,
    *,
    radius: Scalar,
    crown: Scalar = 0,
    at: Place = (0, 0, 0),
    to: Place = (0, 0, 0),
    coordinates: Coordinates = None,
    limits: LimitsByName = None,
    loop: Loop = None,
) -> Joint:
    """Return rolling without slip: a wheel whose axis is the y axis of `to` rolls on the plane z = 0 of `at`.

    It keeps three conditions: contact on positions, and no slip in two directions on velocities. Its reaction is the
    force of the ground at the contact. Where it opens the tree, five coordinates keep the contact, and the two other
    conditions, along x and y, stay constraints. A wheel that closes a loop doesn't slip along its heading and across,
    and must not lie flat; a ball doesn't slip along x and y. Motors and friction, such as rolling resistance, act along
    its heading, lean and spin by ``mechanism.joint(name).freedom("phi")`` in both cases.

    Args:
        name: the name of the joint.
        parent: what carries the plane; its other side, z < 0, is inside.
        child: the wheel.
        radius: from the centre of the wheel to the contact when it stands upright.
        crown: the radius of the cross-section: zero of a disc with a sharp edge, between zero and the radius of a
            torus such as a motorcycle's tyre, and the radius of a ball.
        at: the plane on the parent, in the parent's axes.
        to: the centre of the wheel on the child, in the child's axes.
        coordinates: along x and y, the heading about z, the lean about the heading, and the spin; ``x_<name>``,
            ``y_<name>``, ``psi_<name>``, ``theta_<name>`` and ``phi_<name>`` by default. With a crown, x and y are
            those of the centre of the cross-section.
        limits: the least and the largest values of coordinates by their names, such as ``{"theta": (-1.5, 1.5)}``; see
            `stops`. By default, a wheel that opens the tree leans up to a right angle, where it lies flat.
        loop: True if it shall close a loop, False if it shall open the tree.

    >>> from symbody import Link, assemble, ground, rolling, symbols
    >>> m, r = symbols("m r")
    >>> disc = Link("disc", m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    >>> coin = assemble([rolling("K", ground, disc, radius=r)])
    >>> coin.constraints[0]
    Constraint(K.slip x, x_K' - r*cos(psi_K)*phi_K' = 0)
    """
    where = f"rolling {name}"
    sizes = expression(radius), expression(crown)
    _check_sizes(where, *sizes)
    mounting = mounted("rolling", name, (parent, child), at, to, loop=loop)
    return joined("rolling", mounting, Contact(sizes[0] - sizes[1], sizes[1]), coordinates, limits)


def _check_sizes(where: str, radius: Expr, crown: Expr) -> None:
    if radius.depends_on_time or (radius.is_constant and float(radius) <= 0):
        raise JointError(
            f"{where}: radius = {radius}; expected a positive constant, the distance from the wheel's centre to the "
            "contact"
        )
    if crown.depends_on_time or (crown.is_constant and float(crown) < 0):
        raise JointError(f"{where}: crown = {crown}; expected a constant that isn't negative")
    beyond = crown - radius
    if beyond.is_constant and float(beyond) > 0:
        raise JointError(
            f"{where}: crown = {crown}, more than radius = {radius}; expected a cross-section within the wheel: zero "
            "for a disc, the radius itself for a ball"
        )


_TURNS = "ZXY"
"""The axes of the heading, the lean and the spin."""


@final
class Contact(Pair):
    """A torus that rolls on a plane: a circle of centres of cross-sections, and their radius."""

    names = ("x", "y", "psi", "theta", "phi")
    turning = ("phi",)
    rolls = True

    def __init__(self, circle: Expr, crown: Expr) -> None:
        self.circle, self.crown = circle, crown

    @property
    def sizes(self) -> tuple[Size, ...]:
        """The radius of the wheel, and those of its circle and its cross-section, which are within it."""
        wheel = Size("radius", self.circle + self.crown)
        if self.crown.is_zero:
            return (wheel,)
        return (
            wheel,
            Size("crown", self.crown, may_vanish=True),
            Size("radius - crown", self.circle, may_vanish=True),
        )

    @property
    def own_limits(self) -> tuple[Limit, ...]:
        """A wheel that lies flat can't lean further; a ball can."""
        return () if self.circle.is_zero else (Limit("theta", -pi / 2, pi / 2),)

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        return self._leaning(coordinates) * translate(0, 0, self.circle) * rotate("Y", coordinates[4])

    def measured(self, sides: Sides) -> Mapping[str, Expr]:
        """Return the coordinates measured on both sides: the centre of the lowest cross-section, and the angles."""
        n, e = sides.of_parent(2), sides.of_child(1).projected(sides.parent)
        lean = dot(n, e)
        down = self.circle / sqrt(1 - lean**2) * (n - lean * e)
        x, y, _ = (sides.gap - down).components
        return dict(zip(self.names, (x, y, *angles(_TURNS, sides.entry)), strict=True))

    def travel(self, sides: Sides, name: str) -> Travel | None:
        """Return the axis of an angle; None for x and y, which belong to no fixed point of the wheel."""
        if name in ("x", "y"):
            return None
        axis = turning_axis(sides, _TURNS, self.names.index(name) - 2)
        return Travel(axis, is_rotation=True, jumps=not turns_back(_TURNS, name))

    def _leaning(self, coordinates: Sequence[Expr]) -> Frame:
        """Return the axes that lean with the wheel and don't spin, at the lowest centre of a cross-section."""
        x, y, heading, lean, _ = coordinates
        return translate(x, y, self.crown) * rotate("Z", heading) * rotate("X", lean)

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        """Return contact and slip at the lowest point, which is along ``-(n - (n . e) e)`` from the centre.

        Where a condition follows from others, as the slip across of the second wheel of an axle does, it is the same
        one whatever the heading, ``e x n``. Both axes of the slip are as long as the cosine of the lean, which is
        shorter to write than unit vectors.
        """
        axle, spin = _axle(sides)
        n, e = sides.of_parent(2).projected(axle), sides.of_child(1).projected(axle)
        w = angular_velocity(axle) + spin * e - angular_velocity(sides.parent)
        at_centre, arm = velocity(sides.point, sides.parent), -self.crown * n
        if self.circle.is_zero:
            return _at(sides, arm.projected(sides.parent), at_centre + cross(w, arm), _of_plane(sides))
        lean = dot(n, e)
        arm -= self.circle / sqrt(1 - lean**2) * (n - lean * e)
        heading = cross(e, n)
        axes = {"along": heading, "across": cross(n, heading)}
        return _at(sides, arm.projected(sides.parent), at_centre + cross(w, arm), axes)

    def opened(self, sides: Sides, coordinates: Sequence[Expr]) -> tuple[Closure, ...]:
        """Return the same by the axes that don't spin: the slip is ``(x', y', 0) - R phi' e_x - crown w x n``."""
        n, leaning = sides.of_parent(2), sides.parent * self._leaning(coordinates)
        dx, dy, heading, lean, spin = time_derivatives(coordinates)
        w = Vector(leaning, lean, spin, 0).projected(sides.parent) + heading * n
        arm = Vector(leaning, 0, 0, -self.circle).projected(sides.parent) - self.crown * n
        slip = Vector(sides.parent, dx, dy, 0) - self.circle * spin * Vector(leaning, 1, 0, 0)
        return _at(sides, arm, slip - self.crown * cross(w, n), _of_plane(sides))


def _axle(sides: Sides) -> tuple[Frame, Expr]:
    """Return a frame that carries the wheel's axis and doesn't spin with it, and the rate of the spin in it.

    Without the spin the conditions are shorter. Where the last motion of the child is none about its axis, the frame is
    that of the child, in which nothing spins.
    """
    spinning = sides.child.last_moving
    motion, before = spinning.motion, spinning.parent
    if (
        before is not None
        and motion is not None
        and motion.turn_axis is not None
        and motion.turn_angle is not None
    ):
        along = sides.of_child(1).projected(spinning).components[motion.turn_axis]
        if (along * along - 1).is_zero:
            (rate,) = time_derivatives([motion.turn_angle])
            return before, along * rate
    return sides.child, number(0)


def _of_plane(sides: Sides) -> dict[str, Vector]:
    return {"x": sides.of_parent(0), "y": sides.of_parent(1)}


def _at(sides: Sides, arm: Vector, slip: Vector, axes: Mapping[str, Vector]) -> tuple[Closure, ...]:
    """Return the closures at the contact, an arm away from the centre, for slips along some axes by their names."""
    place = (sides.point + arm).projected(sides.parent)
    zero = Vector(sides.parent, 0, 0, 0)
    slips = (
        Closure(f"slip {name}", dot(slip, axis), place, axis.projected(sides.parent), zero)
        for name, axis in axes.items()
    )
    return Closure("contact", place.coordinates[2], place, sides.of_parent(2), zero), *slips
