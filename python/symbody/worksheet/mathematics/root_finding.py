"""Roots in numbers: Newton's method with a line search, from several starts."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, TypeAlias

from symbody.deferred import Deferred
from symbody.symbolic import Expr, jacobian

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")


__all__ = ["newton"]

Column: TypeAlias = "NDArray[np.float64]"
Bounds = tuple[float, float] | None
ValueAt: TypeAlias = Callable[[Expr, Mapping[Expr, float]], float]

_TOLERANCE = 1e-12
_STARTS = 200
_STEP = 1e-5
"""Of central differences, of functions that have some ten digits."""


def newton(
    residuals: list[Expr],
    unknowns: list[Expr],
    starts: list[float | None],
    ranges: list[Bounds],
    value_at: ValueAt | None = None,
) -> list[float] | None:
    """Return a root within the ranges, or None; the starts are fixed, so that the result is always the same.

    Args:
        residuals: what is zero.
        unknowns: what is looked for.
        starts: where to begin, if it is given.
        ranges: the bounds, if they are given.
        value_at: gives a residual at numbers, if its derivative is not known; differences stand for it.
    """
    slopes = jacobian(residuals, unknowns) if value_at is None else None
    entries = list(slopes.entries) if slopes is not None else []

    def evaluate(expressions: list[Expr], x: Column) -> Column:
        values = dict(zip(unknowns, map(float, x), strict=True))
        return np.array([(value_at or Expr.evaluate)(each, values) for each in expressions])

    def slope(x: Column) -> Column:
        if value_at is None:
            return evaluate(entries, x).reshape(len(residuals), len(unknowns))
        columns = [
            evaluate(residuals, x + step) - evaluate(residuals, x - step) for step in _STEP * np.eye(len(x))
        ]
        return np.array(columns).T / (2 * _STEP)

    for start in itertools.islice(_candidates(starts, ranges), _STARTS):
        found = _iterated(lambda x: evaluate(residuals, x), slope, np.array(start))
        if found is None:
            continue
        if all(
            each is None or each[0] - 1e-9 <= x <= each[1] + 1e-9
            for x, each in zip(found, ranges, strict=True)
        ):
            return [0.0 if abs(x) < 1e-14 else float(x) for x in found]
    return None


def _candidates(starts: list[float | None], ranges: list[Bounds]) -> Iterator[list[float]]:
    chance = random.Random(1)
    middle = [
        start if start is not None else (sum(bounds) / 2 if bounds else 0.0)
        for start, bounds in zip(starts, ranges, strict=True)
    ]
    yield middle
    yield [m + 0.1 * (i + 1) / len(middle) for i, m in enumerate(middle)]
    width = 1.0
    while True:
        yield [
            chance.uniform(*bounds) if bounds else m + chance.uniform(-width, width)
            for m, bounds in zip(middle, ranges, strict=True)
        ]
        width = min(width * 1.1, 1e4)


def _iterated(
    function: Callable[[Column], Column], slope: Callable[[Column], Column], x: Column
) -> Column | None:
    try:
        value = function(x)
        for _ in range(60):
            size = np.linalg.norm(value)
            if not np.isfinite(size):
                return None
            new, new_value = x, value
            step = np.linalg.lstsq(slope(x), -value, rcond=None)[0]
            factor = 1.0
            while factor > 1e-6:
                new = x + factor * step
                new_value = function(new)
                if np.linalg.norm(new_value) < size or size == 0:
                    break
                factor /= 2
            else:
                return x if size < 1e-9 else None
            x, value = new, new_value
            if (
                np.linalg.norm(factor * step) <= _TOLERANCE * (1 + np.linalg.norm(x))
                and np.linalg.norm(value) < 1e-8
            ):
                return x
    except (ArithmeticError, ValueError, np.linalg.LinAlgError):
        return None
    return x if np.linalg.norm(value) < 1e-9 else None
