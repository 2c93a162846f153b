"""Motions: what a simulation returns."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ModelError, SimulationError, SymbodyError
from symbody.multibody import System
from symbody.simulation.given.event import Occurrence
from symbody.simulation.given.reading import Reading
from symbody.simulation.integrate.outcome import Statistics
from symbody.simulation.model.model import Model
from symbody.simulation.model.unknown import explain_unknown
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic.given.arguments import counted, described

from .drawing import drawer
from .rates_along import accelerations_along

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Motion"]

Array = NDArray[np.float64]

_READING = Reading(
    "motion",
    "motion.t has the instants, motion.states a row for each of them, and motion.state_at(0) is the state at the first",
)


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion: the state at each instant, and the value of any expression of the model along it.

    ``motion[expression]`` takes expressions of time, coordinates, speeds, accelerations, multipliers and parameters,
    and derivatives of these by time.

    Attributes:
        model: what moves.
        parameters: the values of the parameters.
        t: the instants, N of them; behind the asked ones the end, where the motion ended between two.
        states: coordinates, then speeds, a row for each instant.
        work: the work of loads and moving constraints since the first instant, in J; zero where there is none, NaN
            where it wasn't integrated.
        events: what happened, in order of time.
        statistics: what the integration took.
        completed: whether it came to its end, the last instant or a terminal event.
        message: why it ended.
        output_expressions: expressions to evaluate, by name.
    """

    model: Model = field(repr=False)
    parameters: Mapping[Expr, float]
    t: Array
    states: Array
    work: Array
    events: tuple[Occurrence, ...]
    statistics: Statistics
    completed: bool
    message: str
    output_expressions: Mapping[str, Expr] = field(default_factory=dict)

    def __repr__(self) -> str:
        names = ", ".join(map(str, self.model.coordinates))
        instants = f"{counted(len(self.t), 'instant')} from {self.t[0]:g} to {self.t[-1]:g} s"
        return f"Motion of {names}: {instants}, {self.message}"

    def __len__(self) -> int:
        """Return how many instants there are."""
        return len(self.t)

    @property
    def system(self) -> System:
        """What moves."""
        return self.model.system

    def __iter__(self) -> NoReturn:
        """Raise an error: Python would ask for ``motion[0]``, ``motion[1]`` and so on."""
        _READING.refuse_iteration()

    def __getitem__(self, expression: Expr) -> Array:
        """Return the values of an expression, one for each instant.

        Raises:
            ArgumentError: it is no expression; numbers are none here.
            SimulationError: an expression of which the model knows nothing.
            ParameterError: a parameter that stands in none of the equations, and has no value.
        """
        expression = _READING.one(expression, self.model.state)
        if expression in self.model.state:
            return self.states[:, self.model.state.index(expression)]
        values: Array = self.evaluate([expression])[0]
        return values

    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, a row for each.

        Raises:
            ArgumentError: no list of expressions.
            SimulationError: an expression of which the model knows nothing.
            ParameterError: a parameter that stands in none of the equations, and has no value.
        """
        wanted = _READING.several(expressions)
        if not wanted:
            return np.empty((0, len(self.t)))
        known = self.model.unknowns_in(wanted)
        return self._values(wanted, known, [self._solved_for(name) for name in known])

    def _values(self, wanted: Sequence[Expr], known: tuple[Expr, ...], columns: Sequence[Array]) -> Array:
        """Return the values of expressions, given those of accelerations and multipliers in them."""
        try:
            function = self.model.function(wanted, tuple(self.parameters), known)
        except SymbodyError as failure:
            explain_unknown("motion", wanted, self.model, self.parameters)
            raise SimulationError(f"motion: {failure}") from failure
        values = function(self.t, *self.states.T, *columns, *self.parameters.values())
        return np.stack([np.broadcast_to(row, self.t.shape) for row in values])

    def _solved_for(self, unknown: Expr) -> Array:
        """Return the values of an acceleration or a multiplier; all of them are found at the first one."""
        if unknown in self.model.accelerations:
            return self.accelerations[:, self.model.accelerations.index(unknown)]
        return self.multipliers[:, self.model.multipliers.index(unknown)]

    @cached_property
    def outputs(self) -> dict[str, Array]:
        """The values of what was asked for, by name."""
        return dict(
            zip(self.output_expressions, self.evaluate(list(self.output_expressions.values())), strict=True)
        )

    @cached_property
    def accelerations(self) -> Array:
        """The rates of the speeds, a row for each instant."""
        return accelerations_along(self.model, self.parameters, self.t, self.states)

    @cached_property
    def multipliers(self) -> Array:
        """The multipliers of the constraints, a row for each instant: ``M u' = forcing + phi_q^T lambda``."""
        model = self.model
        return self._values(model.multipliers, (), ()).T if model.multipliers else np.empty((len(self.t), 0))

    def state_at(self, instant: int = -1) -> dict[Expr, float]:
        """Return the coordinates and speeds at the instant of a number: what another simulation can begin with.

        Args:
            instant: which one, from 0; negative ones count from the last.

        Raises:
            ArgumentError: there is no such instant.
        """
        count = len(self.t)
        if not hasattr(instant, "__index__") or not -count <= instant < count:
            raise ArgumentError(
                f"motion.state_at: {described(instant)}; expected the number of one of the {count} instants, from 0"
            )
        return dict(zip(self.model.state, map(float, self.states[instant]), strict=True))

    @cached_property
    def energy(self) -> Array:
        """The mechanical energy less the work of loads and of moving constraints: constant, but for errors.

        Raises:
            ModelError: motions that are prescribed in frames do work that nobody knows.
            ParameterError: a mass or an inertia that stands in none of the equations has no value.
        """
        model = self.model
        if np.isnan(self.work).any():
            raise ModelError(
                "motion: loads do work, which the methods 'ida', 'ida2' and 'ida3' don't integrate; use another method"
            )
        energies = [
            model.kinetic_energy,
            *([] if model.potential_energy is None else [model.potential_energy]),
        ]
        driven = sorted(
            str(leaf) for leaf in free_symbols(energies) if leaf.depends_on_time and leaf not in model.state
        )
        if driven:
            raise ModelError(
                f"motion: frames move by {', '.join(driven)}, a prescribed motion whose drive does work that the "
                "equations don't hold: the energy isn't constant; prescribe it by a constraint to have its work counted"
            )
        total: Array = self.evaluate(energies).sum(axis=0) - self.work
        return total

    @cached_property
    def energy_drift(self) -> float:
        """The largest change of the energy's balance, relative to the largest energy that moves.

        ``max |E - W - E0| / max(T, |V - V0|, |W|)`` with the kinetic and the potential energy and the work.
        """
        kinetic = self.evaluate([self.model.kinetic_energy])[0]
        potential = self.energy + self.work - kinetic
        parts = [kinetic, potential - potential[0], self.work]
        scale = max(float(np.abs(part).max()) for part in parts)
        change = float(np.abs(self.energy - self.energy[0]).max())
        return change / scale if scale else change

    @cached_property
    def constraint_drift(self) -> float:
        """The largest value of a constraint."""
        return self._largest(self.model.constraints)

    @cached_property
    def constraint_rate_drift(self) -> float:
        """The largest rate of a constraint."""
        return self._largest(self.model.system.rate(self.model.constraints))

    def _largest(self, expressions: Sequence[Expr]) -> float:
        return float(np.abs(self.evaluate(expressions)).max()) if expressions else 0.0

    def plot(
        self,
        *panels: Any,
        units: Mapping[Expr | str, str] | None = None,
        time: str = "s",
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return a figure over time, a panel for each argument; without one, of coordinates and speeds.

        See `symbody.view.plot`, also for the errors.
        """
        figure: Figure = drawer("plot")(self, *panels, units=units, time=time, title=title, path=path)
        return figure

    def animate(self, path: str | os.PathLike[str], **options: Any) -> Path:
        """Write the motion as a page that shows it in a browser; see `symbody.view.animate` for the options."""
        page: Path = drawer("animate")(self, path, **options)
        return page
