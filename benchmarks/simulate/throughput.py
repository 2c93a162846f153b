"""Throughput: many motions of a system, by what a user would write with each tool, at equal accuracy."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from statistics import median
from time import perf_counter, process_time
from types import ModuleType

import numpy as np

from symbody import simulate, simulate_many
from symbody.simulation.batch import run_cases
from symbody.simulation.given.options import Options
from symbody.simulation.integrate import native as native_integrator
from symbody.simulation.integrate.native import problem_of, run_many

from . import by_scipy
from .problem import Array, Problem

TOLERANCES = tuple(float(f"{digit}e-{k}") for k in range(6, 14) for digit in (63, 40, 25, 16, 10))
"""The tolerances to try: a method of order 5 takes a tenth more steps from one to the next, as settings of steps do."""

FINER = 1.1
"""The number of equal steps is increased by this factor."""

WITHOUT_LANES = "one motion at a time: simulate_many"

ONE_BY_ONE = "initial states and motions one by one: simulate_many"

Many = Callable[[Array, float], Array]
"""Takes a row for each initial state and a setting; returns a row for each end."""


@dataclass(frozen=True)
class Manner:
    """A way to run many motions.

    Attributes:
        label: what the report calls it.
        many: runs them.
        settings: what to try until it is accurate enough, the fastest first.
        unit: what the setting is.
        is_loop: whether it runs one after another in Python; some of the motions tell the time of a loop.
    """

    label: str
    many: Many
    settings: tuple[float, ...]
    unit: str = "tolerance"
    is_loop: bool = False


@dataclass
class Rate:
    """How fast a manner is.

    Attributes:
        manner: which one.
        setting: the first one that was accurate enough.
        error: the largest difference of an angle at the end, in rad.
        runs: how many motions were run.
        first: seconds of the first run with this setting, in which what is compiled is compiled.
        times: seconds by the clock on the wall, of each round.
        work: seconds of all threads' processors, of each round.
    """

    manner: Manner
    setting: float
    error: float
    runs: int
    first: float
    times: list[float] = field(default_factory=list)
    work: list[float] = field(default_factory=list)

    @property
    def per_second(self) -> float:
        """Motions in a second: the median."""
        return self.runs / median(self.times)


@dataclass(frozen=True)
class Batch:
    """Many motions of a system, and the ways to run them.

    Attributes:
        problem: the system.
        states: the initial states, a row each.
        manners: the ways; the first one is symbody's.
        error: what each contender may miss at the end, in rad or in lengths.
        text: what the report says of the motions.
        missing: rivals for this system that are not installed; the empty text if all are there.
    """

    problem: Problem
    states: Array
    manners: tuple[Manner, ...]
    error: float
    text: str
    missing: str = ""


@dataclass(frozen=True)
class Throughput:
    """What was measured of many motions: the rates, and how far the reference is from SciPy's."""

    batch: Batch
    rates: tuple[Rate, ...]
    check: float


def measured(batch: Batch, sample: int, rounds: int) -> Throughput:
    """Return the rates of all manners over all motions; of loops over a sample of them."""
    problem, states, n = batch.problem, batch.states, batch.problem.size
    ends = batch.manners[0].many(states, 1e-13)[:, :n]
    some = np.random.default_rng(7).choice(len(states), min(sample, len(states)), replace=False)
    few = some[:3]
    by_radau = solve_ivp(problem, "Radau").many(states[few], 1e-11)
    check = float(np.abs(by_radau[:, :n] - ends[few]).max())
    found = []
    for manner in batch.manners:
        chosen = some if manner.is_loop else np.arange(len(states))
        found.append((_tuned(manner, states[chosen], ends[chosen], batch.error), states[chosen]))
        print(".", end="", file=sys.stderr, flush=True)
    for _ in range(rounds):
        for rate, own in found:
            wall, work = perf_counter(), process_time()
            rate.manner.many(own, rate.setting)
            rate.times.append(perf_counter() - wall)
            rate.work.append(process_time() - work)
    print(f" many motions: {problem.name}", file=sys.stderr)
    return Throughput(batch, tuple(rate for rate, _ in found), check)


def _tuned(manner: Manner, states: Array, ends: Array, bound: float) -> Rate:
    """Return a manner with the first setting whose ends are close enough."""
    for setting in manner.settings:
        begin = perf_counter()
        found = manner.many(states, setting)
        first = perf_counter() - begin
        error = float(np.abs(found[:, : ends.shape[1]] - ends).max())
        if error <= bound:
            return Rate(manner, setting, error, len(states), first)
    raise RuntimeError(f"{manner.label}: no setting reaches an error of {bound}")


def _instants(problem: Problem) -> Array:
    """Return the first, the last and a middle instant: a pair would mean a thousand."""
    return np.linspace(0, problem.duration, 3)


def by_simulate_many(problem: Problem, *, given: int | None = None) -> list[Manner]:
    """Return `simulate_many` by both explicit methods, in one thread and two.

    Args:
        problem: the system.
        given: how many coordinates are given, if the others follow from constraints; all states by default.
    """
    return [
        Manner(f"symbody, simulate_many, {method}, {threads} thread{'s' * (threads > 1)}", many, TOLERANCES)
        for method in ("dop853", "tsit5")
        for threads in (1, 2)
        for many in [partial(_simulate_many, problem, method, threads, given)]
    ]


