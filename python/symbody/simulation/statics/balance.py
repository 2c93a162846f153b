"""The balance of forces at rest as equations for coordinates, multipliers, and forces that hold coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.simulation.constraint.dependent_constraints import nearby
from symbody.simulation.constraint.gauss_newton import gauss_newton
from symbody.simulation.constraint.least_norm import least_norm
from symbody.symbolic import Expr

from .small_motion import SmallMotion
from .statics import Statics

__all__ = ["Balance"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Balance:
    """The conditions for the free coordinates, the multipliers, and the forces that hold fixed coordinates."""

    statics: Statics
    t: float
    p: Array
    held: tuple[Expr, ...]

    @property
    def equations(self) -> Equations:
        return self.statics.equations

    @property
    def is_free(self) -> NDArray[np.bool_]:
        """Which coordinates are free."""
        return np.array([q not in self.held for q in self.equations.coordinates])

    @property
    def order(self) -> list[Expr]:
        """The coordinates that are fixed, in the order of the forces that hold them."""
        return [q for q in self.equations.coordinates if q in self.held]

    @property
    def count(self) -> int:
        """The number of multipliers, of constraints and of what holds."""
        return len(self.equations.constraints) + len(self.held)

    def values(self, q: Array, forces: Array) -> tuple[Array, Array, Array]:
        """Return the conditions, their derivatives by all coordinates and forces, and the sizes of their terms."""
        m, is_held = len(self.equations.constraints), ~self.is_free
        holding = np.zeros(len(q))
        holding[is_held] = forces[m:]
        with np.errstate(all="ignore"):
            F, slopes, sizes = self.statics.function(self.t, q, forces[:m], holding, self.p)
        return F, slopes[:, np.concatenate([np.ones(len(q) + m, dtype=bool), is_held])], sizes

    def scale(self, q: Array, forces: Array) -> Array:
        """Return the sizes of the terms, and no less than what a thousandth of the coordinates makes."""
        _, slopes, sizes = self.values(q, forces)
        n, width = len(self.equations.speeds), len(q)
        scale = np.maximum(sizes, 1e-3 * np.abs(slopes[:, :width]) @ np.maximum(np.abs(q), 1))
        scale = np.where(np.isfinite(scale), scale, 1.0)
        scale[:n] = np.maximum(scale[:n], max(_FAINT * scale[:n].max(), _NOTHING))
        return np.where(scale > 0, scale, 1.0)

    def error(self, q: Array, forces: Array) -> float:
        """Return the largest condition in the size of its terms; infinite where something isn't finite."""
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

    def solved(self, q: Array) -> tuple[Array, Array]:
        """Return where Gauss-Newton steps lead; forces count in the size of the equations of motion."""
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

    def neutral(self, q: Array, forces: Array) -> Array:
        """Return directions of the coordinates in which the conditions don't change to first order, one a column."""
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
        """Return the directions of the multipliers' and the holding forces, one a row, here and at places nearby."""
        n, none = len(self.equations.speeds), np.zeros(self.count)
        places = np.vstack([q, q + nearby(self.equations, q).T])
        slopes = [self.values(place, none)[1][:n, len(q) :].T for place in places]
        return np.array([rows for k, rows in enumerate(slopes) if not k or np.isfinite(rows).all()])

    def least_forces(self, q: Array, forces: Array, combinations: Sequence[Array]) -> Array:
        """Return the least forces of those that balance, where combinations of forces do nothing."""
        if not combinations:
            return forces
        n = len(self.equations.speeds)
        F, slopes, _ = self.values(q, np.zeros(self.count))
        _, determined = least_norm(np.array(combinations), np.zeros(len(combinations)))
        least: Array = determined @ least_norm(slopes[:n, len(q) :] @ determined, -F[:n])[0]
        return least if self.error(q, least) <= max(self.error(q, forces), _ROUNDED) else forces

    def small_motion(self, q: Array, forces: Array, *, is_held: bool) -> SmallMotion:
        """Return the linear equations of the motions that the constraints allow.

        Args:
            q: the equilibrium.
            forces: the multipliers, and what holds coordinates there.
            is_held: whether these stay where they are; else they are free, and the forces on them stay as they are.
        """
        m, n = len(self.equations.constraints), len(self.equations.speeds)
        M, C, K = self.statics.small_motion(self.t, q, forces[:m], self.p)
        _, slopes, _ = self.values(q, forces)
        reactions = slopes[:n, len(q) : None if is_held else len(q) + m].T
        _, Z = least_norm(reactions, np.zeros(len(reactions)))
        S = slopes[:n, : len(q)] @ K
        return SmallMotion(Z.T @ M @ Z, Z.T @ C @ Z, Z.T @ S @ Z)


_FAINT = 1e-6
"""The part of the largest forces that counts, where an equation has no terms but rounding errors."""
_ROUNDED = 1e-7
"""The part of its terms that a condition may be off, where directions of forces that nearly agree are left out."""
_NOTHING = 1e-12
"""A force or moment that counts where there are no others."""
