"""Columns of cases that are drawn when they are asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.column import Column
from symbody.symbolic import Expr

__all__ = ["Drawn", "DrawnColumns", "some_of"]


@runtime_checkable
class Drawn(Protocol):
    """A table of cases that is drawn in blocks, such as a `LazySample`."""

    names: tuple[Expr, ...]

    def __len__(self) -> int:
        """Return the number of cases."""

    def block(self, first: int, count: int) -> dict[Expr, NDArray[np.float64]]:
        """Return the values of some cases."""

    def column(self, name: Expr) -> NDArray[np.float64]:
        """Return all values of one variable."""


@dataclass(frozen=True, eq=False)
class DrawnColumns(Mapping[Expr, Column]):
    """Values by name, of which some are drawn again each time.

    Attributes:
        given: the values that are kept, shape (k,) each.
        drawn: the names of the others.
        source: what draws them.
    """

    given: Mapping[Expr, Column]
    drawn: tuple[Expr, ...]
    source: Drawn

    def __len__(self) -> int:
        return len(self.given) + len(self.drawn)

    def __iter__(self) -> Iterator[Expr]:
        yield from (*self.given, *self.drawn)

    def __contains__(self, name: object) -> bool:
        return name in self.given or name in self.drawn

    def __getitem__(self, name: Expr) -> Column:
        return self.source.column(name) if name in self.drawn else self.given[name]


def some_of(columns: Mapping[Expr, Column], indices: NDArray[np.intp]) -> dict[Expr, Column]:
    """Return the values of some cases, in order and without a gap if they are drawn."""
    if not isinstance(columns, DrawnColumns):
        return {name: values[indices] for name, values in columns.items()}
    block = columns.source.block(int(indices[0]), len(indices)) if columns.drawn else {}
    kept = {name: values[indices] for name, values in columns.given.items()}
    return {**kept, **{name: block[name] for name in columns.drawn}}
