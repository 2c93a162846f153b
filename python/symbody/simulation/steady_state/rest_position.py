"""A position of rest: the eigenvalues of small motions about it, and the forces that it determines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.kinematics import Kinematics
from symbody.simulation.constraint.singular_position import is_singular
from symbody.simulation.steady_state.force_balance import Balance

from .undetermined_forces import UndeterminedForces

__all__ = ["RestPosition"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RestPosition:
    """An equilibrium.

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
    def undetermined(self) -> UndeterminedForces:
        """The forces that the balance does not determine."""
        return UndeterminedForces(self.problem, self.q, self.forces)

    @property
    def least_forces(self) -> Array:
        """The least forces in balance."""
        return self.undetermined.least_forces

    @cached_property
    def is_singular(self) -> bool:
        """Whether the constraints are dependent here, but not at neighbouring positions."""
        found = self.undetermined
        return any(found.is_of_constraints(rows) for rows in found.groups) and self._is_singular(())

    @cached_property
    def is_singular_held(self) -> bool:
        """The same for the constraints and the fixed coordinates."""
        held = self.problem.order
        return self._is_singular(held) if held and self.undetermined.groups else self.is_singular

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
        if self.undetermined.groups:
            yield self.undetermined.notice()
        if self.is_singular or self.is_singular_held:
            what = "the constraints" if self.is_singular else "the constraints and what is held"
            whose = "eigenvalues" if self.is_singular else "held_eigenvalues"
            yield (
                f"the position is singular: {what} depend on each other here, but not at neighbouring positions, so "
                f"that no linear equations describe the small motions about it: {whose} are NaN"
            )
