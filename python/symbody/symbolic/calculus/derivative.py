"""Derivatives and substitution."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.container import Kind, derived, is_container, substituted
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.given.arguments import size

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "diff",
    "free_symbols",
    "gradient",
    "jacobian",
    "partial_derivative",
    "subs",
    "substitute",
    "time_derivative",
    "time_derivatives",
]


@overload
def diff(expression: ExprLike, variable: Expr, n: int = 1) -> Expr: ...
@overload
def diff(expression: Kind, variable: Expr, n: int = 1) -> Kind: ...
def diff(expression: Any, variable: Expr, n: int = 1) -> Any:
    """Return the n-th derivative: the partial one, and with respect to ``t`` the total one.

    x, x', x'' are variables of their own, linked by d/dt. `partial_derivative` holds them fixed for ``t``, too.
    Vectors and points are differentiated as seen from their own frames, and the derivative of a point is a vector.

    Args:
        expression: the expression, or a list, dictionary, array, matrix, vector or point of expressions.
        variable: a symbol, a function of time or one of its derivatives, or ``t``.
        n: the order of the derivative.

    Raises:
        ExpressionError: ``variable`` is not a variable.

    >>> from symbody import diff, functions_of_time, sin
    >>> x = functions_of_time("x")
    >>> diff(sin(x) ** 2, x)
    2*sin(x)*cos(x)
    """
    if not is_container(expression):
        return _core.number(expression, "diff, expression").diff(variable, n)
    return _entry_by_entry(expression, lambda entries: _core.diff_all(entries, variable), n, "diff")


def free_symbols(expressions: Sequence[ExprLike]) -> frozenset[Expr]:
    """Return the symbols, functions of time and their derivatives that several expressions contain.

    >>> from symbody import symbols
    >>> from symbody.symbolic import free_symbols
    >>> a, b = symbols("a b")
    >>> sorted(map(str, free_symbols([a, a * b])))
    ['a', 'b']
    """
    return _core.free_symbols(expressions)


@overload
def time_derivative(expression: ExprLike, n: int = 1) -> Expr: ...
@overload
def time_derivative(expression: Matrix, n: int = 1) -> Matrix: ...
@overload
def time_derivative(expression: NDArray[Any], n: int = 1) -> NDArray[Any]: ...
@overload
def time_derivative(expression: list[Any], n: int = 1) -> list[Any]: ...
@overload
def time_derivative(expression: tuple[Any, ...], n: int = 1) -> tuple[Any, ...]: ...
def time_derivative(expression: Any, n: int = 1) -> Any:
    """Return the n-th total time derivative: x becomes x', x' becomes x''; lists, arrays, matrices entry by entry.

    >>> from symbody import functions_of_time, time_derivative
    >>> x, y = functions_of_time("x y")
    >>> time_derivative(x**2, 2)
    2*(x*x'' + x'**2)
    >>> time_derivative([x, x * y])
    [x', x*y' + y*x']
    """
    return _entry_by_entry(expression, _core.time_derivatives, n, "time_derivative")


@overload
def partial_derivative(expression: ExprLike, variable: Expr, n: int = 1) -> Expr: ...
@overload
def partial_derivative(expression: Matrix, variable: Expr, n: int = 1) -> Matrix: ...
@overload
def partial_derivative(expression: NDArray[Any], variable: Expr, n: int = 1) -> NDArray[Any]: ...
@overload
def partial_derivative(expression: list[Any], variable: Expr, n: int = 1) -> list[Any]: ...
@overload
def partial_derivative(expression: tuple[Any, ...], variable: Expr, n: int = 1) -> tuple[Any, ...]: ...
def partial_derivative(expression: Any, variable: Expr, n: int = 1) -> Any:
    """Return the n-th partial derivative with all other variables fixed, also for ``t``; lists, matrices by entry.

    For ``t``, the functions of time are fixed: ``time_derivative(e) = de/dt + de/dx x' + de/dx' x'' + ...``. For any
    other variable, `diff` gives the same.

    Args:
        expression: the expression, or a list, an array or a matrix of expressions.
        variable: a symbol, a function of time or one of its derivatives, or ``t``.
        n: the order of the derivative.

    Raises:
        ExpressionError: ``variable`` is not a variable.

    >>> from symbody import diff, functions_of_time, partial_derivative, t
    >>> x = functions_of_time("x")
    >>> partial_derivative(x * t**2, t), diff(x * t**2, t)
    (2*t*x, t**2*x' + 2*t*x)
    """

    def derive(expressions: Sequence[ExprLike]) -> tuple[Expr, ...]:
        return _core.partial_derivatives(expressions, variable)

    return _entry_by_entry(expression, derive, n, "partial_derivative")


def _entry_by_entry(
    expression: Any, derive: Callable[[Sequence[ExprLike]], tuple[Expr, ...]], n: int, place: str
) -> Any:
    """Return the n-th derivatives of an expression, or of the entries of a list, an array or a matrix."""
    times = size(n, f"{place}: n", "derivatives")
    if not is_container(expression):
        return _repeated(derive, times, (_core.number(expression, f"{place}, expression"),))[0]
    for _ in range(times):
        expression = derived(expression, derive, place)
    return expression


def _repeated(
    derive: Callable[[Sequence[ExprLike]], tuple[Expr, ...]], times: int, entries: tuple[Expr, ...]
) -> tuple[Expr, ...]:
    for _ in range(times):
        entries = derive(entries)
    return entries


def time_derivatives(expressions: Sequence[ExprLike]) -> tuple[Expr, ...]:
    """Return the total time derivatives of several expressions, computed in one sweep.

    >>> from symbody import functions_of_time, time_derivatives
    >>> x = functions_of_time("x")
    >>> time_derivatives([x, x**2])
    (x', 2*x*x')
    """
    return _core.time_derivatives(expressions)


def gradient(expression: ExprLike, variables: Expr | Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the partial derivatives with respect to one or many variables, by one reverse sweep.

    Raises:
        ExpressionError: one of ``variables`` is not a variable, or it is ``t`` and the expression contains functions of
            time: `time_derivative` gives the total derivative, `partial_derivative` the partial one.

    >>> from symbody import gradient, symbols
    >>> x, y = symbols("x y")
    >>> gradient(x * y**2, [x, y])
    (y**2, 2*x*y)
    """
    return _core.gradient(expression, variables)


def jacobian(expressions: Expr | Sequence[ExprLike], variables: Expr | Sequence[Expr]) -> Matrix:
    """Return the matrix of partial derivatives: one row per expression, one column per variable.

    A single expression or variable needs no list.

    Raises:
        ExpressionError: one of ``variables`` is not a variable, or it is ``t`` and an expression contains functions of
            time: `time_derivative` gives the total derivative, `partial_derivative` the partial one.

    >>> from symbody import jacobian, symbols
    >>> x, y = symbols("x y")
    >>> jacobian([x * y, x + y], [x, y])
    Matrix([[y, x], [1, 1]])
    """
    rows = _core.jacobian(expressions, variables)
    if not rows:
        return Matrix.from_entries(0, 1 if isinstance(variables, Expr) else len(variables), ())
    return Matrix(rows)


@overload
def subs(expression: ExprLike, mapping: Mapping[Expr, ExprLike]) -> Expr: ...
@overload
def subs(expression: Kind, mapping: Mapping[Expr, ExprLike]) -> Kind: ...
def subs(expression: Any, mapping: Mapping[Expr, ExprLike]) -> Any:
    """Return the expression with every key replaced by its value, all at once.

    A replacement of x(t) also replaces x', x'', ... by its time derivatives, unless the mapping has
    entries for them. In a list, dictionary, matrix, vector, frame, body, system or in equations, all expressions are
    replaced.

    >>> from symbody import functions_of_time, sin, subs, t, time_derivative
    >>> x = functions_of_time("x")
    >>> subs(time_derivative(x), {x: sin(t)})
    cos(t)
    """
    if is_container(expression):
        return substituted(expression, mapping)
    return _core.number(expression, "subs, expression").subs(mapping)


def substitute(expressions: Sequence[ExprLike], mapping: Mapping[Expr, ExprLike]) -> tuple[Expr, ...]:
    """Return several expressions with every key replaced by its value, all at once, in one sweep.

    >>> from symbody import substitute, symbols
    >>> x, y = symbols("x y")
    >>> substitute([x + y, x * y], {x: y, y: x})
    (x + y, x*y)
    """
    return _core.substitute(expressions, mapping)
