"""Coordinates and speeds of a system: functions of time, not rates of them, each given once."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.errors import ModelError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief


def check_function_of_time(thing: Expr, where: str) -> None:
    """Raise an error unless a coordinate or a multiplier is a function of time, and not a rate of one."""
    if thing.kind != "time_function" or thing.order != 0:
        raise ModelError(f"{where} {brief(thing)} isn't a function of time; make it with functions_of_time")


def rate_of_any(coordinates: Iterable[Expr], leaves: Iterable[Expr]) -> Expr | None:
    """Return the first by name of the leaves that are rates of coordinates."""
    rates = [leaf for leaf in leaves if leaf.kind == "time_function" and leaf.order > 0]
    if not rates:  # as in most frames, for each of which this is asked
        return None
    names = {coordinate.name for coordinate in coordinates}
    of_coordinates = (rate for rate in rates if rate.name in names)
    return min(of_coordinates, key=lambda rate: (rate.name, rate.order), default=None)
