"""Motors at their limits, where no steady motion was found: what is asked of them has no effect any more."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.multibody import Element, Variables
from symbody.symbolic import Expr, substitute
from symbody.symbolic.given.arguments import brief

__all__ = ["reached_limits"]

BEYOND = 1e-9
"""How far what is asked of a motor is beyond its limit, relative to it."""


def reached_limits(system: Variables, inputs: Mapping[Expr, Expr], values: Mapping[Expr, float]) -> str:
    """Return which motors are at their limits, as a part of a message; empty if none is.

    Args:
        system: the system.
        inputs: the expressions of inputs.
        values: those of variables and parameters.
    """
    found = []
    for load in getattr(system, "loads", ()):
        if not isinstance(load, Element) or "effort" not in load.law or "effort" not in load.quantities:
            continue
        efforts = substitute([load.law["effort"], load["effort"]], dict(inputs))
        if all(each.free_symbols <= values.keys() for each in efforts):
            asked, given = (float(each.evaluate(dict(values))) for each in efforts)
            if abs(asked - given) > BEYOND * (1 + abs(given)):
                found.append(f"{brief(load)} is at its limit of {given:.6g}")
    return f", where {', '.join(found)}" if found else ""
