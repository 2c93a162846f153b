"""A task: the method and the model of motions that differ only in their numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.redundant_constraints import Redundancy
from symbody.simulation.given.event import Event
from symbody.simulation.given.options import Options
from symbody.simulation.given.parameter import parameters_in
from symbody.simulation.integrate.baumgarte_parameters import chosen_damping
from symbody.simulation.model.model import DAMPING, Model, without_stabilization
from symbody.simulation.model.variation import Variation, variation_of
from symbody.symbolic import Expr

from .outcome import Outcome

__all__ = ["Columns", "Integrate", "KeepGoing", "Method", "Task"]

Array = NDArray[np.float64]

Columns = Mapping[Expr, Array]
"""Values of parameters by name, one for each motion: arrays of shape (k,)."""

KeepGoing = Callable[[float], bool]
"""Called before each motion and from time to time within it, for progress and Ctrl-C. Its argument is the number of
motions that are done; a motion in progress counts by the part of its duration that is done, if that is known. If it
returns False, the motions in progress end as `FailureKind.INTERRUPTED`, and no other is started."""

Integrate = Callable[[Columns, Array, int, KeepGoing], Iterable[Outcome | None]]
"""Integrates motions. Its arguments are the parameters, the initial states, the number of threads, and `KeepGoing`; it
yields the outcome of each motion, None for those that were not started."""

TRAIL = 2**14
"""The most states at the ends of steps that are kept, if they are needed."""


@dataclass(frozen=True)
class Method:
    """A method of integration, and what it can do. A task that needs more of it is refused.

    Attributes:
        prepare: derives and compiles what the method needs, and returns the function that integrates the motions.
        is_explicit: whether the method is explicit, so that stiff equations limit its steps.
        keeps_branch: whether the method keeps a motion on its branch of the constraints, if it projects.
        enforces_constraints: whether the method enforces constraints by itself: with constraints="projection", by
            projection or in another way. Baumgarte's stabilisation is part of the rates, and needs nothing of a method.
        locates_events: whether the method finds the events of the task, and ends at terminal ones.
        integrates_work: whether the states of the outcome contain the work of loads, where the model has it.
        integrates_sensitivities: whether the method integrates the derivatives of the state by parameters.
    """

    prepare: Callable[[Task], Integrate]
    is_explicit: bool = False
    keeps_branch: bool = False
    enforces_constraints: bool = False
    locates_events: bool = False
    integrates_work: bool = False
    integrates_sensitivities: bool = False


@dataclass(frozen=True, eq=False)
class Task:
    """What to integrate, how, and what to evaluate along the motions; made once, for one motion or many.

    Attributes:
        model: the model.
        instants: the instants of the results, shape (N,), in s.
        options: the method by name, its tolerances and its longest step.
        method: the method.
        constraints: how constraints are enforced; see `simulate`.
        outputs: expressions to evaluate at all instants, by name.
        events: the events to watch.
        guess: where to look for initial states that satisfy the constraints.
        keeps_states: whether the states of many motions are results, or only the outputs.
        redundancy: the constraints that are redundant where the mechanism moves, if the model is without these.
        by: the parameters and initial values by which the state is differentiated.
        device: the device that integrates many motions, by name; None for threads of this process.
    """

    model: Model
    instants: Array
    options: Options
    method: Method
    constraints: str | tuple[float, float]
    outputs: Mapping[str, Expr]
    events: tuple[Event, ...]
    guess: Mapping[Expr, float]
    keeps_states: bool = True
    redundancy: Redundancy | None = None
    by: tuple[Expr, ...] = ()
    device: str | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Drop what is compiled: it belongs to this process."""
        return {name: value for name, value in self.__dict__.items() if name in self.__dataclass_fields__}

    @cached_property
    def integrate(self) -> Integrate:
        """The function that integrates the motions; derived and compiled on first use."""
        return self.method.prepare(self)

    @property
    def observed(self) -> list[Expr]:
        """The expressions that are evaluated along the motions beside their states: outputs and events."""
        return [*self.outputs.values(), *(event.expression for event in self.events)]

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values: those of the model, then those of outputs and events."""
        return (*self.model.parameters, *parameters_in(self.observed))

    @property
    def variation(self) -> Variation | None:
        """The equations of the sensitivities; None if none are asked for."""
        return variation_of(self.model, self.by) if self.by else None

    @property
    def is_projected(self) -> bool:
        """Whether states are projected onto the constraints after each step."""
        return self.constraints == "projection"

    @property
    def trail(self) -> int:
        """The most states at the ends of steps that are kept of a motion; 0 if none of them can be singular.

        Steps of some methods stay on the branch of the constraints. Embedded equations may be singular.
        """
        stays = self.is_projected and self.method.keeps_branch
        may_be_singular = bool(self.model.constraints) and not stays
        return TRAIL if may_be_singular or self.model.system.eliminated_constraints else 0

    @cached_property
    def unstabilized(self) -> Model:
        """The model without Baumgarte's stabilisation."""
        return without_stabilization(self.model)

    def damping_of(self, parameters: Mapping[Expr, float], state: Array) -> dict[Expr, float]:
        """Return the parameters of Baumgarte's stabilisation, omega and zeta; empty without it.

        Args:
            parameters: the parameters of a motion.
            state: its initial state; what follows is ignored, such as sensitivities.
        """
        if not self.model.is_stabilized:
            return {}
        damping = self.constraints
        if isinstance(damping, str):
            values = np.array([parameters[name] for name in self.unstabilized.parameters])
            damping = chosen_damping(
                self.unstabilized, values, state[: self.unstabilized.width], self.instants
            )
        return dict(zip(DAMPING, damping, strict=True))

    def values(
        self, expressions: list[Expr], states: Array, instants: Array, parameters: Mapping[Expr, float]
    ) -> Array:
        """Return the values of expressions along a motion, shape (expressions, N).

        Args:
            expressions: the expressions.
            states: coordinates, then speeds, shape (N, n).
            instants: the instants, shape (N,), in s.
            parameters: the values of the parameters.
        """
        if not expressions:
            return np.empty((0, len(instants)))
        function = self.model.function(expressions, tuple(parameters))
        return np.asarray(function(instants, *states.T, *parameters.values()))

    def values_of_many(
        self, expressions: list[Expr], states: Array, reached: NDArray[np.int64], parameters: Columns
    ) -> Array:
        """Return `values` along k motions, to the same digits, shape (k, expressions, N); NaN after their ends.

        Args:
            expressions: the expressions.
            states: coordinates, then speeds, shape (k, N, n).
            reached: how many instants each motion reached, shape (k,).
            parameters: the values of the parameters, one for each motion.
        """
        function = self.model.function(expressions, tuple(parameters))
        values = np.full((len(states), len(expressions), len(self.instants)), np.nan)
        for points in np.unique(reached[reached > 0]).tolist():
            own = np.flatnonzero(reached == points)
            t, case = np.tile(self.instants[:points], len(own)), np.repeat(own, points)
            at = states[own, :points].reshape(len(t), -1).T
            found = function.at_points_of(points, t, *at, *(column[case] for column in parameters.values()))
            values[own, :, :points] = np.moveaxis(np.reshape(found, (-1, len(own), points)), 0, 1)
        return values
