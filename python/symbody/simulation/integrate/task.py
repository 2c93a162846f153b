"""A task: motions that differ in nothing but their numbers, and the method that integrates them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.event import Event
from symbody.simulation.given.options import Options
from symbody.simulation.model.model import DAMPING, Model, without_stabilization
from symbody.symbolic import Expr

from .baumgarte_damping import chosen_damping
from .observed import parameters_in
from .outcome import Outcome

__all__ = ["Columns", "Integrate", "KeepGoing", "Method", "Task"]

Array = NDArray[np.float64]

Columns = Mapping[Expr, Array]
"""Values of parameters by name, one for each motion."""

KeepGoing = Callable[[float], bool]
"""Asked now and then whether to go on, with the number of motions that are done: of one alone, the part of its time."""

Integrate = Callable[[Columns, Array, int, KeepGoing], Iterable[Outcome | None]]
"""Takes the parameters and the first states of motions, the number of threads, and whom to ask whether to go on; gives
how the integration of each motion went, None where it was not begun."""

TRAIL = 2**14
"""States at the ends of steps that are kept, where somebody looks at them."""


@dataclass(frozen=True)
class Method:
    """A method of integration.

    Attributes:
        prepare: derives and compiles what the method needs of a task, and returns what integrates its motions.
        is_explicit: whether it is an explicit method: stiff equations make its steps short, and with projection they
            stay on the branch of the constraints.
    """

    prepare: Callable[[Task], Integrate]
    is_explicit: bool = False


@dataclass(frozen=True, eq=False)
class Task:
    """What to integrate, how, and what to read out of the motions: made once, for one motion or many.

    Attributes:
        model: what moves.
        instants: when its states are asked for.
        options: the method by name, its tolerances and its longest step.
        method: the method.
        constraints: how constraints are kept; see `simulate`.
        outputs: expressions to evaluate at all instants, by name.
        events: what to look for.
        guess: where to look for the initial states of constrained systems.
        keeps_states: whether the states of many motions are results, or only the outputs.
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

    def __getstate__(self) -> dict[str, Any]:
        """Leave behind what is compiled, which is of this process."""
        return {name: value for name, value in self.__dict__.items() if name in self.__dataclass_fields__}

    @cached_property
    def integrate(self) -> Integrate:
        """What integrates its motions; derived and compiled when it is first asked for."""
        return self.method.prepare(self)

    @property
    def observed(self) -> list[Expr]:
        """What is evaluated along the motions beside their states: outputs and events."""
        return [*self.outputs.values(), *(event.expression for event in self.events)]

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values: those of the model, then those of outputs and events."""
        return (*self.model.parameters, *parameters_in(self.observed))

    @property
    def is_projected(self) -> bool:
        """Whether states are put back onto the constraints after each step."""
        return self.constraints == "projection"

    @property
    def trail(self) -> int:
        """How many states at the ends of steps are kept of a motion, at most; none where steps stay on the branch."""
        stays = self.is_projected and self.method.is_explicit
        return TRAIL if self.model.constraints and not stays else 0

    @cached_property
    def unstabilized(self) -> Model:
        """What moves, without Baumgarte's stabilisation."""
        return without_stabilization(self.model)

    def damping_of(self, parameters: Mapping[Expr, float], state: Array) -> dict[Expr, float]:
        """Return the frequency and the damping ratio with which violations of constraints die out, if they do.

        Args:
            parameters: those of a motion.
            state: where it begins.
        """
        if not self.model.is_stabilized:
            return {}
        damping = self.constraints
        if isinstance(damping, str):
            values = np.array([parameters[name] for name in self.unstabilized.parameters])
            damping = chosen_damping(self.unstabilized, values, state, self.instants)
        return dict(zip(DAMPING, damping, strict=True))

    def values(
        self, expressions: list[Expr], states: Array, instants: Array, parameters: Mapping[Expr, float]
    ) -> Array:
        """Return the values of expressions along a motion, a row for each."""
        if not expressions:
            return np.empty((0, len(instants)))
        function = self.model.function(expressions, tuple(parameters))
        return np.asarray(function(instants, *states.T, *parameters.values()))
