"""Statistics over many motions, computed part by part: the partial results are merged in a fixed order."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Partial", "Statistic"]

Array: TypeAlias = NDArray[np.float64]

Partial: TypeAlias = Mapping[str, NDArray[Any]]
"""What is known of the cases so far: arrays by name, so that it can be sent and stored."""


@dataclass(frozen=True)
class Statistic(ABC):
    """A statistic of q outputs at N instants over any number of cases, whose partial results can be merged."""

    numbers: ClassVar[int] = 4
    """About how many numbers a partial result has for each output and instant."""

    @abstractmethod
    def of(self, values: Array, first: int) -> Partial:
        """Return the partial result of some cases.

        Args:
            values: the outputs, shape (k, q, N); NaN where a motion has ended.
            first: the number of the first of these cases.
        """

    @abstractmethod
    def merged(self, one: Partial, other: Partial) -> Partial:
        """Return the partial result of two sets of cases, of which the first come before the others."""

    @abstractmethod
    def columns(self, partial: Partial, names: Sequence[str]) -> dict[str, Array]:
        """Return what the statistic says, by name: arrays of shape (q, N), NaN where no motion has a value.

        Args:
            partial: the merged result of all cases.
            names: the names of the outputs.
        """
