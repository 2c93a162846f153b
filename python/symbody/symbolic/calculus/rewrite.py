"""Rewrites: another form of the same value, of an expression or of all expressions in a container.

A container is a list, a tuple, the values of a dictionary, an array or a matrix, a vector, a point, a frame, a body, a
load, a system, or equations of motion.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, overload

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.container import Kind, Rewrite, is_container, rewritten
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.given.arguments import expression_or_container

from .collected import with_needed_coefficients
from .simplified_together import simplified_together

__all__ = ["coeff", "collect", "combine_trig", "expand", "expand_trig", "factor_terms", "simplify"]


@overload
def expand(expression: ExprLike) -> Expr: ...
@overload
def expand(expression: Kind) -> Kind: ...
def expand(expression: Any) -> Any:
    """Multiply out products of sums.

    Raises:
        ExpressionError: the result would have more than 200 000 terms, or numbers of too many digits.

    >>> from symbody import expand, symbols
    >>> a, b = symbols("a b")
    >>> expand((a + b) ** 2)
    a**2 + 2*a*b + b**2
    """
    return _rewritten("expand", expression)


@overload
def expand_trig(expression: ExprLike) -> Expr: ...
@overload
def expand_trig(expression: Kind) -> Kind: ...
def expand_trig(expression: Any) -> Any:
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
    return _rewritten("expand_trig", expression)


@overload
def collect(expression: ExprLike, variables: Expr | Sequence[ExprLike]) -> Expr: ...
@overload
def collect(expression: Kind, variables: Expr | Sequence[ExprLike]) -> Kind: ...
def collect(expression: Any, variables: Expr | Sequence[ExprLike]) -> Any:
    """Write an expression as a polynomial in one or several variables; the first one is outermost.

    The coefficients hold no symbols on which they don't depend.

    >>> from symbody import collect, symbols
    >>> x, a, b = symbols("x a b")
    >>> collect(a * x + b * x + a, [x])
    x*(a + b) + a
    """
    if is_container(expression):
        return rewritten(expression, _each(partial(_collected, variables)), "collect")
    return _collected(variables, expression)


def _collected(variables: Expr | Sequence[ExprLike], expression: Expr) -> Expr:
    collected = _core.collect(expression, variables)  # which refuses what is no list of variables
    listed = [variables] if isinstance(variables, Expr) else [*map(_core.number, variables)]
    return with_needed_coefficients(collected, listed)


def coeff(expression: ExprLike, variable: ExprLike, n: int = 1) -> Expr:
    """Return the coefficient of a power of a variable.

    Args:
        expression: the expression, a polynomial in the variable after expansion.
        variable: the variable, or a power or a product of variables.
        n: the exponent of the power; 0 for the terms without the variable.

    Raises:
        ArgumentError: the variable is a number.

    >>> from symbody import coeff, symbols
    >>> x, a, b = symbols("x a b")
    >>> coeff((a + x) * b, x), coeff((a + x) * b, x, 0), coeff(a * x**2 + b / x, 1 / x)
    (b, a*b, b)
    """
    if isinstance(variable, (int, float)) or getattr(variable, "is_number", False):
        raise ArgumentError(
            f"coeff, variable: {variable} is a number; expected a symbol, or a function, such as x"
        )
    return _core.coeff(expression, variable, n)


@overload
def factor_terms(expression: ExprLike) -> Expr: ...
@overload
def factor_terms(expression: Kind) -> Kind: ...
def factor_terms(expression: Any) -> Any:
    """Take out the common factors of all terms.

    >>> from symbody import factor_terms, symbols
    >>> a, b, c = symbols("a b c")
    >>> factor_terms(a * b + a * c)
    a*(b + c)
    """
    return _rewritten("factor_terms", expression)


@overload
def combine_trig(expression: ExprLike) -> Expr: ...
@overload
def combine_trig(expression: Kind) -> Kind: ...
def combine_trig(expression: Any) -> Any:
    """Write products of sines and cosines as sines and cosines of sums.

    >>> from symbody import combine_trig, cos, sin, symbols
    >>> a, b = symbols("a b")
    >>> combine_trig(cos(a) * cos(b) + sin(a) * sin(b))
    cos(a - b)
    """
    return _rewritten("combine_trig", expression)


@overload
def simplify(expression: ExprLike) -> Expr: ...
@overload
def simplify(expression: Kind) -> Kind: ...
def simplify(expression: Any) -> Any:
    """Return the cheapest form that a fixed list of rewrites finds.

    It seeks the form that takes the fewest operations, for code; `readable` seeks the form for text to be read. The
    search is bounded and deterministic, and the result never costs more than the expression. The value at the random
    point proves that the mathematics is unchanged.

    The total cost of a container never rises either: an expression keeps its form if its simplified form would raise
    the total, because it shares less with the others. Large containers are simplified in part, the cheapest
    expressions first, up to some 1000 operations, which takes about a second; `M.map(simplify)` simplifies each
    entry by itself.

    >>> from symbody import cos, simplify, sin, symbols
    >>> a, b, x = symbols("a b x")
    >>> simplify(a * sin(x) ** 2 + (a + b) * cos(x) ** 2)
    a + b*cos(x)**2
    >>> simplify({"one": sin(x) ** 2 + cos(x) ** 2, "both": [a - a, b]})
    {'one': 1, 'both': [0, b]}
    """
    if is_container(expression):
        return rewritten(expression, simplified_together, "simplify")
    return _core.rewrite("simplify", expression_or_container(expression, "simplify"))


def short_form(expression: Expr) -> Expr:
    """Return the first of the forms that `readable` tries: found part by part, in no time, and never longer.

    >>> from symbody import cos, sin, symbols
    >>> a, b = symbols("a b")
    >>> short_form(sin(a) * cos(b) + cos(a) * sin(b))
    sin(a + b)
    """
    return _core.rewrite("readable", expression)


def textbook_form(expression: Expr) -> Expr:
    """Return a term of equations as a textbook prints it: as `readable` does, also where that is longer.

    Sums are flat, and factors stand before a whole sum only; angles are those of the coordinates.

    >>> from symbody import cos, symbols
    >>> c, l, a = symbols("c l a")
    >>> textbook_form(c**2 + l * (l + 2 * c * cos(a)))
    c**2 + l**2 + 2*c*l*cos(a)
    """
    return _core.rewrite("textbook_form", expression)


def _each(operation: Callable[[Expr], Expr]) -> Rewrite:
    """Return the operation on several expressions, one by one."""

    def apply(expressions: tuple[Expr, ...]) -> tuple[Expr, ...]:
        return tuple(map(operation, expressions))

    return apply


def _rewritten(name: str, expression: Any) -> Any:
    if is_container(expression):
        return rewritten(expression, _each(partial(_core.rewrite, name)), name)
    return _core.rewrite(name, expression_or_container(expression, name))
