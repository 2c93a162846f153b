"""Sums of printed terms."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from symbody.multibody import System, Variables
from symbody.symbolic import Expr, latex, listing_of_equations, time_derivative
from symbody.symbolic.calculus.single_angles import in_single_angles
from symbody.symbolic.calculus.whole_divisors import with_whole_divisors

from .deflection import with_own_signs
from .difference import are_lengths, signs
from .inertia_sign import with_positive_inertia
from .one_direction import in_one_direction
from .reader_of import angles_given

Listing = tuple[list[tuple[str, str]], list[str]]
"""Named quantities and printed terms."""


def printed(terms: Iterable[Expr], notation: str, system: Variables, further: Sequence[Expr] = ()) -> Listing:
    """Return named quantities and printed terms: coordinates, speeds and multipliers are in the system's order.

    Differences of lengths in the model, such as `R - r`, keep their direction; of the two directions of others, that
    with fewer minus signs is printed. Differences of two other parameters, and those with sines and cosines, have one
    direction in all terms. From the deflections of springs, lengths are subtracted. Divisors have no fractions, and
    terms of x and 2*x have the angle x.

    Args:
        terms: the terms.
        notation: "text" or "latex".
        system: the system to which they belong.
        further: functions of time that are ordered like speeds, such as names of velocities.
    """
    terms = in_single_angles([*map(with_whole_divisors, terms)], angles_given(system))
    added, behind = signs(system) if isinstance(system, System) else ((), ())
    is_open = added and isinstance(system, System) and not are_lengths(system)
    directions = [behind, added] if is_open else [behind]
    listings = [(direction, _listed(terms, "text", system, direction, further)) for direction in directions]
    direction, plain = _with_one_direction(
        terms, system, *min(listings, key=lambda each: _minuses(each[1])), further
    )

    def texts_of(sums: Sequence[Expr]) -> list[str]:
        return _listed(tuple(sums), notation, system, direction, further)[1]

    definitions, texts = plain if notation == "text" else _listed(terms, notation, system, direction, further)
    moving = [str(each) if notation == "text" else latex(each) for each in (*in_order(system), *further)]
    return definitions, in_one_direction(with_own_signs(terms, texts, system, texts_of), moving)


def _listed(
    terms: tuple[Expr, ...],
    notation: str,
    system: Variables,
    subtracted: Sequence[Expr],
    further: Sequence[Expr],
) -> Listing:
    """Return the terms printed together.

    Args:
        terms: the terms.
        notation: "text" or "latex".
        system: the system to which they belong.
        subtracted: the parameters that follow the minus sign in differences.
        further: functions of time that are ordered like speeds.
    """
    speeds = (*system.quasi_velocities, *further, *system.multipliers)
    return listing_of_equations(terms, notation, in_order(system), speeds, subtracted)


def _with_one_direction(
    terms: tuple[Expr, ...],
    system: Variables,
    subtracted: Sequence[Expr],
    listing: Listing,
    further: Sequence[Expr],
) -> tuple[Sequence[Expr], Listing]:
    """Return the subtracted parameters by which differences of two have one direction, such as `Iy - Iz`, if any do.

    Args:
        terms: the terms.
        system: the system to which they belong.
        subtracted: the parameters that are subtracted in differences of lengths.
        listing: the terms printed with these.
        further: functions of time that are ordered like speeds.
    """
    known = {leaf.name: leaf for leaf in system.leaves if leaf.kind == "symbol"}
    for pair in _opposites(listing)[:_MOST]:
        tried = [
            (more, _listed(terms, "text", system, more, further))
            for more in ((*subtracted, known[name]) for name in pair if name in known)
        ]
        better = [each for each in tried if len(_opposites(each[1])) < len(_opposites(listing))]
        if better:
            subtracted, listing = min(better, key=lambda each: (len(_opposites(each[1])), _minuses(each[1])))
    return subtracted, listing


_MOST = 3
"""The pairs of opposite differences that are brought to one direction."""


def _opposites(listing: Listing) -> list[tuple[str, str]]:
    """Return the pairs of names whose difference stands in both directions."""
    found = {pair for text in listing[1] for pair in _DIFFERENCE.findall(text)}
    return sorted(pair for pair in found if pair < pair[::-1] and pair[::-1] in found)


_DIFFERENCE = re.compile(r"\((\w+) - (\w+)\)")


def in_order(system: Variables) -> tuple[Expr, ...]:
    """Return the functions of time in the order of the speeds; coordinates whose rates are no speeds come last."""
    coordinate_of = {time_derivative(coordinate): coordinate for coordinate in system.coordinates}
    driving = [coordinate_of.get(speed, speed) for speed in system.speeds]
    return (*driving, *(each for each in system.coordinates if each not in driving))


def _minuses(listing: Listing) -> int:
    return sum(text.count("-") for text in listing[1])


def left_side(terms: Iterable[str], own: Expr, system: Variables, notation: str) -> str:
    """Return the left side of the equation of an acceleration, in which coefficients of accelerations are positive.

    Differences of two parameters keep their direction, but those that are inertia of their own.
    """
    text = written(terms)
    for acceleration in system.accelerations:
        name = str(acceleration) if notation == "text" else latex(acceleration)
        text = with_positive_inertia(text, name, least=2 if acceleration == own else 3)
    return text


def written(terms: Iterable[str], *, is_ordered: bool = False) -> str:
    """Return the sum of printed terms; one with a plus sign comes first, unless they are in an order that counts.

    >>> written(["-a*b", "c - d"]), written(["-a*lambda1", "b*lambda2"], is_ordered=True)
    ('c - d - a*b', '-a*lambda1 + b*lambda2')
    """
    texts = list(terms)
    first = 0 if is_ordered else next((k for k, text in enumerate(texts) if not text.startswith("-")), 0)
    texts[: first + 1] = [texts[first], *texts[:first]] if texts else []
    return (
        "".join(
            f" - {text[1:].lstrip()}" if k and text.startswith("-") else f"{' + ' if k else ''}{text}"
            for k, text in enumerate(texts)
        )
        or "0"
    )
