"""Elements along a line, such as springs with dampers, whose ends meet: there the line has no direction."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from symbody.codegen import lambdify
from symbody.multibody import System, Variables
from symbody.multibody.element.element import Element
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.arguments import brief

__all__ = ["without_direction"]


def without_direction(system: Variables, given: Given, known: Mapping[Expr, float]) -> str:
    """Return which element has a force that is not finite, as its length is zero; the empty text if none has.

    Args:
        system: the system.
        given: the expressions that replace input functions of time.
        known: the values of time, parameters, coordinates, speeds and states.
    """
    if not isinstance(system, System):
        return ""
    for load in system.loads:
        if not isinstance(load, Element) or load.line is None:
            continue
        forces = [component for action in load.actions for component in action.vector.components]
        values = substitute_inputs(system, given, [load.line, *forces])
        if not free_symbols(values) <= known.keys():
            continue
        with np.errstate(all="ignore"):
            found = lambdify([list(known)], list(values))([*known.values()])
        if found[0] == 0 and not np.isfinite(found).all():
            return (
                f"{brief(load)} has the length zero there, so that its line has no direction; keep its ends apart, "
                "or replace it: a spring of free length zero without damping, or a bushing, is safe there"
            )
    return ""