def solve_ivp(problem: Problem, method: str) -> Manner:
    """Return a loop of solve_ivp."""
    functions = by_scipy.rates(problem), by_scipy.jacobian(problem)
    many = partial(_solve_ivp, problem, method, *functions)
    return Manner(f"Python loop of solve_ivp, {method}", many, TOLERANCES, is_loop=True)


def loop_of_simulate(problem: Problem) -> Manner:
    """Return a loop of `simulate`."""
    return Manner("Python loop of simulate", partial(_simulate, problem), TOLERANCES, is_loop=True)


def one_at_a_time(problem: Problem, *, given: int | None = None) -> list[Manner]:
    """Return `simulate_many` as it is without lanes, which is what their gain is measured by.

    Args:
        problem: the system.
        given: how many coordinates are given, as in `by_simulate_many`.
    """
    return [
        Manner(f"{WITHOUT_LANES}, dop853, {threads} thread{'s' * (threads > 1)}", many, TOLERANCES)
        for threads in (1, 2)
        for many in [_changed(partial(_simulate_many, problem, "dop853", threads, given), WITHOUT)]
    ]


def one_by_one(problem: Problem, *, given: int) -> Manner:
    """Return `simulate_many` that also solves for one initial state after another.

    Args:
        problem: the system.
        given: how many coordinates are given, as in `by_simulate_many`.
    """
    many = _changed(partial(_simulate_many, problem, "dop853", 1, given), {**WITHOUT, **UNKNOWN})
    return Manner(f"{ONE_BY_ONE}, dop853, 1 thread", many, TOLERANCES, is_loop=True)


WITHOUT: dict[tuple[ModuleType, str], object] = {(native_integrator, "WORTH_LANES"): sys.maxsize}
"""What runs motions without lanes."""

UNKNOWN: dict[tuple[ModuleType, str], object] = {
    (run_cases, "_initial_states"): lambda task, cases, _: np.full((cases.count, task.model.width), np.nan)
}
"""What leaves each initial state to the solver for one motion."""


def _changed(many: Many, values: Mapping[tuple[ModuleType, str], object]) -> Many:
    """Return a way to run motions with other values of some names of modules."""

    def run(states: Array, tolerance: float) -> Array:
        before = {(module, name): getattr(module, name) for module, name in values}
        try:
            for (module, name), value in values.items():
                setattr(module, name, value)
            return many(states, tolerance)
        finally:
            for (module, name), value in before.items():
                setattr(module, name, value)

    return run


def native(problem: Problem) -> list[Manner]:
    """Return the integration alone, of whole states with one set of parameters: in lanes, and one motion at a time."""
    many = _native(problem)
    return [
        Manner("of which the native integrator, dop853, 1 thread", many, TOLERANCES),
        Manner(
            "one motion at a time: the native integrator, dop853, 1 thread",
            _changed(many, WITHOUT),
            TOLERANCES,
        ),
    ]


def _simulate_many(
    problem: Problem, method: str, threads: int, given: int | None, states: Array, tolerance: float
) -> Array:
    names, count = problem.model.state, len(problem.model.state) if given is None else given
    runs = simulate_many(
        problem.equations,
        problem.parameters,
        dict(zip(names[:count], states.T[:count], strict=True)),
        _instants(problem),
        method=method,
        guess=dict(problem.initial) if count < len(names) else None,
        rtol=tolerance,
        atol=tolerance,
        threads=threads,
        progress=False,
    )
    return np.asarray(runs.states[:, -1])


def _native(problem: Problem) -> Many:
    """Return the integration alone, with one set of parameters."""
    compiled = problem_of(problem.model, is_projected=True)

    def many(states: Array, tolerance: float) -> Array:
        options = Options("dop853", tolerance, tolerance)
        parameters = np.broadcast_to(problem.values, (len(states), len(problem.values)))
        starts = np.pad(
            states, ((0, 0), (0, compiled.width - states.shape[1]))
        )  # no work is done at the start
        return run_many(compiled, starts, parameters, _instants(problem), options, 1).states[:, -1]

    return many


def _simulate(problem: Problem, states: Array, tolerance: float) -> Array:
    names, t = problem.model.state, _instants(problem)
    motions = (
        simulate(
            problem.equations,
            problem.parameters,
            dict(zip(names, map(float, state), strict=True)),
            t,
            rtol=tolerance,
            atol=tolerance,
            progress=False,
        )
        for state in states
    )
    return np.stack([motion.states[-1] for motion in motions])


def _solve_ivp(
    problem: Problem,
    method: str,
    rates: by_scipy.Function,
    jacobian: by_scipy.Function,
    states: Array,
    tolerance: float,
) -> Array:
    given = (problem.duration, method, rates, jacobian, tolerance)
    return np.stack([by_scipy.integrated(state, *given) for state in states])
