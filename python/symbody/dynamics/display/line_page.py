"""The page of equations in which the forces along lines have names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from typing import NamedTuple

from symbody.deferred import cached_property
from symbody.multibody import Action, System, Variables
from symbody.symbolic import Expr, Matrix, number
from symbody.symbolic.calculus.reader import Reader

from .balance import Balance, balances
from .causes import generalized_forces
from .degree import by_christoffel, without
from .equation_page import EquationPage
from .line import NamedLine, named_lines
from .line_terms import ByForce, ByLength, InFull, LineTerms, has_root
from .page import Page
from .reader_of import reader_of
from .short_names import LONG

Lines = tuple[NamedLine, ...]
Rest = tuple[tuple[Balance, ...], Matrix]
"""The rows of equations, and their mass matrix in its form for the reader."""


def with_lines_if_shorter(
    page: Page, residuals: Sequence[Expr], bias: Sequence[Expr], jacobian: Matrix
) -> Page:
    """Return the page on which forces along lines are written by their laws, and have names, if it is shorter so.

    Equations of a few lines have names only where these save a fifth of the loads, or a tenth for several lengths.

    Args:
        page: the page on which these forces are written as other loads are.
        residuals: the equations, expressions that are zero.
        bias: the residuals at zero accelerations and multipliers.
        jacobian: phi_q, m x n.
    """
    equations = _Equations(page.system, page.balances, page.mass_matrix, residuals, bias, jacobian)
    size = partial(_size, reader=reader_of(page.system))
    is_long = len(page.description()) >= LONG
    if not is_long:
        by_law = _rewritten(page, equations.written(InFull))
        page = by_law if size(by_law) <= _EQUAL * size(page) else page
    named = min((_rewritten(page, equations.written(way)) for way in (ByForce, ByLength)), key=size)
    if is_long:
        return min(page, named, key=lambda each: len(each.description()))
    return named if size(named) <= (_WORTH if equations.has_one_line else _OF_SEVERAL) * size(page) else page


def row_with_lines_if_shorter(
    page: EquationPage,
    place: int,
    mass_matrix: Matrix,
    residuals: Sequence[Expr],
    bias: Sequence[Expr],
    jacobian: Matrix,
) -> EquationPage:
    """Return the page of one equation of a large system, with names for forces along lines if that is shorter.

    Args:
        page: the page on which these forces are written like other loads.
        place: the index of the equation.
        mass_matrix: M, n x n.
        residuals: the equations, expressions that are zero.
        bias: the residuals at zero accelerations and multipliers.
        jacobian: phi_q, m x n.
    """
    given = (page.balance,)
    equations = _Equations(page.system, given, mass_matrix, residuals, bias, jacobian, [place])
    written = equations.written(ByForce)  # as in whole pages, where a force occurs in several rows
    if not written.named:
        return page
    named = replace(page, balance=written.balances[0], named=written.named)
    return min(page, named, key=lambda each: len(each.description()))


def _rewritten(page: Page, written: _Written) -> Page:
    if written.balances is page.balances:
        return page
    return replace(page, balances=written.balances, mass_matrix=written.mass_matrix, named=written.named)


_EQUAL = 1.1
"""The size of loads by their laws, at most, in relation to other forms, whose terms belong to no spring."""
_WORTH, _OF_SEVERAL = 0.8, 0.9
"""The size of the loads with a name of one length, and of several lengths, at most, in relation to that without."""


def _size(page: Page, reader: Reader) -> int:
    """Return the characters of the loads and of what their names stand for, by standard names."""
    loads = (term for balance in page.balances for term in balance.loads)
    named = (len(str(name)) + len(_DEFINED) + reader.length(value) for name, value in page.named)
    return sum(map(reader.length, loads)) + sum(named)


_DEFINED = "     := "
"""What stands around a name where it is defined, with the end of the line."""


class _Written(NamedTuple):
    """Equations with forces along lines in one notation, their mass matrix, and the names in them."""

    balances: tuple[Balance, ...]
    mass_matrix: Matrix
    named: tuple[tuple[Expr, Expr], ...] = ()


@dataclass(frozen=True)
class _Equations:
    """Equations in which forces along lines are written like other loads.

    Attributes:
        system: the system to which they belong.
        given: the rows.
        mass_matrix: M, n x n.
        residuals: the equations, expressions that are zero.
        bias: the residuals at zero accelerations and multipliers.
        jacobian: phi_q, m x n.
        places: the indices of the rows to write, for large systems; by default all.
    """

    system: Variables
    given: tuple[Balance, ...]
    mass_matrix: Matrix
    residuals: Sequence[Expr]
    bias: Sequence[Expr]
    jacobian: Matrix
    places: Sequence[int] | None = None

    def written(self, way: type[LineTerms]) -> _Written:
        """Return the equations with forces along lines in one notation; unchanged if these can't be separated."""
        system, reader = self.system, self._reader
        lines, rest = self._with_roots if way is InFull else self._all
        if rest is None or not isinstance(system, System):
            return _Written(self.given, self.mass_matrix)
        (rows, matrix), slopes, writer = rest, [line.slopes(system) for line in lines], way(system, reader)
        written = []
        for i, row in zip(self._chosen, rows, strict=True):
            terms = [writer.terms(line, slope[i]) for line, slope in zip(lines, slopes, strict=True)]
            written.append(replace(row, loads=(*row.loads, *chain.from_iterable(terms))))
        return _Written(
            tuple(written), matrix, tuple(pair for line in lines for pair in writer.definitions(line))
        )

    @property
    def _chosen(self) -> Sequence[int]:
        return range(len(self.bias)) if self.places is None else self.places

    @property
    def has_one_line(self) -> bool:
        """Whether there is only one force along a line."""
        return len(self._all[0]) == 1

    @cached_property
    def _reader(self) -> Reader:
        return reader_of(self.system)

    @cached_property
    def _all(self) -> tuple[Lines, Rest | None]:
        """All forces along lines, and what is left without them."""
        system = self.system
        lines = named_lines(system) if isinstance(system, System) else ()
        return lines, self._without(lines)

    @cached_property
    def _with_roots(self) -> tuple[Lines, Rest | None]:
        """The springs and dampers whose lengths are roots, and what is left without them."""
        lines, rest = self._all
        rooted = tuple(
            line for line in lines if "stiffness" in line.element.law and has_root(line, self._reader)
        )
        return rooted, rest if rooted == lines else self._without(rooted)

    def _without(self, lines: Lines) -> Rest | None:
        """Return the rows without forces along lines, and M; None if there are none, or they can't be told apart."""
        system, matrix = self.system, self.mass_matrix
        if not isinstance(system, System) or not lines:
            return None
        slopes = [line.slopes(system) for line in lines]
        pulls = [_pull(lines, [slope[i] for slope in slopes]) for i in range(len(self.bias))]
        rest = [entry - pull for entry, pull in zip(self.bias, pulls, strict=True)]
        actions = _other_actions(system, lines)
        short = _short_bias(system, matrix, rest, lines, actions, self._chosen)
        if short is None:
            return None
        others = [residual - pull for residual, pull in zip(self.residuals, pulls, strict=True)]
        return balances(system, others, matrix, short, self.jacobian, actions, self.places)


