"""Elementary functions of expressions and numbers."""

from __future__ import annotations

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.given.arguments import brief

__all__ = [
    "Abs",
    "Max",
    "Min",
    "Piecewise",
    "acos",
    "asin",
    "atan",
    "atan2",
    "cos",
    "cosh",
    "exp",
    "log",
    "sign",
    "sin",
    "sinh",
    "sqrt",
    "tan",
    "tanh",
]


def sin(x: ExprLike) -> Expr:
    """Return the sine of an angle in radians.

    In a sum, ``math.pi/2`` is taken as exactly pi/2; alone, it stays a decimal.

    >>> from symbody import pi, sin, symbols
    >>> x, y = symbols("x y")
    >>> sin(x + pi), sin(pi / 6)
    (-sin(x), 1/2)
    """
    return _core.apply("sin", (_core.angle_beside_others(x, "sin"),))


def cos(x: ExprLike) -> Expr:
    """Return the cosine of an angle in radians.

    In a sum, ``math.pi/2`` is taken as exactly pi/2; alone, it stays a decimal.

    >>> from symbody import cos, pi, symbols
    >>> x, y = symbols("x y")
    >>> cos(x + pi / 2), cos(pi / 4)
    (-sin(x), sqrt(2)/2)
    """
    return _core.apply("cos", (_core.angle_beside_others(x, "cos"),))


def tan(x: ExprLike) -> Expr:
    """Return the tangent of an angle in radians.

    In a sum, ``math.pi/2`` is taken as exactly pi/2; alone, it stays a decimal.

    >>> from symbody import pi, tan, symbols
    >>> x, y = symbols("x y")
    >>> tan(x + pi), tan(pi / 3)
    (tan(x), sqrt(3))
    """
    return _core.apply("tan", (_core.angle_beside_others(x, "tan"),))


def asin(x: ExprLike) -> Expr:
    """Return the angle in [-pi/2, pi/2] whose sine is x.

    >>> from symbody import asin, number, symbols
    >>> x, y = symbols("x y")
    >>> asin(x).diff(x), asin(number("1/2"))
    (1/sqrt(1 - x**2), pi/6)
    """
    return _core.apply("asin", (x,))


def acos(x: ExprLike) -> Expr:
    """Return the angle in [0, pi] whose cosine is x.

    >>> from symbody import acos, symbols
    >>> x, y = symbols("x y")
    >>> acos(x).diff(x), acos(0)
    (-1/sqrt(1 - x**2), pi/2)
    """
    return _core.apply("acos", (x,))


def atan(x: ExprLike) -> Expr:
    """Return the angle in (-pi/2, pi/2) whose tangent is x.

    >>> from symbody import atan, symbols
    >>> x, y = symbols("x y")
    >>> atan(x).diff(x), atan(1)
    (1/(x**2 + 1), pi/4)
    """
    return _core.apply("atan", (x,))


def atan2(y: ExprLike, x: ExprLike) -> Expr:
    """Return the angle in (-pi, pi] of the point (x, y); note the order of the arguments.

    >>> from symbody import atan2, symbols
    >>> x, y = symbols("x y")
    >>> atan2(y, x).diff(y), atan2(1, -1)
    (x/(x**2 + y**2), 3*pi/4)
    """
    return _core.apply("atan2", (y, x))


def sinh(x: ExprLike) -> Expr:
    """Return the hyperbolic sine.

    >>> from symbody import sinh, symbols
    >>> x, y = symbols("x y")
    >>> sinh(x).diff(x), sinh(0)
    (cosh(x), 0)
    """
    return _core.apply("sinh", (x,))


def cosh(x: ExprLike) -> Expr:
    """Return the hyperbolic cosine.

    >>> from symbody import cosh, symbols
    >>> x, y = symbols("x y")
    >>> cosh(x).diff(x), cosh(0)
    (sinh(x), 1)
    """
    return _core.apply("cosh", (x,))


def tanh(x: ExprLike) -> Expr:
    """Return the hyperbolic tangent.

    >>> from symbody import tanh, symbols
    >>> x, y = symbols("x y")
    >>> tanh(-x), tanh(0)
    (-tanh(x), 0)
    """
    return _core.apply("tanh", (x,))


def exp(x: ExprLike) -> Expr:
    """Return e to the power x.

    >>> from symbody import exp, symbols
    >>> x, y = symbols("x y")
    >>> exp(x) * exp(y) == exp(x + y), exp(x).diff(x)
    (True, exp(x))
    """
    return _core.apply("exp", (x,))


def log(x: ExprLike) -> Expr:
    """Return the natural logarithm.

    >>> from symbody import exp, log, symbols
    >>> x, y = symbols("x y")
    >>> log(exp(x)), log(x).diff(x)
    (x, 1/x)
    """
    return _core.apply("log", (x,))


def sqrt(x: ExprLike) -> Expr:
    """Return the non-negative square root.

    >>> from symbody import sqrt, symbols
    >>> x, y = symbols("x y")
    >>> sqrt(x**2), sqrt(8)
    (Abs(x), 2*sqrt(2))
    """
    return _core.sqrt(x)


def Abs(x: ExprLike) -> Expr:
    """Return the absolute value.

    >>> from symbody import Abs, symbols
    >>> x, y = symbols("x y")
    >>> Abs(-x), Abs(x) ** 2, Abs(x).diff(x)
    (Abs(x), x**2, sign(x))
    """
    return _core.apply("Abs", (x,))


def sign(x: ExprLike) -> Expr:
    """Return -1 for negative x, 1 for positive x, and 0 for zero.

    >>> from symbody import sign, symbols
    >>> x, y = symbols("x y")
    >>> sign(-x), sign(-3), sign(x) * x
    (-sign(x), -1, x*sign(x))
    """
    return _core.apply("sign", (x,))


def Min(*args: ExprLike) -> Expr:
    """Return the smallest of the arguments.

    >>> from symbody import Min, symbols
    >>> x, y = symbols("x y")
    >>> Min(x, y), Min(x, x), Min(1, 2, -3)
    (Min(x, y), x, -3)
    """
    return _core.apply("Min", args)


def Max(*args: ExprLike) -> Expr:
    """Return the greatest of the arguments.

    >>> from symbody import Max, symbols
    >>> x, y = symbols("x y")
    >>> Max(x, y), Max(x, x), Max(1, 2, -3)
    (Max(x, y), x, 2)
    """
    return _core.apply("Max", args)


def Piecewise(*branches: tuple[ExprLike, ExprLike | bool], otherwise: ExprLike = 0) -> Expr:
    """Return the value of the first branch ``(value, condition)`` whose condition is positive; ``x`` means x > 0.

    Args:
        branches: pairs of a value and the expression that is its condition. A last branch ``(value, True)`` means the
            same as ``otherwise=value``.
        otherwise: the value where no condition is positive.

    >>> from symbody import Piecewise, symbols
    >>> x, k = symbols("x k")
    >>> contact = Piecewise((k * x, x))  # a spring that pushes only
    >>> contact.subs({x: -1})
    0
    """
    flat: list[ExprLike] = []
    for place, branch in enumerate(branches, 1):
        if not isinstance(branch, tuple) or len(branch) != 2:  # type: ignore[redundant-expr]  # users may err
            raise ArgumentError(
                f"a branch of Piecewise is a pair (value, condition > 0), found {brief(repr(branch))}"
            )
        if branch[1] is True and place == len(branches):
            return _core.apply("Piecewise", (*flat, branch[0]))
        flat.extend(branch)
    return _core.apply("Piecewise", (*flat, otherwise))
