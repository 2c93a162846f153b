"""How messages put names into sentences."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["joined_by_and"]


def joined_by_and(names: Sequence[str], most: int = 6, last: str = "and") -> str:
    """Return names joined by commas and "and", or another last word, and how many more there are.

    >>> joined_by_and(["1", "2", "3"]), joined_by_and(["1", "2", "3"], most=1)
    ('1, 2 and 3', '1 and 2 more')
    """
    shown = [*names[:most], *([f"{len(names) - most} more"] if len(names) > most else [])]
    return f" {last} ".join(filter(None, [", ".join(shown[:-1]), shown[-1]]))
