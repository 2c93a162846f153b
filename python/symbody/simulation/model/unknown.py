"""Errors for variables that have no values along a motion."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.errors import ParameterError, SimulationError
from symbody.multibody import Variables
from symbody.simulation.given.closing_joint import measured_note
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.namesake import namesake_note
from symbody.symbolic.given.wording import joined_by_and

from .model import Model

__all__ = ["explain_unknown", "unknown_variables"]

_LISTED = 8


def explain_unknown(place: str, wanted: Sequence[Expr], model: Model, parameters: Iterable[Expr]) -> None:
    """Raise an error that names the variables without values along a motion; do nothing if all have values.

    Args:
        place: the call that failed, for the message.
        wanted: the expressions.
        model: the model.
        parameters: the parameters that have values.

    Raises:
        ParameterError: a parameter has no value.
        SimulationError: another variable has no values.
    """
    known = {*model.code_variables, *model.accelerations, *model.multipliers, *model.damping, *parameters}
    strange = [leaf for leaf in free_symbols(wanted) if not free_symbols(model.along_motion([leaf])) <= known]
    note = namesake_note(strange, known, ("asked for", "of the motion"))
    symbols = sorted(str(leaf) for leaf in strange if leaf.kind == "symbol")
    if symbols:
        function = "simulate_many" if place == "runs" else "simulate"
        raise ParameterError(
            f"{place}: {', '.join(symbols)} has no value in this motion; give it with the parameters of "
            f"{function}{note}"
        )
    if strange:
        raise SimulationError(unknown_variables(place, strange, model.system) + note)


def unknown_variables(place: str, unknown: Iterable[Expr], system: Variables, more: str = "") -> str:
    """Return which variables have no values along a motion, which ones have, and a way out.

    Args:
        place: the call that failed.
        unknown: the variables.
        system: the system.
        more: other variables that have values.

    >>> from symbody import Body, System, functions_of_time, symbols, translate
    >>> (x, y), m = functions_of_time("x y"), symbols("m")
    >>> text = unknown_variables("motion", [y], System([Body(translate(x, 0, 0), m)], coordinates=[x]))
    >>> text.partition(";")[0]
    'motion: no values of y'
    """
    names = sorted(set(unknown), key=str)
    known = f"the coordinates {_shown(system.coordinates)}, the speeds {_shown(system.speeds)}"
    known += f", the states {_shown(system.states)}" if system.states else ""
    return (
        f"{place}: no values of {_shown(names)}; this motion has values of time, {known}, accelerations, multipliers "
        f"and parameters{more}; {_way_out(names, system)}"
    )


def _way_out(names: Sequence[Expr], system: Variables) -> str:
    own = {coordinate.name for coordinate in (*system.coordinates, *system.speeds, *system.states)}
    rates = [name for name in names if name.kind == "time_function" and name.order and name.name in own]
    if rates:
        verb = "is" if len(rates) == 1 else "are"
        return (
            f"{_shown(rates)} {verb} of too high an order: evaluate the accelerations and differentiate their "
            "values, for example with numpy.gradient"
        )
    eliminated = [name for name in names if name in system.whole.multipliers]
    if eliminated and system.eliminated:
        return (
            f"{_shown(eliminated)} of the constraints were eliminated: simulate the equations with multipliers, or let "
            "inverse_dynamics(equations, motion, unknowns=[]) find them along this motion, with the equations that "
            "were embedded, and evaluate there"
        )
    closing = measured_note(system, names)
    if closing:
        return closing.removeprefix("; ")
    verb, what = ("is", "it") if len(names) == 1 else ("are", "them")
    return (
        f"{_shown(names)} {verb} neither a coordinate nor a speed of this system: use those, or add {what} to the "
        "system before simulating"
    )


def _shown(names: Sequence[Expr]) -> str:
    return joined_by_and([str(name) for name in names], most=_LISTED)
