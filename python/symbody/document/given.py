"""What a report is given besides the model: values of parameters and coordinates, units, a title."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from symbody.dynamics import Equations
from symbody.errors import ReportError
from symbody.multibody import Variables
from symbody.simulation.given.unused import warn_of_unused
from symbody.simulation.given.values import check_known, finite_number, state_values
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief, described

__all__ = ["parameters_of", "position_of", "title_of", "units_of"]


def parameters_of(equations: Equations, given: object) -> dict[Expr, float]:
    """Return the values of parameters; a notice reports those that the model doesn't contain.

    Raises:
        ReportError: the argument is not a dictionary of symbols.
        ParameterError: a key is not a parameter, or a value is not finite.
        ArgumentError: a value is not a number.
    """
    found = _by_symbol(given, "parameters", "{l: 0.5}")
    symbols = [each for each in found if each.kind == "symbol" and each not in equations.parameters]
    known = (*equations.parameters, *symbols)
    check_known(found, known, "report, parameters", "a parameter of these equations")
    warn_of_unused(equations, found, (), "report")
    return {name: finite_number(name, value, "report, parameters") for name, value in found.items()}


def position_of(system: Variables, given: object) -> dict[Expr, float]:
    """Return the values of coordinates.

    Raises:
        ReportError: the argument is not a dictionary of functions of time.
        ParameterError: a key is not a coordinate, or a value is not finite.
        ArgumentError: a value is not a number.
    """
    found = _by_symbol(given, "position", "{theta: 0.3}")
    return state_values(system, found, where="report", argument="position", has_speeds=False)


def units_of(equations: Equations, given: object) -> dict[Expr, str]:
    """Return the units of symbols.

    Raises:
        ReportError: the argument is not a dictionary of symbols and texts.
        ParameterError: a key is not a variable of the model.
    """
    found = _by_symbol(given, "units", "{k: 'N/m'}")
    system = equations.system
    known = {
        *equations.parameters,
        *system.leaves,
        *equations.inputs,
        *system.state_names,
        *equations.multipliers,
    }
    in_order = sorted(known, key=str)
    check_known(found, in_order, "report, units", "a variable of this model")
    for name, unit in found.items():
        if not isinstance(unit, str):
            raise ReportError(f"report, units: {described(unit)}, for {name}; expected a text, such as 'N/m'")
    return found


def title_of(given: object) -> str:
    """Return the title; the empty text stands for the name of the system.

    Raises:
        ReportError: the title is not a text.
    """
    if not isinstance(given, str):
        raise ReportError(f"report, title: {described(given)}; expected a text, such as 'A pendulum'")
    return given


def _by_symbol(given: object, name: str, example: str) -> dict[Expr, Any]:
    """Return a dictionary by symbols and functions of time; the empty one by default."""
    found: object = {} if given is None else given
    if not isinstance(found, Mapping) or not all(isinstance(key, Expr) for key in found):
        raise ReportError(f"report: {brief(found)} for {name}; expected a dictionary such as {example}")
    return dict(found)
