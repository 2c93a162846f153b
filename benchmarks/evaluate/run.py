"""Measure compiled equations of motion beside Pinocchio and CasADi.

    python -m benchmarks.evaluate.run [--quick] [--rounds N]

A full run takes about ten minutes and writes docs/benchmarks/evaluate.md; with --quick the tables are printed.
"""

from __future__ import annotations

import argparse

from symbody import cost, newton_euler

from ..derive.by_symbody import chain as symbolic_chain
from ..page import write_page
from . import by_symbody, report, scaling
from .measure import Effort, Timing, compare, in_turns
from .robot import chain, from_reference
from .states import COUNT, random_states
from .targets import INVERSE, PANDA, SOLO, Bound

MANY = 500_000
"""States that are shared among threads."""


def main() -> None:
    """Parse the command line, measure, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.evaluate.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--quick", action="store_true", help="the arm and a short chain, three rounds")
    parser.add_argument("--rounds", type=int, default=15, help="trials of each contender (default 15)")
    arguments = parser.parse_args()
    if arguments.quick:
        print(quick())
        return
    write_page("evaluate.md", full(arguments.rounds))


def quick() -> str:
    """Return the tables of small robots."""
    effort = Effort(3, 0.001)
    results = compare([from_reference("panda_7dof", PANDA), chain(4)], effort)
    parts = [report.introduction(effort), report.comparison(results), report.speeds(results)]
    return "\n".join([*parts, report.batches(many_states(Effort(3, 0.001)))])


def full(rounds: int) -> str:
    """Return all tables."""
    effort = Effort(rounds, 0.02)
    robots = [from_reference("panda_7dof", PANDA), chain(30), from_reference("solo12_floating", SOLO)]
    results = compare(robots, effort)
    many = many_states(effort)
    grown = [scaling.measured(bodies) for bodies in scaling.SIZES]
    tables = [report.introduction(effort), report.comparison(results), report.speeds(results)]
    tables += [report.batches(many), report.growth(grown)]
    operations = results[PANDA, INVERSE][0].operations
    assert operations is not None
    return "\n".join([*tables, report.bounds([*_operations(operations), *_batches(many), *_making(grown)])])


def many_states(effort: Effort) -> list[tuple[int, Timing]]:
    """Return the timings of the arm's inverse dynamics, state by state, in vectors, and on threads."""
    robot = from_reference("panda_7dof", PANDA)
    few = by_symbody.Model(robot, random_states(robot))
    timings = in_turns([*by_symbody.contenders(few, INVERSE), by_symbody.batch(few, INVERSE)], effort)
    many = by_symbody.Model(robot, random_states(robot, MANY))
    shared = in_turns([by_symbody.threaded(many, INVERSE, threads) for threads in (1, 2)], effort)
    return [*((COUNT, timing) for timing in timings), *((MANY, timing) for timing in shared)]


def _operations(arm: int) -> list[Bound]:
    axes = ["XYZ"[i % 3] for i in range(30)]
    general = cost(newton_euler(symbolic_chain.system(axes)).residuals).total
    return [
        Bound("panda, inverse dynamics: operations", 800, lambda: arm),
        Bound("chain of 30, inverse dynamics, symbolic parameters: operations", 5100, lambda: general),
    ]


def _batches(many: list[tuple[int, Timing]]) -> list[Bound]:
    scalar, plain, vectors = (timing for _, timing in many[:3])
    packed = "vectors over machine code of one state (itself packed)"
    return [
        Bound(packed, 4, lambda: scalar.over(vectors), at_least=True),
        Bound("vectors over generated C", 4, lambda: plain.over(vectors), at_least=True),
    ]


def _making(grown: list[scaling.Growth]) -> list[Bound]:
    first, forty, last = grown[0], grown[-2], grown[-1]
    at = f"{forty.operations} operations"
    most = f"{last.operations} operations"

    def an_operation(g: scaling.Growth) -> float:
        return g.scalar / g.operations

    def whole(*steps: str) -> float:
        return sum(getattr(last, step) for step in ("derive", *steps))

    return [
        Bound(f"{at}: machine code", 5, lambda: forty.scalar, " s"),
        Bound(f"{at}: machine code of many states", 5, lambda: forty.batch, " s"),
        Bound(f"{at}: C compiled", 5, lambda: forty.compile, " s"),
        Bound(
            f"time an operation, {most} over {first.operations}",
            1.3,
            lambda: an_operation(last) / an_operation(first),
        ),
        Bound(f"{most}, derived and compiled to machine code", 15, lambda: whole("scalar"), " s"),
        Bound(f"{most}, derived, written as C and compiled", 15, lambda: whole("generate", "compile"), " s"),
        Bound(f"{most}: memory", 1, lambda: max(last.memory, last.compiler_memory), " GB"),
    ]


if __name__ == "__main__":
    main()
