"""The functions of the table, applied to expressions and numbers."""

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
    """Return the sine of an angle in radians; ``math.pi/2`` beside other terms is pi/2, alone a number."""
    return _core.apply("sin", (_core.angle_beside_others(x, "sin"),))


def cos(x: ExprLike) -> Expr:
    """Return the cosine of an angle in radians; ``math.pi/2`` beside other terms is pi/2, alone a number."""
    return _core.apply("cos", (_core.angle_beside_others(x, "cos"),))


def tan(x: ExprLike) -> Expr:
    """Return the tangent of an angle in radians; ``math.pi/2`` beside other terms is pi/2, alone a number."""
    return _core.apply("tan", (_core.angle_beside_others(x, "tan"),))


def asin(x: ExprLike) -> Expr:
    """Return the angle in [-pi/2, pi/2] whose sine is x."""
    return _core.apply("asin", (x,))


def acos(x: ExprLike) -> Expr:
    """Return the angle in [0, pi] whose cosine is x."""
    return _core.apply("acos", (x,))


def atan(x: ExprLike) -> Expr:
    """Return the angle in (-pi/2, pi/2) whose tangent is x."""
    return _core.apply("atan", (x,))


def atan2(y: ExprLike, x: ExprLike) -> Expr:
    """Return the angle in (-pi, pi] of the point (x, y)."""
    return _core.apply("atan2", (y, x))


def sinh(x: ExprLike) -> Expr:
    """Return the hyperbolic sine."""
    return _core.apply("sinh", (x,))


def cosh(x: ExprLike) -> Expr:
    """Return the hyperbolic cosine."""
    return _core.apply("cosh", (x,))


def tanh(x: ExprLike) -> Expr:
    """Return the hyperbolic tangent."""
    return _core.apply("tanh", (x,))


def exp(x: ExprLike) -> Expr:
    """Return e to the power x."""
    return _core.apply("exp", (x,))


def log(x: ExprLike) -> Expr:
    """Return the natural logarithm."""
    return _core.apply("log", (x,))


def sqrt(x: ExprLike) -> Expr:
    """Return the non-negative square root; ``sqrt(x**2)`` is ``Abs(x)``."""
    return _core.sqrt(x)


def Abs(x: ExprLike) -> Expr:
    """Return the absolute value."""
    return _core.apply("Abs", (x,))


def sign(x: ExprLike) -> Expr:
    """Return -1, 0 or 1."""
    return _core.apply("sign", (x,))


def Min(*args: ExprLike) -> Expr:
    """Return the least of the arguments."""
    return _core.apply("Min", args)


def Max(*args: ExprLike) -> Expr:
    """Return the greatest of the arguments."""
    return _core.apply("Max", args)


def Piecewise(*branches: tuple[ExprLike, ExprLike | bool], otherwise: ExprLike = 0) -> Expr:
    """Return the value of the first branch ``(value, condition)`` whose condition is positive, as ``x`` is for x > 0.

    A last branch ``(value, True)`` says the same as ``otherwise=value``.

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
