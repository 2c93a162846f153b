"""Contradictory linear equations: combinations whose left sides cancel, but not the right sides."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.multibody import Constraint
from symbody.multibody.named_constraint import named_constraints
from symbody.symbolic.given.wording import joined_by_and

from .vanishing_combinations import vanishing_combinations

__all__ = ["INCONSISTENT", "cancelling_combinations", "contradiction_between", "contradictory_equations"]

Array = NDArray[np.float64]

CANCELLED = 1e-9
"""The relative size below which a combination of left sides counts as zero."""
INCONSISTENT = 1e-6
"""The relative residual above which a combination fails; numbers with seven digits are off by as much."""


def cancelling_combinations(A: Array) -> list[Array]:
    """Return the combinations of rows that cancel. The rows may have different units."""
    scale = np.abs(A).max(axis=1, initial=0.0, keepdims=True)
    scale = np.where(scale > 0, scale, 1.0)
    return [combination / scale[:, 0] for combination in vanishing_combinations(A / scale, CANCELLED)]


def contradictory_equations(A: Array, b: Array, terms: Array) -> tuple[int, ...]:
    """Return the rows of ``A x = b`` that combine to ``0 = r`` with an r larger than rounding.

    Args:
        A: the left sides.
        b: the right sides.
        terms: the magnitudes of the terms.
    """
    for y in cancelling_combinations(A):
        if abs(y @ b) > INCONSISTENT * np.abs(y) @ terms:
            return tuple(int(row) for row in np.flatnonzero(y))
    return ()


def contradiction_between(constraints: Sequence[Constraint], rows: Iterable[int]) -> str:
    """Return which constraints contradict each other, and the way out."""
    names = named_constraints(constraints, rows)
    if len(names) == 1:
        return f"constraint {names[0]} can't be satisfied there by any motion; correct it"
    return (
        f"constraints {joined_by_and(names)} contradict each other: they require different motions of the same "
        "coordinates; correct them, or leave out those that should follow from the others"
    )
