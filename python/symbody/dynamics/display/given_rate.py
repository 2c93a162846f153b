"""Rates of frames that are given, such as Omega of ``rotate("Z", Omega*t)``: they add to the speeds."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.multibody import System, Variables
from symbody.symbolic import Expr, diff, free_symbols, substitute, symbols, time_derivative

from .degree import Degrees, degrees


def by_given_rates(inertia: Sequence[Expr], system: Variables) -> list[Degrees | None]:
    """Return forces of inertia by their degree in the speeds and in given rates, so that ``(Omega + q')**2`` is found.

    None of each where no rate is given, or where the forces are no quadratic polynomial of both.
    """
    rates = given_rates(system) if isinstance(system, System) else ()
    if not rates:
        return [None] * len(inertia)
    given = {rate.name for rate in rates if rate.kind == "time_function"}
    leaves = sorted(
        (leaf for leaf in free_symbols(inertia) if leaf.name in given and leaf.order > 1), key=str
    )
    standing = {leaf: symbols(f"{leaf.name}__{leaf.order}") for leaf in leaves}  # no derivatives of the rates
    found = degrees(substitute(inertia, standing), (*system.speeds, *rates))
    original = {stand: leaf for leaf, stand in standing.items()}
    return [each and each.substituted(original) for each in found]


def given_rates(system: System) -> tuple[Expr, ...]:
    """Return the rates of frames that no coordinate has.

    >>> from symbody import Body, functions_of_time, rotate, symbols, t, translate
    >>> q, (Omega, m, l) = functions_of_time("q"), symbols("Omega m l")
    >>> bob = Body(rotate("Z", Omega * t) * rotate("Z", q) * translate(l, 0, 0), m)
    >>> given_rates(System([bob], coordinates=[q]))
    (Omega,)
    """
    placing = [value for body in system.bodies for motion in body.frame.motions for value in motion.variables]
    unknown = {each.name for each in (*system.coordinates, *system.speeds, *system.eliminated)}
    found = dict[Expr, None]()
    for rate in map(time_derivative, dict.fromkeys(placing)):
        leaves = sorted((leaf for leaf in rate.free_symbols if leaf.name not in unknown), key=str)
        found |= dict.fromkeys(leaf for leaf in leaves if diff(rate, leaf).is_number)
    return tuple(found)
