"""Symbols, functions of time, undefined functions and constants."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeAlias

from symbody.errors import ArgumentError, ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.given.arguments import counted, described, size
from symbody.symbolic.given.name_list import is_list_of_names, names_in

__all__ = [
    "ExprLike",
    "Meaning",
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
_TAKEN = (
    {"t": "time, symbody.t", "pi": "the circle constant, symbody.pi"}
    | {name: f"the function symbody.{name}" for name in (*_core.function_names(), "sqrt") if name != "Power"}
    | {"linear_solution": "a component of a solution, symbody.linear_solve"}
)
_NAME = re.compile(r"[^\W\d]\w*")
_DIGITS = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_NUMBER = re.compile(rf"\s*[+-]?{_DIGITS}\s*(?:/\s*{_DIGITS}\s*)?")

t: Expr = _core.time()
"""The independent variable, time."""

pi: Expr = _core.pi()
"""The circle constant."""

symbol = _core.symbol


def number(value: ExprLike | Fraction | Decimal | str) -> Expr:
    """Return a number as an expression, exactly: a fraction, a decimal, or a text of one.

    Doubles keep the decimals that print them, and so do texts: 0.1 is 1/10.

    Raises:
        ArgumentError: it is no number.
        ExpressionError: the text is no number; ``parse`` reads expressions.

    >>> from fractions import Fraction
    >>> number(Fraction(1, 3)) + number(0.5), number("1/2"), number("1e-3")
    (0.8333333333333334, 1/2, 0.001)
    """
    return _number_in(value) if isinstance(value, str) else _core.number(value, "number")


def _number_in(text: str) -> Expr:
    if not _NUMBER.fullmatch(text):
        raise ExpressionError(
            f"number: {text!r} is no number; expected one such as '1/2', '-7/3', '0.1' or '1e-3'; "
            "parse reads expressions"
        )
    numerator, _, denominator = text.partition("/")
    if not denominator:
        return _decimal(numerator)
    divisor = _decimal(denominator)
    if divisor.is_zero:
        raise ExpressionError(f"number: {text!r} is divided by zero")
    return _decimal(numerator) / divisor


def _decimal(text: str) -> Expr:
    plain = text.strip()
    return _core.number(int(plain) if plain.lstrip("+-").isdigit() else Decimal(plain), "number")


def check_name(name: str) -> None:
    """Raise an error for a name that prints as something else."""
    if not _NAME.fullmatch(name):
        raise ExpressionError(
            f"{name!r} is no name; expected letters, digits and underscores, not starting with a digit"
        )
    if name in _TAKEN:
        raise ExpressionError(f"the name {name!r} stands for {_TAKEN[name]}; choose another name")


def _named(names: object, make: Callable[[str], Expr], place: str) -> Any:
    """Return what is made of each name, in the structure that the names have."""
    if isinstance(names, str):
        made = tuple(make(name) for name in _checked(names_in(names)))
        return made if is_list_of_names(names) else made[0]
    if not isinstance(names, Iterable):
        raise ArgumentError(f"{place}: {described(names)}; expected names in a text, such as 'm g l1'")
    listed = [_named(each, make, place) for each in names]
    return type(names)(listed) if isinstance(names, tuple | set | frozenset) else listed


def _checked(names: list[str]) -> list[str]:
    for name in names:
        check_name(name)
    return names


def symbols(
    names: str | Iterable[str], *, positive: bool = False, real: bool = True, **unknown: object
) -> Any:
    """Return the symbols of these names: one alone, a tuple for several or a range, a list for a list of texts.

    Names and ranges are written as for SymPy: ``"x y"``, ``"x0:3"`` (x0, x1, x2), ``"a:d"``, ``"x,"`` (a tuple of one).
    A symbol is real unless ``real=False``; the roots of a ``positive`` one are taken exactly. There are no other
    assumptions.

    >>> from symbody import sqrt, symbols
    >>> m, g = symbols("m g")
    >>> length = symbols("length", positive=True)
    >>> sqrt(length**2), symbols("q1:4"), symbols(["k"])
    (length, (q1, q2, q3), [k])
    """
    for assumption in unknown:
        negative = "; a negative number is -symbols('a', positive=True)" if assumption == "negative" else ""
        raise ArgumentError(
            f"symbols: there is no assumption {assumption}; expected positive=True, or real=False, or none{negative}"
        )
    for option, value in (("positive", positive), ("real", real)):
        if not isinstance(value, bool):
            raise ArgumentError(f"symbols: {option} is {value!r}; expected True or False")
    return _named(names, lambda name: _core.symbol(name, positive=positive, real=real), "symbols")


def functions_of_time(names: str | Iterable[str], **unknown: object) -> Any:
    """Return functions of time of these names, ranges too, as ``symbols`` does; primes denote their derivatives.

    They are real, and have no other assumptions.

    >>> from symbody import functions_of_time, time_derivative
    >>> x, y = functions_of_time("x y")
    >>> time_derivative(x * y)
    x*y' + x'*y
    """
    for assumption, value in unknown.items():
        if (assumption, value) != ("real", True):
            raise ArgumentError(
                f"functions_of_time: there is no assumption {assumption}; functions of time are real, and that is all "
                "that is known of them: leave it out"
            )
    return _named(names, _core.time_function, "functions_of_time")


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
        checked = [size(n, f"{self.name}.derivative: an order", "derivatives") for n in orders]
        if len(checked) != len(args):
            raise ExpressionError(
                f"{self.name}.derivative: {counted(len(checked), 'order')} for "
                f"{counted(len(args), 'argument')}; expected one for each"
            )
        return _core.application(self.name, args, checked)


def function(name: str) -> UndefinedFunction:
    """Return the undefined function of this name.

    >>> from symbody import function, symbols
    >>> x, y = symbols("x y")
    >>> f = function("f")
    >>> f(x * y, y).diff(x)
    y*D[1](f)(x*y, y)
    """
    if not isinstance(name, str):
        raise ArgumentError(f"function: {described(name)}; expected a name in a text, such as 'f'")
    found = _checked(names_in(name))
    if len(found) > 1:
        raise ExpressionError(f"function: {len(found)} names in {name!r}; expected one, such as 'f'")
    return UndefinedFunction(found[0])


Meaning: TypeAlias = ExprLike | UndefinedFunction
"""What a name in a text may stand for."""
