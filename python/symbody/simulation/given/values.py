"""The values given for parameters and for a state: complete, known by name, and finite."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import CanonicalEquations, Equations
from symbody.errors import ArgumentError, ModelError, ParameterError
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.symbolic import Expr, ExprLike, t
from symbody.symbolic.given.arguments import brief, described, expression
from symbody.symbolic.given.namesake import namesake_note
from symbody.symbolic.given.similar_name import did_you_mean

from .closing_joint import closing_joint
from .column import column_of
from .given_input import check_no_circle
from .missing_input import missing_inputs

__all__ = [
    "check_equations",
    "check_known",
    "check_parameters",
    "check_state_names",
    "finite_number",
    "given_inputs",
    "parameter_values",
    "state_values",
    "zero_parameters",
]


def parameter_values(
    names: Sequence[Expr],
    parameters: Mapping[Expr, ArrayLike] | None,
    *,
    where: str = "simulate",
    beside: Iterable[Expr] = (),
) -> NDArray[np.float64]:
    """Return the values of parameters, in the order of their names. Other parameters may have values, too.

    Args:
        names: the parameters that need values.
        parameters: their values.
        where: the function that the user called, for messages.
        beside: other variables of the model, which a parameter without a value may be mistaken for.

    Raises:
        ParameterError: a parameter has no value, a key is not a symbol, or a value is not finite.
        ArgumentError: the parameters are not a mapping, or a value is not a number.

    >>> from symbody import symbols
    >>> m, g = symbols("m g")
    >>> parameter_values([g, m], {m: 2, g: 9.81})
    array([9.81, 2.  ])
    """
    given = _mapping(parameters, where, "parameters")
    check_parameters(names, given, where, beside)
    values = {name: finite_number(name, value, f"{where}, parameters") for name, value in given.items()}
    return np.array([values[name] for name in names], dtype=np.float64)


def check_parameters(
    names: Sequence[Expr],
    given: Mapping[Any, ArrayLike],
    where: str = "simulate",
    beside: Iterable[Expr] = (),
) -> None:
    """Check that all parameters have values, and that only symbols have values.

    Args:
        names: the parameters.
        given: the values.
        where: the function that the user called, for messages.
        beside: other variables of the model, which a parameter without a value may be mistaken for.

    Raises:
        ParameterError: a parameter has no value, or a key is not a symbol.
    """
    more = tuple(
        name for name in given if isinstance(name, Expr) and name.kind == "symbol" and name not in names
    )
    check_known(given, (*names, *more), f"{where}, parameters", "a parameter of these equations")
    missing = [name for name in names if name not in given]
    if missing:
        unused = f"; the equations don't contain {_listed(more)}, which you gave" if more else ""
        raise ParameterError(
            f"{where}: no value for {_listed(missing)}; give parameters={{{_examples(missing)}}}"
            f"{namesake_note(missing, given) or namesake_note(missing, beside, _OF_THE_MODEL) or unused}"
        )


def zero_parameters(parameters: object) -> tuple[Expr, ...]:
    """Return the parameters with a value of zero, in one case at least. Values that are not numbers are ignored."""
    if not isinstance(parameters, Mapping):
        return ()
    return tuple(name for name, value in parameters.items() if _has_zero(value))


def _has_zero(value: object) -> bool:
    return value == 0 if isinstance(value, float | int) else bool(np.any(np.asarray(value) == 0))


def state_values(
    system: Variables,
    given: Mapping[Expr, ArrayLike] | None,
    *,
    where: str = "simulate",
    argument: str = "initial",
    has_speeds: bool = True,
    has_states: bool = False,
    kept: Sequence[Expr] | None = None,
) -> dict[Expr, float]:
    """Return the given values of coordinates, rates of coordinates, speeds, and states.

    Args:
        system: the system.
        given: the values; a variable that is not named is free.
        where: the function that the user called, for messages.
        argument: the name of the argument, for messages.
        has_speeds: whether rates, speeds and states may be given, or only coordinates.
        has_states: whether states may be given beside coordinates, where speeds may not.
        kept: the states that may be given, if nothing else may.

    Raises:
        ParameterError: a key is not a coordinate, a rate of one or a speed; or a value is not finite.
        ArgumentError: the argument is not a mapping, or a value is not a number.
    """
    values, place = _mapping(given, where, argument), f"{where}, {argument}"
    if kept is not None:
        check_known(values, kept, place, "a state of this system that is integrated")
    elif has_speeds:
        check_state_names(system, values, place)
    elif has_states:
        known = (*system.coordinates, *system.states)
        check_known(values, known, place, "a coordinate or a state of this system", system)
    else:
        check_known(values, system.coordinates, place, "a coordinate of this system", system)
    return {name: finite_number(name, value, f"{where}, {argument}") for name, value in values.items()}


def check_state_names(system: Variables, given: Iterable[object], place: str) -> None:
    """Check that all keys are coordinates, rates of coordinates or speeds.

    Raises:
        ParameterError: a key is none of these.
    """
    kinds = "a coordinate, a rate of one, a speed or a state" if system.states else _OF_MECHANICS
    check_known(given, system.state_names, place, f"{kinds} of this system", system)


_OF_MECHANICS = "a coordinate, a rate of one or a speed"


def given_inputs(
    eqs: Equations,
    inputs: Mapping[Expr, ExprLike] | None,
    *,
    where: str = "simulate",
    besides: Collection[Expr] = (),
    parameters: Mapping[Expr, object] | None = None,
    example: str = "sin(t)",
) -> dict[Expr, Expr]:
    """Return the expressions that replace the input functions of time.

    Args:
        eqs: the equations that contain the inputs.
        inputs: expressions of time, state and parameters.
        where: the function that the user called, for messages.
        besides: functions of time that need no expression, because they are solved for.
        parameters: what the user gave as parameters, where inputs may stand by mistake.
        example: a value that messages propose for an input.

    Raises:
        ModelError: an input has no expression, or a key is not an input of the equations.
        ArgumentError: the inputs are not a mapping, or a value is not an expression.
    """
    check_equations(eqs, where)
    given = _mapping(inputs, where, "inputs")
    names = sorted({leaf.name for leaf in eqs.inputs})
    states = {z.name for z in eqs.states}
    for function in given:
        if _is_function(function) and function.name in states:
            raise ModelError(
                f"{where}, inputs: {function} is a state, whose rate is given; expected its initial value, "
                f"initial={{{function}: ...}}, or make the system with inputs=[{function}] instead of the state"
            )
        if not _is_function(function) or function.name not in names:
            raise ModelError(
                f"{where}, inputs: {_found(function)} is not a function of time that the equations contain "
                f"besides coordinates and speeds; expected {_listed(names) or 'none: leave inputs out'}"
                f"{namesake_note(eqs.inputs, [function], _EXPECTED)}"
            )
    known = {function.name for function in (*given, *besides)}
    missing = [name for name in names if name not in known]
    if missing:
        raise ModelError(missing_inputs(eqs, missing, parameters or {}, where, example))
    formulas = {function: _input(eqs, function, value, where) for function, value in given.items()}
    check_no_circle(eqs.system, formulas, where)
    return formulas


def check_equations(eqs: object, where: str) -> None:
    """Check that the user passed equations of motion.

    Raises:
        ArgumentError: the argument is something else.
    """
    if isinstance(eqs, CanonicalEquations):
        raise ArgumentError(
            f"{where}: the argument is canonical equations; expected equations of motion: pass their attribute "
            "equations, as in hamilton(system).equations"
        )
    if not isinstance(eqs, Equations):
        raise ArgumentError(
            f"{where}: {described(eqs)}; expected equations of motion, such as newton_euler(system)"
        )


def _input(eqs: Equations, function: Expr, value: Any, where: str) -> Expr:
    place, system = f"{where}, inputs, {function}", eqs.system
    if callable(value):
        raise ArgumentError(
            f"{place}: {described(value)}; expected an expression of time and state, such as {function}: sin(t)"
        )
    formula = expression(value, place)
    known = {t, *system.state_names}
    strange = {leaf for leaf in formula.free_symbols if leaf.depends_on_time} - known
    if strange:
        raise ModelError(
            f"{place}: {_listed(sorted(map(str, strange)))} is not part of the state; expected an expression of time, "
            "coordinates, speeds and parameters"
        )
    return formula


def finite_number(name: Expr, value: ArrayLike, place: str) -> float:
    """Return one finite number.

    Raises:
        ParameterError: there are several numbers, or the number is not finite.
        ArgumentError: the value is not a number.
    """
    column = column_of(name, value, place)
    if column.ndim:
        function = place.split(",", maxsplit=1)[0]
        way = (
            "for many motions use simulate_many"
            if function == "simulate"
            else f"call {function} for each value"
        )
        raise ParameterError(
            f"{place}: {name} has values of shape {column.shape}; expected one number; {way}"
        )
    if not np.isfinite(column):
        raise ParameterError(f"{place}: {name} is {float(column)}; expected a finite number")
    return float(column)


def check_known(
    given: Iterable[object],
    known: Sequence[Expr],
    place: str,
    expected: str,
    system: Variables | None = None,
) -> None:
    """Check that all keys are known, and suggest what was meant.

    Args:
        given: the keys.
        known: the variables that they may be.
        place: the function and the argument, for messages.
        expected: what the keys should be.
        system: the system, whose joints may close loops, if the keys are coordinates.

    Raises:
        ParameterError: a key is not known.
    """
    for name in given:
        if not isinstance(name, Expr) or name not in known:
            near = _of_closing_joint(name, known, system) or namesake_note(known, [name], _EXPECTED)
            near = near or f"; {_near(name, known)}"
            raise ParameterError(f"{place}: {_found(name)} is not {expected}{near}")


def _of_closing_joint(name: object, known: Sequence[Expr], system: Variables | None) -> str:
    """Return the way out for the coordinate of a joint that closes a loop, or a freedom; the empty text for others."""
    if isinstance(name, Freedom):
        return f"; freedom.value is {brief(name.value)}; expected one of {_listed(known)}"
    joint = None if name in known else closing_joint(system, name)
    if joint is None:
        return ""
    return (
        f": {joint} closes a loop, and has none; expected those of the tree, such as {known[0]}, or the joint with "
        "loop=False"
    )


_EXPECTED = ("expected", "given")
_OF_THE_MODEL = ("without a value", "of the model")
"""The descriptions by which `namesake_note` distinguishes variables of one name."""


def _mapping(given: object, where: str, argument: str) -> Mapping[Any, ArrayLike]:
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise ArgumentError(
            f"{where}, {argument}: {described(given)}; expected a dictionary of variables and their values"
        )
    return given


def _is_function(thing: object) -> bool:
    """Return whether something is a function of time, not a rate of one."""
    return isinstance(thing, Expr) and thing.kind == "time_function" and thing.order == 0


def _found(name: object) -> str:
    return brief(name) if isinstance(name, Expr) else described(name).replace(" is ", ", ", 1) + ","


def _near(name: object, known: Sequence[Expr]) -> str:
    """Return a suggestion: the variable for a text with its name, similar names, or all of them."""
    names = [str(each) for each in known]
    if not names:
        return "there are none: leave it out"
    if not isinstance(name, Expr) and str(name) in names:
        return f"expected the variable itself, {name}, and not its name"
    return did_you_mean([name], names) or f"expected one of {_listed(known)}"


def _listed(names: Iterable[object]) -> str:
    return ", ".join(map(str, names))


def _examples(names: Iterable[Expr]) -> str:
    return ", ".join(f"{name}: ..." for name in names)
