"""Tables of what was measured, as Markdown."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from math import isfinite
from textwrap import fill

from .engines import ENGINES, SYMBODY
from .problem import Contender, Measurement, Problem, Results, Target
from .rounds import agree

INTRODUCTION = """\
# Deriving equations of motion

Written by `python -m benchmarks.derive.run`: {rounds}.
Each trial is a separate process, so that nothing derived before helps it, and contenders take turns.

* *derive*: seconds (median) from nothing to the outputs, including building the model. *cse*: seconds of common
  subexpression elimination, by each rival's own means. symbody has no such step, because a common subexpression is
  never built twice. Times are processor times, as the clock would show on an idle machine; all contenders use one
  thread.
* Operations are those of the code that each contender gives after cse: the instructions that symbody's `generate`
  prints, and those of CasADi's `Function`. SymPy and SymEngine have expressions, which are written as such code: a
  subtraction counts as an addition, and so does a change of sign that no sum absorbs; an integer power costs its
  repeated squarings, once. A matrix counts by its upper triangle.
* *agrees*: the counted instructions, evaluated at a random point, give the same numbers as those of the first
  contender, to 1e-9 of the largest.
* "By hand": the rival has no mechanics, or a slower one. The model is written for it in scalars, with velocities in
  local axes, as a careful user would do. SymPy's Kane is `sympy.physics.mechanics`.

Versions: {versions}; Python {python}, {cores} cores.
"""

WIDTH = 120
"""Of lines of text."""

HEADER = (
    "| n | contender | derive s | cse s | additions | multiplications | divisions | functions | operations | agrees |",
    "|---:|---|---:|---:|---:|---:|---:|---:|---:|---|",
)


def introduction(rounds: str) -> str:
    """Say how it was measured, and with what."""
    versions = ", ".join(f"{engine.name} {engine.version or 'not installed'}" for engine in ENGINES)
    return INTRODUCTION.format(
        rounds=rounds, versions=versions, python=platform.python_version(), cores=os.cpu_count()
    )


def section(problem: Problem, sizes: Sequence[int], results: Results) -> str:
    """Return the tables of a problem."""
    rows = [_row(problem, contender, size, results) for size in sizes for contender in problem.contenders]
    return "\n".join([f"## {problem.title}", "", fill(problem.statement, WIDTH), "", *HEADER, *rows, ""])


def targets(problem: Problem, results: Results) -> str:
    """Return the table of targets."""
    rows = [_target_row(target, results) for target in problem.targets]
    return "\n".join(["| target | bound | measured | met |", "|---|---:|---:|---|", *rows, ""])


def _row(problem: Problem, contender: Contender, size: int, results: Results) -> str:
    measurement = results.get((contender.label, size))
    if measurement is None:
        return f"| {size} | {contender.label} | {_absence(contender, size)} |" + " |" * 7
    operations = measurement.operations
    counts = operations.additions, operations.multiplications, operations.divisions, operations.functions
    cells = [
        str(size),
        contender.label,
        _seconds(measurement.derive),
        "–" if contender.engine is SYMBODY else _seconds(measurement.compress),
        *map(_integer, counts),
        f"**{_integer(operations.total)}**",
        _agreement(measurement, results.get((problem.contenders[0].label, size))),
    ]
    return f"| {' | '.join(cells)} |"


def _absence(contender: Contender, size: int) -> str:
    if contender.engine.version is None:
        return "not installed"
    return "gave no result in time" if contender.tries(size) else "not tried: too slow"


def _agreement(measurement: Measurement, reference: Measurement | None) -> str:
    if reference is None or reference is measurement:
        return ""
    return "yes" if agree(reference, measurement) else "**NO**"


def _target_row(target: Target, results: Results) -> str:
    try:
        measured = target.measured(results)
    except KeyError:
        return f"| {target.quantity} | {_bound(target)} | not measured | |"
    met = "yes" if isfinite(measured) and measured <= target.bound else "**no**"
    return f"| {target.quantity} | {_bound(target)} | {_value(measured, target.unit)} | {met} |"


def _bound(target: Target) -> str:
    return f"≤ {_value(target.bound, target.unit)}"


def _value(value: float, unit: str) -> str:
    if unit == "s":
        return f"{_seconds(value)} s"
    return _integer(int(value)) if value == int(value) else f"{value:.2f}"


def _seconds(value: float) -> str:
    return f"{value:.4f}" if value < 0.1 else f"{value:.3g}"


def _integer(value: int) -> str:
    return f"{value:,}".replace(",", " ")
