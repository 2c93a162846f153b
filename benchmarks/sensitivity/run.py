"""Measure the sensitivities of a double pendulum over 10 s by 6 parameters.

    python -m benchmarks.sensitivity.run [--quick] [--rounds N]

A full run takes a minute and writes docs/benchmarks/sensitivity.md; with --quick the table is printed.
"""

from __future__ import annotations

import argparse
import os
import platform
from importlib.metadata import PackageNotFoundError, version
from statistics import median
from time import perf_counter

import numpy as np

from ..page import write_page
from .contenders import ATOL, CONTENDERS, DURATION, RTOL, Array, Solve, forward

BOUND = 4.0
"""The most time of the sensitivities, in times of the motion alone."""

TEXT = """\
# Sensitivities of a double pendulum

Written by `python -m benchmarks.sensitivity.run`: medians of {rounds} rounds in which contenders take turns, in one
process, after preparation and a first call. The motion of {duration:g} s, with tolerances of {rtol:g} (relative) and
{atol:g}, is differentiated by two masses, two lengths, gravity, and an initial angle. symbody returns 1001 instants,
the others the end alone. The error is that of the derivatives at the end, relative to the largest of them, against
symbody at 1e-13. CasADi, SciPy and JAX have the equations by hand; SciPy evaluates them in NumPy.

Versions: {versions}; Python {python}, {cores} cores.

| contender | ms | times the motion | error |
|---|---:|---:|---:|
{rows}

Bound for symbody: {bound:g} times the motion alone; {met}.
"""


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.sensitivity.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--quick", action="store_true", help="three rounds, printed")
    parser.add_argument("--rounds", type=int, default=31, help="rounds of each contender (default 31)")
    arguments = parser.parse_args()
    text = report(3 if arguments.quick else arguments.rounds)
    if arguments.quick:
        print(text)
        return
    write_page("sensitivity.md", text)


def report(rounds: int) -> str:
    """Return the page."""
    exact = forward(1e-13, 1e-14)()
    solvers = {each.label: each.prepare() for each in CONTENDERS if each.is_installed}
    ends = {label: solve() for label, solve in solvers.items()}
    seconds = _in_turns(solvers, rounds)
    first, second = (each.label for each in CONTENDERS[:2])
    rows = [
        _row(each.label, seconds, ends, exact)
        if each.is_installed
        else f"| {each.label} | not installed | | |"
        for each in CONTENDERS
    ]
    packages = ("symbody", "scipy", "casadi", "jax")
    return TEXT.format(
        rounds=rounds,
        duration=DURATION,
        rtol=RTOL,
        atol=ATOL,
        versions=", ".join(f"{name} {_version(name)}" for name in packages),
        python=platform.python_version(),
        cores=os.cpu_count(),
        rows="\n".join(rows),
        bound=BOUND,
        met="met" if seconds[second] <= BOUND * seconds[first] else "**not met**",
    )


def _in_turns(solvers: dict[str, Solve], rounds: int) -> dict[str, float]:
    """Return the median times in s."""
    times: dict[str, list[float]] = {label: [] for label in solvers}
    for _ in range(rounds):
        for label, solve in solvers.items():
            begin = perf_counter()
            solve()
            times[label].append(perf_counter() - begin)
    return {label: median(each) for label, each in times.items()}


def _row(label: str, seconds: dict[str, float], ends: dict[str, Array], exact: Array) -> str:
    took, alone = seconds[label], seconds[CONTENDERS[0].label]
    end = ends[label]
    error = f"{np.abs(end - exact).max() / np.abs(exact).max():.1e}" if end.size else ""
    return f"| {label} | {1e3 * took:.3g} | {took / alone:.1f} | {error} |"


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


if __name__ == "__main__":
    main()
