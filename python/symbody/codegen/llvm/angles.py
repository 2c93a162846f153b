"""Sines and cosines that are computed together: the order that brings them next to each other, and runs of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from math import inf

from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.instruction import WAVES

__all__ = ["MOST_RUNS", "angles_first", "are_inlined", "segments"]

MOST_RUNS, MOST_PACKS = 16, 64
"""The largest numbers of runs in a function, and of vectors of angles in them, for which sines are inlined.

Each run has a branch for large angles, and its constants wait in registers for the next run: the time to allocate
registers grows as the square of the number of runs. A call of a sine instead compiles in a tenth of a millisecond.
Chains of sixteen and more are as fast with calls; sines that are independent of one another take 4/3 of the time.
"""


def angles_first(reads: Sequence[Sequence[int]], trigonometric: Sequence[bool], first: int) -> list[int]:
    """Return the order of the instructions with sines and cosines of known angles first, then those of further angles.

    A processor computes several sines in the time of one, if they follow one another.

    Args:
        reads: the places that each instruction reads.
        trigonometric: whether it is a sine or a cosine.
        first: the place of the first instruction's result; the others follow.

    >>> angles_first([[0], [1, 0], [0], [2, 3]], [True, False, True, False], first=1)
    [0, 2, 1, 3]
    """
    order: list[int] = []
    placed = [False] * len(reads)
    for level in _levels(reads, trigonometric, first):
        order += _below(level, reads, placed, first)
        order += sorted(level, key=lambda k: (reads[k][0], k))
        for k in level:
            placed[k] = True
    return order + [k for k, is_placed in enumerate(placed) if not is_placed]


def _levels(reads: Sequence[Sequence[int]], trigonometric: Sequence[bool], first: int) -> list[list[int]]:
    """Return the sines and cosines by nesting depth."""
    depths = _depths(reads, trigonometric, first)
    levels: list[list[int]] = [[] for _ in range(max(depths, default=0))]
    for k, is_wave in enumerate(trigonometric):
        if is_wave:
            levels[depths[k] - 1].append(k)
    return levels


def _depths(reads: Sequence[Sequence[int]], trigonometric: Sequence[bool], first: int) -> list[int]:
    """Return the nesting depth of sines and cosines at each instruction."""
    depths: list[int] = []
    for places, is_wave in zip(reads, trigonometric, strict=True):
        below = max((depths[place - first] for place in places if place >= first), default=0)
        depths.append(below + is_wave)
    return depths


def _below(level: Sequence[int], reads: Sequence[Sequence[int]], placed: list[bool], first: int) -> list[int]:
    """Place the instructions that those of a level need, and return them in their order."""
    needed: set[int] = set()
    stack = [place - first for k in level for place in reads[k]]
    while stack:
        k = stack.pop()
        if k >= 0 and not placed[k]:
            placed[k] = True
            needed.add(k)
            stack += [place - first for place in reads[k]]
    return sorted(needed)


def segments(code: Code, rows: Sequence[int], most: float = inf) -> list[tuple[bool, list[int]]]:
    """Return the rows in their order, divided into runs of sines and cosines (true) and what lies between (false).

    Args:
        code: what the rows belong to.
        rows: the numbers of instructions.
        most: how many angles a run has at most.
    """
    found: list[tuple[bool, list[int]]] = []
    for is_wave, group in groupby(rows, key=lambda k: code.instructions[k].operation in WAVES):
        if is_wave:
            found += [(True, run) for run in _runs(code, group, most)]
        else:
            found.append((False, list(group)))
    return found


def are_inlined(code: Code, rows: Sequence[int], size: int) -> bool:
    """Whether the sines and cosines of the rows are inlined, if ``size`` angles fill a vector."""
    runs = [run for is_wave, run in segments(code, rows) if is_wave]
    packs = [-(-len({code.instructions[k].reads for k in run}) // size) for run in runs]
    return len(packs) <= MOST_RUNS and sum(packs) <= MOST_PACKS


def _runs(code: Code, rows: Iterable[int], most: float) -> list[list[int]]:
    """Return consecutive sines and cosines in runs; in a run, none depends on another one."""
    runs: list[list[int]] = [[]]
    angles: set[int] = set()
    made: set[int] = set()
    for k in rows:
        (angle,) = code.instructions[k].reads
        if angle in made or (len(angles) == most and angle not in angles):
            runs.append([])
            angles, made = set(), set()
        runs[-1].append(k)
        angles.add(angle)
        made.add(code.first_instruction + k)
    return runs
