"""The residuals of a fit and their derivatives: motions of all experiments, with exact sensitivities."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.errors import ConstraintError, ModelNotice, SimulationError
from symbody.simulation.motion.motion import Motion
from symbody.simulation.motion.simulate import simulate
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic import number as as_expression

from .experiment import Experiment
from .unknown import Unknown

__all__ = ["Residuals"]

Array = NDArray[np.float64]

_STEP = 1e-4
"""The relative step of difference quotients: far above the tolerances of motions."""


@dataclass(eq=False)
class Residuals:
    """The residuals ``(y(t, p) - y_measured) / deviation`` as a function of the unknowns p, and their Jacobian.

    Attributes:
        eqs: the equations of motion.
        experiments: the experiments.
        unknowns: the unknowns p.
        parameters: the values of the other parameters, of all experiments.
        initial: the known initial values, of all experiments.
        options: further arguments of `simulate`.
        by_differences: whether derivatives came from difference quotients.
    """

    eqs: Equations
    experiments: Sequence[Experiment]
    unknowns: Sequence[Unknown]
    parameters: Mapping[Expr, float]
    initial: Mapping[Expr, float]
    options: Mapping[str, Any]
    by_differences: bool = False
    _last: tuple[bytes, Array, Array | None] | None = field(default=None, repr=False)

    @property
    def places(self) -> list[int]:
        """Where the residuals of each experiment end."""
        sizes = [sum(len(m.values) for m in each.measurements) for each in self.experiments]
        return list(accumulate(sizes))

    def concerns(self, unknown: Unknown, number: int) -> bool:
        """Return whether an experiment depends on an unknown: a parameter may be in some measurements alone."""
        if not unknown.is_in(number):
            return False
        return unknown.name in self.eqs.system.state_names or unknown.name in self._symbols[number]

    @cached_property
    def _symbols(self) -> list[frozenset[Expr]]:
        """The symbols in the model, the inputs and the measurements of each experiment."""
        shared = {*self.eqs.parameters, *free_symbols(_values(self.options.get("inputs", {})))}
        return [
            frozenset(
                {*shared, *free_symbols(_values(each.inputs))}
                | free_symbols([measured.expression for measured in each.measurements])
            )
            for each in self.experiments
        ]

    def values(self, p: Array) -> Array:
        """Return the residuals; infinite ones where there is no motion, so that the search turns back."""
        return self._found(p)[0]

    def jacobian(self, p: Array) -> Array:
        """Return the derivatives of the residuals by the unknowns."""
        slopes = self._found(p)[1]
        if slopes is not None and np.isfinite(slopes).all():
            return slopes
        self.by_differences = True
        return self._quotients(p)

    def _found(self, p: Array) -> tuple[Array, Array | None]:
        """Return residuals and derivatives; those of the last point are remembered."""
        key = p.tobytes()
        if self._last is None or self._last[0] != key:
            self._last = (key, *self._computed(p))
        return self._last[1:]

    def _computed(self, p: Array) -> tuple[Array, Array | None]:
        total = self.places[-1]
        try:
            parts = [self._of_experiment(p, number) for number in range(len(self.experiments))]
        except (SimulationError, ConstraintError) as failure:
            if self._last is None:
                raise SimulationError(
                    f"fit: there is no motion at the start of the search: {failure}"
                ) from failure
            return np.full(total, np.inf), None
        slopes = np.concatenate([part[1] for part in parts])
        return np.concatenate([part[0] for part in parts]), slopes

    def _of_experiment(self, p: Array, number: int) -> tuple[Array, Array]:
        """Return the residuals of one experiment and their derivatives."""
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore", ModelNotice
            )  # what the motions of the solution say is reported at the end
            motion = self.motion(p, number, is_differentiated=not self.by_differences)
        rows: list[Array] = []
        slopes: list[Array] = []
        for each in self.experiments[number].measurements:
            places = np.searchsorted(motion.t, each.t)
            scale = 1.0 if each.deviation is None else 1 / each.deviation
            rows.append((motion[each.expression][places] - each.values) * scale)
            columns = np.zeros((len(places), len(self.unknowns)))
            for k, unknown in enumerate(self.unknowns):
                if self.concerns(unknown, number):
                    columns[:, k] = self._slope(motion, each.expression, unknown)[places] * scale
            slopes.append(columns)
        return np.concatenate(rows), np.concatenate(slopes)

    def _slope(self, motion: Motion, expression: Expr, unknown: Unknown) -> Array:
        if self.by_differences:
            return np.full(len(motion.t), np.nan)
        return motion.sensitivity(expression, by=unknown.name)

    def motion(
        self, p: Array, number: int, *, t: Array | None = None, is_differentiated: bool = False
    ) -> Motion:
        """Return the motion of an experiment.

        Args:
            p: the unknowns.
            number: the number of the experiment.
            t: the instants; by default those of its measurements.
            is_differentiated: whether it has sensitivities by the unknowns.
        """
        experiment = self.experiments[number]
        parameters, initial = self.given(p, number)
        return simulate(
            self.eqs,
            parameters,
            initial,
            experiment.instants if t is None else t,
            inputs={**self.options.get("inputs", {}), **experiment.inputs},
            outputs={f"measurement {k}": each.expression for k, each in enumerate(experiment.measurements)},
            sensitivities=[each.name for each in self.unknowns if self.concerns(each, number)]
            if is_differentiated
            else None,
            progress=False,
            **{name: value for name, value in self.options.items() if name != "inputs"},
        )

    def given(self, p: Array, number: int) -> tuple[dict[Expr, float], dict[Expr, float]]:
        """Return the parameters and the initial values of an experiment."""
        experiment = self.experiments[number]
        values = {
            each.name: float(value)
            for each, value in zip(self.unknowns, p, strict=True)
            if self.concerns(each, number)
        }
        of_parameters = {name: value for name, value in values.items() if name.kind == "symbol"}
        of_state = {name: value for name, value in values.items() if name.kind != "symbol"}
        return (
            {**self.parameters, **experiment.parameters, **of_parameters},
            {**self.initial, **experiment.initial, **of_state},
        )

    def _quotients(self, p: Array) -> Array:
        """Return central difference quotients, one-sided at bounds."""
        columns = []
        for k, unknown in enumerate(self.unknowns):
            step = _STEP * max(abs(p[k]), _STEP)
            low, high = max(p[k] - step, unknown.low), min(p[k] + step, unknown.high)
            ends = []
            for value in (low, high):
                other = p.copy()
                other[k] = value
                ends.append(self._computed(other)[0])
            columns.append((ends[1] - ends[0]) / (high - low))
        return np.array(columns).T


def _values(inputs: Mapping[Expr, ExprLike]) -> list[Expr]:
    return [as_expression(value) for value in inputs.values()]
