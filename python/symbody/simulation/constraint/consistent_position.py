"""Consistent positions: coordinates that satisfy the constraints, as close as possible to given values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError
from symbody.multibody import Variables
from symbody.multibody.named_constraint import named_constraint
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import counted

from .contradiction import contradiction_between, contradictory_equations
from .gauss_newton import gauss_newton
from .kinematics import Kinematics, neutral_position
from .least_norm import least_norm
from .many_systems import added
from .open_loop import open_joints
from .opposite_axes import check_senses

__all__ = [
    "EXACT",
    "ROUNDED",
    "Positions",
    "listed_values",
    "positions",
    "starting_points",
    "term_sizes",
    "term_sizes_of_many",
]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

EXACT = 1e-10
"""The relative violation up to which a constraint counts as satisfied."""
ROUNDED = 1e-6
"""The relative violation, as of numbers with seven digits, up to which given values are corrected as well."""
_PRINTED = 1e-4
"""The relative violation that rounded dimensions explain."""
_FREER = {
    1: "a cylindrical joint in place of a revolute one",
    2: "a spherical joint in place of a revolute one",
    3: "a cylindrical and a spherical joint in place of two revolute ones",
}
"""How joints of a loop get as many freedoms more."""
APPROACHES = 60
"""The most steps to the position nearest to the guess."""
_NAMED = 4
_LISTED = 12


@dataclass(frozen=True, eq=False)
class Positions:
    """The equations ``phi(q, t) = 0`` for some of the coordinates, relative to the magnitudes of their terms."""

    kinematics: Kinematics
    p: Array
    t: float
    scale: Array

    @classmethod
    def at(cls, kinematics: Kinematics, p: Array, t: float, q: Array) -> Positions:
        """Return the equations, scaled at the position where the search starts."""
        with np.errstate(all="ignore"):
            _, phi_q, sizes = kinematics.position(t, q, p)
        return cls(kinematics, p, t, term_sizes(q, phi_q, sizes))

    def linearization(self, q: Array, is_free: Flags) -> tuple[Array, Array]:
        """Return the scaled constraints and their derivatives with respect to the free coordinates."""
        with np.errstate(all="ignore"):
            phi, phi_q, _ = self.kinematics.position(self.t, q, self.p)
            return phi / self.scale, phi_q[:, is_free] / self.scale[:, None]

    def error(self, q: Array) -> float:
        """Return the largest relative violation; infinity if a constraint is not finite."""
        with np.errstate(all="ignore"):
            phi, phi_q, sizes = self.kinematics.position(self.t, q, self.p)
        error = float(np.max(np.abs(phi) / term_sizes(q, phi_q, sizes), initial=0.0))
        return error if np.isfinite(error) else np.inf

    def solution(self, q: Array, is_free: Flags, most: int = 200) -> Array:
        """Return the position after Gauss-Newton steps of the free coordinates, at most as many as given."""
        found = q.copy()
        if not self.kinematics.position_constraints:
            return found

        def of_free(free: Array) -> tuple[Array, Array]:
            found[is_free] = free
            return self.linearization(found, is_free)

        found[is_free] = gauss_newton(of_free, q[is_free], most)
        return found


def positions(
    kinematics: Kinematics,
    p: Array,
    t: float,
    fixed: Mapping[Expr, float],
    guess: Mapping[Expr, float],
    where: str = "consistent_state",
) -> Array:
    """Return the coordinates, shape (n_q,), at which all joints are closed with the right sense.

    They are the fixed values, and the smallest change of the others from their guess.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        fixed: the values of fixed coordinates.
        guess: the values near which the others should be.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: no position was found that satisfies the constraints, or the sides of a joint are turned there.
    """
    q = _closed(kinematics, p, t, fixed, guess, where)
    check_senses(kinematics, p, t, q, where)
    return q


def _closed(
    kinematics: Kinematics,
    p: Array,
    t: float,
    fixed: Mapping[Expr, float],
    guess: Mapping[Expr, float],
    where: str,
) -> Array:
    """Return a position that satisfies the constraints.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        fixed: the values of fixed coordinates.
        guess: the values near which the others should be.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: none was found.
    """
    coordinates = kinematics.system.coordinates
    neutral = neutral_position(kinematics.system)
    start = np.array([fixed.get(q, guess.get(q, zero)) for q, zero in zip(coordinates, neutral, strict=True)])
    is_free = np.array([q not in fixed for q in coordinates])
    if not kinematics.position_constraints:
        return start
    best, least = start, np.inf
    for beginning in starting_points(start, is_free):
        problem = Positions.at(kinematics, p, t, beginning)
        found = problem.solution(beginning, is_free)
        if problem.error(found) <= EXACT:
            return _nearest(problem, start, found, is_free)
        if problem.error(found) <= ROUNDED:
            polished = problem.solution(found, np.ones_like(is_free))
            if problem.error(polished) <= EXACT and np.allclose(polished, found, rtol=1e-4, atol=1e-4):
                return polished
        if problem.error(found) < least:
            best, least = found, problem.error(found)
    raise ConstraintError(f"{where}: {_unsatisfied(kinematics, p, t, best, fixed)}")


def starting_points(start: Array, is_free: Flags) -> Iterator[Array]:
    """Yield the start, then points around it at growing distances; these are regular even if the start is singular."""
    yield start
    if not is_free.any():
        return
    directions = np.random.Generator(np.random.PCG64(1))
    for size in (1e-2, 1e-1, 0.3, 1.0, 1.0, 3.0, 3.0, 3.0, 10.0, 10.0):
        shift = directions.uniform(-1, 1, len(start)) * is_free
        yield start + size * np.maximum(np.abs(start), 0.3) * shift


def term_sizes(q: Array, phi_q: Array, sizes: Array) -> Array:
    """Return the magnitudes of the constraints' terms, bounded below by those of a thousandth of the coordinates."""
    scale = np.maximum(sizes, 1e-3 * np.abs(phi_q) @ np.maximum(np.abs(q), 1))
    return np.where(np.isfinite(scale) & (scale > 0), scale, 1.0)


