"""Measure simulations beside SciPy's solve_ivp, JAX and MuJoCo.

    python -m benchmarks.simulate.run [--quick] [--only many] [--rounds N]

A full run takes some minutes and writes docs/benchmarks/simulate.md and .svg; with --quick the tables are printed. With
--only many, the tables of many motions are measured, and replace those on the page; with --only linkages, that of
linkages alone.
"""

from __future__ import annotations

import argparse
from time import process_time

from ..page import FOLDER, write_page
from . import by_scipy, report
from .andrews import andrews
from .batches import arms, linkages, pendulums
from .double_pendulum import double_pendulum
from .plot import write_plot
from .precision import Comparison, Effort, compared
from .problem import Problem
from .throughput import Batch, measured

CALLS = 20_000
"""Calls of the rates whose time is taken together."""


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.simulate.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument(
        "--quick", action="store_true", help="a short motion, few tolerances, one round: seconds"
    )
    parser.add_argument("--rounds", type=int, default=9, help="trials of each contender (default 9)")
    parser.add_argument("--only", choices=["many", "linkages"], help="measure this part of the page alone")
    arguments = parser.parse_args()
    if arguments.quick:
        print(quick())
        return
    if arguments.only:
        page, rounds = (FOLDER / "simulate.md").read_text(encoding="utf-8"), max(3, arguments.rounds // 3)
        kept, begin, others = page.partition("## Many motions\n")
        if arguments.only == "many":
            write_page("simulate.md", kept + many(batches_of(double_pendulum()), 50, rounds))
        else:
            table = report.throughput(measured(linkages(10_000), 50, rounds))
            write_page("simulate.md", kept + begin + with_section(others, table))
        return
    text, comparisons = full(arguments.rounds)
    write_plot(comparisons, FOLDER / "simulate.svg")
    write_page("simulate.md", text)


def with_section(page: str, section: str) -> str:
    """Return a page with another section in place of that of the same heading, which ends at the next one."""
    heading = section.partition("\n")[0] + "\n"
    before, _, after = page.partition(heading)
    _, mark, rest = after.partition("\n### ")
    return before + section.rstrip("\n") + "\n" + (mark and "\n" + mark.lstrip("\n")) + rest


def quick() -> str:
    """Return the tables of short motions and few tolerances."""
    effort, tolerances = Effort(1, 0.001), (1e-4, 1e-6, 1e-8)
    problems = [double_pendulum(0.5), andrews()]
    comparisons = [compared(problem, effort, tolerances) for problem in problems]
    few = [pendulums(problems[0], 3), linkages(4, 0.1), arms(4, 0.1)]
    return tables(effort, comparisons, many(few, sample=2, rounds=1))


def full(rounds: int) -> tuple[str, list[Comparison]]:
    """Return all tables, and what the plot shows."""
    effort, problems = Effort(rounds, 0.02), [double_pendulum(), andrews()]
    comparisons = [compared(problem, effort) for problem in problems]
    text = many(batches_of(problems[0]), sample=50, rounds=max(3, rounds // 3))
    return tables(effort, comparisons, text), comparisons


def batches_of(pendulum: Problem) -> list[Batch]:
    """Return the batches of a full run."""
    return [pendulums(pendulum, 100), linkages(10_000), arms(1000)]


def many(batches: list[Batch], sample: int, rounds: int) -> str:
    """Return the tables of many motions."""
    found = [measured(batch, sample, rounds) for batch in batches]
    return "\n".join([report.many_motions(), *map(report.throughput, found)])


def tables(effort: Effort, comparisons: list[Comparison], throughput: str) -> str:
    """Return the report."""
    calls = {found.problem.name: _call(found.problem) for found in comparisons}
    return "\n".join(
        [
            report.introduction(effort, calls),
            *map(report.comparison, comparisons),
            throughput,
        ]
    )


def _call(problem: Problem) -> float:
    """Return the seconds of a call of the rates from Python."""
    rates, state = by_scipy.rates(problem), problem.start
    begin = process_time()
    for _ in range(CALLS):
        rates(0.0, state)
    return (process_time() - begin) / CALLS


if __name__ == "__main__":
    main()
