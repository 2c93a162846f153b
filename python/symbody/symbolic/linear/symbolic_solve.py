"""Linear equations, solved in symbols."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.given.arguments import expression

__all__ = ["solve"]


def solve(equations: Expr | Sequence[ExprLike], unknowns: Expr | Sequence[Expr]) -> dict[Expr, Expr]:
    """Solve equations that are linear in the unknowns; an equation is an expression that is to be zero.

    Equations that can be solved separately are solved first; at most six unknowns may be coupled.

    Args:
        equations: the expressions that are to be zero; a single one needs no list.
        unknowns: symbols, functions of time or their derivatives; a single one needs no list.

    Returns:
        The values by unknown.

    Raises:
        ExpressionError: an equation is not linear, the equations contradict each other or leave
            unknowns free, or too many are coupled; the message names them.

    >>> from symbody import solve, symbols
    >>> x, y, a = symbols("x y a")
    >>> solve([x + y - a, x - y], [x, y])
    {x: a/2, y: a/2}
    """
    for each in equations if isinstance(equations, Sequence) else [equations]:
        if isinstance(each, bool):
            expression(each, "solve, equations")  # raises an error that says so
    values = _core.solve(equations, unknowns)
    return dict(zip([unknowns] if isinstance(unknowns, Expr) else unknowns, values, strict=True))
