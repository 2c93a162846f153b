"""Integrals in numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from symbody.deferred import Deferred
from symbody.symbolic import Expr
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import decimal
from symbody.worksheet.values.value import Listed, Range, Relation, Unevaluated, Value

if TYPE_CHECKING:
    from scipy import integrate
else:
    integrate = Deferred("scipy.integrate")

__all__ = ["OF_FUNCTION", "integral_number"]

ValueAt: TypeAlias = Callable[[Value, Mapping[Expr, float]], float]

OF_FUNCTION = symbol("_x")
"""The variable of an integral that names none, ``Int(f, a..b)``: the argument of the function f."""


_INFINITE = {symbol("infinity"): math.inf, -symbol("infinity"): -math.inf}


@dataclass(frozen=True, slots=True)
class _Place:
    """A variable and its bounds, which may depend on the variables of the integrals around it."""

    variable: Expr
    low: Expr
    high: Expr


def integral_number(value: Unevaluated, digits: int, value_at: ValueAt | None = None) -> Value:
    """Return ``Int(e, x = a..b)``, ``Int(e, [x = a..b, y = c..d])`` or ``Int(f, a..b)`` as a number, if it is one.

    Other values are returned as they are.

    Args:
        value: the integral.
        digits: the digits of the number.
        value_at: gives the integrand at numbers, if it is a function, or calls functions that have digits of their own.
    """
    integrand, places = _iterated(value)
    if not places or not _has_all_names(integrand, places):
        return value

    def function(*at: float) -> Any:
        values = dict(zip((each.variable for each in places), at, strict=True))
        if value_at is not None:
            return value_at(integrand, values)
        assert isinstance(integrand, Expr)
        return integrand.evaluate(values)

    accuracy = (1e-13, 1e-12) if value_at is None else (1e-8, 1e-8)
    options: Any = {"epsabs": accuracy[0], "epsrel": accuracy[1], "limit": 200}
    bounds = [_bounds(places, k) for k in range(len(places))]
    found = integrate.nquad(function, bounds, opts=[options] * len(places))[0]
    return decimal(float(found), digits)


def _iterated(value: Value) -> tuple[Value, list[_Place]]:
    """Return the integrand of an integral and its places, the innermost first; without places for another value."""
    if not isinstance(value, Unevaluated) or getattr(value.function, "name", "") not in ("Int", "int"):
        return value, []
    if len(value.arguments) != 2:
        return value, []
    inner, places = _iterated(value.arguments[0])
    last = value.arguments[1]
    made = [_place(each) for each in (last.items if isinstance(last, Listed) else (last,))]
    return inner, [*places, *(each for each in made if each is not None)] if None not in made else []


def _place(value: Value) -> _Place | None:
    bounds = value.right if isinstance(value, Relation) else value
    variable = value.left if isinstance(value, Relation) else OF_FUNCTION
    if not isinstance(bounds, Range) or not isinstance(variable, Expr):
        return None
    low, high = bounds.start, bounds.stop
    return _Place(variable, low, high) if isinstance(low, Expr) and isinstance(high, Expr) else None


def _has_all_names(integrand: Value, places: Sequence[_Place]) -> bool:
    """Whether all names of an integral are its variables, and bounds are numbers where those around them are."""
    variables = {each.variable for each in places}
    if variables != {OF_FUNCTION} and not (
        isinstance(integrand, Expr) and integrand.free_symbols <= variables
    ):
        return False
    for k, each in enumerate(places):
        outer = {other.variable for other in places[k + 1 :]}
        for bound in (each.low, each.high):
            if not bound.free_symbols <= outer and bound not in _INFINITE:
                return False
    return True


def _bounds(places: Sequence[_Place], k: int) -> Callable[..., tuple[float, float]]:
    """Return the bounds of an integral as a function of the variables around it."""
    outer = [each.variable for each in places[k + 1 :]]

    def at(*values: float) -> tuple[float, float]:
        known = dict(zip(outer, values, strict=True))
        low, high = (_INFINITE.get(each) or each.evaluate(known) for each in (places[k].low, places[k].high))
        return float(low), float(high)

    return at
