"""Checks of masses and inertias that depend on parameters: whether a body with the given values can exist."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
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

Flags = NDArray[np.bool_]

BLOCK = 2**16
"""The cases whose inertia tensors are in memory at a time."""

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
    by_value: dict[tuple[Expr, ...], _Judged] = {}
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
                by_value[entries] = _judged(entries, given)
                if names and not body.has_partial_inertia:
                    found += _impossible_inertia(body, by_value[entries])
            is_negative = is_negative | by_value[entries].is_negative
        if is_symbolic:
            found += _impossible_difference(group, given, np.flatnonzero(is_negative))
    return found


@lru_cache(maxsize=512)
def _function(entries: tuple[Expr, ...]) -> tuple[tuple[Expr, ...], CompiledFunction]:
    """Return the symbols in the mass and the inertia tensor of a body, and the function of these symbols."""
    names = tuple(sorted(free_symbols(list(entries)), key=str))
    return names, lambdify(list(names), list(entries), compile=False)


@dataclass(frozen=True, eq=False)
class _Judged:
    """The mass and the inertia tensor of a body, in one case or in k of them.

    Attributes:
        is_impossible: whether no distribution of mass has them, shape (k,).
        is_negative: whether the mass or a moment of inertia is negative, shape (k,).
        first: the first inertia tensor that is impossible, if one is.
    """

    is_impossible: Flags
    is_negative: Flags
    first: Array | None


def _judged(entries: tuple[Expr, ...], given: Mapping[Expr, ArrayLike]) -> _Judged:
    """Judge the mass and the inertia tensor of all cases, some at a time."""
    names, function = _function(entries)
    columns = [np.atleast_1d(np.asarray(given[name], float)) for name in names]
    count, first = max((len(column) for column in columns), default=1), None
    are_different = [len(column) > 1 and column.strides != (0,) for column in columns]
    flags = []
    for start in range(0, count if any(are_different) else 1, BLOCK):
        part = slice(start, start + BLOCK)
        pairs = zip(columns, are_different, strict=True)
        own = function(*(column[part if is_different else slice(1)] for column, is_different in pairs))
        values = np.asarray(own, float).reshape(10, -1)
        mass, J = values[0], values[1:].T.reshape(-1, 3, 3)
        impossible = are_impossible(mass, J)
        flags.append((impossible, (mass < 0) | (np.einsum("kii->ki", J) < 0).any(axis=1)))
        if first is None and impossible.any():
            first = J[impossible][0]
    whole = [np.concatenate(each) for each in zip(*flags, strict=True)]
    is_impossible, is_negative = (np.broadcast_to(each, count) if len(each) == 1 else each for each in whole)
    return _Judged(is_impossible, is_negative, first)


def _impossible_inertia(body: Body, judged: _Judged) -> list[str]:
    places, first = np.flatnonzero(judged.is_impossible), judged.first
    if first is None:
        return []
    text = inertia_fault(body, first, has_products=bool((first - np.diag(np.diag(first))).any()))
    return [f"{counted_cases(places, len(judged.is_impossible))}{text}"]


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
