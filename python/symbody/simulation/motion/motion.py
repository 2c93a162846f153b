"""Motions: what a simulation returns."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, overload

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ModelError, SimulationError, SymbodyError
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.simulation.integrate.methods import methods_that
from symbody.simulation.integrate.outcome import Statistics
from symbody.simulation.model.model import Model
from symbody.simulation.model.unknown import explain_unknown
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import counted, described, with_known_names
from symbody.symbolic.given.wording import joined_by_and

from .continuous_angle import values_along
from .differentiated_motion import DifferentiatedMotion
from .drawing import NotebookPage, drawing_function
from .occurrence import Occurrence
from .range_table import range_table
from .rates_along import accelerations_along
from .reading import Reading

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Motion"]

Array = NDArray[np.float64]

_READING = Reading(
    "motion",
    "motion.t has the instants, motion.states a row for each of them, and motion.state_at(0) is the state at the first",
)

_ROUNDING = 16 * float(np.finfo(np.float64).eps)
"""The rounding of a sum of energies, relative to it."""


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion: the state at each instant, and the value of any expression of the model along it.

    ``motion[expression]`` accepts expressions of time, coordinates, speeds, accelerations, multipliers and parameters,
    and their time derivatives.

    Attributes:
        model: the model that was integrated.
        parameters: the values of the parameters.
        t: the instants, shape (N,). If the motion ended between two of them, its end is the last one.
        states: coordinates, then speeds, shape (N, n).
        work: the work of loads and moving constraints since the first instant, in J, shape (N,); zero if nothing does
            work, NaN if the method does not integrate it.
        events: the events that occurred, in order of time.
        statistics: the cost of the integration.
        completed: whether the motion reached the last instant or a terminal event.
        message: why the motion ended.
        output_expressions: the expressions of `outputs`, by name.
        by: the parameters and initial values by which the motion was differentiated.
        slopes: the derivatives of the state by these, S, shape (N, n, k); None without `sensitivities`.

    >>> import symbody as sb
    >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
    >>> cart = sb.Body(sb.translate(x, 0, 0), m)
    >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
    >>> motion = sb.simulate(oscillator, {m: 1, k: 4}, {x: 0.1}, t=(0, 1))
    >>> motion.t.shape, motion.states.shape
    ((1001,), (1001, 2))
    >>> round(float(motion[x][-1] / 0.1 - np.cos(2)), 9) + 0.0
    0.0
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
    by: tuple[Expr, ...] = ()
    slopes: Array | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        names = ", ".join(map(str, self.model.coordinates))
        instants = f"{counted(len(self.t), 'instant')} from {self.t[0]:g} to {self.t[-1]:g} s"
        return f"Motion of {names}: {instants}, {self.message}"

    def _repr_html_(self) -> str:
        return range_table(str(self), "state", zip(self.model.state, self.states.T, strict=True))

    def __len__(self) -> int:
        """Return how many instants there are."""
        return len(self.t)

    @property
    def system(self) -> Variables:
        """The system that moves."""
        return self.model.system

    def __iter__(self) -> NoReturn:
        """Refuse to iterate: Python would ask for ``motion[0]``, ``motion[1]`` and so on."""
        _READING.refuse_iteration()

    def __getitem__(self, expression: Expr | Freedom) -> Array:
        """Return the values of an expression, shape (N,).

        A freedom of a joint, ``motion[mechanism.joint("C").freedom()]``, is its value, and an angle among them goes
        over pi without a jump.

        Raises:
            ArgumentError: the argument is not an expression, or is a number.
            SimulationError: the expression contains a variable that the model does not know.
            ParameterError: a parameter that is not in the equations has no value.
        """
        if isinstance(expression, Freedom):
            return values_along(expression, self.t, self.evaluate)
        if isinstance(expression, str) and expression in self.output_expressions:
            raise ArgumentError(
                f"motion[...]: {expression!r} is the name of an output; expected motion.outputs[{expression!r}]"
            )
        expression = _READING.one_expression(expression, self.model.state)
        if expression in self.model.state:
            return self.states[:, self.model.state.index(expression)]
        values: Array = self.evaluate([expression])[0]
        return values

    @cached_property
    def at_events(self) -> Motion:
        """The motion at the instants of its events alone: ``motion.at_events[expression]`` has a value for each.

        So accelerations, multipliers and reactions are known there, just before what the event stands for.

        Raises:
            SimulationError: no event occurred.

        >>> import symbody as sb
        >>> z = sb.functions_of_time("z")
        >>> weight = sb.Vector(sb.ground, 0, 0, -10)
        >>> ball = sb.System([sb.Body(sb.translate(0, 0, z), 2)], coordinates=[z], gravity=weight)
        >>> landing = sb.Event(z, direction=-1, terminal=True)
        >>> motion = sb.simulate(sb.newton_euler(ball), {}, {z: 5}, t=(0, 2), events=[landing])
        >>> motion.at_events[z.diff(sb.t)].round(6).tolist(), motion.at_events[z.diff(sb.t, 2)].tolist()
        ([-10.0], [-10.0])
        """
        if not self.events:
            raise SimulationError(
                "motion.at_events: no event occurred; expected one at least, see motion.events"
            )
        states = np.array([[at.state[name] for name in self.model.state] for at in self.events])
        slopes = [at.sensitivities for at in self.events if at.sensitivities is not None]
        return replace(
            self,
            t=np.array([at.t for at in self.events]),
            states=states,
            work=np.full(len(states), 0.0 if self.model.power is None else np.nan),
            slopes=np.array(slopes) if slopes else None,
        )

    @with_known_names
    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, one row for each: shape (expressions, N).

        Raises:
            ArgumentError: the argument is not a list of expressions.
            SimulationError: an expression contains a variable that the model does not know.
            ParameterError: a parameter that is not in the equations has no value.
        """
        wanted = _READING.several_expressions(expressions)
        if not wanted:
            return np.empty((0, len(self.t)))
        known = self.model.unknowns_in(wanted)
        return self._values(wanted, known, [self._solved_for(name) for name in known])

    def _values(self, wanted: Sequence[Expr], known: tuple[Expr, ...], columns: Sequence[Array]) -> Array:
        """Return the values of expressions, given the values of accelerations and multipliers in them."""
        try:
            function = self.model.function(wanted, tuple(self.parameters), known)
        except SymbodyError as failure:
            explain_unknown("motion", wanted, self.model, self.parameters)
            raise SimulationError(f"motion: {failure}") from failure
        values = function(self.t, *self.states.T, *columns, *self.parameters.values())
        return np.stack([np.broadcast_to(row, self.t.shape) for row in values])

    def _solved_for(self, unknown: Expr) -> Array:
        """Return the values of an acceleration or a multiplier; the first call computes all of them."""
        if unknown in self.model.accelerations:
            return self.accelerations[:, self.model.accelerations.index(unknown)]
        return self._solved_multipliers[:, self.model.multipliers.index(unknown)]

    @with_known_names
    def sensitivity(self, expression: Expr, by: Expr) -> Array:
        """Return the derivative of an expression by a parameter, or by an initial value, at all instants: shape (N,).

        ``de/dp = e_x S + e_p`` with ``S = dx/dp`` at a fixed time [Hairer, Norsett & Wanner 1993, I.14].

        Args:
            expression: an expression of the model, as in ``motion[expression]``.
            by: one of the `sensitivities` of `simulate`.

        Raises:
            ParameterError: the motion was not differentiated by it.
            ArgumentError: the argument is not an expression.
            SimulationError: the expression contains a variable that the model does not know.

        >>> import symbody as sb
        >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
        >>> cart = sb.Body(sb.translate(x, 0, 0), m)
        >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
        >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
        >>> motion = sb.simulate(oscillator, {m: 1, k: 4}, {x: 0.1}, t=(0, 1), sensitivities=[k, x])
        >>> round(float(motion.sensitivity(x, by=k)[-1] + 0.1 * np.sin(2) / 4), 9) + 0.0
        0.0
        >>> round(float(motion.sensitivity(x, by=x)[-1] - np.cos(2)), 8) + 0.0
        0.0
        """
        wanted = _READING.one_expression(expression, self.model.state)
        return self._differentiated.sensitivity(wanted, by)

    @with_known_names
    def instant_sensitivity(self, occurrence: Occurrence, by: Expr) -> float:
        """Return the derivative of the instant of an event by a parameter, or by an initial value, in s per its unit.

        ``dt/dp = -(g_x S + g_p) / (dg/dt)`` at the zero of the event's expression g.

        Args:
            occurrence: one of `events`.
            by: one of the `sensitivities` of `simulate`.

        Raises:
            ParameterError: the motion was not differentiated by it.
            ArgumentError: it is not an event of this motion.
            SimulationError: the expression of the event only touches zero.

        >>> import symbody as sb
        >>> x = sb.functions_of_time("x")
        >>> v = sb.time_derivative(x)
        >>> body = sb.newton_euler(sb.System([sb.Body(sb.translate(x, 0, 0), 1)], coordinates=[x]))
        >>> motion = sb.simulate(body, {}, {v: 2}, t=(0, 1), events=[sb.Event(x - 1)], sensitivities=[v])
        >>> round(motion.instant_sensitivity(motion.events[0], by=v), 9)
        -0.25
        """
        return self._differentiated.instant_sensitivity(occurrence, by)

    @property
    def _differentiated(self) -> DifferentiatedMotion:
        return DifferentiatedMotion(self.model, self.parameters, self.by, self.t, self.states, self.slopes)

    @cached_property
    def outputs(self) -> dict[str, Array]:
        """The values of the outputs, by name; each has the shape (N,)."""
        return dict(
            zip(self.output_expressions, self.evaluate(list(self.output_expressions.values())), strict=True)
        )

    @cached_property
    def accelerations(self) -> Array:
        """The rates of the speeds, one row for each instant."""
        return accelerations_along(self.model, self.parameters, self.t, self.states)

    @cached_property
    def multipliers(self) -> Array:
        """The multipliers of the constraints, one row for each instant: ``M u' = forcing + phi_q^T lambda``.

        If constraints are redundant, so that many multipliers balance the loads, those of minimum norm.
        """
        return (
            self.evaluate(self.system.whole.multipliers).T
            if self.system.left_out
            else self._solved_multipliers
        )

    @cached_property
    def _solved_multipliers(self) -> Array:
        """Those of the constraints that the simulation keeps, if they act alone."""
        model = self.model
        return self._values(model.multipliers, (), ()).T if model.multipliers else np.empty((len(self.t), 0))

    @with_known_names
    def state_at(self, instant: int = -1) -> dict[Expr, float]:
        """Return the coordinates and speeds at one instant, as an initial state for another simulation.

        Args:
            instant: the index of the instant, from 0; negative ones count from the last.

        Raises:
            ArgumentError: there is no such instant.
        """
        count = len(self.t)
        if not hasattr(instant, "__index__") or not -count <= instant < count:
            raise ArgumentError(
                f"motion.state_at: {described(instant)}; expected the index of one of the {count} instants, from 0"
            )
        return dict(zip(self.model.state, map(float, self.states[instant]), strict=True))

    @cached_property
    def energy(self) -> Array:
        """The mechanical energy less the work of loads and moving constraints: constant but for errors. Shape (N,).

        Raises:
            ModelError: prescribed motions of frames do work that the equations do not contain.
            ParameterError: a mass or an inertia that is not in the equations has no value.
        """
        model = self.model
        if np.isnan(self.work).any():
            unable = methods_that(lambda method: not method.integrates_work)
            raise ModelError(
                f"motion: loads do work, which the methods {joined_by_and(unable)} don't integrate; use another method"
            )
        energies = model.energies
        if not energies:
            raise ModelError(
                "motion: the energy isn't known: the equations were given without bodies; give it to them, as in "
                "equations_of(M, f, coordinates, energy=E)"
            )
        if model.prescribed:
            raise ModelError(
                f"motion: frames move by {', '.join(model.prescribed)}, a prescribed motion, and the equations don't "
                "contain the work of its drive: the energy isn't constant; prescribe it by a constraint, whose work is "
                "counted"
            )
        if model.is_driven:
            raise ModelError(
                "motion: the bodies move while all speeds are zero, as a moving frame, the kinematics or an eliminated "
                "constraint prescribe, and the equations don't contain the work of this drive: the energy isn't "
                "constant; prescribe the motion by a constraint with a multiplier, whose work is counted"
            )
        total: Array = self.evaluate(energies).sum(axis=0) - self.work
        return total

    @cached_property
    def energy_drift(self) -> float:
        """The largest change of the energy balance, relative to the largest energy that varies.

        ``max |E - W - E0| / max(T, |V - V0|, |W|)``: T is the kinetic energy, V the potential energy, W the work. A
        change within the rounding of E is zero, as of a system that stays at rest.
        """
        total = self.energy + self.work
        kinetic = self.evaluate(self.model.energies[:1])[0]
        potential = total - kinetic
        parts = [kinetic, potential - potential[0], self.work]
        scale = max(float(np.abs(part).max()) for part in parts)
        change = float(np.abs(self.energy - self.energy[0]).max())
        if change <= _ROUNDING * float(np.abs(total).max()):
            return 0.0
        return change / scale if scale else change

    @cached_property
    def constraint_drift(self) -> float:
        """The largest violation of a constraint: of positions, and of velocities where it is on these.

        Constraints that were eliminated, or left out as redundant, count as well.
        """
        return self._largest(self.system.whole.constraints)

    @cached_property
    def constraint_rate_drift(self) -> float:
        """The largest rate of change of a constraint on positions, or violation of one on velocities."""
        system = self.system.whole
        return self._largest(system.velocity_level(system.constraints))

    def _largest(self, expressions: Sequence[Expr]) -> float:
        return float(np.abs(self.evaluate(expressions)).max()) if expressions else 0.0

    @with_known_names
    def plot(
        self,
        *panels: Any,
        units: Mapping[Expr | str, str] | None = None,
        time: str = "s",
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return a figure over time, with one panel for each argument; by default, of coordinates and speeds.

        Args:
            panels: what to plot; see `symbody.view.plot`, also for the errors.
            units: the units of expressions or of panels, for the labels.
            time: the unit of time, for the label.
            title: the title of the figure.
            path: a file to save the figure in.
        """
        figure: Figure = drawing_function("plot")(
            self, *panels, units=units, time=time, title=title, path=path
        )
        return figure

    @overload
    def animate(self, path: None = ..., **options: Any) -> NotebookPage: ...

    @overload
    def animate(self, path: str | os.PathLike[str], **options: Any) -> Path: ...

    def animate(self, path: str | os.PathLike[str] | None = None, **options: Any) -> Path | NotebookPage:
        """Return the motion as a page that a notebook shows; with a path, write it as a page for a browser.

        Args:
            path: the file of the page, such as ``"motion.html"``.
            options: what to draw; see `symbody.view.animate`, also for the errors.
        """
        page: Path | NotebookPage = drawing_function("animate")(self, path, **options)
        return page
