"""Symbols, functions of time, undefined functions and constants."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeAlias

from symbody.errors import ArgumentError, ExpressionError, user_frame
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.given.arguments import counted, described, size
from symbody.symbolic.given.name_list import is_list_of_names, names_in
from symbody.symbolic.given.new_namesake import notice_named

__all__ = [
    "ExprLike",
    "Meaning",
    "UndefinedFunction",
    "application",
    "function",
    "functions_of_time",
    "number",
    "pi",
    "symbol",
    "symbols",
    "t",
    "time_function",
]

#: What converts to an expression: numbers of Python (int, float, Fraction) and NumPy scalars.
ExprLike: TypeAlias = Expr | int | float

#: Names that have a meaning already.
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
time_function = _core.time_function
application = _core.application


def number(value: ExprLike | Fraction | Decimal | str) -> Expr:
    """Return a number as an exact expression: a fraction, a decimal, or a string with one.

    A double stands for the decimal that it prints as, and so does a string: 0.1 is 1/10.

    Raises:
        ArgumentError: the value is not a number.
        ExpressionError: the string is not a number; ``parse`` reads expressions.

    >>> from fractions import Fraction
    >>> number(Fraction(1, 3)) + number(0.5), number("1/2"), number("1e-3")
    (2.5/3, 1/2, 0.001)
    """
    return _number_in(value) if isinstance(value, str) else _core.number(value, "number")


def _number_in(text: str) -> Expr:
    if not _NUMBER.fullmatch(text):
        raise ExpressionError(
            f"number: {text!r} is not a number; expected one such as '1/2', '-7/3', '0.1' or '1e-3'; "
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
    """Raise an error for a name that has a meaning already, or that is not an identifier."""
    if not _NAME.fullmatch(name):
        raise ExpressionError(
            f"{name!r} is not a name; expected letters, digits and underscores, not starting with a digit"
        )
    if name in _TAKEN:
        raise ExpressionError(f"the name {name!r} stands for {_TAKEN[name]}; choose another name")


def _noticed(names: object, make: Callable[[str], Expr], place: str) -> Any:
    """Return what ``_named`` returns, after notices of variables with a name that others have."""
    made: dict[str, Expr] = {}

    def made_too(name: str) -> Expr:
        made[name] = variable = make(name)
        return variable

    result = _named(names, made_too, place)
    notice_named(made.items(), place, user_frame())
    return result


def _named(names: object, make: Callable[[str], Expr], place: str) -> Any:
    """Return what ``make`` returns for each name, in the same nested structure as the names."""
    if isinstance(names, str):
        made = [make(name) for name in _checked(names_in(names))]
        return tuple(made) if is_list_of_names(names) else made[0]
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
    """Return symbols: one for one name, a tuple for several names or a range, a list for a list of strings.

    Args:
        names: names and ranges, written as in SymPy: ``"x y"``, ``"x0:3"`` (x0, x1, x2), ``"a:d"``, ``"x,"`` (a tuple
            of one); or a list of these.
        positive: whether the values are positive: ``sqrt(x**2)`` is then x.
        real: whether the values are real.
        unknown: any other assumption, which is an error.

    >>> from symbody import sqrt, symbols
    >>> m, g = symbols("m g")
    >>> length = symbols("length", positive=True)
    >>> sqrt(length**2), symbols("q1:4"), symbols(["k"])
    (length, (q1, q2, q3), [k])
    """
    _check_not_small(names, "symbols", unknown)
    for assumption in unknown:
        negative = "; a negative number is -symbols('a', positive=True)" if assumption == "negative" else ""
        raise ArgumentError(
            f"symbols: unknown assumption {assumption}; expected positive=True, real=False, or none{negative}"
        )
    for option, value in (("positive", positive), ("real", real)):
        if not isinstance(value, bool):
            raise ArgumentError(f"symbols: {option} is {value!r}; expected True or False")
    if positive and not real:
        raise ArgumentError(
            "symbols: positive=True with real=False; positive numbers are real: leave one of them out"
        )
    return _noticed(names, lambda name: _core.symbol(name, positive=positive, real=real), "symbols")


def _check_not_small(names: object, place: str, options: Mapping[str, object]) -> None:
    """Raise an error for the option by which a user may try to make small variables."""
    if "small" in options:
        raise ArgumentError(
            f"{place}: small is a function, not an option; expected small(*{place}({names!r}))"
        )


def functions_of_time(names: str | Iterable[str], **unknown: object) -> Any:
    """Return functions of time, for names and ranges as in ``symbols``; primes denote their derivatives.

    Args:
        names: names and ranges, as in ``symbols``.
        unknown: assumptions. Functions of time are real, so ``real=True`` may be given; any other one is an error.

    >>> from symbody import functions_of_time, time_derivative
    >>> x, y = functions_of_time("x y")
    >>> time_derivative(x * y)
    x*y' + y*x'
    """
    _check_not_small(names, "functions_of_time", unknown)
    for assumption, value in unknown.items():
        if (assumption, value) != ("real", True):
            raise ArgumentError(
                f"functions_of_time: unknown assumption {assumption}; functions of time are real and have no other "
                "assumptions: leave it out"
            )
    return _noticed(names, _core.time_function, "functions_of_time")


@dataclass(frozen=True)
class UndefinedFunction:
    """A function of which only the name is known; applied to arguments, it gives an expression.

    >>> from symbody import function, symbols
    >>> x, y = symbols("x y")
    >>> f = function("f")
    >>> f(x, y).diff(y) == f.derivative([0, 1], x, y)
    True
    """

    name: str

    def __call__(self, *args: ExprLike) -> Expr:
        if not args:
            raise ExpressionError(f"{self.name} needs at least one argument, found none")
        return _core.application(self.name, args)

    def derivative(self, orders: Sequence[int], *args: ExprLike) -> Expr:
        """Return a partial derivative at ``args``; ``orders`` has one order for each argument."""
        checked = [size(n, f"{self.name}.derivative: an order", "derivatives") for n in orders]
        if len(checked) != len(args):
            raise ExpressionError(
                f"{self.name}.derivative: {counted(len(checked), 'order')} for "
                f"{counted(len(args), 'argument')}; expected one for each"
            )
        return _core.application(self.name, args, checked)


def function(name: str) -> UndefinedFunction:
    """Return the undefined function with this name.

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
"""A possible meaning of a name in a parsed text."""
