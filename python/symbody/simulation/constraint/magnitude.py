"""Magnitudes of sums: the sums of the absolute values of their terms, to which rounding errors are proportional."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.symbolic import Expr
from symbody.symbolic.calculus.summands import summands

__all__ = ["MeasuredFunction", "magnitudes", "measured"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MeasuredFunction:
    """A compiled function whose last output are the terms of sums, of which it returns the magnitudes.

    Terms are numbers when their absolute values are taken: the absolute value of an expression takes long, because the
    signs of its factors are looked for.
    """

    function: CompiledFunction
    counts: tuple[int, ...]

    def __call__(self, *arguments: ArrayLike) -> Any:
        """Return the outputs, and the magnitudes of the sums."""
        return self._summed(self.function(*arguments))

    def at_few_points(self, *arguments: ArrayLike) -> Any:
        """Return the same at any number of points as at one: to the same digits."""
        return self._summed(self.function.at_few_points(*arguments))

    def _summed(self, outputs: Any) -> Any:
        *others, values = outputs
        return (*others, magnitudes(values, self.counts))


def measured(
    arguments: Sequence[Expr | list[Expr]], outputs: Sequence[Any], sums: Sequence[Expr]
) -> MeasuredFunction:
    """Return a function of some arguments that returns outputs, and the magnitudes of sums."""
    found = [summands(each) for each in sums]
    flat = [term for row in found for term in row]
    return MeasuredFunction(lambdify(arguments, [*outputs, flat]), tuple(map(len, found)))


def magnitudes(values: Array, counts: Sequence[int]) -> Array:
    """Return the sums of absolute values of as many terms each, along the first axis."""
    starts = [0, *accumulate(counts)][:-1]
    absolute = np.abs(values)
    return np.add.reduceat(absolute, starts, axis=0) if starts else absolute
