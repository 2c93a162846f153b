"""A position of rest: the eigenvalues of small motions about it, and the forces that it determines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.kinematics import Kinematics
from symbody.simulation.constraint.singular_position import is_singular
from symbody.simulation.steady_state.force_balance import Balance
from symbody.symbolic import free_symbols
from symbody.symbolic import t as time

from .undetermined_forces import UndeterminedForces

__all__ = ["RestPosition"]

Array = NDArray[np.float64]

_LATER = (0.0618, 0.7, 3.3)
"""How much later, in s, a balance is looked at again; no period divides all of them."""
_MOVED = 1e-6
"""The relative residual beyond which a condition no longer holds."""


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

    def leaving(self) -> str:
        """Return the name of a condition that does not hold at other times, or nothing."""
        if time not in free_symbols(self.problem.conditions.expressions):
            return ""
        for later in _LATER:
            then = replace(self.problem, t=self.problem.t + later)
            forces = then.first_forces(self.q)
            left = np.abs(then.values(self.q, forces)[0] / then.scale(self.q, forces))
            if not left.max() <= _MOVED:
                return self.problem.conditions.names[int(np.argmax(np.nan_to_num(left, nan=np.inf)))]
        return ""

    def notices(self, *, at_instant: bool) -> Iterator[str]:
        """Yield notices of undetermined forces, of unknown eigenvalues, and of a balance at one instant alone.

        Args:
            at_instant: whether the user asked for the balance at an instant.
        """
        moved = "" if at_instant else self.leaving()
        if moved:
            now = f"t={self.problem.t:g}"
            yield (
                f"{moved.rstrip(',')} depends on the time: forces are in balance at {now}, but the system does not "
                f"stay at rest; pass {now} if this instant is meant, or give loads, inputs and frames that are constant"
            )
        undetermined = self.undetermined.notice()
        if undetermined:
            yield undetermined
        if self.is_singular or self.is_singular_held:
            what = "the constraints" if self.is_singular else "the constraints and what is held"
            whose = "eigenvalues" if self.is_singular else "held_eigenvalues"
            yield (
                f"the position is singular: {what} depend on each other here, but not at neighbouring positions, so "
                f"that no linear equations describe the small motions about it: {whose} are NaN"
            )
