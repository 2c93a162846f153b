"""Checks of elements whose laws depend on parameters: sizes and resistances that the given values make negative."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.errors import notify
from symbody.multibody import Element, System, Variables
from symbody.multibody.element.attachment import negative_fault, zero_fault
from symbody.multibody.element.expectation import Expectation
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.arguments import brief

from .given_bodies import counted_cases

__all__ = ["size_in_cases", "warn_of_negative_sizes"]


def warn_of_negative_sizes(system: Variables, given: Mapping[Expr, ArrayLike], where: str) -> None:
    """Give a notice of each size or resistance of an element that is negative, such as damping that gives energy.

    And of those that are zero, where a law divides by them, and of those that make no sense together.

    Those that are numbers were checked when the element was made.

    Args:
        system: the system.
        given: the values of the parameters: a number, or one value for each case.
        where: the function that the user called, for messages.
    """
    elements = (
        [load for load in system.loads if isinstance(load, Element)] if isinstance(system, System) else []
    )
    for element in elements:
        first_of_its_value = {size: name for name, size in reversed(element.sizes.items())}
        for size, name in first_of_its_value.items():
            fault = _fault(name, size, given, may_vanish=name not in element.positive)
            if fault:
                which, what = fault
                notify(f"{where}: {which}{brief(element)}: {what}")
        for expected in element.expected:
            fault = _unexpected(expected, given)
            if fault:
                which, what = fault
                notify(f"{where}: {which}{brief(element)}: {what}")


def _fault(
    name: str, size: Expr, given: Mapping[Expr, ArrayLike], *, may_vanish: bool
) -> tuple[str, str] | None:
    """Return the cases in which a size makes no sense, and what is wrong; None if nothing is, or if it is not known."""
    values = size_in_cases(size, given)
    places = np.flatnonzero(values < 0 if may_vanish else values <= 0)
    if not len(places):
        return None
    first = float(values[places[0]])
    return counted_cases(places, len(values)), negative_fault(name, first) if first else zero_fault(name)


def _unexpected(expected: Expectation, given: Mapping[Expr, ArrayLike]) -> tuple[str, str] | None:
    """Return the cases in which values make no sense together, and what is wrong; None as `_fault` does."""
    columns = [size_in_cases(value, given) for value in expected.values]
    if not all(column.size for column in columns):
        return None
    columns = [*np.broadcast_arrays(*columns)]
    places = np.flatnonzero(expected.fails(*columns))
    if not len(places):
        return None
    first = [float(column[places[0]]) for column in columns]
    return counted_cases(places, len(columns[0])), expected.fault(*first)


def size_in_cases(size: Expr, given: Mapping[Expr, ArrayLike]) -> NDArray[np.float64]:
    """Return the value of a size, or one for each case; none if symbols in it have no values."""
    names, function = _function(size)
    if not given.keys() >= {*names}:
        return np.empty(0)
    return np.ravel(np.asarray(function(*(given[each] for each in names)), float))


@lru_cache(maxsize=512)
def _function(size: Expr) -> tuple[tuple[Expr, ...], CompiledFunction]:
    """Return the symbols in a size, and the function of these symbols."""
    names = tuple(sorted(free_symbols([size]), key=str))
    return names, lambdify(list(names), size, compile=False)
