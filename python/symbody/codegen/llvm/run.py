"""Runs: sines and cosines that follow one another and don't wait for one another, so that they are taken together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from math import inf

from symbody.codegen.straight_line.code import Code

__all__ = ["are_inlined", "segments"]

MOST_RUNS, MOST_PACKS = 16, 64
"""Runs of a function, and vectors of angles in them, up to which sines and cosines become a part of its code.

Each run has a branch for large angles, and its constants wait in registers for the next run: the time to allocate
registers grows as the square of the number of runs. Called instead, a sine compiles in a tenth of a millisecond.
Chains of sixteen and more run as fast; sines that are independent of one another take 4/3 of the time.
"""


def segments(code: Code, rows: Sequence[int], most: float = inf) -> Iterator[tuple[bool, list[int]]]:
    """Return the rows in their order, runs of sines and cosines (true) apart from what lies between them (false).

    Args:
        code: what the rows belong to.
        rows: the numbers of instructions.
        most: how many angles a run has at most.
    """
    for is_wave, group in groupby(rows, key=lambda k: code.instructions[k][0] in {"sin", "cos"}):
        if is_wave:
            yield from ((True, run) for run in _runs(code, group, most))
        else:
            yield False, list(group)


def are_inlined(code: Code, rows: Sequence[int], size: int) -> bool:
    """Whether the sines and cosines of rows become a part of the code, if so many angles fill a vector."""
    runs = [run for is_wave, run in segments(code, rows) if is_wave]
    packs = [-(-len({code.instructions[k][1] for k in run}) // size) for run in runs]
    return len(packs) <= MOST_RUNS and sum(packs) <= MOST_PACKS


def _runs(code: Code, rows: Iterator[int], most: float) -> Iterator[list[int]]:
    run: list[int] = []
    angles: set[int] = set()
    made: set[int] = set()
    for k in rows:
        angle = code.instructions[k][1]
        if angle in made or (len(angles) == most and angle not in angles):
            yield run
            run, angles, made = [], set(), set()
        run.append(k)
        angles.add(angle)
        made.add(code.first_instruction + k)
    yield run
