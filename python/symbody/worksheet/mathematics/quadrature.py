"""Integrals in numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.symbolic import Expr
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Range, Relation, Unevaluated, Value

if TYPE_CHECKING:
    from scipy import integrate
else:
    integrate = Deferred("scipy.integrate")

__all__ = ["integral_number"]


def integral_number(value: Unevaluated, digits: int) -> Value:
    """Return ``Int(e, x = a..b)`` as a number, if it is one; other values as they are."""
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
        return integrand.evaluate({variable: x})

    found = integrate.quad(function, low, high, epsabs=1e-13, epsrel=1e-12, limit=200)[0]
    return decimal(float(found), digits)
