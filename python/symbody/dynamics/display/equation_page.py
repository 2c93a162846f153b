"""One equation of motion on a page of its own, with the names that it needs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from symbody.multibody import Constraint, Variables
from symbody.symbolic import Expr, latex
from symbody.symbolic.expression.latex_layout import (
    ARTICLE,
    aligned,
    broken,
    displayed,
    in_pages,
    one_formula,
)

from .balance import Balance
from .names_of_formulas import with_one_naming
from .page import lines_of, shorter
from .reader_of import names_of_masses, reader_of
from .row import left_side, printed, written
from .short_names import Definition, in_order_of_use, occurs, shortened


@dataclass(frozen=True)
class EquationPage:
    """The equation of one speed in the form for the reader.

    Attributes:
        system: the system to which it belongs.
        speed: the coordinate whose speed it is, or the quasi-velocity.
        balance: the equation.
        named: names in it, and what they stand for.
        conditions: the constraints on positions that determine its coordinates, for an embedded equation.
        moving: the names that are ordered like speeds in products.
    """

    system: Variables
    speed: Expr
    balance: Balance
    named: tuple[tuple[Expr, Expr], ...] = ()
    conditions: tuple[Constraint, ...] = ()
    moving: tuple[Expr, ...] = ()

    def __repr__(self) -> str:
        return f"EquationPage(equation of motion of {self.speed})"

    def description(self) -> str:
        """Return the equation line by line, after the quantities that have names: what `show` prints."""
        return "\n".join([f"EQUATION OF MOTION of {self.speed}", *lines_of(self.texts)])

    @cached_property
    def texts(self) -> list[str]:
        """The names with what they stand for, then the equation."""
        definitions, (left, right, *kept) = self._row("text")
        names = (each.label for each in self.conditions)
        return [
            *(f"{name} := {value}" for name, value in definitions),
            f"{left} = {right}",
            *(f"{name}: {text} = 0" for name, text in zip(names, kept, strict=True)),
        ]

    @with_one_naming
    def latex(self) -> str:
        """Return the equation in LaTeX, after the quantities that have names; it is broken at terms."""
        definitions, (left, right, *kept) = self._row("latex")
        rows = [row for name, value in definitions for row in broken(f"{name} &= ", value, ARTICLE)]
        texts = (f"{left} = {right}", *(f"{text} = 0" for text in kept))
        return in_pages(aligned([*rows, *(row for text in texts for row in broken("&", text, ARTICLE))]))

    def _repr_latex_(self) -> str:
        return displayed(one_formula(self.latex()))

    def _row(self, notation: str) -> tuple[list[Definition], list[str]]:
        """Return the names, and the sides of the equation, followed by the conditions."""
        balance, reader = self.balance, reader_of(self.system)
        kept = [shorter(each.condition, reader) for each in self.conditions]
        named = [side for pair in self.named for side in pair]
        shared, texts = printed(
            [*balance.left, *balance.right, *kept, *named], notation, self.system, self.moving
        )
        remaining = iter(texts)
        left, right = ([next(remaining) for _ in side] for side in (balance.left, balance.right))
        acceleration = self.system.accelerations[self.system.driving.index(self.speed)]
        sides = [
            left_side(left, acceleration, self.system, notation),
            written(right, is_ordered=len(balance.constraints) > 1),
        ]
        sides += [next(remaining) for _ in kept]
        names = [*remaining]
        given = in_order_of_use([*shared, *zip(names[::2], names[1::2], strict=True)])
        leaves, masses = self.system.leaves, names_of_masses(self.system)
        taken = {str(leaf) if notation == "text" else latex(leaf) for leaf in leaves}
        return shortened(sides, (), _used(given, sides), notation, taken=taken, masses=masses)


def _used(definitions: list[Definition], sides: list[str]) -> list[Definition]:
    """Return the definitions that an equation needs, in their order; each uses only those before it."""
    needed, texts = list[Definition](), [*sides]
    for name, value in reversed(definitions):
        if occurs(name, texts):
            needed.append((name, value))
            texts.append(value)
    return needed[::-1]