def term_sizes_of_many(q: Array, phi_q: Array, sizes: Array) -> Array:
    """Return `term_sizes` at k positions: of coordinates (n, k), slopes (m, n, k) and sizes (m, k)."""
    of_coordinates = added(np.abs(phi_q) * np.maximum(np.abs(q), 1), 1)
    scale = np.maximum(sizes, 1e-3 * of_coordinates)
    return np.where(np.isfinite(scale) & (scale > 0), scale, 1.0)


def _nearest(problem: Positions, start: Array, found: Array, is_free: Flags) -> Array:
    """Return the solution nearest to the start, by descent from a solution that was found.

    Each step projects the difference to the start onto the tangent space, and then returns to the constraints.
    """
    share = 1.0
    for _ in range(APPROACHES):
        _, J = problem.linearization(found, is_free)
        _, tangents = least_norm(J, np.zeros(len(J)))
        back = np.zeros_like(found)
        back[is_free] = tangents @ (tangents.T @ (start - found)[is_free])
        if np.abs(back).max() <= 1e-10 * (1 + np.abs(found).max()):
            break
        nearer = problem.solution(found + share * back, is_free)
        if problem.error(nearer) <= EXACT and _distance(nearer, start) < _distance(found, start):
            found, share = nearer, min(1.0, 2 * share)
        elif share > 1e-3:
            share /= 4
        else:
            break
    return found


def _distance(a: Array, b: Array) -> float:
    return float(np.linalg.norm(a - b))


