"""The range of quantities over time, as a notebook shows it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic.expression.html_table import html_table

__all__ = ["range_table"]


def range_table(title: str, kind: str, rows: Iterable[tuple[object, NDArray[np.float64]]]) -> str:
    """Return a table of first, least, largest and last values.

    Args:
        title: the caption.
        kind: the head of the column of names.
        rows: names, and the values at all instants.

    >>> ">0.5</td>" in range_table("", "state", [("x", np.array([0.5, 1, 2]))])
    True
    """
    ranges = ((name, values[0], values.min(), values.max(), values[-1]) for name, values in rows)
    texts: list[Sequence[object]] = [[name, *(f"{value:.6g}" for value in found)] for name, *found in ranges]
    return html_table(title, [kind, "first", "least", "largest", "last"], texts)
