"""Tables of what was measured, as Markdown."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from math import isfinite, isinf
from statistics import median
from textwrap import fill

from ..evaluate.report import _met, _version
from . import by_scipy, by_symbody
from .precision import ERRORS, Comparison, Curve, Effort
from .throughput import ONE_BY_ONE, WITHOUT_LANES, Rate, Throughput

BOUND = 20.0
"""How many times longer solve_ivp's best method must take, at least."""

SHOWN = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
"""The tolerances whose points are shown."""

WIDTH = 120
"""Of lines of text."""

PACKAGES = ("symbody", "scipy", "numpy", "llvmlite", "scikit-sundae", "jax", "diffrax", "mujoco")

INTRODUCTION = """\
# Simulating

Written by `python -m benchmarks.simulate.run`: {rounds} rounds. In each round every contender runs in turn. A trial
consists of as many integrations as fill {milliseconds:.0f} ms, or of a single longer one. Results are medians.
Times are processor times, since other programs ran on the machine; only the throughput of many motions is measured in
wall-clock time.

* All contenders integrate the same machine code of the rates. Symbody's integrators call it from compiled code.
  solve_ivp calls it in the cheapest way that Python offers: permanent buffers, one foreign call without conversions,
  one copy in, one copy out ({call}).
  LSODA, Radau and BDF also use the Jacobian as machine code.
* The *error* is the largest difference of a coordinate from a reference, in rad, at the ends of integrations over
  90 %, 95 % and all of the time (a single one may happen to be a zero of the error). Relative and absolute tolerances
  are equal, and all contenders run through the same decades. Times at equal error are interpolated by power laws
  between those points of a method that no other of its points beats.
* symbody integrates the prepared system, for two instants. The time of the whole call of `simulate` is given below.
* Systems with constraints: symbody integrates with projection onto the constraints after each step (`ida`: unreduced,
  by SUNDIALS, called from Python). solve_ivp integrates ordinary differential equations of index 1, and drifts off
  the constraints.

Versions: {versions}; Python {python}, {cores} cores.

![Work and precision](simulate.svg)
"""


MANY = """\
## Many motions

Each contender uses the loosest setting whose largest error at the end is at most that of the table. Settings are as
fine for all: from one to the next, a method of order 5 takes a tenth more steps. *One motion at a time* is
without lanes, so that their gain is a ratio of two rows. The native integrator is `simulate_many` without what Python
does for all motions: initial states, checks and findings. The reference is symbody's dop853 at 1e-13.
Loops in Python are measured on a sample and scaled to all motions. JAX runs the function that `generate` writes for it,
with all motions in one call, 64 bits, and as many threads as it chooses. *First* is the first call with the setting, in
which JAX compiles. *Motions*: how many motions were measured. *Of processors*: the time of all threads together; other
programs ran on the machine{load}. *Over loop*: motions per second, relative to the fastest loop of solve_ivp.
"""


def many_motions() -> str:
    """Say how many motions were measured."""
    average = f" (load average {os.getloadavg()[1]:.1f})" if hasattr(os, "getloadavg") else ""
    return MANY.format(load=average)


def introduction(effort: Effort, calls: dict[str, float]) -> str:
    """Say how it was measured, and with what; calls are the seconds of a call of the rates from Python, by problem."""
    return INTRODUCTION.format(
        rounds=effort.rounds,
        milliseconds=effort.seconds * 1e3,
        call=", ".join(f"{name}: {seconds * 1e6:.2f} µs" for name, seconds in calls.items()),
        versions=", ".join(f"{name} {_version(name)}" for name in PACKAGES),
        python=platform.python_version(),
        cores=os.cpu_count(),
    )


def comparison(found: Comparison) -> str:
    """Return the tables of one problem."""
    checks = "; ".join(f"{what}: {error:.1e} rad" for what, error in found.check.items())
    text = (
        "The reference is SciPy's DOP853 at 1e-13, with steps that are far smaller than necessary. These results "
        f"differ from it: {checks}."
    )
    parts = [
        f"## {found.problem.name[0].upper()}{found.problem.name[1:]}, {found.problem.duration:g} s",
        "",
        fill(text, WIDTH),
        "",
        *_ratios(found),
        "",
        *_methods(found),
        "",
        *_calls(found),
        "",
        *_points(found),
        "",
    ]
    return "\n".join(parts)


def _ratios(found: Comparison) -> list[str]:
    head = [
        "| error | symbody | ms | solve_ivp | ms | ratio | target | met |",
        "|---:|---|---:|---|---:|---:|---:|---|",
    ]
    return [*head, *(_ratio(found, error) for error in ERRORS)]


def _ratio(found: Comparison, error: float) -> str:
    own, rival = found.best(by_symbody.TOOL, error), found.best(by_scipy.TOOL, error)
    cells = " | ".join(
        "– | –" if isinf(seconds) else f"{method} | {_ms(seconds)}" for method, seconds in (own, rival)
    )
    ratio = found.ratio(error)
    verdict = (
        f"{ratio:.1f} | ≥ {BOUND:g} | {_met(ratio >= BOUND)}"
        if isfinite(ratio)
        else f"– | ≥ {BOUND:g} | not measured"
    )
    return f"| {error:.0e} | {cells} | {verdict} |"


def _methods(found: Comparison) -> list[str]:
    """Return the table of the times of all methods at equal errors."""
    columns = " | ".join(f"ms at {error:.0e}" for error in ERRORS)
    rows = [
        f"| {curve.contender.label} | {' | '.join(_ms(curve.seconds(error)) for error in ERRORS)} |"
        for curve in found.curves
    ]
    return [f"| method | {columns} |", "|---|" + "---:|" * len(ERRORS), *rows]


