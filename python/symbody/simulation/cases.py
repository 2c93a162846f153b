"""Cases: the parameters and initial values of many motions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, ParameterError, SymbodyError
from symbody.symbolic import Expr
from symbody.symbolic.arguments import described

Column = NDArray[np.float64]

PLACE = "simulate_many"
"""Whose arguments the messages speak of."""


@dataclass(frozen=True, eq=False)
class Cases:
    """What tells the motions of a batch apart: for each name an array with a value for each motion.

    Attributes:
        parameters: the values of parameters.
        initial: the values of coordinates and speeds at the first instant, as far as they are given.
        count: how many motions there are.
    """

    parameters: dict[Expr, Column]
    initial: dict[Expr, Column]
    count: int

    def some(self, indices: NDArray[np.intp]) -> Cases:
        """Return some of the cases."""
        parameters = {name: values[indices] for name, values in self.parameters.items()}
        initial = {name: values[indices] for name, values in self.initial.items()}
        return Cases(parameters, initial, len(indices))

    def parameters_of(self, case: int) -> dict[Expr, float]:
        """Return the parameters of one motion."""
        return {name: float(values[case]) for name, values in self.parameters.items()}

    def initial_of(self, case: int) -> dict[Expr, float]:
        """Return what is given of the initial state of one motion."""
        return {name: float(values[case]) for name, values in self.initial.items()}


def cases_of(
    parameters: Mapping[Expr, ArrayLike] | None,
    initial: Mapping[Expr, ArrayLike] | None,
    cases: Mapping[Expr, ArrayLike] | None = None,
) -> Cases:
    """Return the cases of numbers, which hold for all, and of arrays, with a value for each.

    Args:
        parameters: values of symbols.
        initial: values of coordinates, their rates and speeds.
        cases: both together, such as a `grid`: symbols are parameters, functions of time belong to the state.

    Raises:
        ParameterError: arrays of different lengths, an empty one, or a name that is given twice.
        ArgumentError: a key that is no variable, or a value that is no number and no row of numbers.
    """
    given = {"parameters": dict(parameters or {}), "initial": dict(initial or {})}
    for name, values in (cases or {}).items():
        kind = "parameters" if _variable(name, "cases").kind == "symbol" else "initial"
        if name in given[kind]:
            raise ParameterError(
                f"{PLACE}: {name} stands in {kind} and in cases; leave it out of one of them"
            )
        given[kind][name] = values
    columns = {
        kind: {_variable(name, kind): _column(name, values, kind) for name, values in mapping.items()}
        for kind, mapping in given.items()
    }
    count = _count({name: column for mapping in columns.values() for name, column in mapping.items()})
    whole = {
        kind: {name: _spread(c, count) for name, c in mapping.items()} for kind, mapping in columns.items()
    }
    return Cases(whole["parameters"], whole["initial"], count)


def column_of(name: Expr, values: ArrayLike, place: str) -> Column:
    """Return a number, or a row of numbers, as an array of doubles."""
    try:
        array = np.asarray(values)
        if array.dtype.kind in "iuf" or (array.dtype.kind == "O" and all(x is not None for x in array.flat)):
            return array.astype(np.float64)
    except (ValueError, TypeError, SymbodyError):
        pass
    raise ArgumentError(
        f"{place}: the value of {name}: {described(values)}; expected a number, or a row of numbers"
    )


def _variable(name: object, kind: str) -> Expr:
    if isinstance(name, Expr) and name.is_variable:
        return name
    raise ArgumentError(
        f"{PLACE}, {kind}: {described(name)}; expected a symbol or a function of time, and its values behind it"
    )


def _column(name: Expr, values: ArrayLike, kind: str) -> Column:
    column = column_of(name, values, f"{PLACE}, {kind}")
    if column.ndim > 1:
        raise ParameterError(
            f"{PLACE}, {kind}: {name} has values of shape {column.shape}; expected a number, or a row of numbers with "
            "one for each case. For all combinations of several rows use cases=grid({...})"
        )
    if column.size == 0:
        raise ParameterError(
            f"{PLACE}, {kind}: {name} has no values, so there is nothing to run; give at least one"
        )
    return column


def _count(columns: Mapping[Expr, Column]) -> int:
    """Return how many cases there are: the length of all arrays."""
    lengths = {name: len(column) for name, column in columns.items() if column.ndim == 1}
    if len(set(lengths.values())) > 1:
        found = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise ParameterError(
            f"{PLACE}: arrays of different lengths ({found}); expected one value for each case in every array, or "
            "a number for all cases. For all combinations use cases=grid({...})"
        )
    return next(iter(lengths.values()), 1)


def _spread(column: Column, count: int) -> Column:
    spread = np.array(np.broadcast_to(column, count))
    spread.flags.writeable = False
    return spread
