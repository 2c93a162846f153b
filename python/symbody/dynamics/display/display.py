"""The display of equations of motion: written out if they are short enough to be read, otherwise as sizes.

Equations that are too long term by term are written as a recursion of named quantities if that is short enough.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from symbody.deferred import cached_property
from symbody.errors import ModelError
from symbody.multibody import System, Variables
from symbody.symbolic import Expr, Matrix, cost, readable, substitute
from symbody.symbolic.expression.html_table import scrolled
from symbody.symbolic.expression.latex_layout import displayed, in_pages, one_formula
from symbody.symbolic.given.arguments import brief, counted

from .abridged import PAGES, abridged, pages_of
from .balance import Balance, balances
from .element_force import named_forces, with_forces, without_elements
from .equation_page import EquationPage
from .given_motion import given_motions, with_given_motions
from .line_page import row_with_lines_if_shorter, with_lines_if_shorter
from .long_entries import are_long
from .matrix_form import MatrixForm, matrix_form, with_names
from .names_of_formulas import with_one_naming
from .page import Page
from .ratio_page import better_page, page_of_ratios
from .recursive_page import LINES, RecursivePage, recursive_page, row_by_quantities
from .summary import is_readable, summary, summary_in_latex, summary_table

_WALL = 3000
"""The characters from which on an equation of a large system may be shorter if its terms are not told apart."""
_BY_RATIOS = 400
"""Operations of equations with constraints up to which embedded ones are written by velocity ratios."""
_READABLE = 60
"""Lines up to which a notebook shows equations."""
_AT_ONCE = 500
"""Operations up to which a notebook writes equations out: about a second."""


_WITHIN_PAGES = 200
"""Equations with more operations, and long entries of the mass matrix, certainly fill pages."""
_OF_MOTIONS = 120
"""Operations from which on equations have names for motions that are functions of time; others are read at a glance."""


class Shown(Protocol):
    """The equations that a display shows."""

    @property
    def system(self) -> Variables:
        """The system to which they belong."""

    @property
    def derived_residuals(self) -> Sequence[Expr]:
        """The residuals of the equations of motion."""

    @property
    def mass_matrix(self) -> Matrix:
        """The mass matrix M, n x n."""

    @property
    def bias(self) -> Sequence[Expr]:
        """The residuals at zero accelerations and multipliers."""

    @property
    def constraints(self) -> tuple[Expr, ...]:
        """Expressions that are zero."""

    @property
    def constraint_jacobian(self) -> Matrix:
        """The Jacobian phi_q of the constraints, m x n."""

    @property
    def state_rates(self) -> Mapping[Expr, Expr]:
        """The rates of the states beside the mechanics."""

    @property
    def whole(self) -> Shown | None:
        """The equations with constraints from which embedded equations were derived, else None."""

    @property
    def display(self) -> Display:
        """Their display."""

    def of(self, system: System) -> Shown:
        """Return the equations of another system."""


@dataclass(frozen=True, eq=False)
class Display:
    """Equations in all notations: text, LaTeX, a single equation, matrices, the output of a notebook cell.

    Attributes:
        shown: the equations.
    """

    shown: Shown

    @property
    def system(self) -> Variables:
        """The system to which the equations belong."""
        return self.shown.system

    @cached_property
    def page(self) -> Page:
        """The equations row by row, in the form for the reader."""
        shown = self.shown
        rows, matrix = balances(
            shown.system, shown.derived_residuals, shown.mass_matrix, shown.bias, shown.constraint_jacobian
        )
        return Page(shown.system, rows, shown.constraints, matrix, tuple(shown.state_rates.items()))

    @cached_property
    def page_with_lines(self) -> Page:
        """The same page with names for forces along lines, if that is shorter."""
        shown = self.shown
        return with_lines_if_shorter(
            self.page, shown.derived_residuals, shown.bias, shown.constraint_jacobian
        )

    @cached_property
    def _page_of_ratios(self) -> Page | None:
        """The page of embedded equations by velocity ratios."""
        shown, whole = self.shown, self.shown.whole
        if whole is None or cost(whole.derived_residuals).total > _BY_RATIOS:
            return None
        page = whole.display.page_with_lines
        return page_of_ratios(shown.system, shown.derived_residuals, shown.state_rates, page)

    @cached_property
    def page_with_motions(self) -> Page:
        """The page, with names for motions that are functions of time if the equations are long."""
        shown, system = self.shown, self.system
        if (
            not isinstance(system, System)
            or shown.whole
            or cost(shown.derived_residuals).total <= _OF_MOTIONS
        ):
            return self.page_with_lines
        if not (names := given_motions(system)):
            return self.page_with_lines
        page = shown.of(with_given_motions(system, names)).display.page_with_lines
        motions = {name: motion for motion, name in names.items()}
        is_same = substitute([row.residual for row in page.balances], motions) == shown.derived_residuals
        return replace(page, named=(*motions.items(), *page.named)) if is_same else self.page_with_lines

    @cached_property
    def _page_with_forces(self) -> Page:
        """The page with motions, and with names for forces of contacts, tyres and friction if that is shorter."""
        page, shown, system = self.page_with_motions, self.shown, self.system
        if not isinstance(system, System) or shown.whole or (forces := named_forces(system)) is None:
            return page
        free = shown.of(without_elements(system, forces.elements))
        slopes, residuals = forces.slopes(system), (free.derived_residuals, shown.derived_residuals)
        if slopes is None or forces.totals(slopes, system) != [
            one - other for one, other in zip(*residuals, strict=True)
        ]:
            return page
        named = with_forces(free.display.page_with_motions, forces, slopes)
        return min(page, replace(named, system=system), key=lambda each: len(each.description()))

    def in_names_of_forces(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions by the names that forces of contacts, tyres and friction have in these equations."""
        is_named = self.is_readable and self._page_with_forces is not self.page_with_motions
        forces = named_forces(self.system) if is_named and isinstance(self.system, System) else None
        return tuple(expressions) if forces is None else forces.in_names(expressions)

    @cached_property
    def _printed_page(self) -> Page:
        """The one that reads better."""
        if self._page_of_ratios is None:
            return self._page_with_forces
        if not is_readable(self.shown.derived_residuals):
            return self._page_of_ratios
        return better_page(self.page_with_lines, self._page_of_ratios)

    @cached_property
    def _has_long_entries(self) -> bool:
        """Whether the entries of the mass matrix are too long to be written term by term."""
        is_whole = isinstance(self.system, System) and self.shown.whole is None
        return is_whole and are_long(self.shown.mass_matrix.entries)

    @property
    def _is_wall(self) -> bool:
        """Whether the equations certainly fill pages term by term, so that this form need not be computed."""
        return cost(self.shown.derived_residuals).total > _WITHIN_PAGES and self._has_long_entries

    @cached_property
    def _recursive_page(self) -> RecursivePage | None:
        """The recursion, if the equations are too long term by term and the recursion is short enough."""
        shown, system = self.shown, self.system
        if (
            not isinstance(system, System)
            or not is_readable(shown.derived_residuals)
            or not self._has_long_entries
        ):
            return None
        if not self._is_wall and self._is_printed:
            return None
        page = recursive_page(system, shown.derived_residuals, shown.mass_matrix, shown.state_rates)
        return page if page.description().count("\n") <= LINES else None

    @cached_property
    def _has_page(self) -> bool:
        return is_readable(self.shown.derived_residuals) or self._page_of_ratios is not None

    @cached_property
    def _is_printed(self) -> bool:
        """Whether the equations are written out as text."""
        if not self._has_page or self._is_wall:
            return False
        return self._printed_page.description().count("\n") <= PAGES

    @cached_property
    def is_readable(self) -> bool:
        """Whether the equations are written out in all notations."""
        if self._recursive_page is not None:
            return True
        return self._is_printed and not self._printed_page.has_names_of_sums

    def description(self, *, whole: bool = False) -> str:
        """Return the equations as text, or their sizes if they are too long.

        Args:
            whole: whether equations of at most 1000 operations are written out, however many pages they fill.
        """
        if not self._has_page:
            return summary(self.system, self.shown.derived_residuals)
        if not whole and self._recursive_page is not None:
            return self._recursive_page.description()
        if whole or self._is_printed:
            return self._printed_page.description()
        return abridged(self._printed_page, self.shown.derived_residuals)

    @with_one_naming
    def latex(self, *, whole: bool = False) -> str:
        """Return the same in LaTeX."""
        if not whole and self._recursive_page is not None:
            return in_pages(self._recursive_page.latex())
        if self.is_readable or (whole and self._has_page):
            return in_pages(self._printed_page.latex())
        return summary_in_latex(self.system, self.shown.derived_residuals)

    def equation_of(self, speed: Expr) -> EquationPage:
        """Return one equation on a page of its own.

        Args:
            speed: the coordinate whose equation it is, its rate, or the quasi-velocity.

        Raises:
            ModelError: it is none of these.
        """
        system = self.system
        places = {each: k for known in (system.driving, system.speeds) for k, each in enumerate(known)}
        if speed not in places:
            known = ", ".join(map(str, system.driving))
            raise ModelError(f"equation_of: there is no equation of {brief(speed)}; expected one of {known}")
        k = places[speed]
        if isinstance(system, System) and self._is_long_row(k):
            return row_by_quantities(system, system.driving[k], self.shown.derived_residuals[k])
        if not self._has_page:
            return self._row(k)
        found = pages_of(self._printed_page)[k]
        is_embedded = bool(system.eliminated_constraints)
        return replace(found, conditions=self._printed_page.conditions) if is_embedded else found

    def _is_long_row(self, k: int) -> bool:
        """Return whether an equation is too long term by term: those of a recursion are, others are measured."""
        if self._has_page:
            return self._recursive_page is not None
        mass = self.shown.mass_matrix
        return are_long([mass[k, j] for j in range(mass.columns)])

    def _row(self, k: int) -> EquationPage:
        """Return one equation of a large system by the index of its speed."""
        shown, system = self.shown, self.system
        given = (shown.derived_residuals, shown.bias, shown.constraint_jacobian)
        rows, _ = balances(system, given[0], shown.mass_matrix, *given[1:], places=[k])
        page = EquationPage(system, system.driving[k], rows[0])
        page = row_with_lines_if_shorter(page, k, shown.mass_matrix, *given)
        if len(page.description()) <= _WALL or cost(shown.derived_residuals[k]).total > _BY_RATIOS:
            return page
        whole = replace(page, balance=Balance(velocities=(readable(shown.derived_residuals[k]),)), named=())
        return min(page, whole, key=lambda each: len(each.description()))

    def matrix_form(self, *, christoffel: bool) -> MatrixForm:
        """Return the matrices of the equations, each entry in its form for the reader.

        Raises:
            ModelError: the equations are too long to be read.
        """
        residuals = self.shown.derived_residuals
        if not is_readable(residuals):
            raise ModelError(
                f"matrix_form: the equations have {counted(cost(residuals).total, 'operation')}, too many to "
                "be read; equations.mass_matrix and equations.bias have the entries, and readable(entry) is the form "
                "of one"
            )
        form = matrix_form(self.system, self.page.mass_matrix, self.page.balances, christoffel=christoffel)
        has_motions = self.page_with_motions is not self.page_with_lines
        return with_names(form, self.page_with_lines if has_motions else self._page_with_forces)

    @cached_property
    def notebook_latex(self) -> str | None:
        """The equations in LaTeX if they are short enough to be read below a cell, and to be written at once."""
        if (
            cost(self.shown.derived_residuals).total > _AT_ONCE
            or not self.is_readable
            or self.description().count("\n") > _READABLE
        ):
            return None
        return displayed(one_formula(self.latex()))

    def notebook_html(self) -> str | None:
        """Return equations that are too long to stand below a cell as text that is scrolled, or their sizes."""
        if self.notebook_latex:
            return None
        is_quick = self._is_wall or cost(self.shown.derived_residuals).total <= _AT_ONCE
        if is_quick and self.is_readable:
            return scrolled(self.description())
        return summary_table(self.system, self.shown.derived_residuals)
