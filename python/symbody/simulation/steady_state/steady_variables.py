"""The variables of steady motions: names are checked, and sorted by what they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from math import isnan, nan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ArgumentError, ModelError, ParameterError, SymbodyError
from symbody.simulation.given.values import check_known, finite_number, given_inputs
from symbody.symbolic import Expr, ExprLike, free_symbols, symbol, time_derivative
from symbody.symbolic.given.arguments import brief, described
from symbody.symbolic.given.wording import joined_by_and

__all__ = [
    "Kinds",
    "Limits",
    "Values",
    "bounds",
    "checked_held",
    "checked_unknown",
    "inputs_of",
    "least_and_largest",
    "numbers",
    "sorted_by_kind",
]

Array = NDArray[np.float64]
Limits = Mapping[Expr, tuple[float, float]]
Values = Mapping[Expr, ArrayLike]


@dataclass(frozen=True, eq=False)
class Kinds:
    """The variables of equations, by what they are.

    Attributes:
        equations: the equations of motion.
        where: the function that the user called, for messages.
    """

    equations: Equations
    where: str

    @property
    def state(self) -> tuple[Expr, ...]:
        """Coordinates, speeds and states."""
        eqs = self.equations
        return (*eqs.coordinates, *eqs.speeds, *eqs.states)

    @property
    def inputs(self) -> tuple[Expr, ...]:
        """The input functions of time."""
        return tuple(dict.fromkeys(each for each in self.equations.inputs if each.order == 0))

    @property
    def all(self) -> tuple[Expr, ...]:
        """All that may be given or unknown."""
        return (*self.state, *self.inputs, *self.equations.parameters)

    @property
    def leaves(self) -> set[Expr]:
        """What expressions of a steady motion may hold."""
        rates = [time_derivative(q) for q in self.equations.coordinates]
        return {*self.all, *rates, *self.equations.multipliers, *self.equations.system.eliminated}


def sorted_by_kind(
    kinds: Kinds, given: Values | None
) -> tuple[dict[Expr, float], dict[Expr, float], dict[Expr, float], dict[Expr, float]]:
    """Return the given values of the state, of other expressions, of parameters and of inputs.

    Raises:
        ParameterError: a key is none of these.
    """
    values = numbers(kinds, given, "given", None)
    state, parameters, inputs = (
        {name: value for name, value in values.items() if name in group}
        for group in (kinds.state, kinds.equations.parameters, kinds.inputs)
    )
    others = {name: value for name, value in values.items() if name not in kinds.all}
    for expression in others:
        strange = free_symbols([expression]) - kinds.leaves
        if strange or not any(leaf.depends_on_time for leaf in free_symbols([expression])):
            wrong = sorted(strange, key=str)[:1] or [expression]
            check_known(wrong, kinds.all, f"{kinds.where}, given", _VARIABLE, kinds.equations.system)
    return state, others, parameters, inputs


def numbers(kinds: Kinds, given: object, argument: str, known: tuple[Expr, ...] | None) -> dict[Expr, float]:
    """Return given numbers by their keys.

    Raises:
        ParameterError: a key is not known, or a value is not a finite number.
        ArgumentError: they are no dictionary of expressions.
    """
    place = f"{kinds.where}, {argument}"
    if given is not None and not isinstance(given, Mapping):
        raise ArgumentError(
            f"{place}: {described(given)}; expected a dictionary of variables and their values"
        )
    values: dict[Expr, ArrayLike] = dict(given or {})
    for name in values:
        if known is not None or not isinstance(name, Expr):
            check_known([name], known or kinds.all, place, _VARIABLE, kinds.equations.system)
    return {name: finite_number(name, value, place) for name, value in values.items()}


_VARIABLE = "a variable of these equations"


def checked_unknown(kinds: Kinds, unknown: Iterable[Expr], given: set[Expr]) -> tuple[Expr, ...]:
    """Return the parameters and inputs that are solved for. The state is unknown where it is not given.

    Raises:
        ArgumentError: they are no list.
        ParameterError: one of them is not a variable, or is given.
    """
    names = _listed(unknown, f"{kinds.where}, unknown", "parameters and inputs")
    check_known(names, kinds.all, f"{kinds.where}, unknown", _VARIABLE, kinds.equations.system)
    both = [name for name in names if name in given]
    if both:
        raise ParameterError(
            f"{kinds.where}: {joined_by_and([str(name) for name in both])} {'is' if len(both) == 1 else 'are'} both "
            "given and unknown; leave it out of one of them, and give a value to begin with as guess={...}"
        )
    return tuple(name for name in names if name not in kinds.state)


def _listed(given: object, place: str, expected: str) -> tuple[Expr, ...]:
    """Return the names in a list, each once.

    Raises:
        ArgumentError: it is no list.
    """
    if isinstance(given, Expr):
        raise ArgumentError(f"{place}: {brief(given)} is one expression; expected a list: [{brief(given)}]")
    if isinstance(given, str | Mapping) or not isinstance(given, Iterable):
        raise ArgumentError(f"{place}: {described(given)}; expected a list of {expected}")
    names = list(given)
    return tuple(name for k, name in enumerate(names) if name not in names[:k])


def inputs_of(
    kinds: Kinds, inputs: Mapping[Expr, ExprLike], unknown: tuple[Expr, ...]
) -> tuple[dict[Expr, Expr], dict[Expr, tuple[Expr, float]]]:
    """Return the expressions of inputs, and the symbols that stand for numbers, each with its value.

    Raises:
        ModelError: an input has no value, or a key is not an input.
    """
    eqs = kinds.equations
    own = dict.fromkeys((name for name in unknown if name.kind == "time_function"), 0.0)
    known = {each.name for each in (*own, *inputs)}
    missing = list(dict.fromkeys(each.name for each in eqs.inputs if each.name not in known))
    if missing:
        raise ModelError(
            f"{kinds.where}: no value for the input {joined_by_and(missing)}; give it, such as "
            f"inputs={{{missing[0]}: 0}}, or solve for it: unknown=[{missing[0]}]"
        )
    formulas = given_inputs(eqs, {**own, **inputs}, where=kinds.where)
    constant = {w: formula for w, formula in formulas.items() if formula.is_number}
    stands = {w: (symbol(f"input {w}"), float(formula)) for w, formula in constant.items()}
    return formulas, stands


def checked_held(kinds: Kinds, held: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return the coordinates along which forces keep the motion.

    Raises:
        ArgumentError: they are no list.
        ParameterError: one is not a coordinate.
    """
    names = _listed(held, f"{kinds.where}, held", "coordinates")
    check_known(
        names,
        kinds.equations.coordinates,
        f"{kinds.where}, held",
        "a coordinate of this system",
        kinds.equations.system,
    )
    return names


