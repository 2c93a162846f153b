"""Measure how long it takes to lower Jacobians to straight-line code, with and without signs.

    python -m benchmarks.lower.run [--quick]

A full run takes a minute and writes docs/benchmarks/lower.md; with --quick, the small systems are printed.
"""

from __future__ import annotations

import argparse
import platform
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from time import process_time

from symbody import Equations, cost, jacobian, newton_euler
from symbody.models import flexible_motorcycle, n_pendulum, touring_motorcycle
from symbody.symbolic.numeric.tape import Tape

from ..page import write_page
from .axle import front_axle

TEXT = """\
# Lowering

Written by `python -m benchmarks.lower.run`: the time to lower the Jacobian of the equations of motion, by coordinates
and speeds, to straight-line code. Signs are moduli, roots, extremes and the like, as in the forces of tyres: whether
two expressions that hold some are equal is decided in 64 lanes, others by two words. Times are those of the
processor; {rounds}.

Versions: symbody {version}; Python {python}.

| system | signs | entries | operations | lowering [ms] | per operation [us] |
|---|---|---:|---:|---:|---:|
{rows}
"""


@dataclass(frozen=True)
class Case:
    """A system, and whether its equations hold signs."""

    name: str
    equations: Callable[[], Equations]
    has_signs: bool


CASES = (
    Case("pendulum of 12 masses", lambda: newton_euler(n_pendulum(12).system), has_signs=False),
    Case("touring motorcycle", lambda: newton_euler(touring_motorcycle().system), has_signs=True),
    Case("flexible motorcycle", lambda: newton_euler(flexible_motorcycle().system), has_signs=True),
    Case("front axle, two tyres with relaxation", front_axle, has_signs=True),
)
QUICK = 2
"""The cases of a quick run."""
ROUNDS = 3


@dataclass(frozen=True)
class Found:
    """The size of a Jacobian, and the time to lower it, in seconds."""

    case: Case
    entries: int
    operations: int
    time: float


def lowered(case: Case, rounds: int) -> Found:
    """Measure a case; nothing of an earlier round is kept but the values of nodes."""
    equations = case.equations()
    rates = [*equations.coordinates, *equations.speeds]
    entries = list(jacobian(list(equations.residuals), rates))
    variables = sorted({leaf for entry in entries for leaf in entry.free_symbols}, key=str)
    times = []
    for _ in range(rounds):
        begin = process_time()
        Tape(variables, entries)
        times.append(process_time() - begin)
    return Found(case, len(entries), cost(entries).total, min(times))


def page(found: list[Found], rounds: int) -> str:
    """Return the page."""
    return TEXT.format(
        rounds=f"the least of {rounds} rounds" if rounds > 1 else "one round",
        version=version("symbody"),
        python=platform.python_version(),
        rows="\n".join(map(_row, found)),
    )


def _row(each: Found) -> str:
    signs = "yes" if each.case.has_signs else "no"
    per_operation = 1e6 * each.time / each.operations
    return (
        f"| {each.case.name} | {signs} | {each.entries} | {each.operations} "
        f"| {1e3 * each.time:.3g} | {per_operation:.2g} |"
    )


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.lower.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--quick", action="store_true", help="the small systems, printed")
    if parser.parse_args().quick:
        print(page([lowered(case, 1) for case in CASES[:QUICK]], 1))
        return
    write_page("lower.md", page([lowered(case, ROUNDS) for case in CASES], ROUNDS))


if __name__ == "__main__":
    main()
