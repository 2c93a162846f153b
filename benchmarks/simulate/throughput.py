"""Throughput: many motions of a double pendulum, by what a user would write with each tool, at equal accuracy."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from statistics import median
from time import perf_counter, process_time

import numpy as np

from symbody import simulate, simulate_many
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.native import problem_of, run_many

from . import by_jax, by_scipy
from .problem import Array, Problem

ERROR = 1e-6
"""What each contender may miss at the end, in rad."""

ANGLES = (0.1, 0.8)
"""From where the rods are let go, in rad: small to medium swings, none of which is chaotic."""

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
class Throughput:
    """What was measured of many motions: how many, the rates, and how far the reference is from SciPy's."""

    runs: int
    duration: float
    rates: tuple[Rate, ...]
    check: float


def starts(side: int, size: int = 4) -> Array:
    """Return initial states at rest, from a square grid of angles."""
    angles = np.linspace(*ANGLES, side)
    states = np.zeros((side * side, size))
    states[:, :2] = np.stack(np.meshgrid(angles, angles, indexing="ij"), axis=-1).reshape(-1, 2)
    return states


def manners(problem: Problem) -> list[Manner]:
    """Return all ways that this machine has."""
    tolerances = tuple(float(f"{digit}e-{k}") for k in range(5, 13) for digit in (3, 1))
    found = [
        Manner(f"symbody, simulate_many, {method}, {threads} thread{'s' * (threads > 1)}", many, tolerances)
        for method in ("dop853", "tsit5")
        for threads in (1, 2)
        for many in [partial(_simulate_many, problem, method, threads)]
    ]
    found.append(Manner("of which the native integrator, dop853, 1 thread", _native(problem), tolerances))
    found.append(Manner("Python loop of simulate", partial(_simulate, problem), tolerances, is_loop=True))
    given = by_scipy.rates(problem), by_scipy.jacobian(problem)
    found += [
        Manner(
            f"Python loop of solve_ivp, {method}",
            partial(_solve_ivp, problem, method, *given),
            tolerances,
            is_loop=True,
        )
        for method in ("DOP853", "LSODA")
    ]
    if not by_jax.missing():
        steps = tuple(float(round(8 * problem.duration * 1.1**k) * 10) for k in range(12))
        found += [
            Manner("JAX, vmap of odeint", by_jax.by_odeint(problem), tolerances[4:]),
            Manner("JAX, vmap of RK4 in lax.scan", by_jax.by_runge_kutta(problem), steps, "steps"),
        ]
    return found


def measured(problem: Problem, side: int, sample: int, rounds: int) -> Throughput:
    """Return the rates of all manners over a grid of initial angles; of loops over a sample of it."""
    states = starts(side)
    ends = _simulate_many(problem, "dop853", 1, states, 1e-13)
    some = np.random.default_rng(7).choice(len(states), min(sample, len(states)), replace=False)
    given, few = (by_scipy.rates(problem), by_scipy.jacobian(problem)), some[:3]
    check = _error(_solve_ivp(problem, "Radau", *given, states[few], 1e-11), ends[few])
    found = []
    for manner in manners(problem):
        chosen = some if manner.is_loop else np.arange(len(states))
        found.append((_tuned(manner, states[chosen], ends[chosen]), states[chosen]))
        print(".", end="", file=sys.stderr, flush=True)
    for _ in range(rounds):
        for rate, own in found:
            wall, work = perf_counter(), process_time()
            rate.manner.many(own, rate.setting)
            rate.times.append(perf_counter() - wall)
            rate.work.append(process_time() - work)
    print(" many motions", file=sys.stderr)
    return Throughput(len(states), problem.duration, tuple(rate for rate, _ in found), check)


def _tuned(manner: Manner, states: Array, ends: Array) -> Rate:
    """Return a manner with the first setting whose ends are close enough."""
    for setting in manner.settings:
        begin = perf_counter()
        found = manner.many(states, setting)
        first = perf_counter() - begin
        error = _error(found, ends)
        if error <= ERROR:
            return Rate(manner, setting, error, len(states), first)
    raise RuntimeError(f"{manner.label}: no setting reaches an error of {ERROR}")


def _error(found: Array, ends: Array) -> float:
    return float(np.abs(found[:, :2] - ends[:, :2]).max())


def _instants(problem: Problem) -> Array:
    """Return the first, the last and a middle instant: a pair would mean a thousand."""
    return np.linspace(0, problem.duration, 3)


def _simulate_many(problem: Problem, method: str, threads: int, states: Array, tolerance: float) -> Array:
    runs = simulate_many(
        problem.equations,
        problem.parameters,
        dict(zip(problem.model.state, states.T, strict=True)),
        _instants(problem),
        method=method,
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
        outcomes = run_many(compiled, states, parameters, _instants(problem), options, 1)
        return np.stack([outcome.states[-1] for outcome in outcomes if outcome is not None])

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
