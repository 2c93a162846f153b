"""Accelerations of rigid frames by recursion along their chains, in local axes.

With A the parent, B the child, d the displacement and w the child's spin in the parent:

    al_NB = R_BA al_NA + w' + w_NB x w      a_NB = R_BA (a_NA + F_A d + 2 w_NA x d' + d'')

The field ``F = [al x] + [w x][w x]`` of a frame gives the acceleration of all its points, ``a_Q = a_P + F p_PQ``; it is
built once a frame and used for every offset in it. Its column for an axis e is the relative acceleration of a point at
distance 1 along e. For the axis of a rotation that is one and the same vector in both frames: behind a known field it
is taken from there, and spares the child most of al, and of its own field.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias, final

from symbody.symbolic import Expr, add3, cos, cross3, matvec3, number, scale3, sin, time_derivatives

from .floating import Floating
from .frame import Frame, along_chain
from .motion import Motion, Rotation
from .triple import NULL, Rate, Triple, is_null, rates

Nine: TypeAlias = tuple[Expr, Expr, Expr, Expr, Expr, Expr, Expr, Expr, Expr]
"""A 3x3 matrix, row after row."""


class Column(NamedTuple):
    """The column of a field that belongs to an axis: 0, 1 or 2."""

    axis: int
    components: Triple


@final
class Turning:
    """How a frame turns: angular velocity and acceleration, and the field they make.

    Args:
        column: a column of the field that is there already.
        field: the field, if all of it is there already.
    """

    def __init__(
        self,
        velocity: Triple,
        acceleration: Triple,
        *,
        column: Column | None = None,
        field: Nine | None = None,
    ) -> None:
        self.velocity = velocity
        self.acceleration = acceleration
        self._column = column
        self._field = field

    @property
    def has_field(self) -> bool:
        """Whether the field has been made."""
        return self._field is not None

    @property
    def field(self) -> Nine:
        """``[al x] + [w x][w x]``."""
        if self._field is None:
            self._field = self._new_field() if self._column is None else self._field_beside(self._column)
        return self._field

    def _new_field(self) -> Nine:
        (x, y, z), (u, v, w) = self.velocity, self.acceleration
        xx, yy, zz, xy, yz, zx = x * x, y * y, z * z, x * y, y * z, z * x
        return -(yy + zz), xy - w, zx + v, xy + w, -(xx + zz), yz - u, zx - v, yz + u, -(xx + yy)

    def _field_beside(self, column: Column) -> Nine:
        """Return the field by one column: ``F_ki = 2 w_k w_i - F_ik``, ``F_jj = F_kk + w_j^2 - w_k^2``."""
        k, known = column
        i, j = (k + 1) % 3, (k + 2) % 3
        w, turn = self.velocity, self.acceleration[k]
        ij, jj, kk, twice = w[i] * w[j], w[j] * w[j], w[k] * w[k], number(2) * w[k]
        rows = [[known[row]] * 3 for row in range(3)]
        rows[k][i], rows[k][j] = twice * w[i] - known[i], twice * w[j] - known[j]
        rows[i][j], rows[j][i] = ij - turn, ij + turn
        rows[i][i], rows[j][j] = -(jj + kk), known[k] + (jj - kk)
        (a, b, c), (d, e, f), (g, h, l) = rows
        return a, b, c, d, e, f, g, h, l


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
        if isinstance(motion, Floating):
            own = self._floated(motion, turning)
            return Accelerated(self._turned(motion, turning), add3(own, motion.to_child(linear)))
        if not motion.rotates:
            return Accelerated(turning, linear)
        return Accelerated(self._turned(motion, turning), motion.to_child(linear))

    def _turned(self, motion: Motion, turning: Turning) -> Turning:
        spin = motion.spin(time_derivatives)
        velocity, angular = add3(motion.to_child(turning.velocity), spin), rates(spin, self._rate)
        if turning.has_field and isinstance(motion, Rotation) and not is_null(spin):
            return _turned_about(motion, turning, velocity, angular)
        acceleration = add3(motion.to_child(turning.acceleration), angular)
        acceleration = add3(acceleration, cross3(velocity, spin))
        if turning.has_field and _is_quarter_turn(motion):
            return Turning(velocity, acceleration, field=_exchanged(turning.field, motion))
        return Turning(velocity, acceleration)

    def _floated(self, motion: Floating, turning: Turning) -> Triple:
        """Return ``v' + (2 R^T w_NA + w) x v``: what the twist by speeds adds, in the child's axes."""
        v = motion.twist.linear
        w = add3(scale3(number(2), motion.to_child(turning.velocity)), motion.twist.angular)
        return add3(rates(v, self._rate), cross3(w, v))

    def _displaced(self, motion: Motion, turning: Turning, linear: Triple) -> Triple:
        if not (is_null(turning.velocity) and is_null(turning.acceleration)):
            linear = add3(linear, matvec3(turning.field, motion.displacement))
        if isinstance(motion, Floating):
            return linear
        drift = motion.drift(time_derivatives)
        if is_null(drift):
            return linear
        coriolis = scale3(number(2), cross3(turning.velocity, drift))
        return add3(linear, add3(coriolis, rates(drift, self._rate)))


def _turned_about(motion: Rotation, parent: Turning, velocity: Triple, angular: Triple) -> Turning:
    """Turn by the column of the axis: ``al_j = F_ik - w_i w_k`` and ``al_i = w_j w_k - F_jk``."""
    k, F = motion.axis, parent.field
    i, j = (k + 1) % 3, (k + 2) % 3
    column = motion.to_child((F[k], F[3 + k], F[6 + k]))
    acceleration = [parent.acceleration[k] + angular[k]] * 3
    acceleration[i] = velocity[j] * velocity[k] - column[j]
    acceleration[j] = column[i] - velocity[i] * velocity[k]
    x, y, z = acceleration
    return Turning(velocity, (x, y, z), column=Column(k, column))


def _is_quarter_turn(motion: Motion) -> bool:
    """Tell whether a motion does no more than exchange axes."""
    return isinstance(motion, Rotation) and cos(motion.angle).is_number and sin(motion.angle).is_number


def _exchanged(field: Nine, motion: Motion) -> Nine:
    """Return ``R^T F R``."""
    rows = [motion.to_child((field[3 * i], field[3 * i + 1], field[3 * i + 2])) for i in range(3)]
    columns = [motion.to_child((rows[0][j], rows[1][j], rows[2][j])) for j in range(3)]
    (a, d, g), (b, e, h), (c, f, l) = columns
    return a, b, c, d, e, f, g, h, l
