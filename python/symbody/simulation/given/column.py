"""The numbers given for one variable."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, ParameterError, SymbodyError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

__all__ = ["Column", "column_of"]

Column = NDArray[np.float64]
"""A number, or a row of numbers with one for each motion: an array of shape () or (k,)."""


def column_of(name: Expr, values: ArrayLike, place: str) -> Column:
    """Return a number, or a row of numbers, as an array of doubles."""
    try:
        array = np.asarray(values)
        if array.dtype.kind in "iuf" or (array.dtype.kind == "O" and all(x is not None for x in array.flat)):
            return array.astype(np.float64)
    except OverflowError:
        raise ParameterError(f"{place}: {name} is beyond the largest double, 1.8e308") from None
    except (ValueError, TypeError, SymbodyError):
        pass
    raise ArgumentError(
        f"{place}: the value of {name}: {described(values)}; expected a number, or a row of numbers"
    )
