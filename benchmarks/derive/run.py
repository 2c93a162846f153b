"""Measure symbody and its rivals at deriving equations.

    python -m benchmarks.derive.run [--quick] [--rounds N] [--only NAME]

A full run takes about half an hour and writes docs/benchmarks/derive.md; with --only or --quick the tables are printed.
"""

from __future__ import annotations

import argparse

from ..page import write_page
from .problems import PROBLEMS
from .report import introduction, section, targets
from .rounds import in_this_process, in_turns
from .ways import ways


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.derive.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument(
        "--quick", action="store_true", help="small sizes, one round, in this process: seconds"
    )
    parser.add_argument("--rounds", type=int, default=5, help="trials of each contender (default 5)")
    parser.add_argument("--only", choices=PROBLEMS, help="one problem")
    arguments = parser.parse_args()
    names = [arguments.only] if arguments.only else list(PROBLEMS)
    report = "\n".join(quick(names) if arguments.quick else full(names, arguments.rounds))
    if arguments.quick or arguments.only:
        print(report)
    else:
        write_page("derive.md", report)


def quick(names: list[str]) -> list[str]:
    """Return the tables of small sizes."""
    problems = [PROBLEMS[name] for name in names]
    tables = [section(p, p.quick_sizes, in_this_process(p, p.quick_sizes)) for p in problems]
    return [introduction("a quick look, one round"), *tables]


def full(names: list[str], rounds: int) -> list[str]:
    """Return all tables, with the targets."""
    parts = [introduction(f"{rounds} rounds (one for trials that take more than 5 s)")]
    for problem in (PROBLEMS[name] for name in names):
        results = in_turns(problem, rounds)
        parts += [section(problem, problem.sizes, results), targets(problem, results)]
    return [*parts, ways()] if names == list(PROBLEMS) else parts


if __name__ == "__main__":
    main()
