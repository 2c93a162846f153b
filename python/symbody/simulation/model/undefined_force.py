"""Loads whose forces are not finite, such as those of springs whose ends meet, or of tyres that stand still."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.multibody import Element, Load, System, Variables
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.arguments import brief

__all__ = ["undefined_force"]


def undefined_force(system: Variables, given: Given, known: Mapping[Expr, float]) -> str:
    """Return which load has a force that is not finite, and the way out; the empty text if none has.

    Args:
        system: the system.
        given: the expressions that replace input functions of time.
        known: the values of time, parameters, coordinates, speeds and states.
    """
    if not isinstance(system, System):
        return ""
    for load in system.loads:
        values = _values(load, system, given, known)
        if values is None or np.isfinite(values).all():
            continue
        if isinstance(load, Element) and load.undefined is not None and values[0] == 0:
            return f"{brief(load)} {load.undefined.words}"
        return (
            f"{brief(load)} is not finite; look in it for a division by zero, a root or logarithm of a negative value, "
            "or parameters that make no sense"
        )
    return ""


def _values(
    load: Load, system: System, given: Given, known: Mapping[Expr, float]
) -> NDArray[np.float64] | None:
    """Return what is zero where the law has no value, 1 if there is no such place, and the components of all forces.

    None is returned if they depend on what isn't known, such as multipliers.
    """
    undefined = load.undefined if isinstance(load, Element) else None
    forces = [component for action in load.actions for component in action.vector.components]
    wanted = [*forces] if undefined is None else [undefined.where_zero, *forces]
    values = substitute_inputs(system, given, wanted)
    if not free_symbols(values) <= known.keys():
        return None
    with np.errstate(all="ignore"):
        found = np.asarray(lambdify([list(known)], list(values))([*known.values()]), float)
    return found if undefined is not None else np.concatenate([[1.0], found])
