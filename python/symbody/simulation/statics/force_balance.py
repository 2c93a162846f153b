"""The balance of forces at rest: equations for coordinates, multipliers, and forces that hold coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.simulation.constraint.dependent_constraints import nearby
from symbody.simulation.constraint.gauss_newton import gauss_newton
from symbody.simulation.constraint.least_norm import least_norm
from symbody.simulation.statics.small_motion import SmallMotion
from symbody.simulation.statics.small_motion_of_states import SmallMotionOfStates, StatesAlong
from symbody.simulation.statics.small_motion_with_rates import Rates, SmallMotionWithRates
from symbody.simulation.statics.statics import Statics
from symbody.symbolic import Expr

__all__ = ["Balance"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Balance:
    """The equations for the free coordinates, the multipliers, and the forces that hold fixed coordinates.

    In what follows, q are the positions: the coordinates, then the states beside the mechanics.
    """

    statics: Statics
    t: float
    p: Array
    held: tuple[Expr, ...]

    @property
    def equations(self) -> Equations:
        return self.statics.equations

    @property
    def is_free(self) -> NDArray[np.bool_]:
        """Flags of the positions that are free; states always are."""
        return np.array([q not in self.held for q in self.statics.positions])

    @property
    def order(self) -> list[Expr]:
        """The fixed coordinates, in the order of the forces that hold them."""
        return [q for q in self.equations.coordinates if q in self.held]

    @property
    def count(self) -> int:
        """The number of forces: multipliers and holding forces."""
        return len(self.equations.constraints) + len(self.held)

    def values(self, q: Array, forces: Array) -> tuple[Array, Array, Array]:
        """Return the conditions, their derivatives by all coordinates and forces, and the magnitudes of their terms."""
        m, is_held = len(self.equations.constraints), ~self.is_free
        holding = np.zeros(len(q))
        holding[is_held] = forces[m:]
        with np.errstate(all="ignore"):
            F, slopes, sizes = self.statics.function(self.t, q, forces[:m], holding, self.p)
        return F, slopes[:, np.concatenate([np.ones(len(q) + m, dtype=bool), is_held])], sizes

    def scale(self, q: Array, forces: Array) -> Array:
        """Return the magnitudes of the terms, bounded below by those of a thousandth of the coordinates."""
        _, slopes, sizes = self.values(q, forces)
        n, width = len(self.equations.speeds), len(q)
        scale = np.maximum(sizes, 1e-3 * np.abs(slopes[:, :width]) @ np.maximum(np.abs(q), 1))
        scale = np.where(np.isfinite(scale), scale, 1.0)
        scale[:n] = np.maximum(scale[:n], max(_FAINT * scale[:n].max(), _NOTHING))
        return np.where(scale > 0, scale, 1.0)

    def error(self, q: Array, forces: Array) -> float:
        """Return the largest relative residual; infinity if a condition is not finite."""
        F, _, _ = self.values(q, forces)
        error = float(np.abs(F / self.scale(q, forces)).max())
        return error if np.isfinite(error) else np.inf

    def first_forces(self, q: Array) -> Array:
        """Return the forces that balance a position best."""
        n = len(self.equations.speeds)
        F, slopes, _ = self.values(q, np.zeros(self.count))
        if not (np.isfinite(F).all() and np.isfinite(slopes).all()):
            return np.zeros(self.count)
        return least_norm(slopes[:n, len(q) :], -F[:n])[0]

    def solution(self, q: Array) -> tuple[Array, Array]:
        """Return the result of Gauss-Newton steps; forces are scaled by the terms of the equations of motion."""
        is_free, forces = self.is_free, self.first_forces(q)
        scale = self.scale(q, forces)
        unit = scale[: len(self.equations.speeds)].max()
        whole, columns = q.copy(), np.concatenate([is_free, np.ones(self.count, dtype=bool)])
        weights = np.concatenate([np.ones(int(is_free.sum())), np.full(self.count, unit)])

        def linearization(z: Array) -> tuple[Array, Array]:
            whole[is_free], found = z[: is_free.sum()], unit * z[is_free.sum() :]
            F, slopes, _ = self.values(whole, found)
            return F / scale, slopes[:, columns] * weights / scale[:, None]

        z = gauss_newton(linearization, np.concatenate([q[is_free], forces / unit]))
        whole[is_free] = z[: is_free.sum()]
        return whole, unit * z[is_free.sum() :]

    def is_finite(self, q: Array, forces: Array) -> bool:
        """Return whether the equations and their derivatives, also by speeds, are finite at a position."""
        m = len(self.equations.constraints)
        with np.errstate(all="ignore"):
            parts = [*self.values(q, forces)[:2], *self.statics.small_motion(self.t, q, forces[:m], self.p)]
        return all(np.isfinite(part).all() for part in parts)

    def neutral(self, q: Array, forces: Array) -> Array:
        """Return directions of the coordinates that change no condition to first order, one per column."""
        _, slopes, _ = self.values(q, forces)
        width, scale = len(q), self.scale(q, forces)
        unit = scale[: len(self.equations.speeds)].max()
        is_free = self.is_free
        by_q = slopes[:, :width][:, is_free] / scale[:, None]
        by_forces = slopes[:, width:] * unit / scale[:, None]
        _, s, Vt = np.linalg.svd(np.hstack([by_q, by_forces]))
        rank = int(np.sum(s > 1e-8 * s.max(initial=0.0)))
        directions = np.zeros((width, len(Vt) - rank))
        directions[is_free] = Vt[rank:, : is_free.sum()].T
        U, sizes, _ = np.linalg.svd(directions, full_matrices=False)
        kept: Array = U[:, sizes > 1e-6]
        return kept

    def directions(self, q: Array) -> Array:
        """Return the directions of multipliers and holding forces, one per row, here and at neighbouring positions."""
        n, none = len(self.equations.speeds), np.zeros(self.count)
        shifts = nearby(self.equations, q[: len(self.equations.coordinates)])
        beside = np.zeros((len(self.equations.states), shifts.shape[1]))
        places = np.vstack([q, q + np.vstack([shifts, beside]).T])
        slopes = [self.values(place, none)[1][:n, len(q) :].T for place in places]
        return np.array([rows for k, rows in enumerate(slopes) if not k or np.isfinite(rows).all()])

    def least_forces(self, q: Array, forces: Array, combinations: Sequence[Array]) -> Array:
        """Return the least forces in balance, if combinations of forces have no effect."""
        if not combinations:
            return forces
        n = len(self.equations.speeds)
        F, slopes, _ = self.values(q, np.zeros(self.count))
        _, determined = least_norm(np.array(combinations), np.zeros(len(combinations)))
        least: Array = determined @ least_norm(slopes[:n, len(q) :] @ determined, -F[:n])[0]
        return least if self.error(q, least) <= max(self.error(q, forces), _ROUNDED) else forces

    def small_motion(
        self, q: Array, forces: Array, *, is_held: bool
    ) -> SmallMotion | SmallMotionOfStates | SmallMotionWithRates:
        """Return the linear equations of the motions that the constraints allow.

        Args:
            q: the equilibrium.
            forces: the multipliers and the holding forces there.
            is_held: whether the fixed coordinates stay fixed; if not, they are free, and the holding forces constant.
        """
        m, n = len(self.equations.constraints), len(self.equations.speeds)
        M, C, K, driving = self.statics.small_motion(self.t, q, forces[:m], self.p)
        _, slopes, _ = self.values(q, forces)
        reactions = slopes[:n, len(q) : None if is_held else len(q) + m].T
        giving = self.statics.giving_rates
        others = np.delete(reactions, giving, axis=0)
        _, Z = least_norm(others, np.zeros(len(others)))
        coordinates, states = len(self.equations.coordinates), len(self.equations.states)
        S = slopes[:n, :coordinates] @ K
        mechanical = SmallMotion(Z.T @ M @ Z, Z.T @ C @ Z, Z.T @ S @ Z)
        if not states and not giving:
            return mechanical
        # Reactions follow from the equations of motion, R^T df = M du' + C du + S dx + S_z dz.
        by_reactions = np.zeros((states, len(reactions)))
        of_rates = slopes[len(slopes) - states :]
        by_reactions[:, :m] = of_rates[:, len(q) : len(q) + m]
        back = by_reactions @ -np.linalg.pinv(reactions.T)
        by_states = slopes[:n, coordinates : len(q)]
        of_states = StatesAlong(
            force=Z.T @ by_states,
            inertia=(driving[:, n:] + back @ M) @ Z,
            damping=(driving[:, :n] + back @ C) @ Z,
            stiffness=(of_rates[:, :coordinates] @ K + back @ S) @ Z,
            rate=of_rates[:, coordinates : len(q)] + back @ by_states,
        )
        if not giving:
            return SmallMotionOfStates(mechanical, of_states)
        rows = slopes[[n + k for k in giving]]
        rates = Rates(-reactions[giving] @ Z, rows[:, :coordinates] @ K @ Z, rows[:, coordinates : len(q)])
        return SmallMotionWithRates(mechanical, of_states, rates)


_FAINT = 1e-6
"""The ratio to the largest forces that counts, where all terms of an equation are rounding errors."""
_ROUNDED = 1e-7
"""The relative residual of a condition that is allowed when directions of forces that nearly agree are left out."""
_NOTHING = 1e-12
"""The force or moment that counts if there are no others."""
