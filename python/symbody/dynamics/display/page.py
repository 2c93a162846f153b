"""The equations of motion on a page: row by row, collected by accelerations, speeds, gravity, loads and forces."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from symbody.multibody import Constraint, Variables
from symbody.symbolic import Expr, Matrix, cost, free_symbols, listing
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.expression.latex_layout import ARTICLE, aligned, broken
from symbody.symbolic.expression.text_layout import LINE, lines

from .balance import Balance
from .reader_of import names_of_masses, reader_of
from .row import left_side, printed, written
from .short_names import Definition, in_order_of_use, shortened

_INDENT = "    "
Entry = tuple[int, int, str]
"""Row, column and text of an entry of the mass matrix."""


@dataclass(frozen=True)
class Page:
    """Equations, constraints and kinematics in the form for the reader.

    Attributes:
        system: the system to which the equations belong.
        balances: the equations.
        constraints: expressions that are zero.
        mass_matrix: M, each entry in its form for the reader, n x n.
        state_rates: the rates of the states, z', and what they are.
        named: names in the equations, and what they stand for; each uses only those before it.
        by_names: the kinematics and the rates of the states by these names, if they are written so.
    """

    system: Variables
    balances: tuple[Balance, ...]
    constraints: tuple[Expr, ...]
    mass_matrix: Matrix
    state_rates: tuple[tuple[Expr, Expr], ...] = ()
    named: tuple[tuple[Expr, Expr], ...] = ()
    by_names: tuple[tuple[Expr, Expr], ...] = ()

    @cached_property
    def _reader(self) -> Reader:
        return reader_of(self.system)

    @cached_property
    def rates(self) -> tuple[tuple[Expr, Expr], ...]:
        """The kinematics that need a line, then the rates of the states."""
        if self.by_names:
            return self.by_names
        states = dict(self.state_rates)
        kinematics = ((rate, value) for rate, value in self.system.known_rates.items() if rate not in states)
        return tuple((rate, self._reader.form(value)) for rate, value in (*kinematics, *self.state_rates))

    @cached_property
    def conditions(self) -> tuple[Constraint, ...]:
        """The constraints, and for embedded equations the constraints on positions on which their rows depend."""
        system = self.system
        own = (each.written(form) for each, form in zip(system.conditions, self.constraints, strict=True))
        return (*own, *self._kept) if system.eliminated_constraints else tuple(own)

    @property
    def _kept(self) -> list[Constraint]:
        """The eliminated constraints that contain dependent coordinates of the rows, or of each other."""
        whole = self.system.whole
        on_positions = {whole.conditions[k]: whole.constraints[k].free_symbols for k in whole.holonomic}
        values = (value for _, value in (*self.rates, *self.named))
        dependent = {*self.system.coordinates} - {*self.system.driving}
        used, kept = dependent & free_symbols([*self._terms, *values]), list[Constraint]()
        while len(found := [each for each, leaves in on_positions.items() if leaves & used]) > len(kept):
            kept = found
            used = used.union(*(dependent & on_positions[each] for each in kept))
        return kept

    def description(self) -> str:
        """Return the equations line by line, after the quantities that have names."""
        return self._description

    @cached_property
    def _description(self) -> str:
        definitions, rows = self._named_rows("text")
        sides = [left if right == "" else f"{left} = {right}" for left, right in rows]
        n, m = len(self.balances), len(self.conditions)
        texts = [f"{name} := {value}" for name, value in definitions]
        texts += sides[:n]
        names = (each.label for each in self.conditions)
        texts += [f"{name}: {side}" for name, side in zip(names, sides[n : n + m], strict=True)]
        last = len(sides) - len(self.state_rates)
        texts += [f"kinematics: {side}" for side in sides[n + m : last]]
        texts += [f"state: {side}" for side in sides[last:]]
        title = f"EQUATIONS OF MOTION of {', '.join(map(str, self.system.driving))}"
        return "\n".join([title, *lines_of(texts)])

    def latex(self) -> str:
        """Return the equations in LaTeX, after the quantities that have names; long ones are broken at terms."""
        definitions, rows = self._named_rows("latex")
        made = [row for name, value in definitions for row in broken(f"{name} &= ", value, ARTICLE)]
        n = len(self.balances) + len(self.conditions)
        made += [row for left, right in rows[:n] for row in broken("&", f"{left} = {right}", ARTICLE)]
        made += [row for left, right in rows[n:] for row in broken(f"{left} &= ", right, ARTICLE)]
        return aligned(made)

    @property
    def _terms(self) -> list[Expr]:
        return [term for balance in self.balances for term in (*balance.left, *balance.right)]

    @cached_property
    def _pieces(self) -> tuple[Expr, ...]:
        conditions = (shorter(each.condition, self._reader) for each in self.conditions)
        rates, named = ((side for pair in pairs for side in pair) for pairs in (self.rates, self.named))
        return (*self._terms, *conditions, *rates, *named)

    def _named_rows(self, notation: str) -> tuple[list[Definition], list[tuple[str, str]]]:
        """Return named quantities, and the left and right sides of all rows with short names."""
        entries, given, rows = self._rows(notation)
        texts = [side for row in rows for side in row]
        is_wanted = None if notation == "text" else self._has_short_names
        masses = names_of_masses(self.system)
        definitions, sides = shortened(texts, entries, given, notation, is_wanted=is_wanted, masses=masses)
        return definitions, list(zip(sides[::2], sides[1::2], strict=True))

    @cached_property
    def _has_short_names(self) -> bool:
        """Whether the text has them; then all notations have."""
        return self._names_but_of_sums != self._rows("text")[1]

    @property
    def has_names_of_sums(self) -> bool:
        """Whether repeated sums have names in the text, which other notations write out."""
        return self._named_rows("text")[0] != self._names_but_of_sums

    @cached_property
    def _names_but_of_sums(self) -> list[Definition]:
        entries, given, rows = self._rows("text")
        return shortened([side for row in rows for side in row], entries, given)[0]

    def _rows(self, notation: str) -> tuple[list[Entry], list[Definition], list[tuple[str, str]]]:
        """Return the entries of the mass matrix, named quantities, and the left and right sides of all rows."""
        n = len(self.balances)
        upper = [(i, j) for i in range(n) for j in range(i + 1, n)]
        values = [self.mass_matrix[i, j] for i, j in upper]
        definitions, texts = printed([*self._pieces, *values], notation, self.system)
        remaining = iter(texts)

        def taken(count: int) -> Sequence[str]:
            return [next(remaining) for _ in range(count)]

        rows = [
            (
                left_side(taken(len(balance.left)), acceleration, self.system, notation),
                written(taken(len(balance.right)), is_ordered=len(balance.constraints) > 1),
            )
            for balance, acceleration in zip(self.balances, self.system.accelerations, strict=True)
        ]
        rows += [(next(remaining), "0") for _ in self.conditions]
        rates = [(next(remaining), next(remaining)) for _ in self.rates]
        named = [(next(remaining), next(remaining)) for _ in self.named]
        is_long = bool(definitions)
        definitions = in_order_of_use([*definitions, *named])
        entries = [(i + 1, j + 1, text) for (i, j), text in zip(upper, remaining, strict=True)]
        return entries, definitions, [*rows, *(rates if is_long else self._printed_rates(notation))]

    def _printed_rates(self, notation: str) -> list[tuple[str, str]]:
        """Return the kinematics as books print it, with speeds before sines and cosines: ``x' = v*cos(psi)``."""
        _, texts = listing([side for pair in self.rates for side in pair], notation)
        return list(zip(texts[::2], texts[1::2], strict=True))


def shorter(constraint: Expr, reader: Reader) -> Expr:
    """Return a constraint as it was given, unless it has a shorter form.

    That of rolling is the product of many rotations: most of its terms cancel, and the form is found from what is left.
    """
    forms = [constraint, reader.in_phases(constraint), reader.form(constraint)]
    if _MANY < cost(constraint).total < _TOO_MANY:
        forms.append(reader.simplest_form(constraint))
    return min(forms, key=reader.length)


_MANY, _TOO_MANY = 50, 200
"""The operations of constraints between which terms may cancel, and the form can be found at once."""


def indented(text: str, line: int = LINE) -> list[str]:
    """Return the lines of a formula on a page; those after the first are indented further."""
    first, *others = lines(text, line - 2 * len(_INDENT))
    return [_INDENT + first, *(2 * _INDENT + other for other in others)]


def lines_of(texts: Iterable[str], line: int = LINE) -> list[str]:
    """Return the lines of formulas on a page."""
    return [piece for text in texts for piece in indented(text, line)]
