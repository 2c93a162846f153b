"""The nomenclature: every name of the model, its meaning, and its unit where it is known."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

from symbody.document.document import Block, Heading, Table
from symbody.document.formula import listed
from symbody.document.subject import Subject
from symbody.multibody.quantity.dimension import units_of_multipliers
from symbody.multibody.quantity.role import in_order, roles_of
from symbody.symbolic import Expr, t
from symbody.symbolic.given.wording import joined_by_and
from symbody.view.overview import overview


def nomenclature(subject: Subject) -> list[Block]:
    """Return the section."""
    named = [Entry(name, meaning, subject.units.get(name, unit)) for name, meaning, unit in _entries(subject)]
    rows = []
    for (kind, unit), family in groupby(named, key=lambda entry: (entry.kind, entry.unit)):
        for alike in _lines_of([*family], kind):
            names = [entry.name for entry in alike]
            rows.append((listed(names), (row_meaning(alike),), (unit,)))
    return [Heading("Nomenclature"), Table(("symbol", "meaning", "unit"), tuple(rows))]


_ON_A_LINE = 8
"""The names of one meaning on a line."""


class Entry(NamedTuple):
    """A name, its meaning, and its unit."""

    name: Expr
    meaning: str
    unit: str

    @property
    def kind(self) -> str:
        """The meaning, with `#` in place of the number that the name has, too: m3 is the mass of link 3."""
        number = re.search(r"\d*$", self.name.name)
        return self.meaning if not number or not number[0] else re.sub(rf"\b{number[0]}\b", "#", self.meaning)


def _lines_of(family: Sequence[Entry], kind: str) -> list[Sequence[Entry]]:
    """Return names of one meaning line by line; of parameters, for which a reader may write a meaning, one on each."""
    step = 1 if kind == "parameter" else _ON_A_LINE
    return [family[start : start + step] for start in range(0, len(family), step)]


def row_meaning(alike: Sequence[Entry]) -> str:
    """Return the meaning of a line: "mass of link 1", or "mass of link 1, ..., 7" of a family."""
    first, last = alike[0], alike[-1]
    if first.meaning == last.meaning:
        return first.meaning
    numbers = [entry.name.name[len(entry.name.name.rstrip("0123456789")) :] for entry in alike]
    return _PLURALS.get(first.kind, first.kind).replace(
        "#", joined_by_and(numbers) if len(numbers) <= _FEW else f"{numbers[0]}, ..., {numbers[-1]}"
    )


_PLURALS = {"multiplier of constraint #": "multipliers of constraints #"}
"""The meanings of families that stand in the plural."""
_FEW = 3
"""The numbers of a family that are listed."""


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
    mechanism = subject.mechanism
    roles = {} if mechanism is None else roles_of(mechanism)
    for each in (each for each in equations.inputs if each.order == 0):
        meaning, unit = roles.get(each, ("", ""))
        yield each, f"input, {meaning}" if meaning else "input", unit
    units = {} if mechanism is None else units_of_multipliers(mechanism, subject.units)
    for number, multiplier in enumerate(equations.multipliers, start=1):
        name = system.conditions[number - 1].name
        yield multiplier, f"multiplier of {name or f'constraint {number}'}", units.get(multiplier, "")
    symbols = {leaf for leaf in system.leaves if leaf.kind == "symbol"} | {*equations.parameters}
    for each in sorted(symbols, key=in_order):
        yield each, *roles.get(each, ("time", "s") if each == t else ("parameter", ""))
