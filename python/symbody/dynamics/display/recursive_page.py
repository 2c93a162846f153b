"""The page of long equations as a recursion, in which shared quantities have names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from textwrap import wrap
from typing import NamedTuple

from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, latex, number, substitute, time_derivative, time_function
from symbody.symbolic.calculus.summands import summands
from symbody.symbolic.expression.latex_layout import ARTICLE, aligned, broken
from symbody.symbolic.expression.text_layout import LINE

from .balance import Balance
from .degree import without
from .equation_page import EquationPage
from .page import lines_of
from .recursion import Recursion, short
from .row import left_side, printed, written
from .short_names import Definition, in_order_of_use
from .source import sources

LINES = 240
"""The largest number of lines of a recursion: five pages of short lines."""


class _Row(NamedTuple):
    """An equation.

    Attributes:
        label: what it is called.
        left, right: the terms of its sides.
        is_reversed: whether the left side is one term without the minus sign that the equation has in front of it.
        acceleration: that of an equation of motion, whose coefficient is positive there.
    """

    label: str
    left: list[Expr]
    right: list[Expr]
    is_reversed: bool = False
    acceleration: Expr | None = None


@dataclass(frozen=True)
class RecursivePage:
    """Equations, constraints and kinematics, written by means of the quantities that they share.

    Attributes:
        system: the system to which the equations belong.
        rows: the equations and conditions.
    """

    system: System
    rows: tuple[_Row, ...]

    def description(self) -> str:
        """Return the quantities and the equations line by line."""
        return self._description

    @cached_property
    def _description(self) -> str:
        definitions, rows = self._printed("text")
        texts = [f"{name} := {value}" for name, value in definitions]
        texts += [f"{label}: {left} = {right}" for label, left, right in rows]
        names = ", ".join(map(str, self.system.driving))
        return "\n".join(
            [
                *wrap(
                    f"EQUATIONS OF MOTION of {names}, by quantities that they have in common",
                    LINE,
                    subsequent_indent="    ",
                ),
                *(f"    {'; '.join(map(': '.join, row))}" for row in self._legend(LINE - 4)),
                *lines_of(texts),
                *_ADVICE.format(first=self.system.driving[0]).splitlines(),
            ]
        )

    def latex(self) -> str:
        """Return the same in LaTeX."""
        definitions, rows = self._printed("latex")
        made = [
            "&"
            + r";\; ".join(rf"{latex(time_function(name))}\colon \text{{{meaning}}}" for name, meaning in row)
            for row in self._legend(_WIDTH)
        ]
        made += [row for name, value in definitions for row in broken(f"{name} &= ", value, ARTICLE)]
        made += [row for _, left, right in rows for row in broken("&", f"{left} = {right}", ARTICLE)]
        return aligned(made)

    def _legend(self, longest: int) -> list[list[tuple[str, str]]]:
        """Return the letters and their meanings row by row."""
        rows, length = list[list[tuple[str, str]]](), longest
        for entry in self._recursion.legend:
            size = len(": ".join(entry)) + len("; ")
            rows, length = (rows, length + size) if length + size <= longest else ([*rows, []], size)
            rows[-1].append(entry)
        return rows

    @cached_property
    def _recursion(self) -> Recursion:
        return Recursion(self.system, [term for row in self.rows for term in (*row.left, *row.right)])

    def _printed(self, notation: str) -> tuple[list[Definition], list[tuple[str, str, str]]]:
        """Return the names with their definitions, and the labels and sides of the rows."""
        found = self._recursion
        values, named = self._by_names
        terms = [term for row in named for term in (*row.left, *row.right)]
        further, texts = printed([*found.names, *values, *terms], notation, self.system, found.moving)
        count = len(found.names)
        pairs = zip(texts[:count], texts[count : 2 * count], strict=True)
        definitions = in_order_of_use([*further, *pairs]) if further else [*pairs]
        remaining, rows = iter(texts[2 * count :]), list[tuple[str, str, str]]()
        for row in named:
            left, right = (written(islice(remaining, len(side))) for side in (row.left, row.right))
            if row.acceleration is not None:
                left = left_side([left], row.acceleration, self.system, notation)
            rows.append((row.label, left, right))
        return definitions, rows

    @cached_property
    def _by_names(self) -> tuple[list[Expr], list[_Row]]:
        """The quantities and the rows by the names of quantities; those that a row subtracts have the other sign."""
        found, rows = self._recursion, self._rows_by_names()
        opposite = {name: -name for row in rows for name in _subtracted(row.left, found.names)}
        values = [*substitute(found.values, opposite)] if opposite else found.values
        pairs = zip(found.names, values, strict=True)
        values = [short(_opposite(value)) if name in opposite else value for name, value in pairs]
        return values, [
            row._replace(left=[*substitute(row.left, opposite)], right=[*substitute(row.right, opposite)])
            for row in rows
        ]

    def _rows_by_names(self) -> list[_Row]:
        remaining, made = iter(self._recursion.terms), list[_Row]()
        for row in self.rows:
            left, right = ([*islice(remaining, len(side))] for side in (row.left, row.right))
            if row.is_reversed:
                left = [_opposite(*left)]
            made.append(row._replace(left=[_collected(each, self.system) for each in left], right=right))
        return made


_WIDTH = 70
"""The largest length of a line of text in a formula."""
_ADVICE = """\
    One of them: show(equations.equation_of({first}));
    all of them with their terms multiplied out: print(equations.description(whole=True));
    one entry of the mass matrix: readable(equations.mass_matrix[0, 0])."""


def recursive_page(
    system: System, residuals: Sequence[Expr], mass_matrix: Matrix, state_rates: Mapping[Expr, Expr]
) -> RecursivePage:
    """Return the page of equations as a recursion.

    Args:
        system: the system to which the equations belong.
        residuals: the equations, expressions that are zero.
        mass_matrix: M, n x n.
        state_rates: the rates of the states beside the mechanics.
    """
    given = sources(system, mass_matrix, system.actions).given
    equations = zip(system.driving, residuals, system.accelerations, strict=True)
    rows = [
        _row(f"equation of {speed}", each, given)._replace(acceleration=acceleration)
        for speed, each, acceleration in equations
    ]
    rows += [_Row(each.label, [each.condition], []) for each in system.conditions]
    kinematics = {rate: value for rate, value in system.known_rates.items() if rate not in state_rates}
    for label, rates in (("kinematics", kinematics), ("state", state_rates)):
        rows += [_Row(label, [rate], [value]) for rate, value in rates.items()]
    return RecursivePage(system, tuple(rows))


def row_by_quantities(system: System, speed: Expr, residual: Expr) -> EquationPage:
    """Return one equation with names for the quantities that occur in it several times."""
    positive = _positive(residual)
    found = Recursion(system, [positive])
    named = tuple(zip(found.names, found.values, strict=True))
    (term,) = found.terms
    balance = Balance(velocities=(term if positive == residual else _negative(term),))
    return EquationPage(system, speed, balance, named, moving=tuple(found.moving))


def _row(label: str, residual: Expr, given: frozenset[Expr]) -> _Row:
    """Return an equation by its sides; given forces are on the right."""
    terms = summands(residual) if residual.free_symbols & given else []
    loads = [term for term in terms if without(term, [*given]).is_zero]
    if not loads:
        positive = _positive(residual)
        return _Row(label, [positive], [], is_reversed=positive != residual)
    left = sum((term for term in terms if term not in loads), start=number(0))
    return _Row(label, [left], [*summands(-sum(loads, start=number(0)))])


def _positive(residual: Expr) -> Expr:
    """Return a residual without a leading minus sign: f1 for ``-f1``."""
    factors = residual.args if residual.kind == "product" else ()
    return -residual if any(each.is_number and str(each).startswith("-") for each in factors) else residual


def _opposite(term: Expr) -> Expr:
    return sum((-each for each in summands(term)), start=number(0))


def _subtracted(side: Sequence[Expr], names: Sequence[Expr]) -> list[Expr]:
    """Return the names of the quantities that a side consists of if it subtracts all of them: n1 for ``-n1``."""
    terms = [term for each in side for term in summands(each)]
    if not all(str(term).startswith("-") for term in terms):
        return []
    factors = (factor for term in terms for factor in (-term, *_factors(term)))
    return [*dict.fromkeys(factor for factor in factors if factor in names)]


def _collected(total: Expr, system: System) -> Expr:
    """Return a sum in which each acceleration that terms have as a factor is written once."""
    for speed in system.speeds:
        rate = time_derivative(speed)
        terms = summands(total)
        linear = [term for term in terms if term.kind == "product" and rate in _factors(term)]
        if len(linear) > 1:
            rest = [term for term in terms if term not in linear]
            coefficient = sum((term / rate for term in linear), start=number(0))
            total = sum(rest, start=coefficient * rate)
    return total


def _factors(term: Expr) -> list[Expr]:
    return [leaf for each in term.args for leaf in (_factors(each) if each.kind == "product" else [each])]


def _negative(term: Expr) -> Expr:
    """Return a sum with the other sign; anything else, such as a name, can have either sign."""
    terms = summands(term)
    return sum((-each for each in terms), start=number(0)) if len(terms) > 1 else term
