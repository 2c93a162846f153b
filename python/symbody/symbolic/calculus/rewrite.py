"""Rewrites: another form of the same value."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike

__all__ = ["coeff", "collect", "combine_trig", "expand", "expand_trig", "factor_terms", "simplify"]


def expand(expression: ExprLike) -> Expr:
    """Multiply out products of sums.

    Raises:
        ExpressionError: the result would have more than 200 000 terms, or numbers of too many digits.

    >>> from symbody import expand, symbols
    >>> a, b = symbols("a b")
    >>> expand((a + b) ** 2)
    a**2 + 2*a*b + b**2
    """
    return _core.rewrite("expand", expression)


def expand_trig(expression: ExprLike) -> Expr:
    """Write sines, cosines and tangents of sums and integer multiples with those of single angles, and multiply out.

    The same holds for sinh, cosh and tanh. Tangents are expressed by tangents.

    Raises:
        ExpressionError: the result would have too many terms.

    >>> from symbody import expand_trig, cos, sin, symbols, tan
    >>> a, b = symbols("a b")
    >>> expand_trig(cos(a - b)), expand_trig(sin(2 * a))
    (sin(a)*sin(b) + cos(a)*cos(b), 2*sin(a)*cos(a))
    >>> expand_trig(tan(a + b))
    (tan(a) + tan(b))/(1 - tan(a)*tan(b))
    """
    return _core.rewrite("expand_trig", expression)


def collect(expression: ExprLike, variables: Expr | Sequence[ExprLike]) -> Expr:
    """Write an expression as a polynomial in one or several variables; the first one is outermost.

    >>> from symbody import collect, symbols
    >>> x, a, b = symbols("x a b")
    >>> collect(a * x + b * x + a, [x])
    x*(a + b) + a
    """
    return _core.collect(expression, variables)


def coeff(expression: ExprLike, variable: ExprLike, n: int = 1) -> Expr:
    """Return the coefficient of a power of a variable.

    Args:
        expression: the expression, a polynomial in the variable after expansion.
        variable: the variable.
        n: the exponent of the power; 0 for the terms without the variable.

    >>> from symbody import coeff, symbols
    >>> x, a, b = symbols("x a b")
    >>> coeff((a + x) * b, x), coeff((a + x) * b, x, 0)
    (b, a*b)
    """
    return _core.coeff(expression, variable, n)


def factor_terms(expression: ExprLike) -> Expr:
    """Take out the common factors of all terms.

    >>> from symbody import factor_terms, symbols
    >>> a, b, c = symbols("a b c")
    >>> factor_terms(a * b + a * c)
    a*(b + c)
    """
    return _core.rewrite("factor_terms", expression)


def combine_trig(expression: ExprLike) -> Expr:
    """Write products of sines and cosines as sines and cosines of sums.

    >>> from symbody import combine_trig, cos, sin, symbols
    >>> a, b = symbols("a b")
    >>> combine_trig(cos(a) * cos(b) + sin(a) * sin(b))
    cos(a - b)
    """
    return _core.rewrite("combine_trig", expression)


def simplify(expression: ExprLike) -> Expr:
    """Return the cheapest form that a fixed list of rewrites finds.

    The search is bounded and deterministic, and the result never costs more than the expression. The value at the
    random point proves that the mathematics is unchanged.

    >>> from symbody import cos, simplify, sin, symbols
    >>> a, b, x = symbols("a b x")
    >>> simplify(a * sin(x) ** 2 + (a + b) * cos(x) ** 2)
    a + b*cos(x)**2
    """
    return _core.rewrite("simplify", expression)
