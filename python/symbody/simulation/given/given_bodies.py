"""Checks of masses and inertias that depend on parameters: whether a body with the given values can exist."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.errors import notify
from symbody.multibody import Body, System, Variables
from symbody.multibody.physical_inertia import are_impossible, difference_fault, inertia_fault, joined_bodies
from symbody.symbolic import Expr, free_symbols

__all__ = ["counted_cases", "warn_of_impossible_bodies"]

Array = NDArray[np.float64]

LOOKS = 8
"""The number of cases with a negative mass or moment that are checked for bodies that are joined."""


def warn_of_impossible_bodies(system: Variables, given: Mapping[Expr, ArrayLike], where: str) -> None:
    """Give a notice of each body whose mass and inertia are impossible with the values of the parameters.

    Bodies whose mass and inertia are numbers were checked when they were made. Of several bodies with the same mass
    and inertia, only the first one is named.

    Args:
        system: the bodies.
        given: the values of the parameters: a number, or one value for each case.
        where: the function that the user called, for messages.
    """
    if not isinstance(system, System):
        return
    is_one = all(isinstance(value, float) for value in given.values())
    found = _remembered(system, tuple(given.items())) if is_one else _found(system, given)
    for text in found:
        notify(f"{where}: {text}")


@lru_cache(maxsize=512)
def _remembered(system: System, given: tuple[tuple[Expr, float], ...]) -> list[str]:
    """Return the notices for one motion; they are cached, since loops simulate one system again and again."""
    return _found(system, dict(given))


def _found(system: System, given: Mapping[Expr, ArrayLike]) -> list[str]:
    """Return the notices of all bodies."""
    found: list[str] = []
    by_value: dict[tuple[Expr, ...], tuple[Array, Array]] = {}
    for group in joined_bodies(system.bodies):
        is_negative = np.zeros(1, dtype=bool)
        is_symbolic = False
        for body in group:
            entries = (body.mass, *body.inertia_entries)
            names, _ = _function(entries)
            if not given.keys() >= {*names}:
                continue
            is_symbolic |= bool(names)
            if entries not in by_value:
                by_value[entries] = _numbers(entries, given)
                if names:
                    found += _impossible_inertia(body, *by_value[entries])
            mass, J = by_value[entries]
            is_negative = is_negative | (mass < 0) | (np.einsum("kii->ki", J) < 0).any(axis=1)
        if is_symbolic:
            found += _impossible_difference(group, given, np.flatnonzero(is_negative))
    return found


@lru_cache(maxsize=512)
def _function(entries: tuple[Expr, ...]) -> tuple[tuple[Expr, ...], CompiledFunction]:
    """Return the symbols in the mass and the inertia tensor of a body, and the function of these symbols."""
    names = tuple(sorted(free_symbols(list(entries)), key=str))
    return names, lambdify(list(names), list(entries), compile=False)


def _numbers(entries: tuple[Expr, ...], given: Mapping[Expr, ArrayLike]) -> tuple[Array, Array]:
    """Return the mass and the inertia tensor, for each case or for all: arrays of shapes (k,) and (k, 3, 3)."""
    names, function = _function(entries)
    values = np.asarray(function(*(given[name] for name in names)), float).reshape(10, -1)
    return values[0], values[1:].T.reshape(-1, 3, 3)


def _impossible_inertia(body: Body, mass: Array, J: Array) -> list[str]:
    places = np.flatnonzero(are_impossible(mass, J))
    if not len(places):
        return []
    first = J[places[0]]
    text = inertia_fault(body, first, has_products=bool((first - np.diag(np.diag(first))).any()))
    return [f"{counted_cases(places, len(J))}{text}"]


def _impossible_difference(
    group: Sequence[Body], given: Mapping[Expr, ArrayLike], places: NDArray[np.intp]
) -> list[str]:
    for place in places[:LOOKS].tolist():
        values = {
            name: float(np.ravel(column)[place if np.size(column) > 1 else 0])
            for name, column in given.items()
        }
        text = difference_fault(group, values)
        if text:
            is_many = any(np.size(column) > 1 for column in given.values())
            return [f"{f'first case {place}: ' if is_many else ''}{text}"]
    return []


def counted_cases(places: NDArray[np.intp], count: int) -> str:
    """Return the words for the cases in which a fault was found; none for a single motion."""
    return f"in {len(places)} of {count} cases, first case {places[0]}: " if count > 1 else ""
