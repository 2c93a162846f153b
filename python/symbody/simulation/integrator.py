"""The native integrator: compiled equations in, states out; no Python in its loop."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode
from symbody.symbolic import Expr
from symbody.symbolic._core import Dynamics
from symbody.symbolic.deficiency import Deficiency, deficiencies_of, noting

from .asked import parameters_in
from .event import Event
from .model import Model

__all__ = [
    "EXPLICIT",
    "IMPLICIT",
    "Failure",
    "Options",
    "Outcome",
    "Problem",
    "Statistics",
    "run",
    "run_many",
    "trail_of",
]

EXPLICIT = ("dop853", "tsit5")
IMPLICIT = ("bdf", "esdirk34", "tr_bdf2")

TRAIL = 2**14
"""States at the ends of steps that are kept, where somebody looks at them."""


@dataclass(frozen=True)
class Options:
    """How to integrate.

    Attributes:
        method: one of EXPLICIT and IMPLICIT.
        rtol: the error of a step relative to the state.
        atol: the error of a step where the state is small.
        max_step: the longest step, in s.
    """

    method: str = "dop853"
    rtol: float = 1e-8
    atol: float = 1e-10
    max_step: float = inf


@dataclass(frozen=True)
class Statistics:
    """What an integration took: steps, steps tried again, evaluations; and whether the equations look stiff.

    IDA doesn't tell its steps: they are zero.
    """

    steps: int
    rejected: int
    evaluations: int
    jacobians: int
    is_stiff: bool


@dataclass(frozen=True)
class Failure:
    """Why a motion ended early: a word for the kind, the instant up to which it is known, and a sentence."""

    kind: str
    t: float
    message: str


@dataclass(frozen=True, eq=False)
class Outcome:
    """How an integration went.

    Attributes:
        states: the states at the instants that were reached, a row for each.
        occurrences: the number of an event, when it happened, and the state there.
        end: where the motion ended.
        failure: why it ended early, other than by an event.
        statistics: what it took.
        deficiencies: the linear systems without a unique solution that it met.
        imbalance: since when, and by which part of the largest energy that moves, the balance of energy was off; None
            where the errors of the steps explain what is off, or nobody knows the energy.
        trail: rows of the instant and the state at the ends of steps; empty where the integrator itself keeps a motion
            on the branch of its constraints.
        uncertain: when the integrator first took a step although it could not make sure of that.
    """

    states: NDArray[np.float64]
    occurrences: list[tuple[int, float, list[float]]]
    end: tuple[float, list[float]]
    failure: Failure | None
    statistics: Statistics
    deficiencies: frozenset[Deficiency] = frozenset()
    imbalance: tuple[float, float] | None = None
    trail: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 1)))
    uncertain: float | None = None


@dataclass(frozen=True, eq=False)
class Problem:
    """The compiled functions of an integration.

    Attributes:
        width: the length of the integrated vector.
        controlled: how many of its entries count for the error.
        rates: the rates of the vector.
        jacobian: their derivatives that aren't zero, with rows and columns; for implicit methods.
        corrections: the ways back onto the constraints, of coordinates and of speeds; none without projection.
        energies: the kinetic and the potential energy; none where their sum isn't constant.
        events: functions whose zeros are events, and the events.
        trail: how many states at the ends of steps are kept at most, of each motion; of longer ones every second or
            fourth state, and so on.
    """

    width: int
    controlled: int
    rates: PreparedCode
    jacobian: tuple[PreparedCode, list[tuple[int, int]]] | None = None
    corrections: tuple[PreparedCode, PreparedCode] | None = None
    energies: PreparedCode | None = None
    events: tuple[PreparedCode, tuple[Event, ...]] | None = None
    trail: int = 0

    @classmethod
    def of(
        cls,
        model: Model,
        method: str,
        *,
        is_projected: bool,
        events: Sequence[Event] = (),
    ) -> Problem:
        """Return what integrates a model: no derivatives for explicit methods, no corrections without constraints."""
        watched = model.along_motion([event.expression for event in events])
        others = [name for name in parameters_in(watched) if name not in (*model.parameters, *model.damping)]
        code = model.code(watched, others) if events else None
        return cls(
            width=model.width,
            controlled=len(model.state),
            rates=model.rates_code,
            jacobian=model.jacobian_code if method in IMPLICIT else None,
            corrections=model.correction_codes if is_projected and model.constraints else None,
            energies=model.energies_code,
            events=None if code is None else (code, tuple(events)),
            trail=trail_of(model, method, is_projected=is_projected),
        )

    @property
    def codes(self) -> list[PreparedCode]:
        """All functions, in the order in which their constants stand."""
        jacobian = [] if self.jacobian is None else [self.jacobian[0]]
        events = [] if self.events is None else [self.events[0]]
        energies = [] if self.energies is None else [self.energies]
        return [self.rates, *jacobian, *(self.corrections or ()), *energies, *events]

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """What needs values: the parameters of the rates, then those that stand in events alone."""
        return self.codes[-1].parameters

    def constants(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return what the functions need of the parameters, one after another."""
        return np.concatenate([code.prepare(parameters[: len(code.parameters)]) for code in self.codes])

    @cached_property
    def native(self) -> Dynamics:
        """The functions, by their addresses."""
        positions, velocities = self.corrections or (None, None)
        return Dynamics(
            _code(self.rates),
            None if self.jacobian is None else (_code(self.jacobian[0]), self.jacobian[1]),
            None if positions is None else _code(positions),
            None if velocities is None else _code(velocities),
            None if self.energies is None else _code(self.energies),
            None
            if self.events is None
            else (_code(self.events[0]), [(event.direction, event.terminal) for event in self.events[1]]),
        )


