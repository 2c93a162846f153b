"""Hamilton's equations on a page: the Hamiltonian, the rates of coordinates and momenta, the constraints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from symbody.multibody import System
from symbody.symbolic import Expr, cost, latex, symbol
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.expression.latex_layout import ARTICLE, aligned, broken, in_pages
from symbody.symbolic.expression.text_layout import ends
from symbody.symbolic.given.arguments import counted

from .determinant import over_determinant, printed_rows
from .names_of_formulas import with_one_naming
from .page import indented, shorter
from .reader_of import reader_of
from .short_names import Definition, shortened

_ADVICE = "Too long to be read at once. One of them: readable(canonical.rates[time_derivative(canonical.momenta[0])])."


@dataclass(frozen=True)
class CanonicalPage:
    """Hamilton's equations in the form for the reader.

    Attributes:
        system: the system whose speeds are the momenta p.
        hamiltonian: H.
        rates: q', p', and those of states.
    """

    system: System
    hamiltonian: Expr
    rates: Mapping[Expr, Expr]

    @property
    def _title(self) -> str:
        return ", ".join(map(str, (*self.system.coordinates, *self.system.speeds)))

    @property
    def _name_of_h(self) -> str:
        """H, unless the model holds something of this name."""
        return "Hamiltonian" if "H" in {leaf.name for leaf in self.system.leaves} else "H"

    def description(self) -> str:
        """Return the equations line by line, after the quantities that have names."""
        definitions, sides = self._named_rows("text")
        n = 1 + len(self.rates)
        names = (self._name_of_h, *self.rates)
        texts = [f"{name} := {value}" for name, value in definitions]
        texts += [f"{name} = {side}" for name, side in zip(names, sides[:n], strict=True)]
        constraints = (each.label for each in self.system.conditions)
        texts += [f"{name}: {side} = 0" for name, side in zip(constraints, sides[n:], strict=True)]
        return "\n".join(
            [f"CANONICAL EQUATIONS of {self._title}", *(line for text in texts for line in indented(text))]
        )

    @with_one_naming
    def latex(self) -> str:
        """Return the equations in LaTeX, after the quantities that have names; long ones are broken at terms."""
        definitions, sides = self._named_rows("latex")
        made = [row for name, value in definitions for row in broken(f"{name} &= ", value, ARTICLE)]
        names = map(latex, (symbol(self._name_of_h), *self.rates))
        n = 1 + len(self.rates)
        for name, side in zip(names, sides[:n], strict=True):
            made += broken(f"{name} &= ", side, ARTICLE)
        made += [row for side in sides[n:] for row in broken("&", f"{side} = 0", ARTICLE)]
        return in_pages(aligned(made))

    def _named_rows(self, notation: str) -> tuple[list[Definition], list[str]]:
        """Return named quantities, and the right sides of all rows."""
        values = [self._terms(value) for value in (self.hamiltonian, *self.rates.values())]
        rows = [tuple(map(self._reader, row)) for row in values]
        constraints = [(shorter(constraint, self._reader),) for constraint in self.system.constraints]
        divided = over_determinant(values, self.system, self._reader)
        definitions, texts = printed_rows(rows, divided, notation, self.system, constraints)
        return shortened(texts, (), definitions, notation)

    def _terms(self, value: Expr) -> tuple[Expr, ...]:
        """Return the terms of momenta, of positions alone, and of multipliers."""
        without = value.subs(dict.fromkeys(self.system.multipliers, 0))
        at_rest = without.subs(dict.fromkeys(self.system.speeds, 0))
        parts = (without - at_rest, at_rest, value - without)
        return tuple(part for part in parts if not part.is_zero)

    @cached_property
    def _reader(self) -> Reader:
        return reader_of(self.system)

    # --- equations that are too long to be read ---

    @property
    def _sizes(self) -> list[tuple[str, int]]:
        values = {
            self._name_of_h: self.hamiltonian,
            **{str(rate): value for rate, value in self.rates.items()},
        }
        return [(name, cost(value).total) for name, value in values.items()]

    @property
    def _total(self) -> str:
        n, total = len(self.system.speeds), cost((self.hamiltonian, *self.rates.values())).total
        return f"{n} {'momentum' if n == 1 else 'momenta'}: {counted(total, 'operation')} in all"

    def summary(self) -> str:
        """Return the number and the sizes of equations, and how to see one of them."""
        sizes = [
            "..." if each is None else f"{each[0]}: {counted(each[1], 'operation')}"
            for each in ends(self._sizes)
        ]
        return "\n    ".join([f"CANONICAL EQUATIONS of {self._total}", *sizes, _ADVICE])

    @with_one_naming
    def summary_in_latex(self) -> str:
        """Return the number and the sizes of equations in LaTeX."""
        names = map(latex, (symbol(self._name_of_h), *self.rates))
        rows = [(name, size) for name, (_, size) in zip(names, self._sizes, strict=True)]
        sizes = [
            r"&\;\vdots" if each is None else rf"{each[0]} &\colon \text{{{counted(each[1], 'operation')}}}"
            for each in ends(rows)
        ]
        return aligned([rf"&\text{{Canonical equations of {self._total}}}", *sizes])

    def summary_table(self) -> str:
        """Return the number and the sizes of equations for a notebook, in HTML."""
        return html_table(
            f"Canonical equations of {self._total}",
            ["equation of", "operations"],
            [each or ("...", "...") for each in ends(self._sizes)],
            _ADVICE,
        )
