"""Oversights: what a user may have forgotten in a system that can be derived without it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence, Set

from symbody.geometry.frame.frame import links_of
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.namesake import namesake_note

from .body import Body
from .left_place import left_place_notice, left_places
from .load import Load
from .lost_reaction import lost_reactions

__all__ = ["notices", "unlisted_speeds"]


def notices(
    bodies: Collection[Body],
    loads: Iterable[Load],
    constraints: Iterable[Expr],
    known: Collection[Expr],
    rates: Iterable[Expr] = (),
    unknown: Collection[Expr] = (),
    inputs: Collection[Expr] = (),
) -> Iterator[str]:
    """Return notices for a user to check: loads on other bodies, reactions, motions that are not given, namesakes.

    Args:
        bodies: the bodies of a system.
        loads: its loads.
        constraints: its constraints.
        known: the functions of time that are listed as unknown or given.
        rates: the rates of coordinates that were given.
        unknown: the coordinates and speeds among those that are known.
        inputs: the functions of time that are given, likewise.
    """
    yield from _foreign_loads({*bodies}, loads)
    yield from unlisted_speeds(rates, known)
    yield from lost_reactions(bodies, loads, {*known} - {*inputs})
    yield from (left_place_notice(force, where) for force, where in left_places(bodies, loads))
    yield from _constant_namesakes(bodies, loads, unknown)
    yield from _given_motions(bodies, constraints, {*known})


def unlisted_speeds(rates: Iterable[Expr], known: Collection[Expr]) -> Iterator[str]:
    """Return the notice of functions of time in the rates of coordinates that aren't listed.

    Args:
        rates: the rates of coordinates that were given.
        known: the functions of time that are listed as unknown or given.
    """
    leaves = {leaf.name for rate in rates for leaf in rate.free_symbols if leaf.kind == "time_function"}
    given = sorted(leaves - _named(known))
    if given:
        holds, is_none = ("occurs", "is not a speed") if len(given) == 1 else ("occur", "are not speeds")
        yield (
            f"{', '.join(given)} {holds} in the kinematics and {is_none}, so that the motion must be given from "
            "outside; add what is unknown to speeds=[...], what is given to inputs=[...]"
        )


def _foreign_loads(members: Set[Body], loads: Iterable[Load]) -> Iterator[str]:
    for load in loads:
        bodies = dict.fromkeys(action.body for action in load.actions)
        strangers = [body for body in bodies if body not in members]
        if not strangers:
            continue
        named = " and ".join(map(str, strangers))
        outside = "none of its bodies" if len(strangers) == 1 else "not among its bodies"
        what = "is left out: it acts" if len(strangers) == len(bodies) else "acts"
        left = "" if len(strangers) == len(bodies) else ", which is left out"
        namesakes = {member.name for member in members} & {body.name for body in strangers} - {""}
        way_out = (
            f"another body of it is called {min(namesakes)}: take the one of this system, as links that are assembled "
            "again have other bodies"
            if namesakes
            else "add what is missing to bodies"
        )
        yield f"{load} {what} on {named}, {outside}{left}; {way_out}"


def _given_motions(bodies: Iterable[Body], constraints: Iterable[Expr], known: Set[Expr]) -> Iterator[str]:
    """Return the functions of time that move bodies or occur in constraints, and aren't listed."""
    links = links_of(body.frame for body in bodies)
    motions = (link.motion for link in links if link.motion is not None and link.motion.twist is None)
    moving = {leaf for motion in motions for leaf in motion.leaves} - known
    yield from _namesakes(moving, known)
    constraining = {leaf for constraint in constraints for leaf in constraint.free_symbols} - known
    for leaves, (does, do) in (
        (moving, ("moves bodies", "move bodies")),
        (constraining - moving, ("occurs in a constraint", "occur in constraints")),
    ):
        given = sorted({leaf.name for leaf in leaves if leaf.kind == "time_function"} - _named(known))
        if given:
            acts, adds = (does, "is not a coordinate") if len(given) == 1 else (do, "are not coordinates")
            yield (
                f"{', '.join(given)} {acts} and {adds}, so that the motion must be given from outside; add "
                "what is unknown to coordinates=[...], what is given to inputs=[...]"
            )


def _namesakes(moving: Set[Expr], known: Set[Expr]) -> Iterator[str]:
    """Return notices of symbols in the motions of bodies that share their name with another one, or with an unknown."""
    symbols = [leaf for leaf in moving if leaf.kind == "symbol"]
    if len(_named(symbols) | _named(known)) == len(symbols) + len(_named(known)):
        return
    first: dict[str, Expr] = {function.name: function for function in known}
    for symbol in sorted(symbols, key=lambda symbol: (symbol.name, str(symbol.assumption))):
        other = first.setdefault(symbol.name, symbol)
        note = namesake_note([symbol], [other], ("in one place", "in another"))
        if note:
            yield f"different variables move bodies under the name {symbol.name}{note}"


def _constant_namesakes(
    bodies: Iterable[Body], loads: Iterable[Load], unknown: Iterable[Expr]
) -> Iterator[str]:
    """Return notices of constants in loads and inertias that have the name of a coordinate or a speed."""
    functions = {function.name: function for function in unknown}
    places: list[tuple[Load | Body, Sequence[Expr]]] = [(load, [*_values_of(load)]) for load in loads]
    places += [(body, (body.mass, *body.moments, *body.products)) for body in bodies]
    for thing, values in places:
        leaves = {leaf for leaf in free_symbols(values) if leaf.kind == "symbol" and leaf.name in functions}
        for leaf in sorted(leaves, key=str):
            place = f"the inertia of {thing}" if isinstance(thing, Body) else f"{thing}"
            note = namesake_note([leaf], [functions[leaf.name]], (f"in {brief(place)}", "among the unknowns"))
            yield f"{leaf.name} is two different variables{note}"


def _values_of(load: Load) -> Iterator[Expr]:
    for action in load.actions:
        yield from action.vector.components
        if action.point is not None:
            yield from action.point.coordinates


def _named(functions: Iterable[Expr]) -> set[str]:
    return {function.name for function in functions}
