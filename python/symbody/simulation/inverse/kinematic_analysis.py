"""Kinematic analysis: positions, velocities and accelerations of a driven mechanism [Haug 1989, ch. 3]."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError, SimulationError
from symbody.multibody.named_constraint import named_constraint
from symbody.simulation.constraint.consistent_position import EXACT, Positions, positions
from symbody.simulation.constraint.kinematics import Kinematics
from symbody.simulation.constraint.least_norm import least_norm_many
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import with_known_names

from .prescription import Path
from .states_along import Beside, integrated_states

__all__ = ["Trajectory", "kinematic_analysis"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_FAR = 0.1
"""The largest error of a predicted position, relative to the step."""
_HALVINGS = 16
_EXACT_WAY = 1e-12
"""The relative tolerance with which rates are integrated where constraints are on velocities."""
_OFF = 1e-8
"""The relative residual up to which an equation counts as satisfied."""
_ROUNDING = 1e-12
"""The residual relative to the largest terms of all equations at an instant that rounding errors explain."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The coordinates, speeds, accelerations and states along a motion, one row for each of the N instants."""

    coordinates: Array
    speeds: Array
    accelerations: Array
    states: Array

    @property
    def rows(self) -> Array:
        """All of them in one row for each instant."""
        return np.hstack([self.coordinates, self.speeds, self.accelerations, self.states])


@with_known_names
def kinematic_analysis(
    kinematics: Kinematics,
    p: Array,
    path: Path,
    instants: Array,
    guess: Mapping[Expr, float],
    beside: Beside | None,
    where: str,
) -> Trajectory:
    """Return the motion that the constraints and the prescription determine.

    ``phi(q, t) = 0`` is solved by Newton's method, from a prediction by the rates at the previous instant. Then
    ``(phi', q') = A u + b`` and ``(phi'', q'') = A u' + c`` are linear.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        path: the prescribed coordinates as functions of time.
        instants: the instants, shape (N,), in s.
        guess: coordinates near the first position.
        beside: the states beside the mechanics, which are integrated along the motion.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: the constraints do not allow the motion.
        SimulationError: the motion is not determined, or the prescription is not finite.
    """
    driven = _Driven(kinematics, p, path, where, beside)
    q, z = driven.positions(instants, guess)
    velocities, accelerations = driven.levels(instants, q, z)
    driven.check_determined(instants, velocities)
    driven.check_satisfied(instants, velocities, "speeds")
    driven.check_satisfied(instants, accelerations, "accelerations")
    if beside is not None and not driven.is_followed(instants, q):
        z = integrated_states(beside, lambda time: driven.motion_at(time, instants, q), instants, where)
    return Trajectory(q, velocities.x, accelerations.x, z)


@dataclass(frozen=True, eq=False)
class _Level:
    """The equations for velocities, or for accelerations: ``A x + b = d`` at each instant, with x = u or x = u'.

    Attributes:
        A: the Jacobians of the rates of constraints and coordinates, shape (N, m + n_q, n).
        b: these rates at x = 0, shape (N, m + n_q).
        d: the required rates: zero for constraints, prescribed for coordinates.
        rows: the rows of A that belong to these equations.
        terms: the magnitudes of what cancels in b, as far as they are known, shape (N, number of rows), or zero.
    """

    A: Array
    b: Array
    d: Array
    rows: list[int]
    terms: Array | float = 0.0

    @cached_property
    def _solution(self) -> tuple[Array, Array]:
        return least_norm_many(self.A[:, self.rows], self.d - self.b[:, self.rows])

    @property
    def x(self) -> Array:
        """The speeds or accelerations, of minimum norm if they are not determined."""
        return self._solution[0]

    @property
    def is_open(self) -> Flags:
        """Flags of those that the equations do not determine."""
        is_open: Flags = self._solution[1] < 1 - 1e-6
        return is_open

    @property
    def rates(self) -> Array:
        """The rates of constraints and coordinates."""
        rates: Array = np.einsum("kij,kj->ki", self.A, self.x) + self.b
        return rates

    @property
    def is_off(self) -> Flags:
        """Flags of the equations that are not satisfied."""
        A, b = self.A[:, self.rows], self.b[:, self.rows]
        sizes = np.abs(A).sum(axis=2) * np.abs(self.x).max(axis=1, initial=0.0)[:, None]
        left = np.abs(self.rates[:, self.rows] - self.d)
        own = sizes + np.abs(self.d) + np.abs(b)
        rounded = (own + self.terms).max(axis=1, keepdims=True, initial=0.0)
        # All terms of one equation may be rounding errors of others: of a blade along which nothing accelerates.
        is_off: Flags = ~(left <= _OFF * own + _ROUNDING * rounded)
        return is_off


