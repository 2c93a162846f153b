"""The page of long equations as a recursion, in which shared quantities have names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from textwrap import wrap

from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, number
from symbody.symbolic.calculus.summands import summands
from symbody.symbolic.expression.latex_layout import ARTICLE, aligned, broken
from symbody.symbolic.expression.text_layout import LINE

from .balance import Balance
from .degree import without
from .equation_page import EquationPage
from .page import lines_of
from .recursion import Recursion
from .row import printed, written
from .short_names import Definition, in_order_of_use
from .source import sources

LINES = 150
"""The largest number of lines of a recursion: three pages of short lines."""

_Row = tuple[str, list[Expr], list[Expr]]
"""A label, and the terms on the left and on the right side."""


@dataclass(frozen=True)
class RecursivePage:
    """Equations, constraints and kinematics, written by means of the quantities that they share.

    Attributes:
        system: the system to which the equations belong.
        rows: their labels and sides.
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
                f"EQUATIONS OF MOTION of {names}, by quantities that they have in common",
                *(f"    {line}" for line in wrap(self._recursion.legend, LINE - 4)),
                *lines_of(texts),
                *_ADVICE.format(first=self.system.driving[0]).splitlines(),
            ]
        )

    def latex(self) -> str:
        """Return the same in LaTeX."""
        definitions, rows = self._printed("latex")
        made = [rf"&\text{{{line}}}" for line in wrap(self._recursion.legend, _WIDTH)]
        made += [row for name, value in definitions for row in broken(f"{name} &= ", value, ARTICLE)]
        made += [row for _, left, right in rows for row in broken("&", f"{left} = {right}", ARTICLE)]
        return aligned(made)

    @cached_property
    def _recursion(self) -> Recursion:
        return Recursion(self.system, [term for _, left, right in self.rows for term in (*left, *right)])

    def _printed(self, notation: str) -> tuple[list[Definition], list[tuple[str, str, str]]]:
        """Return the names with their definitions, and the labels and sides of the rows."""
        found = self._recursion
        expressions = [*found.names, *found.values, *found.terms]
        further, texts = printed(expressions, notation, self.system, found.moving)
        count = len(found.names)
        named = zip(texts[:count], texts[count : 2 * count], strict=True)
        definitions = in_order_of_use([*further, *named]) if further else [*named]
        remaining, rows = iter(texts[2 * count :]), list[tuple[str, str, str]]()
        for label, *sides in self.rows:
            left, right = (written([next(remaining) for _ in side]) for side in sides)
            rows.append((label, left, right))
        return definitions, rows


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
    pairs = zip(system.driving, residuals, strict=True)
    rows: list[_Row] = [(f"equation of {speed}", *_sides(each, given)) for speed, each in pairs]
    rows += [(each.label, [each.condition], []) for each in system.conditions]
    kinematics = {rate: value for rate, value in system.known_rates.items() if rate not in state_rates}
    for label, rates in (("kinematics", kinematics), ("state", state_rates)):
        rows += [(label, [rate], [value]) for rate, value in rates.items()]
    return RecursivePage(system, tuple(rows))


def row_by_quantities(system: System, speed: Expr, residual: Expr) -> EquationPage:
    """Return one equation with names for the quantities that occur in it several times."""
    found = Recursion(system, [_positive(residual)])
    named = tuple(zip(found.names, found.values, strict=True))
    balance = Balance(velocities=tuple(found.terms))
    return EquationPage(system, speed, balance, named, moving=tuple(found.moving))


def _sides(residual: Expr, given: frozenset[Expr]) -> tuple[list[Expr], list[Expr]]:
    """Return the left and the right side of an equation; given forces are on the right."""
    terms = summands(residual) if residual.free_symbols & given else []
    loads = [term for term in terms if without(term, [*given]).is_zero]
    if not loads:
        return [_positive(residual)], []
    left = sum((term for term in terms if term not in loads), start=number(0))
    return [left], [*summands(-sum(loads, start=number(0)))]


def _positive(residual: Expr) -> Expr:
    """Return a residual without a leading minus sign: f1 for ``-f1``."""
    factors = residual.args if residual.kind == "product" else ()
    return -residual if any(each.is_number and str(each).startswith("-") for each in factors) else residual
