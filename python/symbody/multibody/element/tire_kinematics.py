"""The contact of a wheel with the road: where it is, how it moves, and the slips [Pacejka 2012, ch. 2].

A wheel is a torus: the spin axis j is the y axis of its frame, R the radius in the plane of the wheel, and rho that of
the crown; rho = 0 is a thin disc. With the normal n of the road:

    x_c = j x n/|j x n|     the direction in which the wheel rolls
    y_c = n x x_c           across it, to the left
    k = x_c x j             in the plane of the wheel, up

The centre of the crown is ``C - (R - rho) k``, at the height h above the road, and the contact is below it. The
carrier of the wheel turns with it, but for the spin, whose rate is Omega = w . y_c/(j . y_c). The contact moves at
v_S + Omega r x_c, where v_S is the velocity of the material point of the wheel there, and r = R - rho + h cos(gamma).

Of another shape (`tire_shape`), the undeformed or deformed cross section reaches to ``C + y j - z k``, at the height h
above the road; the contact is below it, and r = z + h cos(gamma). The tread moves against the rim by the rates of the
deformation, which are part of v_S.
"""

from __future__ import annotations

from typing import Annotated, NamedTuple, TypeAlias

from symbody.errors import LoadError
from symbody.geometry import Frame, Point, Scalar, Triple, Vector, ground, origin
from symbody.geometry.component.triple import NULL, expression
from symbody.geometry.frame.coordinates import vector_components
from symbody.geometry.frame.frame_velocity import Seen, material_velocity, spin
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import (
    ENERGY,
    Abs,
    Expr,
    ExprLike,
    add3,
    asin,
    cos,
    cross3,
    derivation,
    dot3,
    number,
    scale3,
    sin,
    sqrt,
    sub3,
)
from symbody.symbolic.given.arguments import brief

from .attachment import not_negative
from .tire_shape import TireShape

_WHERE = "tire_kinematics"

Shape: TypeAlias = Annotated[
    ExprLike | TireShape, "the radius of the tyre, or its shape, such as tire_shape(y, z) returns"
]
SpinAxis: TypeAlias = Annotated[str, 'the spin axis "Y" or "-Y" of the wheel, which points to the left']


class TireKinematics(NamedTuple):
    """The contact of a wheel with the road, and its velocities there.

    Attributes:
        contact: the point of the road below the wheel.
        longitudinal: the unit vector along which the wheel rolls.
        lateral: the unit vector across it in the road, to the left.
        normal: the normal of the road, upwards.
        camber: the angle gamma between the plane of the wheel and the normal, positive for a lean to the right, in rad.
        deflection: how deep the undeformed wheel is in the road, negative above it, in m.
        sinking: the rate of the deflection, in m/s.
        VS: the longitudinal velocity of the contact, in m/s.
        VN: the lateral velocity of the wheel there, positive to the left, in m/s.
        VR: minus the spin times the rolling radius, in m/s; VS + VR is the velocity at which the wheel slides ahead.
        kappa: the longitudinal slip ``-(VS + VR)/|VS|``, positive if the wheel drives.
        lateral_slip: ``VN/|VS|``, the tangent of the slip angle.
    """

    contact: Point
    longitudinal: Vector
    lateral: Vector
    normal: Vector
    camber: Expr
    deflection: Expr
    sinking: Expr
    VS: Expr
    VN: Expr
    VR: Expr

    @property
    def kappa(self) -> Expr:
        """The longitudinal slip."""
        return -(self.VS + self.VR) / Abs(self.VS)

    @property
    def lateral_slip(self) -> Expr:
        """The tangent of the slip angle."""
        return self.VN / Abs(self.VS)


