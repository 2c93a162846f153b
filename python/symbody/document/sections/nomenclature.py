"""The nomenclature: every name of the model, its meaning, and its unit where it is known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from symbody.document.document import Block, Heading, Table
from symbody.document.formula import listed
from symbody.document.role import in_order, roles_of, units_of_coordinates
from symbody.document.subject import Subject
from symbody.symbolic import Expr, substitute
from symbody.view.overview import overview


def nomenclature(subject: Subject) -> list[Block]:
    """Return the section."""
    named = [(name, meaning, subject.units.get(name, unit)) for name, meaning, unit in _entries(subject)]
    rows = []
    for (meaning, unit), family in groupby(named, key=lambda entry: entry[1:]):
        names = [name for name, _, _ in family]
        rows += [(listed(alike), (meaning,), (unit,)) for alike in _lines_of(names, meaning)]
    return [Heading("Nomenclature"), Table(("symbol", "meaning", "unit"), tuple(rows))]


_ON_A_LINE = 8
"""The names of one meaning on a line."""


def _lines_of(names: Sequence[Expr], meaning: str) -> list[Sequence[Expr]]:
    """Return names of one meaning line by line; of parameters, for which a reader may write a meaning, one on each."""
    step = 1 if meaning == "parameter" else _ON_A_LINE
    return [names[start : start + step] for start in range(0, len(names), step)]


def _entries(subject: Subject) -> Iterator[tuple[Expr, str, str]]:
    """Yield names, meanings and units in the SI."""
    equations, system = subject.equations, subject.system
    coordinates, speeds = overview(system)
    for group in coordinates:
        kind = "coordinate" if group.kind == "coordinate" else f"coordinate, {group.kind}"
        yield from ((each, kind, group.unit("s")) for each in group.expressions)
    for group in speeds:
        own = [each for each in group.expressions if each in system.quasi_velocities]
        speed = "momentum" if system.momenta else "quasi-velocity"
        kind = speed if group.kind == "speed" else f"{speed}, {group.kind}"
        yield from ((each, kind, group.unit("s")) for each in own)
    yield from ((each, "state", "") for each in equations.states)
    roles = roles_of(subject)
    for each in (each for each in equations.inputs if each.order == 0):
        meaning, unit = roles.get(each, ("", ""))
        yield each, f"input, {meaning}" if meaning else "input", unit
    units = {each: unit for each, (_, unit) in roles.items()} | units_of_coordinates(system)
    pairs = zip(equations.multipliers, equations.constraints, strict=True)
    for number, (multiplier, constraint) in enumerate(pairs, start=1):
        unit = _unit_of_multiplier(constraint, units | dict(subject.units))
        name = system.conditions[number - 1].name
        yield multiplier, f"multiplier of {name or f'constraint {number}'}", unit
    symbols = {leaf for leaf in system.leaves if leaf.kind == "symbol"} | {*equations.parameters}
    for each in sorted(symbols, key=in_order):
        yield each, *roles.get(each, ("parameter", ""))


def _unit_of_multiplier(constraint: Expr, units: Mapping[Expr, str]) -> str:
    """Return the unit of a multiplier: that of work divided by that of the constraint, if the lengths in it are known.

    A constraint of degree n in the lengths is in m^n, and its multiplier in N m/m^n.
    """
    leaves = constraint.free_symbols
    if not all(units.get(leaf) in {"m", "rad"} for leaf in leaves):
        return ""
    (scaled,) = substitute([constraint], {leaf: 2 * leaf for leaf in leaves if units[leaf] == "m"})
    return next((unit for n, unit in enumerate(("N m", "N", "N/m")) if scaled == 2**n * constraint), "")
