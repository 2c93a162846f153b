"""Floating frames: a pose by coordinates, and a twist by speeds that are not their rates (quasi-velocities).

With A the parent, B the child, R and p its pose in A, and v and w its twist in A, in the axes of B:

    p' = R v        R' = R [w x]        a_NB = R^T (a_NA + F_A p) + v' + (2 R^T w_NA + w) x v

The unit quaternion of Euler parameters e0, ..., e3 has the rates ``e' = 1/2 e o (0, w)`` [Nikravesh 1988, ch. 6]. Its
rotation matrix is divided by its squared norm. This is one along a motion; with the division, the matrix is a rotation
in spite of rounding errors.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias, final

from symbody.geometry.component.triple import Rate, Triple, is_null, rates
from symbody.geometry.component.turning import Accelerated
from symbody.geometry.component.twist import Twist
from symbody.symbolic import (
    Expr,
    add3,
    cross3,
    dot3,
    free_symbols,
    number,
    scale3,
    sub3,
    substitute,
    time_derivative,
    time_derivatives,
)

from .frame_motion import FrameMotion, Rows, Substitution
from .placement import Placement

Quaternion: TypeAlias = tuple[Expr, Expr, Expr, Expr]
"""Euler parameters: cos(a/2), and sin(a/2) times the axis, of a turn by a."""


@final
class Floating(FrameMotion):
    """A motion whose pose and twist are given independently.

    Args:
        pose: of the child in the parent.
        twist: of the child in the parent, in the child's axes.
        coordinate_rates: the pose's coordinates, and their rates by the twist.
        speeds: the speeds of the twist that are unknown, unless the system lists others.
        quaternion: the Euler parameters of the pose, whose norm is one; empty if it is written in other coordinates.
    """

    tag = b"floating"

    def __init__(
        self,
        pose: Placement,
        twist: Twist,
        coordinate_rates: Mapping[Expr, Expr],
        speeds: Sequence[Expr] = (),
        quaternion: Sequence[Expr] = (),
    ) -> None:
        self._pose = pose
        self.twist: Twist = twist
        self.coordinate_rates = dict(coordinate_rates)
        self.speeds = tuple(speeds)
        self.quaternion = tuple(quaternion)
        self.is_rigid = pose.is_rigid

    @property
    def variables(self) -> tuple[Expr, ...]:
        return *self._pose.variables, *self.twist.angular, *self.twist.linear

    @property
    def displacement(self) -> Triple:
        return self._pose.displacement

    def to_parent(self, v: Triple) -> Triple:
        return self._pose.to_parent(v)

    def to_child(self, v: Triple) -> Triple:
        return self._pose.to_child(v)

    def spin(self, rate: Rate) -> Triple:
        del rate
        return self.twist.angular

    def drift(self, rate: Rate) -> Triple:
        del rate
        return self.to_parent(self.twist.linear)

    def child_twist(self, parent: Twist) -> Twist:
        """Return ``w_B = R^T w_A + w``, ``v_B = R^T (v_A + w_A x d) + v``."""
        linear = parent.linear
        if not is_null(self.displacement):
            linear = add3(linear, cross3(parent.angular, self.displacement))
        angular = add3(self.to_child(parent.angular), self.twist.angular)
        return Twist(angular, add3(self.to_child(linear), self.twist.linear))

    def child_acceleration(self, parent: Accelerated, rate: Rate) -> Accelerated:
        """Return ``a_B = R^T (a_A + F_A d) + v' + (2 R^T w_A + w) x v``, and how the child turns."""
        linear = parent.linear if is_null(self.displacement) else self.material_acceleration(parent)
        v = self.twist.linear
        w = add3(scale3(number(2), self.to_child(parent.turning.velocity)), self.twist.angular)
        own = add3(rates(v, rate), cross3(w, v))
        return Accelerated(self.child_turning(parent.turning, rate), add3(own, self.to_child(linear)))

    def inverse(self) -> tuple[FrameMotion, ...]:
        pose = self._pose.inverted()
        w, v = (self.to_parent(part) for part in self.twist)
        back = Twist(scale3(number(-1), w), sub3(cross3(w, self.displacement), v))
        return (Floating(pose, back, self.coordinate_rates, self.speeds, self.quaternion),)

    def __repr__(self) -> str:
        if self.quaternion:
            return "floating_frame()"
        return f"moving_frame({', '.join(map(str, (*self.twist.linear, *self.twist.angular)))})"

    def in_latex(self, variables: Sequence[str]) -> str:
        if self.quaternion:
            return r"\mathrm{Floating}\left(\right)"
        angular, linear = variables[-6:-3], variables[-3:]
        return rf"\mathrm{{Moving}}\left({', '.join((*linear, *angular))}\right)"

    def rewritten(self, variables: Sequence[Expr]) -> FrameMotion:
        x, y, z, u, v, w = variables[-6:]
        pose, twist = self._pose.rewritten(variables[:-6]), Twist((x, y, z), (u, v, w))
        return Floating(pose, twist, self.coordinate_rates, self.speeds, self.quaternion)

    def subs(self, substitution: Substitution) -> FrameMotion:
        (x, y, z), (u, v, w) = self.twist
        x, y, z, u, v, w = substitute((x, y, z, u, v, w), substitution)
        known = {
            coordinate: rate.subs(substitution)
            for coordinate, rate in self.coordinate_rates.items()
            if coordinate not in substitution
        }
        speeds = tuple(speed for speed in self.speeds if speed not in substitution)
        quaternion = substitute(self.quaternion, substitution)
        return Floating(self._pose.subs(substitution), Twist((x, y, z), (u, v, w)), known, speeds, quaternion)


