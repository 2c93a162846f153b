"""The balance of forces in steady motion: equations for variables, multipliers, and forces that hold coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.simulation.constraint.consistent_position import starting_points
from symbody.simulation.constraint.dependent_constraints import nearby
from symbody.simulation.constraint.gauss_newton import gauss_newton
from symbody.simulation.constraint.least_norm import inverse_and_kernel, least_norm
from symbody.simulation.steady_state.small_motion import Rates, SmallMotion, StatesAlong
from symbody.simulation.steady_state.steady_conditions import SteadyConditions
from symbody.symbolic import Expr

__all__ = ["BALANCED", "Balance"]

Array = NDArray[np.float64]

BALANCED = 1e-9
"""The relative residual up to which a condition counts as satisfied."""


Solution = tuple[Array, Array]
"""Variables and forces."""


@dataclass(frozen=True, eq=False)
class Found:
    """What a search found.

    Attributes:
        solution: a solution within the limits; None if there is none.
        nearest: the variables and forces with the least residuals, if there is none.
        beyond: a solution beyond the limits.
    """

    solution: Solution | None
    nearest: Solution
    beyond: Solution | None = None


@dataclass(frozen=True, eq=False)
class Balance:
    """The equations for the free variables, the multipliers, and the forces that hold coordinates.

    In what follows, x are the variables of the conditions: the coordinates and the states beside the mechanics, then
    speeds and other unknowns of steady motions, of which there are none at rest.

    Attributes:
        conditions: the conditions of steady motion.
        t: the time, in s.
        p: the values of the parameters.
        fixed: the variables with given values.
        held: the coordinates along which forces hold the motion; at rest the fixed ones.
    """

    conditions: SteadyConditions
    t: float
    p: Array
    fixed: tuple[Expr, ...]
    held: tuple[Expr, ...]
    _recent: dict[bytes, tuple[Array, Array, Array]] = field(default_factory=dict, init=False, repr=False)
    """The last results of `values`: steps, their scales and their errors ask for the same ones."""

    @property
    def equations(self) -> Equations:
        return self.conditions.equations

    @property
    def is_free(self) -> NDArray[np.bool_]:
        """Flags of the variables that are free."""
        return np.array([name not in self.fixed for name in self.conditions.variables], dtype=bool)

    @property
    def order(self) -> list[Expr]:
        """The held coordinates, in the order of the forces that hold them."""
        return [q for q in self.equations.coordinates if q in self.held]

    @property
    def count(self) -> int:
        """The number of forces: multipliers and holding forces."""
        return len(self.equations.constraints) + len(self.held)

    def values(self, x: Array, forces: Array) -> tuple[Array, Array, Array]:
        """Return the conditions, their derivatives by all variables and forces, and the magnitudes of their terms."""
        key = x.tobytes() + forces.tobytes()
        if key not in self._recent:
            if len(self._recent) >= _KEPT:
                self._recent.clear()
            self._recent[key] = self._values(x, forces)
        return self._recent[key]

    def _values(self, x: Array, forces: Array) -> tuple[Array, Array, Array]:
        m = len(self.equations.constraints)
        is_held = np.array([q in self.held for q in self.equations.coordinates], dtype=bool)
        holding = np.zeros(len(is_held))
        holding[is_held] = forces[m:]
        with np.errstate(all="ignore"):
            F, slopes, sizes = self.conditions.function(self.t, x, forces[:m], holding, self.p)
        return F, slopes[:, np.concatenate([np.ones(len(x) + m, dtype=bool), is_held])], sizes

    def scale(self, x: Array, forces: Array) -> Array:
        """Return the magnitudes of the terms, bounded below by those of a thousandth of the variables."""
        _, slopes, sizes = self.values(x, forces)
        n, width = len(self.equations.speeds), len(x)
        scale = np.maximum(sizes, 1e-3 * np.abs(slopes[:, :width]) @ np.maximum(np.abs(x), 1))
        scale = np.where(np.isfinite(scale), scale, 1.0)
        scale[:n] = np.maximum(scale[:n], max(_FAINT * scale[:n].max(), _NOTHING))
        return np.where(scale > 0, scale, 1.0)

    def error(self, x: Array, forces: Array) -> float:
        """Return the largest relative residual; infinity if a condition is not finite."""
        F, _, _ = self.values(x, forces)
        error = float(np.abs(F / self.scale(x, forces)).max())
        return error if np.isfinite(error) else np.inf

    def first_forces(self, x: Array) -> Array:
        """Return the forces that balance a motion best."""
        n = len(self.equations.speeds)
        F, slopes, _ = self.values(x, np.zeros(self.count))
        if not (np.isfinite(F).all() and np.isfinite(slopes).all()):
            return np.zeros(self.count)
        return least_norm(slopes[:n, len(x) :], -F[:n])[0]

    def solution(self, x: Array) -> Solution:
        """Return the result of Gauss-Newton steps; forces are scaled by the terms of the equations of motion.

        The scales are those where the steps begin. Far from there, other terms count: a search that has not ended after
        some steps begins again from where it is.
        """
        found = x, self.first_forces(x)
        for _ in range(_ROUNDS):
            before, found = found, self._steps(*found)
            if self.error(*found) <= BALANCED or self.error(*found) > 0.9 * self.error(*before):
                break
        return found

    def _steps(self, x: Array, forces: Array) -> Solution:
        """Return the result of some Gauss-Newton steps from a start, with its scales."""
        is_free, scale = self.is_free, self.scale(x, forces)
        unit = scale[: len(self.equations.speeds)].max()
        whole, columns = x.copy(), np.concatenate([is_free, np.ones(self.count, dtype=bool)])
        sizes = self._sizes(x, forces)[is_free]
        weights = np.concatenate([sizes, np.full(self.count, unit)])

        def linearization(z: Array) -> tuple[Array, Array]:
            whole[is_free], found = sizes * z[: is_free.sum()], unit * z[is_free.sum() :]
            F, slopes, _ = self.values(whole, found)
            return F / scale, slopes[:, columns] * weights / scale[:, None]

        z = gauss_newton(linearization, np.concatenate([x[is_free] / sizes, forces / unit]), _STEPS)
        whole[is_free] = sizes * z[: is_free.sum()]
        return whole, unit * z[is_free.sum() :]

    def _sizes(self, x: Array, forces: Array) -> Array:
        """Return the sizes in which variables are measured: those of states and unknowns that hardly act are large.

        A force in newtons changes little by one newton, and steps that are damped alike would make it creep.
        """
        _, slopes, _ = self.values(x, forces)
        effect = np.abs(slopes[:, : len(x)] / self.scale(x, forces)[:, None]).max(axis=0, initial=0.0)
        effect[: len(self.equations.coordinates)] = 1.0
        found: Array = np.where(np.isfinite(effect) & (effect > _FAINT**2), 1 / np.clip(effect, _FAINT, 1), 1)
        return found

    def searched(self, start: Array, limits: Array | None = None) -> Found:
        """Return the solution that is found from the start, or else from points around it.

        Args:
            start: the variables.
            limits: the least and the largest values of variables, two columns; none by default.
        """
        low, high = (-np.inf, np.inf) if limits is None else limits.T
        nearest, least, beyond = (start, np.zeros(self.count)), np.inf, None
        for beginning in starting_points(start, self.is_free):
            found = self.solution(np.clip(beginning, low, high))
            error = self.error(*found)
            if error <= BALANCED:
                if (found[0] >= low).all() and (found[0] <= high).all():
                    return Found(found, found)
                beyond = beyond or found
            elif error < least:
                nearest, least = found, error
        return Found(None, nearest, beyond)

    def is_finite(self, x: Array, forces: Array) -> bool:
        """Return whether the equations and their derivatives, also by speeds, are finite at a position."""
        m = len(self.equations.constraints)
        with np.errstate(all="ignore"):
            parts = [
                *self.values(x, forces)[:2],
                *self.conditions.small_motion(self.t, x, forces[:m], self.p),
            ]
        return all(np.isfinite(part).all() for part in parts)

    def neutral(self, x: Array, forces: Array) -> Array:
        """Return directions of the variables that change no condition to first order, one per column."""
        _, slopes, _ = self.values(x, forces)
        width, scale = len(x), self.scale(x, forces)
        unit = scale[: len(self.equations.speeds)].max()
        is_free = self.is_free
        by_x = slopes[:, :width][:, is_free] / scale[:, None]
        by_forces = slopes[:, width:] * unit / scale[:, None]
        _, s, Vt = np.linalg.svd(np.hstack([by_x, by_forces]))
        rank = int(np.sum(s > 1e-8 * s.max(initial=0.0)))
        directions = np.zeros((width, len(Vt) - rank))
        directions[is_free] = Vt[rank:, : is_free.sum()].T
        U, sizes, _ = np.linalg.svd(directions, full_matrices=False)
        kept: Array = U[:, sizes > 1e-6]
        return kept

    def other_nearby(self, x: Array, forces: Array) -> Array | None:
        """Return a direction in which there is another solution nearby; None if this one is isolated.

        A direction in which nothing changes to first order may belong to a degenerate but isolated solution, as at the
        buckling load of a column. So a step is taken along it, and the nearest solution is searched from there. Of
        several such directions, combinations may lead nowhere: single variables are tried as well.
        """
        neutral = self.neutral(x, forces)
        moved = np.abs(neutral).max(axis=1, initial=0.0) > 1e-3 if neutral.shape[1] > 1 else []
        for direction in (*neutral.T, *np.eye(len(x))[moved]):
            step = _ASIDE * direction / np.abs(direction).max()
            other = self.solution(x + step)
            if self.error(*other) <= BALANCED and np.abs(other[0] - x).max() > _ASIDE / 2:
                return np.asarray(direction)
        return None

    def directions(self, x: Array) -> Array:
        """Return the directions of multipliers and holding forces, one per row, here and at neighbouring positions."""
        n, none = len(self.equations.speeds), np.zeros(self.count)
        shifts = nearby(self.equations, x[: len(self.equations.coordinates)])
        beside = np.zeros((len(x) - len(shifts), shifts.shape[1]))
        places = np.vstack([x, x + np.vstack([shifts, beside]).T])
        slopes = [self.values(place, none)[1][:n, len(x) :].T for place in places]
        return np.array([rows for k, rows in enumerate(slopes) if not k or np.isfinite(rows).all()])

    def least_forces(self, x: Array, forces: Array, combinations: Sequence[Array]) -> Array:
        """Return the least forces in balance, if combinations of forces have no effect."""
        if not combinations:
            return forces
        n = len(self.equations.speeds)
        F, slopes, _ = self.values(x, np.zeros(self.count))
        _, determined = least_norm(np.array(combinations), np.zeros(len(combinations)))
        least: Array = determined @ least_norm(slopes[:n, len(x) :] @ determined, -F[:n])[0]
        return least if self.error(x, least) <= max(self.error(x, forces), _ROUNDED) else forces

    def small_motion(self, q: Array, forces: Array, *, is_held: bool) -> SmallMotion:
        """Return the linear equations of the motions about rest that the constraints allow.

        Args:
            q: the equilibrium.
            forces: the multipliers and the holding forces there.
            is_held: whether the fixed coordinates stay fixed; if not, they are free, and the holding forces constant.
        """
        m, n = len(self.equations.constraints), len(self.equations.speeds)
        M, C, K, driving = self.conditions.small_motion(self.t, q, forces[:m], self.p)
        _, slopes, _ = self.values(q, forces)
        reactions = slopes[:n, len(q) : None if is_held else len(q) + m].T
        giving = self.conditions.giving_rates
        others = np.delete(reactions, giving, axis=0)
        _, Z = inverse_and_kernel(others)
        width, states = len(self.equations.coordinates), len(self.equations.states)
        S, by_states = slopes[:n, :width] @ K, slopes[:n, width : len(q)]
        # Reactions follow from the equations of motion, R^T df = M du' + C du + S dx + S_z dz.
        by_reactions = np.zeros((states, len(reactions)))
        of_rates = slopes[len(slopes) - states :]
        by_reactions[:, :m] = of_rates[:, len(q) : len(q) + m]
        back = -by_reactions @ inverse_and_kernel(reactions.T)[0]
        along = StatesAlong(
            force=Z.T @ by_states,
            inertia=(driving[:, n:] + back @ M) @ Z,
            damping=(driving[:, :n] + back @ C) @ Z,
            stiffness=(of_rates[:, :width] @ K + back @ S) @ Z,
            rate=of_rates[:, width : len(q)] + back @ by_states,
        )
        rows = slopes[[n + k for k in giving]]
        rates = Rates(-reactions[giving] @ Z, rows[:, :width] @ K @ Z, rows[:, width : len(q)])
        return SmallMotion(Z.T @ M @ Z, Z.T @ C @ Z, Z.T @ S @ Z, along, rates)


_KEPT = 8
"""Results of `values` that are kept."""
_ROUNDS, _STEPS = 8, 25
_ASIDE = 1e-2
_FAINT = 1e-6
"""The ratio to the largest forces that counts, where all terms of an equation are rounding errors."""
_ROUNDED = 1e-7
"""The relative residual of a condition that is allowed when directions of forces that nearly agree are left out."""
_NOTHING = 1e-12
"""The force or moment that counts if there are no others."""
