"""Equations of motion as differential-algebraic equations, in three forms of different index."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import CompiledFunction, PreparedCode, lambdify
from symbody.errors import SimulationError
from symbody.simulation.given.parameter import parameters_in
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, derivation, free_symbols, jacobian, number, substitute, symbols, t

__all__ = ["FORMS", "DifferentialAlgebraicEquations", "dae_of"]

FORMS = ("stabilized", "2", "3")
"""The index-2 form of Gear, Gupta and Leimkuhler; rates of constraints only; constraints on positions only."""


@dataclass(frozen=True, eq=False)
class DifferentialAlgebraicEquations:
    """The equations ``F(t, y, y') = 0`` of a model, with the unknowns ``y = (q, u, lambda)`` or ``(q, u, lambda, mu)``.

    The states z beside the mechanics follow u in y; their equations are ``z' = f(q, u, u', z, lambda)``. The others
    are ``q' = K u``, ``M u' = forcing + phi_q^T lambda``, and the constraints in one of three forms:

    - "3": ``phi = 0``; the index is 3, nothing drifts, and errors of lambda grow as 1/h^2 [Brenan, Campbell &
      Petzold 1996, sec. 6.2];
    - "2": ``phi' = 0``; the index is 2, and phi itself drifts;
    - "stabilized": both, with ``q' = K u + phi_q^T mu`` and multipliers mu that vanish along the exact motion [Gear,
      Gupta & Leimkuhler 1985]; the index is 2, and nothing drifts.

    Constraints that are on velocities only are kept on this level in every form.

    Attributes:
        model: the model.
        form: one of FORMS.
    """

    model: Model
    form: str = "stabilized"

    def __post_init__(self) -> None:
        if self.form not in FORMS:
            raise SimulationError(
                f"simulate: the form {self.form!r} of differential-algebraic equations; expected one of "
                f"{', '.join(FORMS)}"
            )

    @cached_property
    def unknowns(self) -> tuple[Expr, ...]:
        """The unknowns y: the state, the multipliers, and the kinematic multipliers mu if the form has them."""
        return (*self.model.state, *self.model.multipliers, *self._kinematic_multipliers)

    @cached_property
    def rates(self) -> tuple[Expr, ...]:
        """The rates of the state, as separate variables: ``q'`` equals u only once the equations hold."""
        q, z = len(self.model.coordinates), len(self.model.states)
        return (*_named("dae_rate", q), *self.model.accelerations, *_named("dae_state_rate", z))

    @cached_property
    def _kinematic_multipliers(self) -> tuple[Expr, ...]:
        return _named("dae_mu", len(self.model.position_constraints)) if self.form == "stabilized" else ()

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values. Inputs may contain the time, which is not one of them."""
        return tuple(symbol for symbol in self.model.parameters if not symbol.depends_on_time)

    @property
    def differential(self) -> int:
        """The number of unknowns with rates: the state, which comes first."""
        return len(self.model.state)

    @cached_property
    def residuals(self) -> tuple[Expr, ...]:
        """The residuals F, one for each unknown: those of q, u and z, then constraints on velocities and positions."""
        model = self.model
        phi = model.position_constraints if self.form != "2" else ()
        with derivation():
            kinematics = [
                rate - by_speeds - correction
                for rate, by_speeds, correction in zip(
                    self.rates, model.coordinate_rates, self._corrections, strict=False
                )
            ]
            first = len(self.rates) - len(model.states)
            states = [rate - value for rate, value in zip(self.rates[first:], model.state_rates, strict=True)]
            dynamics = (*model.equations.derived_residuals, *states)
            return model.with_inputs([*kinematics, *dynamics, *self._velocities, *phi])

    @property
    def _velocities(self) -> tuple[Expr, ...]:
        """The constraints on the level of velocities; in the form "3", only those that have no other."""
        levels, positions = self.model.velocity_constraints, self.model.system.holonomic
        return tuple(level for k, level in enumerate(levels) if self.form != "3" or k not in positions)

    @property
    def _corrections(self) -> tuple[Expr, ...]:
        """Return ``phi_q^T mu``, with the derivatives with respect to the coordinates."""
        coordinates, mu = self.model.coordinates, self._kinematic_multipliers
        if not mu:
            return (number(0),) * len(coordinates)
        J = jacobian(self.model.position_constraints, coordinates)
        return tuple(
            sum((J[k, i] * mu[k] for k in range(len(mu))), start=number(0)) for i in range(len(coordinates))
        )

    @cached_property
    def inputs(self) -> tuple[Expr, ...]:
        """The variables of the compiled code: t, y, the rates of the state, and cj."""
        return (t, *self.unknowns, *self.rates, _CJ)

    @cached_property
    def residual_code(self) -> PreparedCode:
        """The machine code of the residuals."""
        return PreparedCode(self.parameters, self.inputs, self.residuals)

    @cached_property
    def slopes(self) -> tuple[tuple[Expr, ...], NDArray[np.intp]]:
        """The nonzero derivatives ``dF/dy + cj dF/dy'``, and their rows and columns, column by column."""
        by_unknowns = jacobian(list(self.residuals), list(self.unknowns))
        by_rates = jacobian(list(self.residuals), list(self.rates))
        entries, places = [], []
        for j in range(len(self.unknowns)):
            for i in range(len(self.residuals)):
                entry = by_unknowns[i, j]
                if j < self.differential:
                    entry += _CJ * by_rates[i, j]
                if not entry.is_zero:
                    entries.append(entry)
                    places.append((i, j))
        return tuple(entries), np.array(places, dtype=np.intp).reshape(-1, 2)

    @cached_property
    def slopes_code(self) -> PreparedCode:
        """The machine code of the derivatives."""
        return PreparedCode(self.parameters, self.inputs, self.slopes[0])

    @cached_property
    def start(self) -> CompiledFunction:
        """The function of time, state and parameters that returns the rates of coordinates, A and b.

        ``A (u', lambda) + b = 0`` stands for ``M u' = forcing + phi_q^T lambda`` and ``phi'' = 0``. The function is
        called only once, so it is not compiled.
        """
        model, eqs = self.model, self.model.equations
        unknown = [*model.accelerations, *model.multipliers]
        second = eqs.baumgarte(0, 0) if model.constraints else ()
        equations = model.with_inputs([*eqs.derived_residuals, *second])
        rest = substitute(equations, dict.fromkeys(unknown, number(0)))
        arguments: list[Expr | list[Expr]] = [t, list(model.state), list(self.parameters)]
        outputs = [[*model.with_inputs(model.coordinate_rates)], jacobian(list(equations), unknown), [*rest]]
        return lambdify(arguments, outputs, compile=False)

    @cached_property
    def state_rates(self) -> CompiledFunction:
        """The function of time, state, ``(u', lambda)`` and parameters that returns the rates of the states z."""
        model = self.model
        unknown = [*model.accelerations, *model.multipliers]
        arguments: list[Expr | list[Expr]] = [t, list(model.state), unknown, list(self.parameters)]
        return lambdify(arguments, [[*model.with_inputs(model.state_rates)]], compile=False)

    def observed(self, expressions: Sequence[Expr]) -> PreparedCode:
        """Return the machine code of expressions of time, state, accelerations, multipliers and parameters."""
        values = self.model.with_inputs(expressions)
        if any(leaf.depends_on_time for leaf in free_symbols(values) - {*self.inputs}):
            values = self.model.along_motion(expressions)  # rates of accelerations are not unknowns
        return PreparedCode(parameters_in(values), self.inputs, values)


def _named(stem: str, how_many: int) -> tuple[Expr, ...]:
    return tuple(symbols(f"{stem}_{k}") for k in range(1, how_many + 1))


_CJ = symbols("dae_cj")
"""The derivative of a rate with respect to its unknown in the backward difference formula, of the order of 1/h."""

_made: WeakKeyDictionary[Model, dict[str, DifferentialAlgebraicEquations]] = WeakKeyDictionary()


def dae_of(model: Model, form: str) -> DifferentialAlgebraicEquations:
    """Return the differential-algebraic equations of a model. They are cached, with their compiled code."""
    forms = _made.setdefault(model, {})
    if form not in forms:
        forms[form] = DifferentialAlgebraicEquations(model, form)
    return forms[form]
