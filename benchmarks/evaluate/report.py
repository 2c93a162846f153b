"""Tables of what was measured, as Markdown."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from importlib import metadata
from textwrap import fill

from .measure import RIVALS, Effort, Results, Timing
from .scaling import Growth
from .targets import SPEEDS, Bound, Speed

INTRODUCTION = """\
# Evaluating equations of motion

Written by `python -m benchmarks.evaluate.run`: {rounds} rounds. In each round every contender runs in turn, in a loop
outside Python, over 256 random states. A trial takes at least {milliseconds:.0f} ms.

* *ns*: median time per state. *ratio*: time relative to symbody's machine code, median over the rounds. Times are
  processor times, since other programs ran on the machine; only runs with threads are measured in wall-clock time.
* *agrees*: whether the results of all states equal those of symbody's machine code to 1e-9 of the largest, and the
  largest difference.
* Machine code is made by LLVM in the process (`MachineCode`). Generated C (`generate`), CasADi's C and Pinocchio's
  templates are compiled by gcc with -O3 -march=native -DNDEBUG. For all contenders, forces are inputs of the forward
  dynamics.
* CasADi's C is generated from Pinocchio's recursions (RNEA, CRBA, ABA), written by hand in SX, since the wheel of
  Pinocchio lacks `pinocchio.casadi`. Pinocchio's own templates on SX were measured once for comparison, outside of
  this run. For inverse dynamics they take the same time within 9 %. For forward dynamics they take 404 ns against 471
  (panda), 2437 against 3235 (chain of 30), and 1031 against 791 (solo12). Where they are faster, CasADi's ratios here
  are up to a third too large.
* Pinocchio uses a joint collection of the joint types that occur. Without -march=native its forward dynamics was 6 to
  12 % faster, and its inverse dynamics 8 to 11 % slower.
* The numbers of the robots are folded into the code. For all contenders, a floating base has a quaternion, and
  velocities in its own axes.

{rivals}

Versions: {versions}; Python {python}, {cores} cores.
"""


def introduction(effort: Effort) -> str:
    """Say how it was measured, with what, and who is missing."""
    absent = [f"**{name} is missing: install {r.missing()}.**" for name, r in RIVALS.items() if r.missing()]
    return INTRODUCTION.format(
        rounds=effort.rounds,
        milliseconds=effort.seconds * 1e3,
        rivals="\n".join(absent) or "All rivals ran.",
        versions=", ".join(f"{name} {_version(name)}" for name in ("symbody", "pin", "casadi", "llvmlite")),
        python=platform.python_version(),
        cores=os.cpu_count(),
    )


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def comparison(results: Results) -> str:
    """Return the table of all functions and contenders."""
    head = [
        "| robot | function | contender | ns | ratio | operations | agrees |",
        "|---|---|---|---:|---:|---:|---|",
    ]
    rows = [
        f"| {robot} | {function} | {timing.label} | {timing.nanoseconds:.1f} | {timing.over(timings[0]):.2f} "
        f"| {timing.operations or '–'} | {_agreement(timing)} |"
        for (robot, function), timings in results.items()
        for timing in timings
    ]
    return "\n".join(["## Functions", "", *head, *rows, ""])


def _agreement(timing: Timing) -> str:
    return f"{'yes' if timing.agrees else '**NO**'}, {timing.difference:.0e}"


def speeds(results: Results) -> str:
    """Return the table of the ratios that must be reached."""
    head = ["| target | at least | machine code | met | generated C | met |", "|---|---:|---:|---|---:|---|"]
    return "\n".join(["## Targets of speed", "", *head, *(_speed(s, results) for s in SPEEDS), ""])


def _speed(speed: Speed, results: Results) -> str:
    ratios = speed.measured(results)
    cells = [f"{r:.2f} | {_met(r >= speed.bound)}" for r in ratios] or ["not measured |"] * 2
    return f"| {speed.quantity} | {speed.bound:g} | {' | '.join(cells)} |"


def _met(is_met: bool) -> str:
    return "yes" if is_met else "**no**"


def batches(timings: Sequence[tuple[int, Timing]]) -> str:
    """Return the table of many states at a time."""
    head = ["| the arm's inverse dynamics | states | ns per state | agrees |", "|---|---:|---:|---|"]
    rows = [f"| {t.label} | {states} | {t.nanoseconds:.1f} | {_agreement(t)} |" for states, t in timings]
    (_, one), (_, two) = timings[-2:]
    scaling = f"Two threads are {one.over(two):.2f} times as fast as one (on two cores, which other programs use too)."
    return "\n".join(["## Many states at a time", "", *head, *rows, "", scaling, ""])


def growth(measured: Sequence[Growth]) -> str:
    """Return the table of how long code takes to be made."""
    head = [
        "| bodies | operations | derive | machine code | of many states | C text | C compiled | GB | GB, compiler |",
        "|---:" * 9 + "|",
    ]
    rows = [
        f"| {g.bodies} | {g.operations} | {g.derive:.2f} | {g.scalar:.2f} | {g.batch:.2f} | {g.generate:.2f} "
        f"| {g.compile:.2f} | {g.memory:.2f} | {g.compiler_memory:.2f} |"
        for g in measured
    ]
    sentence = (
        "Inverse dynamics of a chain of bodies with symbolic parameters, in a separate process. Times are processor "
        "times in seconds. C is compiled as in the generated Makefile (-O1)."
    )
    return "\n".join(["## Making the code", "", fill(sentence, 120), "", *head, *rows, ""])


def bounds(targets: Sequence[Bound]) -> str:
    """Return the table of the other targets."""
    head = ["| target | bound | measured | met |", "|---|---:|---:|---|"]
    rows = []
    for target in targets:
        value = target.measured()
        sign = "≥" if target.at_least else "≤"
        shown = f"{value:.4g}{target.unit} | {_met(target.is_met(value))}"
        rows.append(f"| {target.quantity} | {sign} {target.bound:g}{target.unit} | {shown} |")
    return "\n".join(["## Other targets", "", *head, *rows, ""])
