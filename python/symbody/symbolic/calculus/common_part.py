"""What several expressions have in common: sums within their sums, and factors of parameters."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike

__all__ = ["common_parameters", "parameters_outside", "with_shared_sums"]


def with_shared_sums(expressions: Sequence[Expr], beside: Sequence[Expr] = ()) -> tuple[Expr, ...]:
    """Return expressions of the same values whose sums share common parts, if they take fewer operations so.

    Args:
        expressions: the expressions.
        beside: others that are computed with them, and keep their forms.

    >>> from symbody import cost, symbols
    >>> from symbody.symbolic import with_shared_sums
    >>> a, b, c, d = symbols("a b c d")
    >>> cost([a + b + c, d - 2 * a - 2 * b]).total, cost(with_shared_sums([a + b + c, d - 2 * a - 2 * b])).total
    (6, 4)
    """
    return _core.with_shared_sums(expressions, beside)


def common_parameters(expressions: Sequence[ExprLike]) -> tuple[Expr, tuple[Expr, ...]]:
    """Return the common factor of expressions that depends on parameters alone, and each of them without it.

    Without a common parameter, the factor is 1.

    >>> from symbody import functions_of_time, symbols
    >>> from symbody.symbolic import common_parameters
    >>> (x, y), (a, b) = functions_of_time("x y"), symbols("a b")
    >>> common_parameters([a * x / b, 2 * a * y])
    (a, (x/b, 2*y))
    """
    factor, *rests = _core.common_parameters(expressions)
    return factor, tuple(rests)


def parameters_outside(expression: Expr) -> Expr:
    """Return a sum with the factor outside that all its terms, but numbers, have in common, if it is of parameters.

    >>> from symbody import expand, functions_of_time, symbols
    >>> from symbody.symbolic import parameters_outside
    >>> (x, y), l = functions_of_time("x y"), symbols("l")
    >>> parameters_outside(expand(x**2 / l + y**2 / l - 1))
    (x**2 + y**2)/l - 1
    """
    return _core.rewrite("parameters_outside", expression)
