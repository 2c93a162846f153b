"""A position of rest: the forces that it determines, and the eigenvalues of small motions about it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.kinematics import Kinematics
from symbody.simulation.constraint.singular_position import dependent_rows, is_singular
from symbody.simulation.given.wording import joined_by_and
from symbody.simulation.model.named_constraint import named_constraints
from symbody.simulation.statics.force_balance import Balance
from symbody.symbolic import Matrix

__all__ = ["RestPosition"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RestPosition:
    """An equilibrium.

    The balance does not determine forces f in dependent directions, ``[phi_q^T K^T] f = 0``.

    Attributes:
        problem: the balance of forces.
        kinematics: the constraints.
        p: the values of their parameters.
        q: the coordinates, then the states beside the mechanics.
        forces: multipliers and holding forces in balance.
    """

    problem: Balance
    kinematics: Kinematics
    p: Array
    q: Array
    forces: Array

    @cached_property
    def idle(self) -> list[Array]:
        """The combinations of forces that have no effect here."""
        return dependent_rows(self.problem.directions(self.q)) if self.problem.count else []

    @cached_property
    def least_forces(self) -> Array:
        """The least forces in balance."""
        return self.problem.least_forces(self.q, self.forces, self.idle)

    @cached_property
    def is_singular(self) -> bool:
        """Whether the constraints are dependent here, but not at neighbouring positions."""
        return any(self._is_of_constraints(rows) for rows in self._undetermined) and self._is_singular(())

    @cached_property
    def is_singular_held(self) -> bool:
        """The same for the constraints and the fixed coordinates."""
        held = self.problem.order
        return self._is_singular(held) if held and self._undetermined else self.is_singular

    def _is_singular(self, held: Sequence[object]) -> bool:
        names = [q for q in self.problem.order if q in held]
        n = len(self.problem.equations.coordinates)
        return is_singular(self.kinematics.beside(self.q[n:]), self.p, self.problem.t, self.q[:n], names)

    def eigenvalues(self, *, is_held: bool) -> NDArray[np.complex128]:
        """Return the eigenvalues of small motions; NaN if the position is singular."""
        found = self.problem.small_motion(self.q, self.least_forces, is_held=is_held).eigenvalues()
        is_unknown = self.is_singular_held if is_held else self.is_singular
        return np.full(max(1, len(found)), np.nan, complex) if is_unknown else found

    def notices(self) -> Iterator[str]:
        """Yield notices of undetermined forces and unknown eigenvalues."""
        if self._undetermined:
            yield f"{self._open_forces()}; those of minimum norm are given"
        if self.is_singular or self.is_singular_held:
            what = "the constraints" if self.is_singular else "the constraints and what is held"
            whose = "eigenvalues" if self.is_singular else "held_eigenvalues"
            yield (
                f"the position is singular: {what} depend on each other here, but not at neighbouring positions, so "
                f"that no linear equations describe the small motions about it: {whose} are NaN"
            )

    @cached_property
    def _undetermined(self) -> list[NDArray[np.intp]]:
        """The groups of forces that are not determined, except those of constraints that are redundant everywhere."""
        groups = [np.flatnonzero(combination) for combination in self.idle]
        return [rows for rows in groups if not self._is_redundant(rows)]

    def _is_of_constraints(self, rows: NDArray[np.intp]) -> bool:
        return bool((rows < len(self.problem.equations.constraints)).all())

    def _is_redundant(self, rows: NDArray[np.intp]) -> bool:
        """Return whether the forces belong to constraints that are dependent at almost every position."""
        if not self._is_of_constraints(rows):
            return False
        gradients = self.problem.equations.constraint_jacobian.tolist()
        return Matrix([gradients[row] for row in rows]).rank() < len(rows)

    def _open_forces(self) -> str:
        groups = self._undetermined
        shown = "; ".join(self._described(rows) for rows in groups[:_SHOWN])
        return shown + (f"; and {len(groups) - _SHOWN} more groups" if len(groups) > _SHOWN else "")

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
