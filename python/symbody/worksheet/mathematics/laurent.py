"""Series about a pole or a removable singularity, by SymPy."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, from_sympy, to_sympy

from .sympy_refusal import SYMPY_REFUSALS

__all__ = ["laurent_series"]


def laurent_series(value: Expr, variable: Expr, point: Expr, count: int) -> Expr:
    """Return the terms of a Laurent series whose exponent is below a number.

    Args:
        value: the expression.
        variable: the variable of the series.
        point: where it is developed.
        count: the number.
    """
    try:
        import sympy  # noqa: PLC0415 - optional
    except ImportError as error:
        raise WorksheetError("series: about a pole, it needs SymPy; pip install symbody[sympy]") from error
    try:
        found = sympy.series(to_sympy(value), to_sympy(variable), to_sympy(point), count)
        made = from_sympy(found.removeO())
    except SYMPY_REFUSALS as error:
        raise WorksheetError(f"series: no series about {variable} = {point} was found: {error}") from error
    if not isinstance(made, Expr):
        raise WorksheetError(f"series: no series about {variable} = {point} was found")
    return made
