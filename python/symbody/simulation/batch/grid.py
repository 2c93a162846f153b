"""Grids: all combinations of some values."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.given.column import column_of
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described, with_known_names


@with_known_names
def grid(axes: Mapping[Expr, ArrayLike]) -> dict[Expr, NDArray[np.float64]]:
    """Return all combinations of values: the Cartesian product, as an array of shape (k,) for each name.

    The last name changes fastest, so results of shape (k, ...) have the shape of the grid after
    ``result.reshape(n1, n2, ..., -1)``.

    Args:
        axes: the values of each parameter, coordinate or speed; a number is one value.

    Raises:
        ParameterError: there are no names, or a name has no values.
        ArgumentError: a key is not a variable, or values are not numbers.

    >>> from symbody import functions_of_time, symbols
    >>> m, theta = symbols("m"), functions_of_time("theta")
    >>> grid({m: [1, 2], theta: [0.1, 0.2, 0.3]})
    {m: array([1., 1., 1., 2., 2., 2.]), theta: array([0.1, 0.2, 0.3, 0.1, 0.2, 0.3])}
    """
    if not _is_named(axes):
        raise ArgumentError(
            f"grid: {described(axes)}; expected names with their values, such as {{m: [1, 2], theta: [0.1, 0.2]}}"
        )
    if not axes:
        raise ParameterError("grid: no names; give at least one with its values")
    rows = [_row(name, values) for name, values in axes.items()]
    product = np.meshgrid(*rows, indexing="ij")
    return {name: values.reshape(-1) for name, values in zip(axes, product, strict=True)}


def _is_named(axes: object) -> bool:
    return isinstance(axes, Mapping) and all(isinstance(name, Expr) and name.is_variable for name in axes)


def _row(name: Expr, values: ArrayLike) -> NDArray[np.float64]:
    row = column_of(name, values, "grid")
    if row.ndim > 1 or row.size == 0:
        found = "has no values" if row.size == 0 else f"has values of shape {row.shape}"
        raise ParameterError(f"grid: {name} {found}; expected a row of at least one number")
    return np.atleast_1d(row)