def _pull(lines: Sequence[NamedLine], slopes: Sequence[Expr]) -> Expr:
    """Return what the lines add to an equation: ``F l dl'/du / l`` of each."""
    total = number(0)
    for line, slope in zip(lines, slopes, strict=True):
        quantities = line.element.quantities
        total += quantities["force"] * slope / quantities["length"]
    return total


def _other_actions(system: System, lines: Sequence[NamedLine]) -> tuple[Action, ...]:
    along = {id(action) for line in lines for action in line.element.actions}
    return tuple(action for action in system.actions if id(action) not in along)


def _short_bias(
    system: System,
    matrix: Matrix,
    rest: Sequence[Expr],
    lines: Sequence[NamedLine],
    actions: Sequence[Action],
    places: Sequence[int],
) -> Sequence[Expr] | None:
    """Return the bias without lines in a form in which these don't cancel; None if neither way gives its value.

    It follows from Christoffel's symbols and generalised forces, or is free of the symbols that the laws alone hold.

    Args:
        system: the system with its lines.
        matrix: the mass matrix.
        rest: the bias without lines.
        lines: the forces along lines.
        actions: those of the other loads.
        places: the indices of the rows to write; the others stay unchanged.
    """
    forces = generalized_forces(system, actions)
    totals = [
        sum(each, start=number(0)) for each in zip(forces.weight, forces.moving, forces.given, strict=True)
    ]
    inertia = [rest[i] + totals[i] for i in places]
    found = by_christoffel(inertia, matrix, system, places)
    made = {i: known.total - totals[i] for i, known in zip(places, found, strict=True) if known is not None}
    if len(made) < len(places):
        laws = {value for line in lines for value in line.element.law.values() if value.kind == "symbol"}
        made = {i: without(rest[i], sorted(laws, key=str)) for i in places}
    if any(made[i] != rest[i] for i in places):
        return None
    return [made.get(i, entry) for i, entry in enumerate(rest)]
