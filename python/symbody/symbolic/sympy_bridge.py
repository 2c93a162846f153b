"""SymPy and back, lists and matrices included. SymPy is an extra, imported when a function here is called."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.arguments import described
from symbody.symbolic.from_sympy import FromSympy, no_counterpart
from symbody.symbolic.matrix import Matrix
from symbody.symbolic.to_sympy import ToSympy, import_sympy

__all__ = ["from_sympy", "to_sympy"]


def to_sympy(expression: Any, names: Mapping[str, Any] | None = None) -> Any:
    """Return an expression, a matrix, or a list, tuple or dictionary of these as SymPy has it.

    What is shared here is one object there. Functions of time become ``x(t)`` as ``dynamicsymbols`` makes them, symbols
    keep their assumptions, decimals that no double holds become fractions. ``names`` gives SymPy's object for a name
    where another one is wanted.

    Raises:
        ImportError: SymPy isn't installed.
        ExpressionError: the expression is deeper than SymPy's recursions reach.

    >>> from symbody import functions_of_time, symbols, time_derivative
    >>> m = symbols("m")
    >>> x = functions_of_time("x")
    >>> to_sympy([m * time_derivative(x, 2), {m: 2}])
    [m*Derivative(x(t), (t, 2)), {m: 2}]
    """
    sympy = import_sympy()
    bridge = ToSympy(sympy, names or {})
    return _structured(expression, lambda item: _one_to_sympy(bridge, item))


def from_sympy(expression: Any, names: Mapping[str, Expr] | None = None) -> Any:
    """Return an expression of SymPy as an expression, a matrix as a Matrix, and lists and dictionaries of these.

    ``x(t)`` becomes a function of time, an equation the difference of its sides. A symbol without assumptions becomes a
    real one, as ``symbols`` makes it. ``names`` gives the expression for a name where another one is wanted.

    Raises:
        ImportError: SymPy isn't installed.
        ExpressionError: something in the expression has no counterpart.

    >>> import sympy
    >>> x, y = sympy.symbols("x y")
    >>> from_sympy([sympy.sin(x) ** 2, sympy.Matrix([[x, y]]), sympy.Heaviside(x)])
    [sin(x)**2, Matrix([[x, y]]), (1 + sign(x))/2]
    """
    sympy = import_sympy()
    bridge = FromSympy(sympy, names or {})
    return _structured(expression, lambda item: _one_from_sympy(sympy, bridge, item))


def _structured(item: Any, convert: Callable[[Any], Any]) -> Any:
    """Return what is made of each item, in the lists, tuples, dictionaries and arrays in which they stand."""
    if isinstance(item, Mapping):
        return {
            key if isinstance(key, str) else _structured(key, convert): _structured(value, convert)
            for key, value in item.items()
        }
    if isinstance(item, list | tuple | set | frozenset):
        return type(item)([_structured(each, convert) for each in item])
    if isinstance(item, np.ndarray) and item.ndim:
        made = np.empty(item.shape, dtype=object)
        for index in np.ndindex(item.shape):
            made[index] = convert(item[index])
        return made
    return convert(item)


def _one_to_sympy(bridge: ToSympy, item: Any) -> Any:
    if isinstance(item, Matrix):
        return bridge.convert_matrix(item.shape, item.entries)
    return bridge.convert(_core.number(item, "to_sympy"))


def _one_from_sympy(sympy: Any, bridge: FromSympy, item: Any) -> Any:
    """Return one expression, or the matrix, the equation or the list of SymPy's own types that the item is."""
    match item:
        case Expr() | Matrix():
            return item
        case str():
            raise ArgumentError(f"from_sympy: {described(item)}; parse converts it")
        case sympy.MatrixBase():
            return _matrix(item, bridge)
        case sympy.NDimArray():
            return _structured(item.tolist(), bridge.convert)
        case sympy.Tuple():
            return tuple(_one_from_sympy(sympy, bridge, each) for each in item)
        case sympy.Equality():
            return bridge.convert(item.lhs) - bridge.convert(item.rhs)
        case sympy.Basic() if _is_explicit_matrix(sympy, item):
            return _one_from_sympy(sympy, bridge, item.as_explicit())
        case sympy.Expr():
            return bridge.convert(item)
        case sympy.Basic():
            raise no_counterpart(item)
        case _:
            return _of_others(item)


def _matrix(matrix: Any, bridge: FromSympy) -> Matrix:
    rows, columns = matrix.shape
    return Matrix.from_entries(rows, columns, [bridge.convert(entry) for entry in matrix.flat()])


def _is_explicit_matrix(sympy: Any, item: Any) -> bool:
    """Whether it is a matrix expression, such as a product, of matrices whose entries are known."""
    return isinstance(item, sympy.MatrixExpr) and not item.has(sympy.MatrixSymbol)


def _of_others(item: Any) -> Expr:
    """Return a number of Python's or NumPy's; an error that says the way out for anything else."""
    if type(item).__module__.startswith("sympy.physics.vector"):
        raise ArgumentError(
            f"from_sympy: {described(item)} of sympy.physics; convert its components, "
            "as in from_sympy(v.to_matrix(N)), and make a Vector or a Frame of them"
        )
    try:
        return _core.number(item)
    except ArgumentError:
        raise ArgumentError(
            f"from_sympy: {described(item)}; expected an expression or a matrix of SymPy's, or a list of them"
        ) from None
