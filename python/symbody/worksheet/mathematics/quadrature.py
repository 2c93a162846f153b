"""Integrals in numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from symbody.deferred import Deferred
from symbody.symbolic import Expr
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Range, Relation, Unevaluated, Value

if TYPE_CHECKING:
    from scipy import integrate
else:
    integrate = Deferred("scipy.integrate")

__all__ = ["integral_number"]

ValueAt: TypeAlias = Callable[[Expr, Mapping[Expr, float]], float]


def integral_number(value: Unevaluated, digits: int, value_at: ValueAt | None = None) -> Value:
    """Return ``Int(e, x = a..b)`` as a number, if it is one; other values as they are.

    Args:
        value: the integral.
        digits: the digits of the number.
        value_at: gives the integrand at a number, if it calls functions that have digits of their own.
    """
    place = value.arguments[1] if len(value.arguments) == 2 else None
    if getattr(value.function, "name", "") not in ("Int", "int") or not isinstance(place, Relation):
        return value
    integrand, variable, range_ = value.arguments[0], place.left, place.right
    if not (isinstance(integrand, Expr) and isinstance(variable, Expr) and isinstance(range_, Range)):
        return value
    low, high = (as_float(each) if isinstance(each, Expr) else None for each in (range_.start, range_.stop))
    if low is None or high is None or not integrand.free_symbols <= {variable}:
        return value

    def function(x: float) -> Any:
        return (value_at or Expr.evaluate)(integrand, {variable: x})

    accuracy = (1e-13, 1e-12) if value_at is None else (1e-8, 1e-8)
    found = integrate.quad(function, low, high, epsabs=accuracy[0], epsrel=accuracy[1], limit=200)[0]
    return decimal(float(found), digits)
