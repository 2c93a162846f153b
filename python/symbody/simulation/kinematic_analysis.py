"""Kinematic analysis: positions, velocities and accelerations of a mechanism that is driven [Haug 1989, ch. 3]."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError, SimulationError
from symbody.symbolic import Expr

from .consistent import EXACT, Positions, positions, shortened
from .gauss_newton import RANK, least_norm, row_sizes
from .kinematics import Kinematics
from .prescription import Path

__all__ = ["Course", "course", "least_norm_many"]

Array = NDArray[np.float64]

_FAR = 0.1
"""The part of a step that its prediction may be off."""
_HALVINGS = 16


@dataclass(frozen=True, eq=False)
class Course:
    """Where a mechanism is along its prescribed motion; a row for each instant."""

    coordinates: Array
    speeds: Array
    accelerations: Array


def course(
    kinematics: Kinematics, p: Array, path: Path, instants: Array, guess: Mapping[Expr, float], where: str
) -> Course:
    """Return what the constraints and the prescription together demand.

    ``phi(q, t) = 0`` by Newton's method from where the last instant and its rates lead; then
    ``(phi', q') = A u + b`` and ``(phi'', q'') = A u' + c`` are linear.

    Raises:
        ConstraintError: the constraints don't allow the motion.
        SimulationError: they leave some of it open.
    """
    driven = _Driven(kinematics, p, path, where)
    q = driven.positions(instants, guess)
    u, accelerations = driven.rates(instants, q)
    return Course(q, u, accelerations)


@dataclass(frozen=True, eq=False)
class _Driven:
    """A mechanism whose prescribed coordinates follow a path."""

    kinematics: Kinematics
    p: Array
    path: Path
    where: str

    @property
    def places(self) -> list[int]:
        """The places of the prescribed coordinates."""
        coordinates = self.kinematics.system.coordinates
        return [coordinates.index(name) for name in self.path.prescription.coordinates]

    @property
    def is_free(self) -> NDArray[np.bool_]:
        """Which coordinates aren't prescribed."""
        free = np.ones(len(self.kinematics.system.coordinates), dtype=bool)
        free[self.places] = False
        return free

    def positions(self, instants: Array, guess: Mapping[Expr, float]) -> Array:
        """Return the coordinates, a row for each instant."""
        first = self.path.at(instants[0])[0]
        prescribed = dict(zip(self.path.prescription.coordinates, map(float, first), strict=True))
        q = positions(self.kinematics, self.p, float(instants[0]), prescribed, guess, where=self.where)
        rows = np.empty((len(instants), len(q)))
        rows[:] = q
        rows[:, self.places] = self.path.at(instants)[0].T
        if self.kinematics.constraints and self.is_free.any():
            for k in range(1, len(instants)):
                rows[k] = self.followed(rows[k - 1], float(instants[k - 1]), float(instants[k]))
        elif self.kinematics.constraints:
            self.check(rows, instants)
        return rows

    def check(self, rows: Array, instants: Array) -> None:
        """Raise an error where prescribed coordinates, which are all, don't satisfy the constraints."""
        for q, time in zip(rows, instants, strict=True):
            prescribed = dict(zip(self.kinematics.system.coordinates, map(float, q), strict=True))
            positions(self.kinematics, self.p, float(time), prescribed, {}, where=self.where)

    def followed(self, q: Array, start: float, end: float) -> Array:
        """Return the coordinates at the end of a step, by as many smaller ones as it takes."""
        time, step = start, end - start
        least = (end - start) / 2**_HALVINGS
        while time < end:
            next_time = end if time + 1.01 * step >= end else time + step
            found = self.stepped(q, time, next_time)
            if found is not None:
                q, time, step = found, next_time, 2 * step
            elif step / 2 < least:
                raise ConstraintError(self._stuck(q, time))
            else:
                step /= 2
        return q

    def stepped(self, q: Array, start: float, end: float) -> Array | None:
        """Return the coordinates at the end, if they are where their rates lead to."""
        h = end - start
        u, accelerations = self.rates(np.array([start]), q[None], is_checked=False)
        A, _ = self.kinematics.velocity(start, q, self.p)
        rate, second = self.coordinate_rates(start, q, u[0], accelerations[0], A)
        predicted = q + h * rate + h * h / 2 * second
        predicted[self.places] = self.path.at(end)[0]
        if not np.isfinite(predicted).all():
            return None
        problem = Positions.at(self.kinematics, self.p, end, predicted)
        found = problem.solved(predicted, self.is_free)
        off, moved = np.abs(found - predicted).max(), np.abs(found - q).max()
        is_near = off <= max(_FAR * moved, 1e-6 * (1 + np.abs(q).max()))
        return found if is_near and problem.error(found) <= EXACT else None

    def coordinate_rates(
        self, time: float, q: Array, u: Array, accelerations: Array, A: Array
    ) -> tuple[Array, Array]:
        """Return the first and second rates of the coordinates."""
        m = len(self.kinematics.constraints)
        _, b = self.kinematics.velocity(time, q, self.p)
        c = self.kinematics.acceleration(time, np.concatenate([q, u]), self.p)
        return A[m:] @ u + b[m:], A[m:] @ accelerations + c[m:]

    def rates(self, instants: Array, q: Array, *, is_checked: bool = True) -> tuple[Array, Array]:
        """Return speeds and accelerations, a row for each instant."""
        m, n = len(self.kinematics.constraints), len(self.kinematics.system.speeds)
        rows = [*range(m), *(m + place for place in self.places)]
        _, first, second = self.path.at(instants)
        A, b = self.kinematics.velocity(instants, q.T, self.p[:, None])
        A, b = np.moveaxis(A, -1, 0), np.asarray(b).T
        demanded = np.zeros((len(instants), len(rows)))
        demanded[:, m:] = first.T
        u, determined = least_norm_many(A[:, rows], demanded - b[:, rows])
        if is_checked:
            self._check_determined(instants, determined)
            self._check_satisfied(instants, A[:, rows], u, (demanded, b[:, rows]), "speeds")
        c = self.kinematics.acceleration(instants, np.vstack([q.T, u.T]), self.p[:, None])
        demanded[:, m:] = second.T
        c = np.asarray(c).T[:, rows]
        accelerations, _ = least_norm_many(A[:, rows], demanded - c)
        if is_checked:
            self._check_satisfied(instants, A[:, rows], accelerations, (demanded, c), "accelerations")
        return u.reshape(-1, n), accelerations.reshape(-1, n)

    def _check_determined(self, instants: Array, determined: Array) -> None:
        is_open = determined < 1 - 1e-6
        if is_open.any():
            k = int(np.argmax(is_open.any(axis=1)))
            names = [
                str(u) for u, left in zip(self.kinematics.system.speeds, is_open[k], strict=True) if left
            ]
            verb = "isn't" if len(names) == 1 else "aren't"
            prescribed = ", ".join(map(str, self.path.prescription.coordinates))
            raise SimulationError(
                f"{self.where}: at t = {instants[k]:g} s the speeds {', '.join(names)} {verb} determined by the "
                f"constraints and the prescribed {prescribed}; prescribe as many coordinates as the system has degrees "
                "of freedom, others where the position is singular"
            )

    def _check_satisfied(
        self, instants: Array, A: Array, x: Array, terms: tuple[Array, Array], what: str
    ) -> None:
        demanded, rest = terms
        left = np.abs(np.einsum("kij,kj->ki", A, x) + rest - demanded)
        size = np.abs(A).sum(axis=2) * np.abs(x).max(axis=1, initial=0.0)[:, None]
        size += np.abs(demanded) + np.abs(rest)
        off = left > _OFF * size
        if off.any() or not np.isfinite(x).all():
            off |= ~np.isfinite(left)
            k = int(np.argmax(off.any(axis=1)))
            row, m = int(np.argmax(off[k])), len(self.kinematics.constraints)
            broken = (
                f"constraint {row + 1}, {shortened(self.kinematics.system.constraints[row])} = 0,"
                if row < m
                else f"the prescribed motion of {self.path.prescription.coordinates[row - m]}"
            )
            raise ConstraintError(
                f"{self.where}: at t = {instants[k]:g} s no {what} satisfy {broken} together with the other "
                "constraints and prescribed coordinates; prescribe fewer, or a motion that the constraints allow"
            )

    def _stuck(self, q: Array, time: float) -> str:
        names = self.kinematics.system.coordinates
        place = ", ".join(f"{name} = {value:.6g}" for name, value in zip(names[:12], q, strict=False))
        return (
            f"{self.where}: the constraints don't let the prescribed motion go on from t = {time:.6g} s, where "
            f"{place}; it may be a dead centre, or beyond reach: prescribe another motion, or other coordinates"
        )


_OFF = 1e-8
"""The part of its terms that an equation may be off where it counts as satisfied."""


def least_norm_many(A: Array, b: Array) -> tuple[Array, Array]:
    """Return the least solutions of many linear systems, and how far each unknown is determined: 1 if it is.

    Args:
        A: the matrices, N x rows x columns.
        b: the right sides, N x rows.
    """
    count, rows, columns = A.shape
    if columns == 0 or rows == 0:
        return np.zeros((count, columns)), np.zeros((count, columns))
    if count == 1:
        x, kernel = least_norm(A[0], b[0])
        return x[None], 1 - np.sum(kernel**2, axis=1)[None]
    size = row_sizes(A)
    inverse = np.linalg.pinv(A / size, rcond=RANK)
    x = np.einsum("kij,kj->ki", inverse, b / size[:, :, 0])
    determined = np.einsum("kij,kji->ki", inverse, A / size)
    return x, determined
