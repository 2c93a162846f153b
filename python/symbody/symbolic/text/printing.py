"""Expressions in LaTeX, in Maple's notation, and as listings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.shown_form import ShownForms, shown_form
from symbody.symbolic.expression.container import Typeset, in_latex, is_container, printed_in
from symbody.symbolic.expression.latex_layout import displayed
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.expression.naming import latex_listing, latex_of, naming_of
from symbody.symbolic.given.arguments import expression_or_container

__all__ = ["latex", "listing", "listing_of_equations", "maple"]


def latex(expression: Any) -> str:
    r"""Return an expression in LaTeX, without dollar signs; also a list, matrix, frame, equations, or a linear model.

    Names are typeset as in a textbook: ``m_1`` is m with the index 1, ``omega0``, ``I__xx`` and ``theta_dot`` have
    Greek letters, indices and dots. Different names in one formula are typeset differently: beside ``m1``, the name
    ``m_1`` is written as it is, and so is ``theta_dot`` beside a function of time ``theta``. A form with symbols on
    which the value doesn't depend, or with nested rotations, is not shown: another one takes its place.

    >>> from symbody import functions_of_time, latex, sin, symbols, time_derivative
    >>> theta = functions_of_time("theta")
    >>> print(latex(time_derivative(sin(theta))))
    \cos(\theta) \dot{\theta}
    >>> print(latex(symbols("m_1 I__xx omega0 load")))
    \left(m_{1}, I_{xx}, \omega_{0}, \mathrm{load}\right)
    """
    if is_container(expression):
        with naming_of(printed_in(expression)):
            forms = ShownForms()
            return in_latex(expression, "latex", forms, forms.read_together)
    if isinstance(expression, Typeset) and not isinstance(expression, type | Expr):
        return expression.latex()
    return latex_of(shown_form(expression_or_container(expression, "latex")))


def _repr_latex_(self: Expr | Matrix) -> str:
    """Return what a notebook shows of an expression or a matrix."""
    return displayed(latex(self))


Expr._repr_latex_ = _repr_latex_  # type: ignore[method-assign]  # Expr can't import the forms for the reader
Matrix._repr_latex_ = _repr_latex_  # type: ignore[attr-defined]


def maple(expression: ExprLike) -> str:
    """Return an expression in Maple's one-dimensional notation.

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

    If the texts would be long, shared parts are named: the length is that of the graph, not of the tree.

    Args:
        expressions: one expression or several.
        notation: "text", "latex" or "maple".

    Returns:
        Pairs of a name and its definition, in an order in which they can be evaluated; then one text per expression.

    >>> from symbody import exp, listing, symbols
    >>> v = symbols("v1:61")
    >>> weight = exp(sum(v))
    >>> definitions, results = listing([weight * v[0], weight * v[1]] * 20)
    >>> [name for name, _ in definitions], results[:2]
    (['z1', 'z2'], ['v1*z2', 'v2*z2'])
    """
    if notation == "latex" and not isinstance(expressions, Expr):
        return latex_listing(expressions)
    definitions, results = _core.listing(expressions, notation)
    return definitions, results


def listing_of_equations(
    expressions: Iterable[Expr],
    notation: str,
    functions: Sequence[Expr],
    speeds: Sequence[Expr],
    subtracted: Sequence[Expr] = (),
) -> tuple[list[tuple[str, str]], list[str]]:
    r"""Return the terms of equations of motion printed together, as `listing` does.

    The functions of time in a product are in the order of the equations, speeds and multipliers behind sines and
    cosines; a fraction stands in front of a product.

    Args:
        expressions: the terms.
        notation: "text" or "latex".
        functions: the functions of time, in their order.
        speeds: those of them that are velocities or multipliers, and others, which come last.
        subtracted: the parameters behind the minus sign in differences of the model: `R - r` keeps its sign.

    >>> from symbody import functions_of_time, sin, symbols
    >>> (theta, u2, u1), m = functions_of_time("theta u2 u1"), symbols("m")
    >>> listing_of_equations([3 * m * u1 * u2 * sin(theta) / 2], "text", [theta], [u2, u1])
    ([], ['3/2*m*sin(theta)*u2*u1'])
    >>> listing_of_equations([3 * m * u1 * u2 / 2], "latex", [theta], [u2, u1])
    ([], ['\\frac{3}{2} m u_{2} u_{1}'])
    """
    ordered, speed_names, subtracted_names = (
        [each.name for each in names] for names in (functions, speeds, subtracted)
    )
    names = ordered, speed_names, subtracted_names
    if notation == "latex":
        return latex_listing(expressions, names)
    definitions, results = _core.listing(expressions, notation, names)
    return definitions, results
