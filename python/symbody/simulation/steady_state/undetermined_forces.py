"""Forces in a steady motion that the balance does not determine, such as those of dependent constraints."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.multibody.named_constraint import named_constraints
from symbody.simulation.constraint.singular_position import dependent_rows
from symbody.simulation.steady_state.force_balance import Balance
from symbody.symbolic import Matrix
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

    @cached_property
    def groups(self) -> list[NDArray[np.intp]]:
        """The groups of forces that are not determined, except those of constraints that are redundant everywhere."""
        groups = [np.flatnonzero(combination) for combination in self.idle]
        return [rows for rows in groups if not self._is_redundant(rows)]

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
        if not self.groups:
            return ""
        shown = "; ".join(self._described(rows) for rows in self.groups[:_SHOWN])
        more = f"; and {len(self.groups) - _SHOWN} more groups" if len(self.groups) > _SHOWN else ""
        return f"{shown}{more}; those of minimum norm are given"

    def _described(self, rows: NDArray[np.intp]) -> str:
        eqs, m = self.problem.equations, len(self.problem.equations.constraints)
        multipliers = [
            f"{eqs.multipliers[row]} of constraint {name}"
            for row, name in zip(
                rows[rows < m], named_constraints(eqs.system.conditions, rows[rows < m]), strict=True
            )
        ]
        names = [
            *multipliers,
            *(f"the force that holds {self.problem.order[row - m]}" for row in rows[rows >= m]),
        ]
        if len(names) == 1:
            return f"{names[0]} is not determined here: it moves nothing at this position"
        return (
            f"{joined_by_and(names)} are not determined here, as they act in directions that depend on each other at "
            "this position: other values balance as well"
        )


_SHOWN = 4