@dataclass(frozen=True, eq=False)
class _Driven:
    """A mechanism whose prescribed coordinates follow a path."""

    kinematics: Kinematics
    p: Array
    path: Path
    where: str
    beside: Beside | None = None

    @property
    def prescribed(self) -> tuple[Expr, ...]:
        """The coordinates that follow the path."""
        return self.path.prescription.coordinates

    @property
    def places(self) -> list[int]:
        """The indices of the prescribed coordinates."""
        return [self.kinematics.system.coordinates.index(name) for name in self.prescribed]

    @property
    def is_free(self) -> Flags:
        """Flags of the coordinates that are not prescribed."""
        free = np.ones(len(self.kinematics.system.coordinates), dtype=bool)
        free[self.places] = False
        return free

    def positions(self, instants: Array, guess: Mapping[Expr, float]) -> tuple[Array, Array]:
        """Return the coordinates, one row for each instant, and the states, where they are integrated together."""
        path = self.path.at(instants)
        self._check_finite(instants, path)
        first = dict(zip(self.prescribed, map(float, path[0, :, 0]), strict=True))
        q = positions(self.kinematics, self.p, float(instants[0]), first, guess, where=self.where)
        rows = np.tile(q, (len(instants), 1))
        rows[:, self.places] = path[0].T
        beside = np.zeros(0) if self.beside is None else self.beside.start
        states = np.tile(beside, (len(instants), 1))
        if self.is_followed(instants, rows):
            self._follow(rows, states, instants)
        elif self.kinematics.position_constraints and self.is_free.any():
            for k in range(1, len(instants)):
                rows[k] = self.advanced(rows[k - 1], float(instants[k - 1]), float(instants[k]))
        elif self.kinematics.position_constraints:
            self.check(rows, instants)
        return rows, states

    def is_followed(self, instants: Array, rows: Array) -> bool:
        """Return whether positions follow from rates alone: by constraints on velocities, or by kinematics.

        Positions at one instant determine other coordinates only if as many constraints on positions hold these.
        """
        system, is_free = self.kinematics.system, self.is_free
        if not system.whole.is_holonomic:
            return True
        if not is_free.any() or not system.has_quasi_velocities:
            return False
        with np.errstate(all="ignore"):
            _, phi_q, _ = self.kinematics.position(float(instants[0]), rows[0], self.p)
        rank = np.linalg.matrix_rank(phi_q[:, is_free]) if np.isfinite(phi_q).all() and len(phi_q) else 0
        return bool(rank < is_free.sum())

    def motion_at(self, time: float, instants: Array, rows: Array) -> Array:
        """Return coordinates, speeds and accelerations at any time, from the positions at instants."""
        k = max(int(np.searchsorted(instants, time, side="right")) - 1, 0)
        q = rows[k].copy()
        q[self.places] = self.path.at(time)[0]
        if self.kinematics.position_constraints and self.is_free.any() and time > instants[k]:
            q = self.advanced(rows[k], float(instants[k]), time)
        velocities, accelerations = self.levels(np.array([time]), q[None], np.zeros((1, 0)))
        return np.concatenate([q, velocities.x[0], accelerations.x[0]])

    def _follow(self, rows: Array, states: Array, instants: Array) -> None:
        """Put in positions and states along the way: constraints on velocities don't tell them by the instant alone."""
        from scipy.integrate import solve_ivp  # noqa: PLC0415 - slow to load, and rarely needed

        if len(instants) == 1:
            return
        begin, n = np.concatenate([rows[0], states[0]]), rows.shape[1]
        span = float(instants[0]), float(instants[-1])
        found = solve_ivp(self._rates_at, span, begin, "DOP853", instants, rtol=_EXACT_WAY, atol=_EXACT_WAY)
        states[: found.y.shape[1]] = found.y[n:].T
        if not found.success:
            raise ConstraintError(self._stuck(found.y[:n, -1], float(found.t[-1])))
        for k in range(1, len(instants)):
            reached = found.y[:n, k].copy()
            reached[self.places] = rows[k, self.places]
            problem = Positions.at(self.kinematics, self.p, float(instants[k]), reached)
            rows[k] = problem.solution(reached, self.is_free) if self.is_free.any() else reached
            if not problem.error(rows[k]) <= EXACT:
                raise ConstraintError(self._stuck(rows[k - 1], float(instants[k - 1])))

    def _rates_at(self, time: float, place: Array) -> Array:
        n = len(self.kinematics.system.coordinates)
        q, z = place[:n], place[n:]
        velocities, accelerations = self.levels(np.array([time]), q[None], z[None])
        rates: Array = velocities.rates[0, len(self.kinematics.constraints) :]
        if self.beside is None:
            return rates
        motion = np.concatenate([q, velocities.x[0], accelerations.x[0], z])
        return np.concatenate([rates, self.beside.rates_at(time, motion)])

    def check(self, rows: Array, instants: Array) -> None:
        """Check that the constraints are satisfied if all coordinates are prescribed."""
        for q, time in zip(rows, instants, strict=True):
            prescribed = dict(zip(self.kinematics.system.coordinates, map(float, q), strict=True))
            positions(self.kinematics, self.p, float(time), prescribed, {}, where=self.where)

    def advanced(self, q: Array, start: float, end: float) -> Array:
        """Return the coordinates at the end of an interval, with as many steps as needed."""
        time, step = start, end - start
        least = (end - start) / 2**_HALVINGS
        while time < end:
            next_time = end if time + 1.01 * step >= end else time + step
            found = self.step_result(q, time, next_time)
            if found is not None:
                q, time, step = found, next_time, 2 * step
            elif step / 2 < least:
                raise ConstraintError(self._stuck(q, time))
            else:
                step /= 2
        return q

    def step_result(self, q: Array, start: float, end: float) -> Array | None:
        """Return the coordinates after one step; None if they are not near the prediction by their rates."""
        h, m = end - start, len(self.kinematics.constraints)
        velocities, accelerations = self.levels(np.array([start]), q[None], np.zeros((1, 0)))
        predicted = q + h * velocities.rates[0, m:] + h * h / 2 * accelerations.rates[0, m:]
        predicted[self.places] = self.path.at(end)[0]
        if not np.isfinite(predicted).all():
            return None
        problem = Positions.at(self.kinematics, self.p, end, predicted)
        found = problem.solution(predicted, self.is_free)
        off, moved = np.abs(found - predicted).max(), np.abs(found - q).max()
        is_near = off <= max(_FAR * moved, 1e-6 * (1 + np.abs(q).max()))
        return found if is_near and problem.error(found) <= EXACT else None

    def levels(self, instants: Array, q: Array, z: Array) -> tuple[_Level, _Level]:
        """Return the equations for velocities and for accelerations, at positions and states for each instant."""
        kinematics = self.kinematics.beside(z.T)
        m, p = len(self.kinematics.constraints), self.p[:, None]
        rows = [*range(m), *(m + place for place in self.places)]
        _, first, second = self.path.at(instants)
        at_rest = np.zeros((len(instants), m))
        A, b = kinematics.velocity(instants, q.T, p)
        A = np.moveaxis(A, -1, 0)
        velocities = _Level(A, b.T, np.hstack([at_rest, first.T]), rows)
        c = kinematics.acceleration(instants, np.vstack([q.T, velocities.x.T]), p)
        # The terms of c are products of speeds with rates of A, which are about as large as A.
        terms = np.abs(A[:, rows]).sum(axis=2) * np.abs(velocities.x).max(axis=1, initial=0.0)[:, None] ** 2
        return velocities, _Level(A, c.T, np.hstack([at_rest, second.T]), rows, terms)

    def _check_finite(self, instants: Array, path: Array) -> None:
        is_strange: Flags = np.logical_not(np.isfinite(path)).max(axis=0)
        if is_strange.any():
            k = int(np.argmax(is_strange.any(axis=0)))
            raise SimulationError(
                f"{self.where}, motion: {self.prescribed[int(np.argmax(is_strange[:, k]))]}, or a rate of it, isn't "
                f"finite at t = {instants[k]:g} s; prescribe a motion with finite first and second derivatives"
            )

    def check_determined(self, instants: Array, velocities: _Level) -> None:
        """Check that the speeds are determined."""
        is_open = velocities.is_open
        if not is_open.any():
            return
        k = int(np.argmax(is_open.any(axis=1)))
        speeds = self.kinematics.system.speeds
        names = [str(u) for u, left in zip(speeds, is_open[k], strict=True) if left]
        what = f"speed {names[0]} isn't" if len(names) == 1 else f"speeds {', '.join(names)} aren't"
        raise SimulationError(
            f"{self.where}: at t = {instants[k]:g} s the {what} determined by the constraints and the prescribed "
            f"{', '.join(map(str, self.prescribed))}; prescribe as many coordinates as the system has degrees of "
            "freedom, or other ones if the position is singular"
        )

    def check_satisfied(self, instants: Array, level: _Level, what: str) -> None:
        """Check that the equations do not contradict each other."""
        is_off = level.is_off
        if not is_off.any():
            return
        k = int(np.argmax(is_off.any(axis=1)))
        row, m = int(np.argmax(is_off[k])), len(self.kinematics.constraints)
        broken = (
            f"constraint {row + 1}, {named_constraint(self.kinematics.system.conditions[row])},"
            if row < m
            else f"the prescribed motion of {self.prescribed[row - m]}"
        )
        raise ConstraintError(
            f"{self.where}: at t = {instants[k]:g} s no {what} satisfy {broken} together with the other "
            "constraints and prescribed coordinates; prescribe fewer, or a motion that the constraints allow"
        )

    def _stuck(self, q: Array, time: float) -> str:
        names = self.kinematics.system.coordinates
        place = ", ".join(f"{name} = {value:.6g}" for name, value in zip(names[:12], q, strict=False))
        return (
            f"{self.where}: the constraints don't allow the prescribed motion beyond t = {time:.6g} s, where "
            f"{place}; it may be a dead centre, or beyond reach: prescribe another motion, or other coordinates"
        )
