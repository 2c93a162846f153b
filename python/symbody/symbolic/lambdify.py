"""Expressions as fast functions of NumPy arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ExpressionError, ParameterError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.leaves import ExprLike, number
from symbody.symbolic.matrix import Matrix

__all__ = ["CompiledFunction", "lambdify"]

#: A structure of outputs: one expression, a sequence of expressions, a matrix, or a sequence of these.
Outputs = Any


@dataclass(frozen=True)
class _Shape:
    """How one result is cut from the flat outputs: its place and its leading dimensions."""

    start: int
    count: int
    dimensions: tuple[int, ...]


@dataclass(frozen=True)
class CompiledFunction:
    """A function of the arguments given to :func:`lambdify`, broadcasting over their trailing axes."""

    arguments: tuple[tuple[Expr, ...] | Expr, ...]
    tape: _core.Tape
    shapes: tuple[_Shape, ...] | _Shape

    def __call__(self, *values: ArrayLike) -> Any:
        """Evaluate. An argument that was a list takes an array with that many rows."""
        inputs = self._columns(values)
        batch = np.broadcast_shapes(*(column.shape for column in inputs)) if inputs else ()
        points = int(np.prod(batch))
        flat = [
            np.ascontiguousarray(c if c.size == 1 else np.broadcast_to(c, batch)).reshape(-1) for c in inputs
        ]
        out = np.empty(self.tape.outputs * points)
        self.tape.evaluate_columns(flat, points, out)
        outputs = out.reshape((self.tape.outputs, *batch))
        if isinstance(self.shapes, _Shape):
            return _cut(outputs, self.shapes)
        return tuple(_cut(outputs, shape) for shape in self.shapes)

    def _columns(self, values: Sequence[ArrayLike]) -> list[NDArray[np.float64]]:
        if len(values) != len(self.arguments):
            raise ParameterError(f"the function takes {len(self.arguments)} arguments, found {len(values)}")
        columns: list[NDArray[np.float64]] = []
        for argument, value in zip(self.arguments, values, strict=True):
            array = np.asarray(value, dtype=np.float64)
            if isinstance(argument, Expr):
                columns.append(array)
                continue
            if array.ndim == 0 or array.shape[0] != len(argument):
                names = ", ".join(map(str, argument[:8])) + (", ..." if len(argument) > 8 else "")
                raise ParameterError(
                    f"the argument [{names}] takes an array of {len(argument)} rows, found shape {array.shape}"
                )
            columns.extend(array)
        return columns


def _cut(outputs: NDArray[np.float64], shape: _Shape) -> Any:
    part = outputs[shape.start : shape.start + shape.count]
    result = part.reshape((*shape.dimensions, *outputs.shape[1:]))
    return result[()] if result.ndim == 0 else result


def lambdify(arguments: Expr | Sequence[Expr | Sequence[Expr]], expressions: Outputs) -> CompiledFunction:
    """Return a fast function of the arguments that evaluates the expressions.

    Args:
        arguments: variables, or lists of variables, which become arrays with a row for each.
        expressions: an expression (the function returns an array of the batch's shape), a list of n
            expressions (n rows), a matrix (rows x columns), or a list of lists and matrices (a tuple).

    Raises:
        ParameterError: an expression contains a variable that is no argument.

    >>> from symbody import cos, lambdify, symbols
    >>> x, a = symbols("x a")
    >>> f = lambdify([x, a], [a * x, cos(x)])
    >>> f([0.0, 1.0], 2.0)
    array([[0.        , 2.        ],
           [1.        , 0.54030231]])
    """
    if isinstance(arguments, Expr):
        arguments = [arguments]
    structure = tuple(a if isinstance(a, Expr) else tuple(a) for a in arguments)
    inputs = [v for a in structure for v in ((a,) if isinstance(a, Expr) else a)]
    outputs, shapes = _flatten(expressions)
    return CompiledFunction(structure, _core.Tape(inputs, outputs), shapes)


def _is_scalar(item: object) -> bool:
    return isinstance(item, Expr | int | float)


def _flatten(expressions: Outputs) -> tuple[list[ExprLike], tuple[_Shape, ...] | _Shape]:
    if _is_scalar(expressions):
        return [expressions], _Shape(0, 1, ())
    if isinstance(expressions, Matrix):
        return list(expressions.entries), _Shape(0, len(expressions.entries), expressions.shape)
    if isinstance(expressions, str) or not isinstance(expressions, Iterable):
        return [number(expressions)], _Shape(0, 1, ())
    items = list(expressions)
    if all(_is_scalar(item) for item in items):
        return items, _Shape(0, len(items), (len(items),))
    outputs: list[ExprLike] = []
    shapes: list[_Shape] = []
    for item in items:
        part, shape = _flatten(item)
        if not isinstance(shape, _Shape):
            raise ExpressionError("lambdify takes lists of expressions and matrices, one level deep")
        shapes.append(_Shape(len(outputs), shape.count, shape.dimensions))
        outputs.extend(part)
    return outputs, tuple(shapes)