def _ms(seconds: float) -> str:
    return "–" if isinf(seconds) else f"{seconds * 1e3:.3g}"


def _calls(found: Comparison) -> list[str]:
    rows = [
        f"| {instants} | {point.tolerance:.0e} | {_ms(point.seconds)} |"
        for instants, curve in found.calls
        for point in curve.points
    ]
    return [
        "The whole call of `simulate`, when the code is already compiled: checks, initial state, integration, motion.",
        "",
        "| instants | tolerance | ms |",
        "|---:|---:|---:|",
        *rows,
    ]


def _points(found: Comparison) -> list[str]:
    """Return all that was measured: error and time, and how far the state is off its constraints."""
    has_drift = bool(found.problem.model.constraints)
    extra = (" drift at 1e-08 |", "---:|") if has_drift else ("", "")
    measured = {point.tolerance for curve in found.curves for point in curve.points}
    tolerances = [tolerance for tolerance in SHOWN if tolerance in measured]
    head = (
        "| error, ms at a tolerance of |"
        + "".join(f" {tolerance:.0e} |" for tolerance in tolerances)
        + extra[0]
    )
    rows = [_row(curve, tolerances, has_drift=has_drift) for curve in found.curves]
    return [head, "|---|" + "---:|" * len(tolerances) + extra[1], *rows]


def _row(curve: Curve, tolerances: Sequence[float], *, has_drift: bool) -> str:
    at = {point.tolerance: point for point in curve.points}
    cells = [
        f"{at[tolerance].error:.1e}, {_ms(at[tolerance].seconds)}" if tolerance in at else "–"
        for tolerance in tolerances
    ]
    if has_drift:
        cells.append("–" if 1e-8 not in at else f"{at[1e-8].drift:.0e}")
    return f"| {curve.contender.label} | {' | '.join(cells)} |"


AIMS = {WITHOUT_LANES: 3.0, ONE_BY_ONE: 3.0, "JAX": 3.0, "MuJoCo": 5.0}
"""How many times the rate of a rival's best is aimed at. Lanes alone are compared where nothing else was gained."""


def throughput(found: Throughput) -> str:
    """Return the table of many motions of a system."""
    batch, name = found.batch, found.batch.problem.name
    sentence = (
        f"{len(batch.states)} {batch.text.format(duration=batch.problem.duration)} Errors: at most {batch.error:.0e}; "
        f"solve_ivp's Radau at 1e-11 differs from the reference by {found.check:.0e} on three of them."
    )
    head = [
        "| many motions | setting | error | motions | first s | s for all | of processors | per second | over loop |",
        "|---|---|---:|---:|---:|---:|---:|---:|---:|",
    ]
    loops = [rate for rate in found.rates if "solve_ivp" in rate.manner.label]
    loop = max(loops, key=lambda rate: rate.per_second, default=None)
    rows = [_rate(rate, len(batch.states), loop) for rate in found.rates]
    lacking = [f"**{batch.missing} is missing.**", ""] if batch.missing else []
    told = [line for rival in AIMS if (line := _beside(rival, found.rates))]
    told += [line for line in [_of_threads(found.rates)] if line]
    verdict = [*told, ""] if told else []
    return "\n".join([f"### {name}", "", fill(sentence, WIDTH), "", *lacking, *head, *rows, "", *verdict])


def _beside(rival: str, rates: Sequence[Rate]) -> str:
    """Return how many times the rate of a rival's best is reached, with one thread and two, and what is aimed at.

    JAX always has all processors; of the others, as many threads are compared.
    """
    parts = []
    for end in ("1 thread", "2 threads"):
        own = [
            r.per_second
            for r in rates
            if r.manner.label.startswith("symbody") and r.manner.label.endswith(end)
        ]
        theirs = [r for r in rates if r.manner.label.startswith(rival)]
        of_all = [r for r in theirs if "thread" not in r.manner.label]
        equal = [r for r in theirs if r.manner.label.endswith(end)] or of_all
        if own and equal:
            parts.append(f"{max(own) / max(r.per_second for r in equal):.1f} with {end}")
    what = rival if rival in (WITHOUT_LANES, ONE_BY_ONE) else f"{rival}'s best"
    has_more = any(rate.manner.label.startswith(ONE_BY_ONE) for rate in rates)
    aim = "what lanes gain" if rival == WITHOUT_LANES and has_more else f"aim: {AIMS[rival]:g}"
    return f"Times the rate of {what}: {', '.join(parts)}; {aim}." if parts else ""


def _of_threads(rates: Sequence[Rate]) -> str:
    """Return what a second thread gains."""
    best = {
        count: max(
            (r.per_second for r in rates if r.manner.label.startswith("symbody") and count in r.manner.label),
            default=0.0,
        )
        for count in ("1 thread", "2 threads")
    }
    one, two = best.values()
    return f"Times the rate of 1 thread: {two / one:.1f} with 2 threads." if one and two else ""


def _rate(rate: Rate, runs: int, loop: Rate | None) -> str:
    setting = f"{rate.setting:.0f} steps" if rate.manner.unit == "steps" else f"{rate.setting:.2g}"
    seconds, work = (median(times) / rate.runs * runs for times in (rate.times, rate.work))
    over = "–" if loop is None else f"{rate.per_second / loop.per_second:.1f}"
    return (
        f"| {rate.manner.label} | {setting} | {rate.error:.0e} | {rate.runs} | {rate.first:.2f} "
        f"| {seconds:.3g} | {work:.3g} | {rate.per_second:.0f} | {over} |"
    )