@checked(LoadError)
def tire_kinematics(
    wheel: Body,
    radius: Shape,
    *,
    crown_radius: Scalar = 0,
    rolling_radius: Scalar | None = None,
    road: Frame = ground,
    carrier: Frame | None = None,
    spin_axis: SpinAxis = "Y",
) -> TireKinematics:
    """Return where a wheel touches the road, and its slips: a torus on the x-y plane of a frame with z upwards.

    Args:
        wheel: the body that spins about the y axis of its frame; rolling ahead along x, its spin is positive.
        radius: R, of the undeformed tyre, in m; or the shape of a tyre that is no torus (`tire_shape`).
        crown_radius: rho, the radius of the cross section; zero for a thin disc, as a wheel with little camber.
        rolling_radius: the spin times this is the velocity of a wheel that rolls freely; the loaded radius by default.
        road: the frame of the road. A moving master frame stands for a road at rest, in whose plane it travels.
        carrier: a frame with the x axis along the direction of rolling, in which the wheel leans about x and spins
            about y alone; without it, the direction is computed from the spin axis, by a root.
        spin_axis: "-Y" for a wheel whose y axis points to the right, as in frames with z downwards.

    >>> from symbody import Body, functions_of_time, rotate, symbols, translate
    >>> (x, theta), R = functions_of_time("x theta"), symbols("R")
    >>> wheel = Body(translate(x, 0, R) * rotate("Y", theta), 1)
    >>> found = tire_kinematics(wheel, R, carrier=translate(x, 0, R))
    >>> found.VS, found.VR, found.VN, found.camber, found.deflection
    (x', -R*theta', 0, 0, 0)
    """
    if spin_axis not in {"Y", "-Y"}:
        raise LoadError(
            f"{_WHERE}: spin_axis = {brief(repr(spin_axis))}; expected 'Y' or '-Y', the axis of the wheel that "
            "points to the left"
        )
    with derivation(order=ENERGY):
        n: Triple = (number(0), number(0), number(1))
        j = vector_components(
            (number(0), number(1 if spin_axis == "Y" else -1), number(0)), wheel.frame, road
        )
        ahead = _ahead(j, n, road, carrier)
        axes = _Axes(j, ahead, cross3(n, ahead), cross3(ahead, j))
        upright = dot3(j, axes.left)
        section = _section(
            origin(wheel.frame).projected(road).coordinates, radius, expression(crown_radius), axes
        )
        contact = Point(road, section.place[0], section.place[1], number(0))
        base = _Base.of(contact, road)
        drift = add3(
            _relative(_carried(contact, _without_spin(wheel.frame)), base.velocity, road), section.tread
        )
        slip = add3(_relative(_carried(contact, wheel.frame), base.velocity, road), section.tread)
        turning = _relative(Seen(spin(wheel.frame), wheel.frame), base.spin, road)
        rate = dot3(turning, axes.left) / upright
        rolling = section.arm if rolling_radius is None else _positive("rolling_radius", rolling_radius)
        camber = asin(dot3(j, n)) if carrier is None else _camber(j, n, upright)
        return TireKinematics(
            contact,
            Vector(road, *ahead),
            Vector(road, *axes.left),
            Vector(road, *n),
            camber,
            section.depth,
            -dot3(drift, n),
            dot3(slip, ahead) + rate * section.arm,
            dot3(drift, axes.left),
            -(rate + section.spin_rate) * rolling,
        )


def _without_spin(frame: Frame) -> Frame:
    """Return the axes that carry a wheel and don't spin, in which its velocity across the spin is shorter to write.

    The spin moves the contact ahead alone, as it is in the plane of the axis and the normal.
    """
    last = frame.last_moving
    if last is frame and last.parent is not None and last.motion is not None and last.motion.turn_axis == 1:
        return last.parent
    return frame


class _Axes(NamedTuple):
    """The axes of the carrier and of the contact, in those of the road."""

    spin: Triple
    ahead: Triple
    left: Triple
    up: Triple


class _Section(NamedTuple):
    """The cross section above or in the road.

    Attributes:
        place: a point on the normal of the road through the contact.
        arm: the distance from the centre of the wheel to the contact, in the plane of the wheel.
        depth: how deep the section is in the road.
        tread: the velocity of the tread against the rim.
        spin_rate: the angular velocity of the tread against the rim.
    """

    place: Triple
    arm: Expr
    depth: Expr
    tread: Triple
    spin_rate: Expr


def _section(center: Triple, radius: ExprLike | TireShape, rho: Expr, axes: _Axes) -> _Section:
    upright = dot3(axes.spin, axes.left)
    if not isinstance(radius, TireShape):
        R = _positive("radius", radius)
        _check_crown(R, rho)
        height, up = center[2], axes.up[2]
        crown = sub3(center, scale3(R - rho, axes.up))
        # upright, both are written without the crown: (R - rho) (1 - up upright) is zero
        arm, depth = (R - rho) * (1 - up * upright) + height * upright, rho * (1 - up) + R * up - height
        return _Section(crown, arm, depth, NULL, number(0))
    if not rho.is_zero:
        raise LoadError(
            f"{_WHERE}: crown_radius = {brief(rho)} beside a shape; expected a radius with it, or the crown in the "
            "profile of the shape"
        )
    shape = radius
    place = add3(center, sub3(scale3(shape.y, axes.spin), scale3(shape.z, axes.up)))
    tread = sub3(scale3(shape.y_rate, axes.spin), scale3(shape.z_rate, axes.up))
    return _Section(place, shape.z + place[2] * upright, -place[2], tread, shape.spin_rate)


