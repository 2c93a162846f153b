"""Linear systems of deficient rank, met at run time: noted by the kernel, told to the user."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence
from threading import Lock

from symbody.errors import ModelNotice
from symbody.symbolic.kernel import take_deficiencies

__all__ = ["SYSTEMS", "notice_deficiencies"]

SYSTEMS = 16
"""Bits of a tag that number the linear systems of one function."""

_lock = Lock()
_noted: dict[int, set[tuple[int, tuple[int, ...]]]] = {}


def notice_deficiencies(tags: Iterable[int], names: Sequence[str] = (), where: str = "lambdify") -> None:
    """Warn of the systems of functions in which equations followed from others since the last call, of each once.

    Args:
        tags: what tells the functions from others, with :data:`SYSTEMS` low bits zero.
        names: the names of the equations, by row.
        where: the function that the user called.
    """
    taken = {deficiency for tag in tags for deficiency in _taken(tag >> SYSTEMS)}
    for number, rows in sorted(taken):
        noun = "equation" if len(rows) == 1 else "equations"
        listed = ", ".join(names[row] if row < len(names) else f"number {row + 1}" for row in rows)
        verb = "follows from the others" if len(rows) == 1 else "follow from the others"
        warnings.warn(
            f"{where}: linear system {number + 1} of the function is of deficient rank at some points: {noun} "
            f"{listed} {verb} there; its solution of least norm was taken",
            ModelNotice,
            stacklevel=4,
        )


def _taken(function: int) -> set[tuple[int, tuple[int, ...]]]:
    """Return what was noted for one function; what was noted for others waits for them."""
    with _lock:
        for tag, rows in take_deficiencies():
            noted = (tag & ((1 << SYSTEMS) - 1), tuple(rows))
            _noted.setdefault(tag >> SYSTEMS, set()).add(noted)
        return _noted.pop(function, set())
