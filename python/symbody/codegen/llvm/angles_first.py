"""The order in which compiled code takes sines and cosines: all those that can be taken together, at once."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["angles_first"]


def angles_first(reads: Sequence[Sequence[int]], trigonometric: Sequence[bool], first: int) -> list[int]:
    """Return the instructions with the sines and cosines of known angles first, then those of further angles.

    A processor takes several angles in the time of one, if they come one after another.

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
    """Return the sines and cosines by how many of them are taken of one another up to each."""
    depths = _depths(reads, trigonometric, first)
    levels: list[list[int]] = [[] for _ in range(max(depths, default=0))]
    for k, is_wave in enumerate(trigonometric):
        if is_wave:
            levels[depths[k] - 1].append(k)
    return levels


def _depths(reads: Sequence[Sequence[int]], trigonometric: Sequence[bool], first: int) -> list[int]:
    """Return how many sines and cosines are taken of one another up to each instruction."""
    depths: list[int] = []
    for places, is_wave in zip(reads, trigonometric, strict=True):
        below = max((depths[place - first] for place in places if place >= first), default=0)
        depths.append(below + is_wave)
    return depths


def _below(level: Sequence[int], reads: Sequence[Sequence[int]], placed: list[bool], first: int) -> list[int]:
    """Place what the instructions need and return it, in its order."""
    needed: set[int] = set()
    stack = [place - first for k in level for place in reads[k]]
    while stack:
        k = stack.pop()
        if k >= 0 and not placed[k]:
            placed[k] = True
            needed.add(k)
            stack += [place - first for place in reads[k]]
    return sorted(needed)
