"""An evaluator of expressions that shares nothing with the core: mpmath on `kind`, `name` and `args`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import prod

import mpmath

from symbody.symbolic import Expr

Value = mpmath.mpf | mpmath.mpc


def _piecewise(*arguments: Value) -> Value:
    """Return the first value whose condition, which follows it, is positive; else the last one."""
    *branches, otherwise = arguments
    pairs = zip(branches[::2], branches[1::2], strict=True)
    return next((result for result, condition in pairs if condition > 0), otherwise)


FUNCTIONS: Mapping[str, Callable[..., Value]] = {
    **{name: getattr(mpmath, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2")},
    **{name: getattr(mpmath, name) for name in ("sinh", "cosh", "tanh", "exp", "log", "sqrt")},
    "abs": abs,
    "sign": mpmath.sign,
    "min": min,
    "max": max,
    "piecewise": _piecewise,
}


def value(expression: Expr, point: Mapping[Expr, Value]) -> Value:
    """Return the value where the leaves have the values of the point."""
    if expression in point:
        return point[expression]
    if expression.kind == "number":
        exact = Fraction(str(expression))
        return mpmath.mpf(exact.numerator) / exact.denominator
    if expression.kind == "constant":
        return +mpmath.pi
    arguments = [value(argument, point) for argument in expression.args]
    match expression.kind:
        case "sum":
            return mpmath.fsum(arguments)
        case "product":
            return prod(arguments, start=mpmath.mpf(1))
        case "power":
            return mpmath.power(*arguments)
        case "function":
            return FUNCTIONS[expression.name.lower()](*arguments)
    raise ValueError(f"no value for {expression.kind} {expression}")
