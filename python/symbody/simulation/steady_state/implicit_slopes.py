"""Derivatives of equilibria and steady motions by parameters and given values: the implicit function theorem.

The conditions ``F(x, f, p) = 0`` determine the variables x and the forces f, so that
``F_x dx/dp + F_f df/dp = -F_p`` with the exact Jacobian [Keller 1977]. Where that matrix is singular, as at a fold,
there are no derivatives. A solution that was found there is beside the exact one, and its Jacobian merely small: it
counts as singular if it changes by its own size along a Newton step, as in the theorem of Newton and
Kantorovich.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.errors import ParameterError, SimulationError
from symbody.simulation.constraint.least_norm import RANK, least_norm
from symbody.symbolic import Expr, free_symbols, jacobian, t
from symbody.symbolic.given.arguments import brief, described
from symbody.symbolic.given.wording import joined_by_and

from .force_balance import Balance
from .steady_conditions import SteadyConditions

__all__ = ["ImplicitSlopes"]

Array = NDArray[np.float64]

_SOLVED = 1e-8
"""The residual, relative to its terms, up to which the equations of the derivatives count as solved."""
_FREE = 1e-6
"""The part of a direction without effect that is allowed in a variable whose derivative is wanted."""
_MERGED = 0.25
"""The relative change of the Jacobian along a Newton step from which solutions merge; it is 1/2 at a double root."""
_ROUNDING = 4 * float(np.finfo(np.float64).eps)
"""The error of a condition relative to its terms."""
_RESOLVED = float(np.sqrt(np.finfo(np.float64).eps))
"""The distance, relative to the variables, up to which rounding errors of conditions hide that two solutions merge."""


@dataclass(frozen=True, eq=False)
class ImplicitSlopes:
    """A solution of conditions of steady motion, and how it moves.

    Attributes:
        balance: the conditions.
        x: the variables.
        forces: the multipliers and the holding forces.
        where: what the user asked, for messages.
    """

    balance: Balance
    x: Array
    forces: Array
    where: str

    def of(self, expression: Expr, values: Mapping[Expr, float], by: Expr) -> float:
        """Return the derivative of an expression of variables, multipliers and parameters.

        Args:
            expression: the expression, by the names in `values`.
            values: the values of all of them.
            by: a parameter, an input, or a variable or expression whose value was given.

        Raises:
            ParameterError: it is none of these.
            SimulationError: the solution has no derivative by it.
        """
        conditions, symbol = self.balance.conditions, self._symbol(by)
        by_x, by_forces, free = self._moved(symbol)
        moved = dict(zip(conditions.variables, by_x, strict=True))
        moved |= dict(zip(self.balance.equations.multipliers, by_forces, strict=False))
        if symbol not in moved:
            moved[symbol] = 1.0
        names = sorted(free_symbols([expression]) & moved.keys(), key=str)
        slopes = jacobian([expression], names).row(0) if names else ()
        known = {name: values[name] for name in free_symbols(list(slopes))}
        found = {name: float(slope.evaluate(known)) for name, slope in zip(names, slopes, strict=True)}
        self._check_determined(found, free)
        return float(sum(slope * moved[name] for name, slope in found.items()))

    def _check_determined(self, slopes: Mapping[Expr, float], free: Array) -> None:
        """Check that an expression doesn't change with what the position leaves open.

        Args:
            slopes: its derivatives.
            free: the directions in which multipliers and holding forces may change without effect, as columns.

        Raises:
            SimulationError: it contains multipliers that aren't determined.
        """
        multipliers = self.balance.equations.multipliers
        open_ones = np.abs(free[: len(multipliers)]).max(axis=1, initial=0.0) > _FREE
        row = np.array([slopes.get(each, 0.0) for each in multipliers])
        if np.abs(row @ free[: len(multipliers)]).max(initial=0.0) > _FREE * np.abs(row).max(initial=0.0):
            is_asked = (open_ones & (row != 0)).tolist()
            names = [str(each) for each, is_open in zip(multipliers, is_asked, strict=True) if is_open]
            raise SimulationError(
                f"{self.where}: the position doesn't determine {joined_by_and(names, most=12)}, as constraints depend "
                "on each other, and the derivatives of their shares aren't known; expected an expression without them, "
                "or in which they balance the same loads"
            )

    def _symbol(self, by: Any) -> Expr:
        """Return the symbol, or the fixed variable, that stands for what was given."""
        conditions = self.balance.conditions
        stands = {**dict(conditions.given), **dict(conditions.prescribed)}
        symbol = stands.get(by, by) if isinstance(by, Expr) else by
        if symbol in conditions.parameters or symbol in self.balance.fixed:
            return symbol
        found = brief(by) if isinstance(by, Expr) else described(by).replace(" is ", ", ", 1) + ","
        if by in conditions.variables or by in conditions.solved:
            raise ParameterError(
                f"{self.where}, by: {found} is not given here, it is solved for; expected a parameter, an input, or "
                "what was given"
            )
        given = [*map(str, self.balance.fixed), *map(str, conditions.equations.parameters)]
        raise ParameterError(
            f"{self.where}, by: {found} is not a parameter here; expected one of "
            f"{joined_by_and(given, most=12, last='or')}"
        )

    def _moved(self, by: Expr) -> tuple[Array, Array, Array]:
        """Return the derivatives of the variables and of the forces, and directions in which forces are not determined.

        Args:
            by: the symbol or the fixed variable.

        Raises:
            SimulationError: there are none.
        """
        balance, width, is_free = self.balance, len(self.x), self.balance.is_free
        _, slopes, _ = balance.values(self.x, self.forces)
        scale = balance.scale(self.x, self.forces)[:, None]
        unit = float(scale[: len(balance.equations.speeds)].max())
        A = self._jacobian(slopes, unit) / scale
        right = -self._explicit(by, slopes) / scale[:, 0]
        found, kernel = least_norm(A, right)
        count = int(is_free.sum())
        left = np.abs(A @ found - right)
        size = np.abs(A) @ np.abs(found) + np.abs(right).max(initial=0.0)
        is_solved = (left <= _SOLVED * np.where(size > 0, size, 1.0)).all()
        is_singular = np.abs(kernel[:count]).max(initial=0.0) > _FREE
        if not is_solved or is_singular or self._is_merged(A, scale, unit):
            raise SimulationError(
                f"{self.where}: the conditions don't determine the derivatives by {by}: this is a fold, or a place "
                "where branches meet; expected another place on the branch"
            )
        by_x = np.zeros(width)
        by_x[is_free] = found[:count]
        if by in balance.fixed:
            by_x[balance.conditions.variables.index(by)] = 1.0
        return by_x, unit * found[count:], kernel[count:]

    def _jacobian(self, slopes: Array, unit: float) -> Array:
        """Return the derivatives of the conditions by the free variables, and by forces over their unit."""
        width = len(self.x)
        return np.hstack([slopes[:, :width][:, self.balance.is_free], unit * slopes[:, width:]])

    def _is_merged(self, A: Array, scale: Array, unit: float) -> bool:
        """Return whether this solution can't be told from one at which several merge.

        Args:
            A: the Jacobian over the scale.
            scale: the magnitudes of the terms of the conditions, a column.
            unit: that of forces.
        """
        F, _, sizes = self.balance.values(self.x, self.forces)
        rows = scale * np.where(
            (largest := np.abs(A).max(axis=1, keepdims=True, initial=0.0)) > 0, largest, 1.0
        )
        A, off = A * scale / rows, (np.abs(F) + _ROUNDING * sizes) / rows[:, 0]
        is_free, count = self.balance.is_free, int(self.balance.is_free.sum())
        U, s, Vt = np.linalg.svd(A, full_matrices=False)
        for u, least, v in zip(U.T, s, Vt, strict=True):
            if least <= RANK * s[0]:
                continue
            noise = _RESOLVED * float(v[:count] ** 2 @ np.abs(self.x[is_free]))
            step = max(np.abs(u) @ off / least, noise) * v
            for sign in (1, -1):
                x = self.x.copy()
                x[is_free] += sign * step[:count]
                _, slopes, _ = self.balance.values(x, self.forces + sign * unit * step[count:])
                with np.errstate(invalid="ignore"):
                    change = u @ (self._jacobian(slopes, unit) / rows - A) @ v
                if abs(change) > _MERGED * least:
                    return True
        return False

    def _explicit(self, by: Expr, slopes: Array) -> Array:
        """Return the derivatives of the conditions by a parameter or a fixed variable."""
        conditions = self.balance.conditions
        if by in self.balance.fixed:
            column: Array = slopes[:, conditions.variables.index(by)]
            return column
        m, q = len(self.balance.equations.constraints), self.balance.equations.coordinates
        holding = np.zeros(len(q))
        holding[[name in self.balance.held for name in q]] = self.forces[m:]
        function = _slope_function(conditions, by)
        return np.ravel(function(self.balance.t, self.x, self.forces[:m], holding, self.balance.p))


@lru_cache(maxsize=128)
def _slope_function(conditions: SteadyConditions, by: Expr) -> CompiledFunction:
    """Return the function of t, the variables, lambda, h and p: the derivatives of the conditions by one of p."""
    unknowns = [[*conditions.variables], [*conditions.equations.multipliers], [*conditions.holding]]
    slopes = jacobian(list(conditions.expressions), [by])
    return lambdify([t, *unknowns, list(conditions.parameters)], list(slopes.entries))
