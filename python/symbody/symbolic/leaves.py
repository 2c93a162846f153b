"""Symbols, functions of time, undefined functions and constants."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from symbody.errors import ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr

__all__ = [
    "ExprLike",
    "UndefinedFunction",
    "function",
    "functions_of_time",
    "number",
    "pi",
    "symbol",
    "symbols",
    "t",
]

#: What converts to an expression: int, float, Fraction and NumPy scalars do.
ExprLike: TypeAlias = Expr | int | float

#: Names that print as something else.
_TAKEN = {"t": "time, symbody.t", "pi": "the circle constant, symbody.pi"} | {
    name: f"the function symbody.{name}" for name in (*_core.function_names(), "sqrt") if name != "Power"
}
_NAME = re.compile(r"[^\W\d]\w*")

t: Expr = _core.time()
"""The independent variable, time."""

pi: Expr = _core.pi()
"""The circle constant."""

number = _core.number
symbol = _core.symbol


def _names(text: str) -> list[str]:
    names = text.replace(",", " ").split()
    if not names:
        raise ExpressionError(f"no name in {text!r}; expected names separated by blanks, such as 'm g l1'")
    for name in names:
        if not _NAME.fullmatch(name):
            raise ExpressionError(
                f"{name!r} is no name; expected letters, digits and underscores, not starting with a digit"
            )
        if name in _TAKEN:
            raise ExpressionError(f"the name {name!r} stands for {_TAKEN[name]}; choose another name")
    return names


def symbols(names: str, *, positive: bool = False, real: bool = True) -> Any:
    """Return the symbols of these names, one alone or a tuple.

    A symbol is real unless ``real=False``; the roots of a ``positive`` one are taken exactly.

    >>> from symbody import sqrt, symbols
    >>> m, g = symbols("m g")
    >>> length = symbols("length", positive=True)
    >>> sqrt(length**2)
    length
    """
    made = tuple(_core.symbol(name, positive=positive, real=real) for name in _names(names))
    return made[0] if len(made) == 1 else made


def functions_of_time(names: str) -> Any:
    """Return functions of time of these names, one alone or a tuple; primes denote their derivatives.

    >>> from symbody import functions_of_time, time_derivative
    >>> x, y = functions_of_time("x y")
    >>> time_derivative(x * y)
    x*y' + x'*y
    """
    made = tuple(_core.time_function(name) for name in _names(names))
    return made[0] if len(made) == 1 else made


@dataclass(frozen=True)
class UndefinedFunction:
    """A function of which nothing but the name is known; applied to arguments it is an expression."""

    name: str

    def __call__(self, *args: ExprLike) -> Expr:
        if not args:
            raise ExpressionError(f"{self.name} needs at least one argument, found none")
        return _core.application(self.name, args)

    def derivative(self, orders: Sequence[int], *args: ExprLike) -> Expr:
        """Return the partial derivative of the given orders, one for each argument."""
        return _core.application(self.name, args, list(orders))


def function(name: str) -> UndefinedFunction:
    """Return the undefined function of this name.

    >>> from symbody import function, symbols
    >>> x, y = symbols("x y")
    >>> f = function("f")
    >>> f(x * y, y).diff(x)
    y*D[1](f)(x*y, y)
    """
    (checked,) = _names(name)
    return UndefinedFunction(checked)
