"""Tables of what was measured, as Markdown."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from textwrap import fill

from .problem import Contender, Problem
from .rounds import Results, agree

INTRODUCTION = """\
# Linear models

Written by `python -m benchmarks.linear.run`: {rounds}.
Each trial is a separate process that has imported its libraries, and contenders take turns. Times are processor times,
medians, from nothing to the eigenvalues: bodies, nonlinear equations, linear equations in symbols, numbers.
*agrees*: the eigenvalues are those of the first contender.

Versions: symbody {symbody}, SymPy {sympy}; Python {python}, {cores} cores.
"""

HEADER = ("| contender | seconds | times symbody's | agrees | bound | met |", "|---|---:|---:|---|---:|---|")


def introduction(rounds: str) -> str:
    """Say how it was measured, and with what."""
    return INTRODUCTION.format(
        rounds=rounds,
        symbody=_version("symbody"),
        sympy=_version("sympy"),
        python=platform.python_version(),
        cores=os.cpu_count(),
    )


def section(problem: Problem, results: Results) -> str:
    """Return the table of a problem."""
    rows = [_row(problem, contender, results) for contender in problem.contenders]
    return "\n".join([f"## {problem.title}", "", fill(problem.statement, 120), "", *HEADER, *rows, ""])


def _row(problem: Problem, contender: Contender, results: Results) -> str:
    first = results[problem.contenders[0].label]
    assert first is not None
    found = results.get(contender.label)
    if found is None:
        reason = "no result in ten minutes" if contender.label in results else _absence(contender)
        return f"| {contender.label} | {reason} | | | | |"
    if found is first:
        met = "yes" if found.seconds <= problem.bound else "**no**"
        return f"| {contender.label} | {found.seconds:.3f} | 1 | | {problem.bound} | {met} |"
    same = "compares itself" if not found.values else "yes" if agree(first, found) else "**no**"
    return f"| {contender.label} | {found.seconds:.3g} | {found.seconds / first.seconds:.0f} | {same} | | |"


def _absence(contender: Contender) -> str:
    return "left out" if contender.is_installed else "not installed"


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"
