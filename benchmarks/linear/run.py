"""Measure symbody and SymPy at linear models, from bodies to eigenvalues.

    python -m benchmarks.linear.run [--quick] [--without-slow] [--rounds N] [--only NAME]

A full run takes some minutes, most of them SymPy's, and writes docs/benchmarks/linear.md; with --only, --quick or
--without-slow the tables are printed.
"""

from __future__ import annotations

import argparse

from ..page import write_page
from .problems import PROBLEMS
from .report import introduction, section
from .rounds import in_this_process, in_turns


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.linear.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument(
        "--quick", action="store_true", help="one round in this process, without slow rivals: seconds"
    )
    parser.add_argument("--without-slow", action="store_true", help="without rivals that take minutes")
    parser.add_argument("--rounds", type=int, default=5, help="trials of each contender (default 5)")
    parser.add_argument("--only", choices=PROBLEMS, help="one problem")
    arguments = parser.parse_args()
    names = [arguments.only] if arguments.only else list(PROBLEMS)
    if arguments.quick:
        print(quick(names))
        return
    report = full(names, arguments.rounds, has_slow=not arguments.without_slow)
    if arguments.only or arguments.without_slow:
        print(report)
    else:
        write_page("linear.md", report)


def quick(names: list[str]) -> str:
    """Return the tables of one round."""
    tables = [section(PROBLEMS[name], in_this_process(PROBLEMS[name])) for name in names]
    return "\n".join([introduction("a quick look, one round"), *tables])


def full(names: list[str], rounds: int, *, has_slow: bool) -> str:
    """Return all tables."""
    problems = [PROBLEMS[name] for name in names]
    tables = [section(each, in_turns(each, rounds, has_slow=has_slow)) for each in problems]
    return "\n".join([introduction(f"{rounds} rounds (one for trials that take more than 5 s)"), *tables])


if __name__ == "__main__":
    main()
