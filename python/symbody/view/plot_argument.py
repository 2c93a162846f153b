"""Arguments of plots, checked: units by name, limits of axes."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from numbers import Real

from symbody.errors import ViewError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

__all__ = ["checked_limits", "checked_units"]


def checked_units(units: object, where: str) -> Mapping[Expr | str, str]:
    """Return units by expression or by name; an empty dictionary for None.

    Raises:
        ViewError: they are no dictionary of texts.

    >>> checked_units({"force": "N"}, "plot")
    {'force': 'N'}
    """
    if units is None:
        return {}
    if not isinstance(units, Mapping):
        raise ViewError(f"{where}, units: {described(units)}; expected a dictionary, such as {{x: 'm'}}")
    for name, unit in units.items():
        if not isinstance(unit, str):
            raise ViewError(f"{where}, units, {name}: {described(unit)}; expected a text, such as 'm'")
    return units


def checked_limits(limits: object, where: str) -> tuple[float, float] | None:
    """Return the least and the largest value of an axis; None for all.

    Raises:
        ViewError: they are not two finite numbers in order.
    """
    if limits is None:
        return None
    pair = tuple(limits) if isinstance(limits, tuple | list) else ()
    if len(pair) != 2 or not all(isinstance(v, Real) and isfinite(v) for v in pair) or not pair[0] < pair[1]:
        raise ViewError(
            f"{where}: {described(limits)}; expected the least and the largest value, such as (-20, 5)"
        )
    return float(pair[0]), float(pair[1])
