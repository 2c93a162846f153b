"""Cases: the parameters and initial values of many motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.given.column import Column, column_of
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

from .drawn_columns import Drawn, DrawnColumns, some_of

Values: TypeAlias = Mapping[Expr, ArrayLike] | Sequence[Mapping[Expr, float]]
"""Values by name: numbers and rows of numbers, or a list with one dictionary of numbers for each motion."""

PLACE = "simulate_many"
"""The function that messages name."""


@dataclass(frozen=True, eq=False)
class Cases:
    """The numbers in which the motions of a batch differ: for each name, an array with one value per motion.

    Attributes:
        parameters: the values of parameters.
        initial: the given values of coordinates and speeds at the first instant.
        count: the number of motions, k.
    """

    parameters: Mapping[Expr, Column]
    initial: Mapping[Expr, Column]
    count: int

    def subset(self, indices: NDArray[np.intp]) -> Cases:
        """Return some of the cases, in order and without a gap if their values are drawn."""
        return Cases(some_of(self.parameters, indices), some_of(self.initial, indices), len(indices))

    def parameters_of(self, case: int) -> dict[Expr, float]:
        """Return the parameters of one motion."""
        return {name: float(values[0]) for name, values in some_of(self.parameters, np.array([case])).items()}

    def initial_of(self, case: int) -> dict[Expr, float]:
        """Return the given initial values of one motion."""
        return {name: float(values[0]) for name, values in some_of(self.initial, np.array([case])).items()}


def cases_of(
    parameters: Values | None,
    initial: Values | None,
    cases: Values | Drawn | None = None,
    place: str = PLACE,
) -> Cases:
    """Return the cases. A number holds for all of them, an array has a value for each.

    Args:
        parameters: values of symbols.
        initial: values of coordinates, their rates and speeds.
        cases: both together, such as a `grid`: symbols are parameters, functions of time are initial values; drawn in
            blocks when they are needed, or a table.
        place: the function that the user called.

    Raises:
        ParameterError: arrays differ in length, one is empty, or a name is given twice.
        ArgumentError: an argument is neither a dictionary nor a list of dictionaries, a key is not a variable, or a
            value is neither a number nor a row of numbers.
    """
    drawn = cases if isinstance(cases, Drawn) else None
    given = {
        "parameters": _rows(parameters, f"{place}, parameters"),
        "initial": _rows(initial, f"{place}, initial"),
    }
    names: dict[str, list[Expr]] = {"parameters": [], "initial": []}
    rows = dict.fromkeys(drawn.names) if drawn is not None else _rows(cases, f"{place}, cases")
    for name, values in rows.items():
        kind = "parameters" if _variable(name, f"{place}, cases").kind == "symbol" else "initial"
        if name in given[kind]:
            raise ParameterError(
                f"{place}: {name} is given in {kind} and in cases; leave it out of one of them"
            )
        names[kind].append(name)
        if drawn is None:
            given[kind][name] = values
    columns = {
        kind: {
            _variable(name, f"{place}, {kind}"): _column(name, values, f"{place}, {kind}")
            for name, values in mapping.items()
        }
        for kind, mapping in given.items()
    }
    lengths = [(str(name), column) for mapping in columns.values() for name, column in mapping.items()]
    if drawn is not None:
        lengths.append(("the sample", np.broadcast_to(0.0, len(drawn))))
    count = _count(lengths, place)
    whole = {
        kind: {name: _spread(c, count) for name, c in mapping.items()} for kind, mapping in columns.items()
    }
    if drawn is None:
        return Cases(whole["parameters"], whole["initial"], count)
    own = {kind: DrawnColumns(whole[kind], tuple(names[kind]), drawn) for kind in whole}
    return Cases(own["parameters"], own["initial"], count)


def _rows(given: object, place: str) -> dict[Any, Any]:
    """Return values by name; a list of dictionaries gives a row for each name."""
    if given is None:
        return {}
    if isinstance(given, Mapping):
        return dict(given)
    if not isinstance(given, list | tuple) or not given or not all(isinstance(one, Mapping) for one in given):
        raise ArgumentError(
            f"{place}: {described(given)}; expected a dictionary of variables and their values, or a list of "
            "dictionaries, one for each motion"
        )
    names = list(given[0])
    for case, one in enumerate(given):
        if set(one) != set(names):
            different = ", ".join(sorted(map(str, set(one) ^ set(names))))
            raise ParameterError(
                f"{place}: the dictionaries of cases 0 and {case} differ by {different}; expected the same "
                "variables in all of them"
            )
    return {name: [one[name] for one in given] for name in names}


def _variable(name: object, place: str) -> Expr:
    if isinstance(name, Expr) and name.is_variable:
        return name
    raise ArgumentError(f"{place}: {described(name)}; expected a symbol or a function of time as a key")


def _column(name: Expr, values: ArrayLike, place: str) -> Column:
    column = column_of(name, values, place)
    if column.ndim > 1:
        raise ParameterError(
            f"{place}: {name} has values of shape {column.shape}; expected a number, or a row of numbers with "
            "one for each case. For all combinations of several rows use cases=grid({...})"
        )
    if column.size == 0:
        raise ParameterError(f"{place}: {name} has no values, so there is nothing to run; give at least one")
    return column


def _count(columns: Sequence[tuple[str, Column]], place: str) -> int:
    """Return the number of cases: the length of all arrays."""
    lengths = [(name, len(column)) for name, column in columns if column.ndim == 1]
    if len({length for _, length in lengths}) > 1:
        found = ", ".join(f"{name} has {length}" for name, length in lengths)
        raise ParameterError(
            f"{place}: arrays of different lengths ({found}); expected one value for each case in every array, or "
            "a number for all cases. For all combinations use cases=grid({...})"
        )
    return lengths[0][1] if lengths else 1


def _spread(column: Column, count: int) -> Column:
    """Return the values of all cases, which can't be changed; a number takes no memory for each case."""
    if column.ndim == 0:
        return np.broadcast_to(column, count)
    spread = column.copy()
    spread.flags.writeable = False
    return spread
