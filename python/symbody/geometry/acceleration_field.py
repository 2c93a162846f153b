"""Accelerations of rigid frames by recursion along their chains, in local axes.

With A the parent, B the child, d the displacement and w the child's spin in the parent:

    al_NB = R_BA al_NA + w' + w_NB x w      a_NB = R_BA (a_NA + F_A d + 2 w_NA x d' + d'')

The field ``F = [al x] + [w x][w x]`` of a frame gives the acceleration of all its points, ``a_Q = a_P + F p_PQ``; it is
built once a frame and used for every offset in it.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple, TypeAlias, final

from symbody.symbolic import Expr, add3, cross3, matvec3, number, scale3, time_derivatives

from .frame import Frame, along_chain
from .motion import Motion
from .triple import NULL, Rate, Triple, is_null, rates

Nine: TypeAlias = tuple[Expr, Expr, Expr, Expr, Expr, Expr, Expr, Expr, Expr]
"""A 3x3 matrix, row after row."""


@final
class Turning:
    """How a frame turns: angular velocity and acceleration, and the field they make."""

    def __init__(self, velocity: Triple, acceleration: Triple) -> None:
        self.velocity = velocity
        self.acceleration = acceleration

    @cached_property
    def field(self) -> Nine:
        """``[al x] + [w x][w x]``."""
        (x, y, z), (u, v, w) = self.velocity, self.acceleration
        xx, yy, zz, xy, yz, zx = x * x, y * y, z * z, x * y, y * z, z * x
        return -(yy + zz), xy - w, zx + v, xy + w, -(xx + zz), yz - u, zx - v, yz + u, -(xx + yy)


class Accelerated(NamedTuple):
    """The state of the recursion: how the frame turns, and the acceleration of its origin."""

    turning: Turning
    linear: Triple


@final
class AccelerationField:
    """The accelerations of all frames that hang on one root.

    Args:
        offset: an acceleration added to the root's, in its axes; minus gravity makes weight an inertia force.
        rate: the time derivative applied to velocities; one that drops the second derivatives of the coordinates
            gives the accelerations at zero coordinate accelerations.
    """

    def __init__(self, offset: Triple = NULL, rate: Rate = time_derivatives) -> None:
        self._offset = offset
        self._rate = rate
        self._memo: dict[bytes, Accelerated] = {}

    def __call__(self, frame: Frame) -> Accelerated:
        """Return the acceleration of a rigid frame, in its own axes."""
        return along_chain(frame, self._memo, self._start, self._step)

    def _start(self, root: Frame) -> Accelerated:
        if root.carrier is None:
            return Accelerated(Turning(NULL, NULL), self._offset)
        angular, linear = root.carrier
        own = add3(rates(linear, self._rate), cross3(angular, linear))
        return Accelerated(Turning(angular, rates(angular, self._rate)), add3(own, self._offset))

    def _step(self, motion: Motion, parent: Accelerated) -> Accelerated:
        turning, linear = parent
        if not is_null(motion.displacement):
            linear = self._displaced(motion, turning, linear)
        if not motion.rotates:
            return Accelerated(turning, linear)
        spin = motion.spin(time_derivatives)
        velocity = add3(motion.to_child(turning.velocity), spin)
        acceleration = add3(motion.to_child(turning.acceleration), rates(spin, self._rate))
        acceleration = add3(acceleration, cross3(velocity, spin))
        return Accelerated(Turning(velocity, acceleration), motion.to_child(linear))

    def _displaced(self, motion: Motion, turning: Turning, linear: Triple) -> Triple:
        if not (is_null(turning.velocity) and is_null(turning.acceleration)):
            linear = add3(linear, matvec3(turning.field, motion.displacement))
        drift = motion.drift(time_derivatives)
        if is_null(drift):
            return linear
        coriolis = scale3(number(2), cross3(turning.velocity, drift))
        return add3(linear, add3(coriolis, rates(drift, self._rate)))