def _unsatisfied(kinematics: Kinematics, p: Array, t: float, q: Array, fixed: Mapping[Expr, float]) -> str:
    """Return which constraints are violated where the search ended, and the way out.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        q: the nearest coordinates that were found, shape (n_q,).
        fixed: the values of fixed coordinates.
    """
    phi, phi_q, sizes = kinematics.position(t, q, p)
    system = kinematics.system if kinematics.system.constraints else kinematics.system.whole
    against = (
        contradictory_equations(phi_q, phi, term_sizes(q, phi_q, sizes)) if np.isfinite(phi_q).all() else ()
    )
    named = [name for name in system.coordinates if name in fixed]
    agreed = _agreed(kinematics, p, t, q) if named and against else None
    if agreed is not None:
        near = listed_values(named, dict(zip(system.coordinates, agreed, strict=True)))
        return (
            f"the given coordinates, {listed_values(named, fixed)}, don't satisfy the constraints at t = {t:g} s; "
            f"values that do: {near}; give these, or the coordinates as a guess, so that they are solved for"
        )
    opened = _open_loop(system, phi, sizes)
    missing = _nearly_dependent(phi_q) if opened and _nearly_closes(q, phi, phi_q, sizes) else 0
    if missing:
        nearest = listed_values(system.coordinates, dict(zip(system.coordinates, q, strict=True)))
        return (
            f"the loop nearly closes at t = {t:g} s: at the nearest position, {nearest}, {opened}; its constraints "
            "nearly depend on each other, so that it closes with exact dimensions alone: give them with all digits, "
            f"or as expressions such as pi/6, or let joints of the loop have {counted(missing, 'more freedom')} "
            f"in all, such as {_FREER.get(missing, 'spherical joints in place of revolute ones')}, which the motion "
            "hardly uses"
        )
    if opened and (against or not named):
        nearest = listed_values(system.coordinates, dict(zip(system.coordinates, q, strict=True)))
        return (
            f"no position was found that closes the loop at t = {t:g} s: at the nearest one, {nearest}, {opened}; "
            "correct the dimensions, or give a guess={coordinate: value} near a closed position"
        )
    if against:
        rows = [system.holonomic[row] for row in against]
        return f"at t = {t:g} s {contradiction_between(system.conditions, rows)}"
    left = [
        f"constraint {k + 1}, {named_constraint(system.conditions[k])}, is off by {value:.3g}"
        for k, value, size in zip(system.holonomic, phi, sizes, strict=True)
        if not abs(value) <= EXACT * size
    ]
    more = f"; and {len(left) - _NAMED} more" if len(left) > _NAMED else ""
    found = opened or "; ".join(left[:_NAMED]) + more
    if named and len(named) == len(system.coordinates):
        return (
            f"the given coordinates, {listed_values(named, fixed)}, don't satisfy the constraints at t = {t:g} s: "
            f"{found}; give some of them as a guess instead, so that they are solved for"
        )
    nearest = listed_values(
        [name for name in system.coordinates if name not in fixed],
        dict(zip(system.coordinates, q, strict=True)),
    )
    what = f"with {listed_values(named, fixed)}" if named else "from the guess"
    dimensions = ", or other dimensions" if opened else ""
    return (
        f"no coordinates were found {what} that satisfy the constraints at t = {t:g} s; nearest, at "
        f"{nearest}: {found}; give fewer or other values{dimensions}, or a guess={{coordinate: value}} near a solution"
    )


def _nearly_closes(q: Array, phi: Array, phi_q: Array, sizes: Array) -> bool:
    """Return whether constraints are violated by no more than what dimensions lose when they are printed."""
    return bool(np.all(np.abs(phi) <= _PRINTED * term_sizes(q, phi_q, sizes)))


def _nearly_dependent(phi_q: Array) -> int:
    """Return how many gradients depend on others up to what dimensions lose when they are printed."""
    rows, columns = phi_q.shape
    directions = phi_q / np.maximum(np.linalg.norm(phi_q, axis=1, keepdims=True), np.finfo(float).tiny)
    if not np.isfinite(directions).all():
        return max(int(rows) - int(columns), 0)
    values = np.linalg.svd(directions, compute_uv=False)
    return int(rows) - int(np.count_nonzero(values > _PRINTED * values[0]))


def _open_loop(system: Variables, phi: Array, sizes: Array) -> str:
    """Return which joints stay open, by the values of the constraints on positions."""
    values = zip(system.holonomic, phi, sizes, strict=True)
    violated = {
        system.conditions[k].name: float(value) for k, value, size in values if not abs(value) <= EXACT * size
    }
    return open_joints(system, violated)


def _agreed(kinematics: Kinematics, p: Array, t: float, q: Array) -> Array | None:
    """Return a position near a given one that satisfies the constraints if no coordinate is fixed; None without one."""
    is_free = np.ones(len(q), bool)
    for beginning in starting_points(q, is_free):
        problem = Positions.at(kinematics, p, t, beginning)
        found = problem.solution(beginning, is_free)
        if problem.error(found) <= EXACT:
            return found
    return None


def listed_values(names: Sequence[Expr], values: Mapping[Expr, float]) -> str:
    """Return the values of some variables as messages list them, the first ones at least."""
    shown = ", ".join(f"{name} = {values[name]:.6g}" for name in names[:_LISTED])
    return shown + (", ..." if len(names) > _LISTED else "")
