"""Cuts of straight-line code into blocks, so that compilers take linear time, and the values that cross the cuts."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

__all__ = ["Cut", "cut"]


@dataclass(frozen=True)
class Cut:
    """The places at which code is cut.

    Attributes:
        starts: the number of the first instruction of each block, then the number of instructions.
        slots: the slot in the workspace of each value that a later block reads, by place.
        size: the number of slots.
    """

    starts: tuple[int, ...]
    slots: Mapping[int, int]
    size: int


def cut(reads: Sequence[Sequence[int]], first: int, limit: int | None, held: Collection[int] = ()) -> Cut:
    """Cut code into blocks of at most ``limit`` instructions, at boundaries that few values cross.

    Args:
        reads: the places that each instruction reads.
        first: the place of the first instruction's result; the others follow.
        limit: the largest size of a block; None for a single block.
        held: places that need no slot, since their values are kept elsewhere.

    >>> cut([[0, 0], [1], [2], [1, 3]], first=1, limit=2)
    Cut(starts=(0, 1, 3, 4), slots={1: 0, 3: 1}, size=2)
    """
    ends = _last_readers(reads, first)
    starts = _starts(len(reads), ends, first, limit)
    crossing = [
        place
        for place, end in sorted(ends.items())
        if place not in held and bisect_right(starts, place - first) < bisect_right(starts, end)
    ]
    return Cut(tuple(starts), *_slots(crossing, ends, starts, first))


def _last_readers(reads: Sequence[Sequence[int]], first: int) -> dict[int, int]:
    """Return the number of the last instruction that reads each result."""
    return {place: reader for reader, places in enumerate(reads) for place in places if place >= first}


def _starts(count: int, ends: Mapping[int, int], first: int, limit: int | None) -> list[int]:
    if limit is None or count <= limit:
        return [0, count]
    change = [0] * (count + 1)
    for place, end in ends.items():
        change[place - first + 1] += 1
        change[min(end + 1, count)] -= 1
    live = list(accumulate(change))
    starts = [0]
    while count - starts[-1] > limit:
        low, high = starts[-1] + max(1, 3 * limit // 4), starts[-1] + limit
        starts.append(min(range(low, high + 1), key=lambda boundary: (live[boundary], -boundary)))
    return [*starts, count]


def _slots(
    crossing: Sequence[int], ends: Mapping[int, int], starts: Sequence[int], first: int
) -> tuple[dict[int, int], int]:
    """Assign slots; a slot is free again in the block after the last reader of its value."""
    slots: dict[int, int] = {}
    free: list[int] = []
    freed_after: dict[int, list[int]] = {}
    size, block = 0, 0
    for place in crossing:
        own = bisect_right(starts, place - first) - 1
        while block < own:
            free += freed_after.pop(block, [])
            block += 1
        if not free:
            free, size = [size], size + 1
        slots[place] = free.pop()
        freed_after.setdefault(bisect_right(starts, ends[place]) - 1, []).append(slots[place])
    return slots, size
