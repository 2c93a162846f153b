"""Sums over subsets, sharing the sums of their last items."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar, final

Item = TypeVar("Item")


@final
class SubsetSum(Generic[Item]):
    """Sums of subsets of items; a subset is an integer whose bits say which items are in it.

    The sum of a subset adds its first item to the sum of the others. Subsets that end with the same items, such as all
    bodies from the k-th on, share their sums: running sums.
    """

    def __init__(self, items: Sequence[Item], add: Callable[[Item, Item], Item]) -> None:
        self._items = items
        self._add = add
        self._sums: dict[int, Item] = {1 << k: item for k, item in enumerate(items)}

    def __call__(self, subset: int) -> Item:
        """Return the sum of a subset that isn't empty."""
        pending = []
        while subset not in self._sums:
            pending.append(subset)
            subset &= subset - 1
        total = self._sums[subset]
        for larger in reversed(pending):
            first = (larger & -larger).bit_length() - 1
            total = self._sums[larger] = self._add(self._items[first], total)
        return total
