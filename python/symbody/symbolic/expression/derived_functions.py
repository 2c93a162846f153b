"""Functions of NumPy and SymPy for which there is no node, written with the elementary functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from symbody.symbolic._core import Expr
from symbody.symbolic.expression.functions import (
    Abs,
    Piecewise,
    acos,
    asin,
    atan,
    cos,
    cosh,
    exp,
    log,
    sign,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
)
from symbody.symbolic.expression.leaves import ExprLike, number, pi

__all__ = ["DERIVED", "WITHOUT_COUNTERPART", "heaviside"]


def heaviside(x: ExprLike, at_zero: ExprLike) -> Expr:
    """Return 0 for negative x, 1 for positive x, and ``at_zero`` at zero; if that is 1/2, (1 + sign(x))/2.

    >>> from symbody import symbols
    >>> x = symbols("x")
    >>> heaviside(x, 0.5), heaviside(x, 1).subs({x: 0})
    ((1 + sign(x))/2, 1)
    """
    if 2 * at_zero == 1:
        return (1 + sign(x)) / 2
    return Piecewise((1, x), (0, -x), otherwise=at_zero)


def _sinc(x: Expr) -> Expr:
    return Piecewise((sin(x) / x, Abs(x)), otherwise=1)


def _asinh(x: Expr) -> Expr:
    """Return a logarithm; each branch adds terms of one sign, so nothing cancels."""
    root = sqrt(x**2 + 1)
    return Piecewise((log(root + x), x), otherwise=-log(root - x))


def _acosh(x: Expr) -> Expr:
    return log(x + sqrt(x - 1) * sqrt(x + 1))


def _atanh(x: Expr) -> Expr:
    return log((1 + x) / (1 - x)) / 2


DERIVED: Mapping[str, Callable[[Expr], Expr]] = {
    "sec": lambda x: 1 / cos(x),
    "csc": lambda x: 1 / sin(x),
    "cot": lambda x: 1 / tan(x),
    "sech": lambda x: 1 / cosh(x),
    "csch": lambda x: 1 / sinh(x),
    "coth": lambda x: 1 / tanh(x),
    "asec": lambda x: acos(1 / x),
    "acsc": lambda x: asin(1 / x),
    "acot": lambda x: atan(1 / x),
    "asinh": _asinh,
    "acosh": _acosh,
    "atanh": _atanh,
    "asech": lambda x: _acosh(1 / x),
    "acsch": lambda x: _asinh(1 / x),
    "acoth": lambda x: _atanh(1 / x),
    "sinc": _sinc,
    "exp2": lambda x: 2**x,
    "expm1": lambda x: tanh(x / 2) * (exp(x) + 1),
    "log2": lambda x: log(x) / log(2),
    "log10": lambda x: log(x) / log(10),
    "cbrt": lambda x: sign(x) * Abs(x) ** (number(1) / 3),
    "degrees": lambda x: x * 180 / pi,
    "radians": lambda x: x * pi / 180,
}
"""Functions of one argument, by the names of SymPy and NumPy.

``expm1`` keeps its digits near zero. The inverse hyperbolic functions are logarithms, with an absolute error of 1e-16;
near zero their relative error is larger. ``log1p`` exists for its relative accuracy near zero, so it is not among them.
"""

WITHOUT_COUNTERPART: Mapping[str, str] = {
    "log1p": "write log(1 + x), whose digits near x = 0 are those of 1 + x",
}
"""Functions that cannot be offered with their accuracy, and what to write instead."""