def floating(position: Triple, quaternion: Quaternion, twist: Twist, speeds: Sequence[Expr]) -> Floating:
    """Return the motion of a free body, with the kinematics of its position and its Euler parameters."""
    rows = rotation_rows(quaternion)
    pose = Placement(rows, position)
    v = pose.to_parent(twist.linear)
    e = quaternion_rates(quaternion, twist.angular)
    rates = dict(zip((*position, *quaternion), (*v, *e), strict=True))
    return Floating(pose, twist, rates, speeds, quaternion)


def rotation_rows(quaternion: Quaternion) -> Rows:
    """Return ``R = ((e0^2 - e . e) 1 + 2 e e^T + 2 e0 [e x]) / (e0^2 + e . e)`` by rows."""
    w, x, y, z = quaternion
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    one = 1 / ((ww + zz) + (xx + yy))
    two = 2 * one
    return (
        (one * ((ww - zz) + (xx - yy)), two * (x * y - w * z), two * (z * x + w * y)),
        (two * (x * y + w * z), one * ((ww - zz) - (xx - yy)), two * (y * z - w * x)),
        (two * (z * x - w * y), two * (y * z + w * x), one * ((ww + zz) - (xx + yy))),
    )


def quaternion_rates(quaternion: Quaternion, w: Triple) -> Quaternion:
    """Return ``e' = 1/2 e o (0, w)``, by the angular velocity in the turned axes."""
    e0, *e = quaternion
    vector = (e[0], e[1], e[2])
    x, y, z = (e0 * a + b for a, b in zip(w, cross3(vector, w), strict=True))
    half = number(1) / 2
    return -half * dot3(vector, w), half * x, half * y, half * z


def known_rates(coordinate_rates: Mapping[Expr, Expr]) -> dict[Expr, Expr]:
    """Return the substitution of the coordinates' rates."""
    return {time_derivative(coordinate): rate for coordinate, rate in coordinate_rates.items()}


def by_speeds(coordinate_rates: Mapping[Expr, Expr], values: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return values with the rates of coordinates, of any order, written by the speeds and their rates.

    ``q' = K u`` gives ``q'' = K u' + K' u``, in which ``K'`` holds first rates: each substitution lowers the order.
    """
    if not coordinate_rates:
        return tuple(values)
    names = {coordinate.name for coordinate in coordinate_rates}
    rates = (
        leaf for leaf in free_symbols(list(values)) if leaf.kind == "time_function" and leaf.name in names
    )
    known, written = known_rates(coordinate_rates), tuple(values)
    for _ in range(max((rate.order for rate in rates), default=0)):
        written = substitute(written, known)
    return written


def rate_by(coordinate_rates: Mapping[Expr, Expr]) -> Rate:
    """Return the time derivative, with the rates of coordinates given by speeds."""
    if not coordinate_rates:
        return time_derivatives
    return lambda values: by_speeds(coordinate_rates, time_derivatives(values))
