"""Results of the routines of a program: scalars, vectors and matrices under their names."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.equations.output import Output
from symbody.errors import ArgumentError, ExpressionError, ProgramError
from symbody.geometry import Vector
from symbody.symbolic import Expr, ExprLike, Matrix, Result, number
from symbody.symbolic.given.arguments import brief


def output_result(name: str, value: Output) -> Result:
    """Return an output as a result of a routine.

    Raises:
        ProgramError: it is not an expression, a vector, a matrix or a list of expressions.
    """
    if isinstance(value, Matrix):
        return matrix_result(name, value)
    if isinstance(value, Vector):
        return vector_result(name, value.components, f"components in {value.frame}")
    if isinstance(value, Sequence) and not isinstance(value, str):
        return vector_result(name, [_scalar(name, entry) for entry in value])
    expression = _scalar(name, value)
    return Result(name, _shown(expression), (expression,), ())


def _scalar(name: str, value: ExprLike) -> Expr:
    try:
        return number(value)
    except (ArgumentError, ExpressionError) as failure:
        raise ProgramError(
            f"program: the output {name} is or holds {brief(repr(value))}; expected an expression, a vector, a "
            "matrix or a list of expressions"
        ) from failure


def _shown(expression: Expr) -> str:
    text = str(expression)
    return text if len(text) <= _SHORT else ""


_SHORT = 60
"""Characters of an expression that a comment may repeat."""


def vector_result(name: str, values: Sequence[Expr], meaning: str = "") -> Result:
    """Return a result of n values, of the shape (n,)."""
    return Result(name, meaning, tuple(values), (len(values),))


def matrix_result(name: str, matrix: Matrix, meaning: str = "") -> Result:
    """Return a result of the shape of a matrix."""
    return Result(name, meaning, matrix.entries, matrix.shape)