def trail_of(model: Model, method: str, *, is_projected: bool) -> int:
    """Return how many states at the ends of steps are kept; none where the steps stay on the branch of the constraints.

    The explicit methods with projection choose their steps so that they do.
    """
    return TRAIL if model.constraints and not (is_projected and method in EXPLICIT) else 0


def _limits(problem: Problem, options: Options) -> tuple[float, float, float, int]:
    return options.rtol, options.atol, options.max_step, problem.controlled


def _code(code: PreparedCode) -> tuple[int, int, int]:
    return code.address, code.constants, len(code.expressions)


def run(
    problem: Problem,
    state: NDArray[np.float64],
    constants: NDArray[np.float64],
    instants: NDArray[np.float64],
    options: Options,
    keep_going: Callable[[float], bool] | None = None,
) -> Outcome:
    """Integrate from a state at the first instant through all of them, with the constants of the parameters."""
    states = np.empty((len(instants), problem.width))
    told = problem.native.integrate(
        options.method,
        np.ascontiguousarray(state, float),
        constants,
        np.ascontiguousarray(instants, float),
        _limits(problem, options),
        states,
        problem.trail,
        keep_going,
    )
    return _outcome(told, states)


def run_many(
    problem: Problem,
    states: NDArray[np.float64],
    parameters: NDArray[np.float64],
    instants: NDArray[np.float64],
    options: Options,
    threads: int = 1,
    keep_going: Callable[[float], bool] | None = None,
) -> list[Outcome | None]:
    """Integrate many motions, a row of states and of parameters for each, in threads outside the interpreter.

    What was not begun when `keep_going` said no is None.
    """
    results = np.full((len(states), len(instants), problem.width), np.nan)
    different, places = np.unique(parameters, axis=0, return_inverse=True)
    prepared = [_prepared(problem, row) for row in different]
    constants = np.array([values for values, _ in prepared])[places]
    told = problem.native.integrate_many(
        options.method,
        np.ascontiguousarray(states, float),
        np.ascontiguousarray(constants),
        np.ascontiguousarray(instants, float),
        _limits(problem, options),
        results,
        problem.trail,
        threads,
        keep_going,
    )
    return [
        None if one is None else _outcome(one[0], rows, prepared[place][1] | deficiencies_of(one[1]))
        for one, rows, place in zip(told, results, places, strict=True)
    ]


def _prepared(
    problem: Problem, parameters: NDArray[np.float64]
) -> tuple[NDArray[np.float64], set[Deficiency]]:
    """Return the constants, and the linear systems of parameters alone that have no unique solution."""
    with noting() as found:
        constants = problem.constants(parameters)
    return constants, found


_Told = tuple[
    int,
    list[tuple[int, float, list[float]]],
    tuple[float, list[float]],
    tuple[str, float, str] | None,
    tuple[int, int, int, int, bool],
    tuple[float, float] | None,
    bytes,
    float | None,
]


def _outcome(told: _Told, states: NDArray[np.float64], deficiencies: Iterable[Deficiency] = ()) -> Outcome:
    reached, occurrences, end, failure, statistics, imbalance, trail, uncertain = told
    return Outcome(
        states[:reached],
        occurrences,
        end,
        None if failure is None else Failure(*failure),
        Statistics(*statistics),
        frozenset(deficiencies),
        imbalance,
        np.frombuffer(trail).reshape(-1, 1 + states.shape[1]),
        uncertain,
    )
