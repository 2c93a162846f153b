"""Forces in a steady motion that the balance does not determine, such as those of dependent constraints."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.multibody.named_constraint import named_constraints
from symbody.multibody.shared_multiplier import HOW_TO_SHARE
from symbody.simulation.constraint.shared_load import shared_load
from symbody.simulation.constraint.singular_position import dependent_rows
from symbody.simulation.steady_state.force_balance import Balance
from symbody.symbolic import Expr, Matrix
from symbody.symbolic.given.wording import joined_by_and

__all__ = ["UndeterminedForces"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class UndeterminedForces:
    """The forces f in dependent directions, ``[phi_q^T K^T] f = 0``: any multiple of them balances as well.

    Attributes:
        problem: the balance of forces.
        x: the variables.
        forces: multipliers and holding forces in balance.
    """

    problem: Balance
    x: Array
    forces: Array

    @cached_property
    def idle(self) -> list[Array]:
        """The combinations of forces that have no effect here."""
        return dependent_rows(self.problem.directions(self.x)) if self.problem.count else []

    @cached_property
    def least_forces(self) -> Array:
        """The least forces in balance."""
        return self.problem.least_forces(self.x, self.forces, self.idle)

    def shared(self, evaluate: Callable[[Sequence[Expr]], Array]) -> Array:
        """Return the forces in balance with the least of what joints bear.

        Args:
            evaluate: the function that returns the values of expressions at the least forces.
        """
        if not self.idle:
            return self.least_forces
        free, system = (
            np.linalg.svd(np.array(self.idle), full_matrices=False)[2].T,
            self.problem.equations.system,
        )
        shared: Array = shared_load(system, self.least_forces[None], [free], evaluate)[0]
        return shared

    @cached_property
    def groups(self) -> list[NDArray[np.intp]]:
        """The groups of forces that are not determined, except those of constraints that are redundant everywhere."""
        return [rows for rows in self._all_groups if not self._is_redundant(rows)]

    @cached_property
    def redundant_groups(self) -> list[NDArray[np.intp]]:
        """The groups of multipliers of constraints that are redundant everywhere."""
        return [rows for rows in self._all_groups if self._is_redundant(rows)]

    @cached_property
    def _all_groups(self) -> list[NDArray[np.intp]]:
        return [np.flatnonzero(combination) for combination in self.idle]

    def is_of_constraints(self, rows: NDArray[np.intp]) -> bool:
        """Return whether a group of forces are multipliers."""
        return bool((rows < len(self.problem.equations.constraints)).all())

    def _is_redundant(self, rows: NDArray[np.intp]) -> bool:
        """Return whether the forces belong to constraints that are dependent at almost every position."""
        if not self.is_of_constraints(rows):
            return False
        gradients = self.problem.equations.constraint_jacobian.tolist()
        return Matrix([gradients[row] for row in rows]).rank() < len(rows)

    def notice(self) -> str:
        """Return which forces are not determined; the empty text if all are."""
        described = [*map(self._described, self.groups), *map(self._redundant, self.redundant_groups)]
        if not described:
            return ""
        more = f"; and {len(described) - _SHOWN} more groups" if len(described) > _SHOWN else ""
        way_out = f", {HOW_TO_SHARE}" if self.redundant_groups else ""
        return f"{'; '.join(described[:_SHOWN])}{more}; those of minimum norm are given{way_out}"

    def _redundant(self, rows: NDArray[np.intp]) -> str:
        return (
            f"{joined_by_and(self._names(rows))} are not determined, as these constraints depend on each other "
            "wherever the mechanism moves: other values balance as well"
        )

    def _names(self, rows: NDArray[np.intp]) -> list[str]:
        eqs, m = self.problem.equations, len(self.problem.equations.constraints)
        multipliers = [
            f"{eqs.multipliers[row]} of constraint {name}"
            for row, name in zip(
                rows[rows < m], named_constraints(eqs.system.conditions, rows[rows < m]), strict=True
            )
        ]
        return [
            *multipliers,
            *(f"the force that holds {self.problem.order[row - m]}" for row in rows[rows >= m]),
        ]

    def _described(self, rows: NDArray[np.intp]) -> str:
        names = self._names(rows)
        if len(names) == 1:
            return f"{names[0]} is not determined here: it moves nothing at this position"
        return (
            f"{joined_by_and(names)} are not determined here, as they act in directions that depend on each other at "
            "this position: other values balance as well"
        )


_SHOWN = 4