def _check_crown(radius: Expr, rho: Expr) -> None:
    not_negative(_WHERE, crown_radius=rho)
    beyond = rho - radius
    if beyond.is_constant and float(beyond) > 0:
        raise LoadError(
            f"{_WHERE}: crown_radius = {brief(rho)}, more than radius = {brief(radius)}; expected a cross section "
            "within the wheel: zero for a thin disc, the radius itself for a ball"
        )


def _positive(name: str, given: Scalar) -> Expr:
    """Return a size, or raise an error for a number that isn't positive."""
    size = expression(given)
    if size.is_constant and float(size) <= 0:
        raise LoadError(f"{_WHERE}: {name} = {brief(size)}; expected a positive number")
    return size


def _ahead(j: Triple, n: Triple, road: Frame, carrier: Frame | None) -> Triple:
    """Return x_c in the axes of the road."""
    across = cross3(j, n)
    if carrier is None:
        length = sqrt(dot3(across, across))
        if length.is_zero:
            raise LoadError(
                f"{_WHERE}: the spin axis, y of the wheel's frame, is across the road, whose normal is z; expected a "
                "wheel that stands on the road"
            )
        x, y, z = (component / length for component in across)
        return x, y, z
    ahead = vector_components((number(1), number(0), number(0)), carrier, road)
    if dot3(ahead, n).depends_on_time and _tilts(road, n):
        raise LoadError(
            f"{_WHERE}: the road = {brief(road)} turns, and its normal z with it, against carrier = "
            f"{brief(carrier)}; expected a carrier whose x axis stays in the plane of the road, as one on a deck that "
            "pitches, or no carrier; the surface of a drum is that of a link without mass that slides below the wheel, "
            "coupled to the drum by a rack"
        )
    if not (dot3(ahead, j).is_zero and dot3(ahead, n).is_zero):
        raise LoadError(
            f"{_WHERE}: the x axis of carrier = {brief(carrier)} isn't along the direction of rolling; expected a "
            "frame whose x axis is across the spin axis, and in the plane of the road"
        )
    return ahead


def _tilts(road: Frame, n: Triple) -> bool:
    """Return whether the normal of a road turns."""
    return road.ancestor.carrier is None and any(
        component.depends_on_time for component in vector_components(n, road, ground)
    )


def _camber(j: Triple, n: Triple, upright: Expr) -> Expr:
    """Return the camber as the angle that the components hold, if they are its sine and its cosine."""
    sine = dot3(j, n)
    for leaf in sorted(sine.free_symbols, key=str):
        for angle in (leaf, -leaf):
            if sin(angle) == sine and cos(angle) == upright:
                return angle
    return asin(sine)


class _Base(NamedTuple):
    """How the road moves at the contact."""

    velocity: Seen
    spin: Seen

    @classmethod
    def of(cls, contact: Point, road: Frame) -> _Base:
        if road.ancestor.carrier is not None:  # it travels along a road that is at rest
            _check_in_plane(road)
            return cls(Seen(NULL, road), Seen(NULL, road))
        return cls(_carried(contact, road), Seen(spin(road), road))


def _check_in_plane(road: Frame) -> None:
    """Check that a master frame travels in its own plane: its velocity is across the normal, its rotation about it."""
    zero = (number(0), number(0), number(0))
    _, _, up = vector_components(*material_velocity(zero, road), road)
    p, q, _ = vector_components(spin(road), road, road)
    if not (up.is_zero and p.is_zero and q.is_zero):
        raise LoadError(
            f"{_WHERE}: the road = {brief(road)} leaves its own plane, with the velocity {brief(up)} along z and the "
            f"angular velocities {brief(p)} about x and {brief(q)} about y; expected a moving master frame that "
            "travels along a road at rest, where these are zero; a deck that moves is a link on a joint: "
            "road=mechanism.frame(deck), reaction=mechanism.body(deck)"
        )


def _carried(point: Point, frame: Frame) -> Seen:
    return material_velocity(point.projected(frame).coordinates, frame)


def _relative(one: Seen, other: Seen, axes: Frame) -> Triple:
    first = vector_components(one.components, one.axes, axes)
    return sub3(first, vector_components(other.components, other.axes, axes))