def bounds(limits: Limits | None, names: tuple[Expr, ...], fixed: tuple[Expr, ...], place: str) -> Array:
    """Return the least and the largest values of variables as two columns.

    Args:
        limits: those of some unknowns.
        names: the variables.
        fixed: those that are given.
        place: the function that the user called and its argument, for messages.

    Raises:
        ArgumentError: limits are no dictionary, or those of a variable are not two numbers.
        ParameterError: a limit is not one of an unknown, or its values are not in order.
    """
    if limits is not None and not isinstance(limits, Mapping):
        raise ArgumentError(
            f"{place}: {described(limits)}; expected a dictionary of variables and their least and largest values"
        )
    argument = place.rpartition(" ")[2]
    found = np.tile([-np.inf, np.inf], (len(names), 1))
    free = tuple(name for name in names if name not in fixed)
    for name, pair in (limits or {}).items():
        check_known([name], free, place, "an unknown")
        low, high = least_and_largest(pair, f"{place}: {name}", f"{argument}={{{name}: (-1, 1)}}")
        if not low < high:
            raise ParameterError(
                f"{place}: {name} is between {low:g} and {high:g}; expected the least value first, such as "
                f"{argument}={{{name}: ({min(low, high):g}, {max(low, high) + (low == high):g})}}"
            )
        found[names.index(name)] = low, high
    return found


def least_and_largest(given: Any, place: str, example: str) -> tuple[float, float]:
    """Return a pair of numbers.

    Raises:
        ArgumentError: it is none.
    """
    pair: list[float] = []
    with suppress(TypeError, ValueError, SymbodyError):
        pair = (
            []
            if isinstance(given, str | Mapping)
            else [nan if isinstance(v, str) else float(v) for v in given]
        )
    if len(pair) != 2 or any(map(isnan, pair)):
        raise ArgumentError(
            f"{place}: {described(given)}; expected the least and the largest value, such as {example}"
        )
    return pair[0], pair[1]
