"""Expressions as text: plain, LaTeX, Maple."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix

__all__ = ["latex", "listing", "maple"]


def latex(expression: ExprLike | Matrix) -> str:
    r"""Return LaTeX, without dollar signs.

    >>> from symbody import functions_of_time, latex, sin, time_derivative
    >>> theta = functions_of_time("theta")
    >>> print(latex(time_derivative(sin(theta))))
    \dot{\theta} \cos\left(\theta\right)
    """
    return expression.latex() if isinstance(expression, Matrix) else _core.number(expression, "latex").latex()


def maple(expression: ExprLike) -> str:
    """Return Maple's one-dimensional notation.

    >>> from symbody import functions_of_time, maple, time_derivative
    >>> x = functions_of_time("x")
    >>> maple(time_derivative(x, 2))
    'diff(x(t),`$`(t,2))'
    """
    return _core.number(expression, "maple").maple()


def listing(
    expressions: Iterable[Expr] | Expr, notation: str = "text"
) -> tuple[list[tuple[str, str]], list[str]]:
    """Return several expressions printed together: named intermediate quantities, then the results.

    What is large and shared is named once, so the listing grows with the graph and not with the tree.
    """
    definitions, results = _core.listing(expressions, notation)
    return definitions, results
