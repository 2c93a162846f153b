"""Conversion to SymPy and back, of lists and matrices too. SymPy is optional; the first conversion imports it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.array import array_like, is_array
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.expression.to_sympy import ToSympy, import_sympy
from symbody.symbolic.given.arguments import described
from symbody.symbolic.sympy_bridge.from_sympy import FromSympy, no_counterpart
from symbody.symbolic.sympy_bridge.methods import converter_of

__all__ = ["from_sympy", "to_sympy"]


def to_sympy(expression: Any, names: Mapping[str, Any] | None = None) -> Any:
    """Return an expression, a matrix, or a list, tuple or dictionary of these as objects of SymPy.

    Shared nodes become shared objects. Functions of time become ``x(t)``, as ``dynamicsymbols`` makes them; symbols
    keep their assumptions; decimals that no double represents become fractions.

    Args:
        expression: the expression, the matrix, or the collection of these.
        names: SymPy objects by name, to be used instead of new symbols and functions of these names.

    Raises:
        ImportError: SymPy is not installed.
        ExpressionError: the expression is nested deeper than SymPy's recursion allows.

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
    """Convert an expression of SymPy to an expression, a matrix to a Matrix, and lists and dictionaries of these.

    ``x(t)`` becomes a function of time, an equation the difference of its sides, a symbol without assumptions a real
    symbol. A KanesMethod or LagrangesMethod of sympy.physics.mechanics whose equations were formed becomes `Equations`.

    Args:
        expression: the expression, the matrix, or the collection of these; or the object of a method.
        names: expressions by name, to be used instead of new symbols and functions of these names.

    Raises:
        ImportError: SymPy is not installed.
        ExpressionError: a part of the expression has no counterpart.

    >>> import sympy
    >>> x, y = sympy.symbols("x y")
    >>> from_sympy([sympy.sin(x) ** 2, sympy.Matrix([[x, y]]), sympy.Heaviside(x)])
    [sin(x)**2, Matrix([[x, y]]), (1 + sign(x))/2]
    """
    sympy = import_sympy()
    bridge = FromSympy(sympy, names or {})

    def convert(part: Any) -> Any:
        return _structured(part, one)

    def one(item: Any) -> Any:
        converter = converter_of(item)
        return _one_from_sympy(sympy, bridge, item) if converter is None else converter(item, convert)

    return convert(expression)


def _structured(item: Any, convert: Callable[[Any], Any]) -> Any:
    """Return the converted items in the same lists, tuples, dictionaries and arrays."""
    if isinstance(item, Mapping):
        return {
            key if isinstance(key, str) else _structured(key, convert): _structured(value, convert)
            for key, value in item.items()
        }
    if isinstance(item, list | tuple | set | frozenset):
        return type(item)([_structured(each, convert) for each in item])
    if is_array(item) and item.ndim:
        return array_like(item, [convert(each) for each in item.flat])
    return convert(item)


def _one_to_sympy(bridge: ToSympy, item: Any) -> Any:
    if isinstance(item, Matrix):
        return bridge.convert_matrix(item.shape, item.entries)
    return bridge.convert(_core.number(item, "to_sympy"))


def _one_from_sympy(sympy: Any, bridge: FromSympy, item: Any) -> Any:
    """Convert one item: an expression, or a matrix, an equation or a list of SymPy's own types."""
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
    """Whether an item is a matrix expression, such as a product, of matrices with known entries."""
    return isinstance(item, sympy.MatrixExpr) and not item.has(sympy.MatrixSymbol)


def _of_others(item: Any) -> Expr:
    """Convert a number of Python or NumPy; raise an error with the way out for anything else."""
    if type(item).__module__.startswith("sympy.physics.vector"):
        raise ArgumentError(
            f"from_sympy: {described(item)} of sympy.physics; convert its components, "
            "as in from_sympy(v.to_matrix(N)), and make a Vector or a Frame of them"
        )
    try:
        return _core.number(item)
    except ArgumentError:
        raise ArgumentError(
            f"from_sympy: {described(item)}; expected an expression or a matrix of SymPy, or a list of them"
        ) from None
