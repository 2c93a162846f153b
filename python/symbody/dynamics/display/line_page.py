"""The page of equations in which the forces along lines have names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from symbody.multibody import Action, System
from symbody.symbolic import Expr, Matrix, number
from symbody.symbolic.calculus.reader import Reader

from .balance import balances
from .causes import generalized_forces
from .degree import by_christoffel, without
from .line import NamedLine, named_lines
from .page import Page
from .reader_of import reader_of
from .short_names import LONG


def with_lines_if_shorter(
    page: Page, residuals: Sequence[Expr], bias: Sequence[Expr], jacobian: Matrix
) -> Page:
    """Return the page with names of forces along lines if it is shorter.

    Equations of a few lines have none, unless a long root, the length of a line, stands in them more than once.
    """
    text = page.description()
    length = len(text)
    is_tried = length >= LONG or _repeats_a_root(text)
    other = _page_with_lines(page, residuals, bias, jacobian) if is_tried else None
    return page if other is None or len(other.description()) >= length else other


def _repeats_a_root(text: str) -> bool:
    """Return whether a long root stands in a text more than once.

    >>> _repeats_a_root("(sqrt(a) + sqrt(b))/sqrt(a)")
    False
    """
    _, *parts = " ".join(text.split()).split("sqrt(")
    roots = Counter(part[:_ROOT] for part in parts if len(part) > _ROOT and ")" not in _outside(part[:_ROOT]))
    return any(count > 1 for count in roots.values())


def _outside(text: str) -> str:
    """Return what is left of a text without its brackets and what they enclose.

    >>> _outside("a*(b + sin(c)) - d)/e")
    'a* - d)/e'
    """
    while (shorter := _BRACKETS.sub("", text)) != text:
        text = shorter
    return text


_BRACKETS = re.compile(r"\([^()]*\)")
_ROOT = 30
"""The characters below a root that make it long."""


def _page_with_lines(
    page: Page, residuals: Sequence[Expr], bias: Sequence[Expr], jacobian: Matrix
) -> Page | None:
    """Return a page in whose equations forces along lines have names; None if there are none, or not these alone.

    Args:
        page: the page without names.
        residuals: the equations, expressions that are zero.
        bias: the residuals at zero accelerations and multipliers.
        jacobian: phi_q, m x n.
    """
    system, matrix = page.system, page.mass_matrix
    lines = named_lines(system) if isinstance(system, System) else ()
    if not isinstance(system, System) or not lines:
        return None
    slopes = [line.slopes(system) for line in lines]
    pulls = [_pull(lines, [slope[i] for slope in slopes]) for i in range(len(bias))]
    rest = [entry - pull for entry, pull in zip(bias, pulls, strict=True)]
    actions = _other_actions(system, lines)
    short = _short_bias(system, matrix, rest, lines, actions)
    if short is None:
        return None
    others = [residual - pull for residual, pull in zip(residuals, pulls, strict=True)]
    rows, matrix = balances(system, others, matrix, short, jacobian, actions)
    reader = reader_of(system)
    named = [
        replace(row, loads=(*row.loads, *_terms(lines, [slope[i] for slope in slopes], reader)))
        for i, row in enumerate(rows)
    ]
    definitions = tuple(pair for line in lines for pair in line.definitions(reader))
    return replace(page, balances=tuple(named), named=definitions)


def _pull(lines: Sequence[NamedLine], slopes: Sequence[Expr]) -> Expr:
    """Return what the lines add to an equation: ``F l dl'/du / l`` of each."""
    total = number(0)
    for line, slope in zip(lines, slopes, strict=True):
        quantities = line.element.quantities
        total += quantities["force"] * slope / quantities["length"]
    return total


def _terms(lines: Sequence[NamedLine], slopes: Sequence[Expr], reader: Reader) -> list[Expr]:
    """Return the same by names."""
    return [
        line.force * reader(slope) / line.length
        for line, slope in zip(lines, slopes, strict=True)
        if not slope.is_zero
    ]


def _other_actions(system: System, lines: Sequence[NamedLine]) -> tuple[Action, ...]:
    along = {id(action) for line in lines for action in line.element.actions}
    return tuple(action for action in system.actions if id(action) not in along)


def _short_bias(
    system: System,
    matrix: Matrix,
    rest: Sequence[Expr],
    lines: Sequence[NamedLine],
    actions: Sequence[Action],
) -> Sequence[Expr] | None:
    """Return the bias without lines in a form in which these don't cancel; None if neither way gives its value.

    It follows from Christoffel's symbols and generalised forces, or is free of the symbols that the laws alone hold.

    Args:
        system: the system with its lines.
        matrix: the mass matrix.
        rest: the bias without lines.
        lines: the forces along lines.
        actions: those of the other loads.
    """
    forces = generalized_forces(system, actions)
    totals = [
        sum(each, start=number(0)) for each in zip(forces.weight, forces.moving, forces.given, strict=True)
    ]
    inertia = [entry + total for entry, total in zip(rest, totals, strict=True)]
    found = by_christoffel(inertia, matrix, system)
    made = [known.total - total for known, total in zip(found, totals, strict=True) if known is not None]
    if len(made) == len(rest):
        return made
    laws = {value for line in lines for value in line.element.law.values() if value.kind == "symbol"}
    others = [without(entry, sorted(laws, key=str)) for entry in rest]
    return others if others == [*rest] else None
