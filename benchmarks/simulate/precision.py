"""Work and precision: what each contender takes, and what it misses at the end, over a range of tolerances."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from itertools import pairwise
from math import exp, inf, log
from statistics import median
from time import process_time

import numpy as np

from . import by_scipy, by_symbody
from .contender import Contender
from .problem import Array, Problem

ERRORS = (1e-4, 1e-6, 1e-8, 1e-10)
"""Where contenders are compared, in rad."""

SLOW = 2.0
"""Seconds of one integration beyond which one is enough, and finer tolerances are not tried."""


@dataclass(frozen=True)
class Effort:
    """How long is measured: how many rounds, and what a trial takes at least, in s."""

    rounds: int
    seconds: float


@dataclass
class Point:
    """One contender at one tolerance.

    Attributes:
        tolerance: what was asked for.
        error: the largest difference of a coordinate at the ends of the durations, in rad.
        drift: the largest violation of a constraint at the end; None without constraints.
        times: the processor's seconds, of each round.
    """

    tolerance: float
    error: float
    drift: float | None = None
    times: list[float] = field(default_factory=list)

    @property
    def seconds(self) -> float:
        """The median."""
        return median(self.times)


@dataclass(frozen=True)
class Curve:
    """All points of a contender, from the loosest tolerance to the finest."""

    contender: Contender
    points: tuple[Point, ...]

    def seconds(self, error: float) -> float:
        """Return the time that it needs for an error: by powers between two points that enclose it, else infinity.

        A point counts if none is both faster and closer. Where all are closer, the fastest of them is what it needs.
        """
        front = self.front
        if not front or front[-1].error > error:
            return inf
        if front[0].error <= error:
            return front[0].seconds
        a, b = next((a, b) for a, b in pairwise(front) if b.error <= error < a.error)
        part = log(a.error / error) / log(a.error / b.error)
        return exp((1 - part) * log(a.seconds) + part * log(b.seconds))

    @property
    def front(self) -> list[Point]:
        """The points that none beats, from the fastest on."""
        kept: list[Point] = []
        for point in sorted(self.points, key=lambda p: (p.seconds, p.error)):
            if not kept or point.error < kept[-1].error:
                kept.append(point)
        return kept


@dataclass(frozen=True)
class Comparison:
    """What was measured of one problem.

    Attributes:
        problem: which one.
        curves: of all contenders.
        calls: of the whole call of `simulate`, by the number of its instants.
        check: the differences of the reference from what else is known of the end, in rad, and what that is.
    """

    problem: Problem
    curves: tuple[Curve, ...]
    calls: tuple[tuple[int, Curve], ...]
    check: dict[str, float]

    def of(self, tool: str) -> list[Curve]:
        """Return the curves of a tool."""
        return [curve for curve in self.curves if curve.contender.tool == tool]

    def best(self, tool: str, error: float) -> tuple[str, float]:
        """Return the method that a tool needs least time with for an error, and the seconds."""
        times = [(curve.seconds(error), curve.contender.method) for curve in self.of(tool)]
        seconds, method = min(times)
        return method, seconds

    def ratio(self, error: float) -> float:
        """Return how many times longer the best method of solve_ivp takes than the best of symbody."""
        return self.best(by_scipy.TOOL, error)[1] / self.best(by_symbody.TOOL, error)[1]


def compared(problem: Problem, effort: Effort, tolerances: Sequence[float] | None = None) -> Comparison:
    """Return the curves of all contenders on a problem, at some tolerances or at all of theirs."""
    ends, check = reference(problem)
    contenders = [*by_symbody.contenders(problem), *by_scipy.contenders(problem)]
    asked = (1e-6, 1e-10) if tolerances is None else tolerances
    calls = {
        instants: Contender(
            by_symbody.TOOL, "simulate", tuple(asked), by_symbody.whole_call(problem, instants)
        )
        for instants in (3, 1001)
    }
    curves = in_turns(problem, [*contenders, *calls.values()], ends, effort, tolerances)
    own = tuple(zip(calls, curves[len(contenders) :], strict=True))
    return Comparison(problem, tuple(curves[: len(contenders)]), own, check)


@cache
def reference(problem: Problem) -> tuple[list[Array], dict[str, float]]:
    """Return the ends of all durations by SciPy's DOP853 in small steps, and how far other results are from them."""
    rates, jacobian = by_scipy.rates(problem), by_scipy.jacobian(problem)
    tight = partial(by_scipy.integrated, problem.start)
    ends = [tight(T, "DOP853", rates, None, 1e-13, T / 4000) for T in problem.durations]
    own = by_symbody.contenders(problem)[0]
    check = {
        "solve_ivp, Radau at 1e-11": _error(
            problem, [tight(T, "Radau", rates, jacobian, 1e-11) for T in problem.durations], ends
        ),
        "symbody, dop853 at 1e-14": _error(problem, [own.end(1e-14, T) for T in problem.durations], ends),
    }
    if problem.published is not None:
        check["the published end"] = _error(problem, [np.array(problem.published)], ends[-1:])
    return ends, check


def _error(problem: Problem, found: Sequence[Array], ends: Sequence[Array]) -> float:
    """Return the largest difference of a coordinate."""
    n = problem.size
    return max(float(np.abs(one[:n] - other[:n]).max()) for one, other in zip(found, ends, strict=True))


def in_turns(
    problem: Problem,
    contenders: Sequence[Contender],
    ends: Sequence[Array],
    effort: Effort,
    tolerances: Sequence[float] | None = None,
) -> list[Curve]:
    """Compare the ends that contenders find with the reference, then time them, round after round."""
    curves = [Curve(c, tuple(_points(problem, c, ends, tolerances or c.tolerances))) for c in contenders]
    for _ in range(effort.rounds):
        for curve in curves:
            for point in curve.points:
                if not point.times or point.times[0] < SLOW:
                    point.times.append(
                        _seconds(curve.contender, point.tolerance, problem.duration, effort.seconds)
                    )
        print(".", end="", file=sys.stderr, flush=True)
    print(f" {problem.name}", file=sys.stderr)
    return curves


def _points(
    problem: Problem, contender: Contender, ends: Sequence[Array], tolerances: Sequence[float]
) -> list[Point]:
    points: list[Point] = []
    for tolerance in tolerances:
        begin = process_time()
        found = [contender.end(tolerance, duration) for duration in problem.durations]
        points.append(Point(tolerance, _error(problem, found, ends), drift(problem, found[-1])))
        if process_time() - begin > SLOW * len(ends):
            break
    return points


def drift(problem: Problem, state: Array) -> float | None:
    """Return the largest violation of a constraint in a state."""
    model = problem.model
    if not model.constraints:
        return None
    violations = model.code(model.constraints).evaluate(
        problem.values, np.array([0.0, *state, *_work(problem)])
    )
    return float(np.abs(violations).max())


def _work(problem: Problem) -> list[float]:
    """Return the place of the work of loads behind the state, where the model integrates that, too."""
    return [0.0] * (problem.model.width - len(problem.model.state))


def _seconds(contender: Contender, tolerance: float, duration: float, least: float) -> float:
    """Return the processor's seconds of one integration, from as many as fill a trial."""
    count, begin = 0, process_time()
    while True:
        contender.end(tolerance, duration)
        count += 1
        spent = process_time() - begin
        if spent >= least:
            return spent / count
