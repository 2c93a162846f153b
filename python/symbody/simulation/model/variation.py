"""The equations of sensitivities along a motion, as expressions: the variational equations.

For ``x' = f(x, p, t)`` with the state x = (q, u, z), the derivatives ``S = dx/dp`` satisfy ``S' = f_x S + f_p``
[Hairer, Norsett & Wanner 1993, I.14]. f_x and f_p are exact, from the graph; those of accelerations follow from the
equations that these solve (`implicit_variation`). The columns of S are multiplied by the sizes of the parameters, so
that one tolerance suits all of them [Hindmarsh et al. 2005].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode, Shortcut
from symbody.dynamics import ForwardDynamics
from symbody.symbolic import Expr, Matrix, derivation, jacobian, number, substitute, symbol

from .constraint_correction import least_change, moved
from .implicit_variation import implicit_variation, solution_values, through_unknowns
from .model import Model
from .switching import switching_functions

__all__ = ["Variation", "variation_of"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Variation:
    """The derivatives of the state of a model by some of its parameters, and by initial values.

    Attributes:
        model: the model.
        by: parameters, and coordinates, speeds and states, which stand for their initial values.
    """

    model: Model
    by: tuple[Expr, ...]

    @cached_property
    def sensitivities(self) -> Matrix:
        """The variables S, multiplied by the sizes of the parameters: n rows, a column for each parameter."""
        names = [[symbol(f"sensitivity of {x} by {p}") for p in self.by] for x in self.model.state]
        return Matrix(names)

    @cached_property
    def sizes(self) -> tuple[Expr, ...]:
        """The variables of the sizes of the parameters."""
        return tuple(symbol(f"size of {p}") for p in self.by)

    def size_values(self, parameters: Mapping[Expr, float]) -> Array:
        """Return the sizes of the parameters: their magnitudes, and 1 for zeros and initial values."""
        return np.array([abs(parameters.get(p, 0.0)) or 1.0 for p in self.by])

    @property
    def width(self) -> int:
        """The length of the vector that is integrated: the state, S row by row, and the work."""
        return self.model.width + self.count

    @property
    def count(self) -> int:
        """The number of entries of S."""
        return len(self.model.state) * len(self.by)

    def along(self, expressions: Sequence[Expr], S: Matrix | None = None) -> list[list[Expr]]:
        """Return the variations ``e_x S + e_p`` of expressions of time, state and parameters, a row for each.

        Args:
            expressions: the expressions e.
            S: the sensitivities; by default, their variables.
        """
        S = self.sensitivities if S is None else S
        x, k = list(self.model.state), len(self.by)
        slopes = jacobian(list(expressions), [*x, *self._parameters])
        explicit = {p: len(x) + place for place, p in enumerate(self._parameters)}
        rows = []
        for i in range(len(expressions)):
            used = [a for a in range(len(x)) if not slopes[i, a].is_zero]
            row = []
            for j in range(k):
                place = explicit.get(self.by[j])
                start = number(0) if place is None else slopes[i, place] * self.sizes[j]
                row.append(sum((slopes[i, a] * S[a, j] for a in used), start=start))
            rows.append(row)
        return rows

    @cached_property
    def switching(self) -> tuple[Expr, ...]:
        """The functions at whose zeros the rates may jump at an instant that depends on the parameters."""
        rates = self.model.rates[: len(self.model.state)]
        return switching_functions(rates, {*self.model.state, *self.by})

    @property
    def _parameters(self) -> list[Expr]:
        return [p for p in self.by if p not in self.model.state]

    @cached_property
    def inputs(self) -> tuple[Expr, ...]:
        """The variables of compiled code: time, the state, S, and the work."""
        variables, after = self.model.code_variables, 1 + len(self.model.state)
        return (*variables[:after], *self.sensitivities.entries, *variables[after:])

    def code(
        self, expressions: Sequence[Expr], more: Sequence[Expr] = (), shortcut: Shortcut | None = None
    ) -> PreparedCode:
        """Return the machine code of expressions of time, state and S."""
        parameters = (*self.model.parameters, *self.model.damping, *self.sizes, *more)
        return PreparedCode(parameters, self.inputs, tuple(expressions), shortcut)

    def widened(self, code: PreparedCode) -> PreparedCode:
        """Return machine code of the model that takes S as well."""
        known = len(self.model.parameters) + len(self.model.damping)
        parameters = (*code.parameters[:known], *self.sizes, *code.parameters[known:])
        return replace(code, parameters=parameters, inputs=self.inputs)

    @cached_property
    def energies_code(self) -> PreparedCode | None:
        """The machine code of the energies, which takes S as well."""
        code = self.model.energies_code
        return None if code is None else self.widened(code)

    @cached_property
    def state_correction_codes(self) -> tuple[PreparedCode, PreparedCode]:
        """The machine code of the corrections of the state, which takes S as well."""
        positions, velocities = self.model.correction_codes
        return self.widened(positions), self.widened(velocities)

    def rates(self, solution: ForwardDynamics) -> tuple[Expr, ...]:
        """Return the rates of the state, of S and of the work, with given accelerations and multipliers."""
        n, plain = len(self.model.state), self.model.rates_with(solution)
        with derivation():
            rows = self._rates_of_sensitivities(solution, plain[:n])
        return (*plain[:n], *(entry for row in rows for entry in row), *plain[n:])

    def _rates_of_sensitivities(self, solution: ForwardDynamics, rates: Sequence[Expr]) -> list[list[Expr]]:
        """Return S', a row for each variable of the state, given the rates of these."""
        model = self.model
        found = implicit_variation(model, solution, self.along)
        if found is None:
            return self.along(rates)
        nq, nu = len(model.coordinates), len(model.speeds)
        of_states = model.with_inputs(model.state_rates)
        rows = through_unknowns(model, of_states, self.along(of_states), found)
        values = solution_values(model, solution)
        return [
            *self.along(rates[:nq]),
            *found.accelerations[:nu],
            *(list(substitute(row, values)) for row in rows),
        ]

    @cached_property
    def rates_code(self) -> PreparedCode:
        """The machine code of the rates."""
        brief = self.model.shortcut
        shortcut = None if brief is None else Shortcut(self.rates(brief), brief.conditions)
        return self.code(self.rates(self.model.solution), shortcut=shortcut)

    @cached_property
    def jacobian_code(self) -> tuple[PreparedCode, list[tuple[int, int]]]:
        """The machine code of the nonzero derivatives of the rates, and their rows and columns."""
        variables = [*self.model.state, *self.sensitivities.entries]
        slopes = jacobian(list(self.rates_code.expressions), variables)
        rows, columns = slopes.shape
        places = [(i, j) for i in range(rows) for j in range(columns) if not slopes[i, j].is_zero]
        return self.code([slopes[place] for place in places]), places

    @cached_property
    def correction_code(self) -> PreparedCode:
        """The machine code of the smallest changes of S that satisfy the derivatives of the constraints.

        ``phi_q S_q + phi_p = 0``, and the same for the constraints on the level of velocities, ``A u + b = 0``. The
        changes are measured as those of the state are; see `constraint_correction`.
        """
        found = self._corrections(self.model.solution.method)
        brief = self.model.shortcut
        if brief is None:
            return self.code(found[0])
        return self.code(found[0], shortcut=Shortcut(*self._corrections(brief.method)))

    def _corrections(self, method: str) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
        """Return the changes of S, row by row, and the conditions under which they are accurate."""
        model, eqs, k = self.model, self.model.equations, len(self.by)
        nq, nu, rows = len(model.coordinates), len(model.speeds), eqs.system.holonomic
        with derivation(fresh=True):
            of_positions = self.along(model.with_inputs(model.position_constraints))
            levels = model.with_inputs(model.velocity_constraints)
            J = eqs.constraint_jacobian
            conditions: list[Expr] = []
            columns: list[tuple[Expr, ...]] = []
            on_position = J if eqs.system.is_holonomic else Matrix([J.row(i) for i in rows])
            change = [[number(0)] * k for _ in range(nq)]
            for j in range(k if rows else 0):
                step = least_change(eqs, on_position, [row[j] for row in of_positions], method)
                conditions += step.conditions
                for i, moves in enumerate(moved(eqs, step.x)):
                    change[i][j] = moves
            corrected = self._moved_by(change)
            of_velocities = self.along(levels, corrected)
            for j in range(k):
                step = least_change(eqs, J, [row[j] for row in of_velocities], method)
                conditions += step.conditions
                columns.append(step.x)
            speeds = [[columns[j][i] for j in range(k)] for i in range(nu)]
            still = [[number(0)] * k for _ in model.states]
            flat = [entry for row in (*change, *speeds, *still) for entry in row]
            return model.with_inputs(flat), model.with_inputs(tuple(dict.fromkeys(conditions)))

    def _moved_by(self, change: Sequence[Sequence[Expr]]) -> Matrix:
        S, k = self.sensitivities, len(self.by)
        rows = [[S[i, j] + change[i][j] for j in range(k)] for i in range(len(change))]
        return Matrix([*rows, *([S[i, j] for j in range(k)] for i in range(len(change), S.rows))])


@lru_cache(maxsize=16)
def variation_of(model: Model, by: tuple[Expr, ...]) -> Variation:
    """Return the variation of a model by parameters. It is cached, with its compiled code."""
    return Variation(model, by)
