"""Linear models for the reader: in LaTeX, and as tables of a notebook."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from symbody.symbolic import Expr, Matrix, cost, latex, readable, time_derivative
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.expression.latex_layout import aligned, bmatrix
from symbody.symbolic.expression.naming import one_naming
from symbody.symbolic.expression.text_layout import LINE, names_text, row_lines
from symbody.symbolic.given.arguments import counted

from .second_order import SecondOrder

__all__ = ["LinearPage", "names_table"]

_AT_ONCE = 120
"""Operations up to which matrices are written out."""
_MOST_STATES = 12
"""States up to which matrices are written out."""
_LONGEST = 40
"""Operations up to which an entry is written out as text."""
_WIDE = 30
"""Columns beyond which a matrix is described by its size."""


class LinearPage(NamedTuple):
    """What is shown of a linear model.

    Attributes:
        second: the equations of second order, or why there are none.
        first: E, A0 and B0.
        states: the names of the states.
        inputs: the names of the inputs.
    """

    second: SecondOrder | str
    first: tuple[Matrix, Matrix, Matrix]
    states: Sequence[Expr]
    inputs: Sequence[Expr]

    @property
    def operations(self) -> int:
        """The operations of all that is shown."""
        return cost([entry for matrix in self._matrices for entry in matrix]).total

    @property
    def _matrices(self) -> tuple[Matrix, ...]:
        """The matrices that are shown."""
        form = self.second
        return (form.M, form.C, form.K, form.F) if isinstance(form, SecondOrder) else self.first

    @property
    def _is_wide(self) -> bool:
        """Whether there are too many states for rows of matrices."""
        columns = len(self.second.coordinates) if isinstance(self.second, SecondOrder) else len(self.states)
        return columns > _WIDE

    @property
    def is_short(self) -> bool:
        """Whether the matrices can be read."""
        return self.operations <= _AT_ONCE and len(self.states) <= _MOST_STATES

    def latex(self) -> str:
        """Return ``M q'' + C q' + K q = F r``, or ``E x' = A0 x + B0 r`` if there is no form of second order.

        Of many states, the sizes of the matrices are returned.
        """
        parameters = {name for matrix in self._matrices for entry in matrix for name in entry.free_symbols}
        with one_naming((*self.states, *self.inputs, *sorted(parameters, key=str))):
            return self._formula()

    def _formula(self) -> str:
        if self._is_wide:
            return aligned([rf"&\text{{{line.strip()}}}" for line in self.description().splitlines()])
        if isinstance(self.second, SecondOrder):
            return self._of_second_order(self.second)
        E, A0, B0 = self.first
        right = [_term(A0, self.states), *([_term(B0, self.inputs)] if self.inputs else [])]
        return f"{_term(E, [time_derivative(x) for x in self.states])} = {' + '.join(right)}"

    def description(self) -> str:
        """Return the form and its matrices as text, row by row, with the sizes of long entries."""
        if isinstance(self.second, SecondOrder):
            form = self.second
            equation = f"M q'' + C q' + K q = {'F r' if self.inputs else '0'}"
            names, matrices = {"q": form.coordinates}, {"M": form.M, "C": form.C, "K": form.K, "F": form.F}
        else:
            equation = f"E x' = A0 x{' + B0 r' if self.inputs else ''}"
            names, matrices = {"x": tuple(self.states)}, dict(zip(("E", "A0", "B0"), self.first, strict=True))
        names |= {"r": tuple(self.inputs)} if self.inputs else {}
        lines = [equation, *(f"    {name} = ({names_text(each, _WIDE)})" for name, each in names.items())]
        if self._is_wide:
            sizes = (f"    {name}: {_size(matrix)}" for name, matrix in matrices.items() if matrix.columns)
            return "\n".join([*lines, *sizes, f"    {_ADVICE}"])
        return "\n".join([*lines, *(line for item in matrices.items() for line in _rows(*item))])

    def _of_second_order(self, form: SecondOrder) -> str:
        left = [
            _term(matrix, [time_derivative(q, order) if order else q for q in form.coordinates])
            for matrix, order in ((form.M, 2), (form.C, 1), (form.K, 0))
            if order == 2 or not _is_zero(matrix)
        ]
        return f"{' + '.join(left)} = {_term(form.F, self.inputs) if self.inputs else '0'}"


def names_table(names: Mapping[str, Sequence[object]], operations: int) -> str:
    """Return the names of a linear model by kind, and its size, in HTML."""
    rows = [[kind, ", ".join(map(str, listed))] for kind, listed in names.items() if listed]
    return html_table("Linear model", ["", "names"], [*rows, ["operations", operations]])


def _term(matrix: Matrix, names: Sequence[Expr]) -> str:
    shown = bmatrix([latex(readable(entry)) for entry in matrix.entries], matrix.columns)
    return f"{shown} {bmatrix([latex(name) for name in names], 1)}"


def _rows(name: str, matrix: Matrix) -> list[str]:
    """Return the rows of a matrix as text, long ones in lines; none of one without columns."""
    columns = matrix.columns
    texts = [_text(entry) for entry in matrix.entries]
    first = f"    {name} = "
    rows = [
        line
        for start in range(0, len(texts), columns or 1)
        for line in row_lines(texts[start : start + columns], LINE - len(first))
    ]
    return [f"{' ' * len(first) if place else first}{row}" for place, row in enumerate(rows)]


def _size(matrix: Matrix) -> str:
    count = sum(not entry.is_zero for entry in matrix.entries)
    return f"{matrix.rows} x {matrix.columns}, {counted(count, 'entry')} other than zero".replace(
        "entrys", "entries"
    )


_ADVICE = (
    "Too wide to be read. One entry: readable(linear.A0[0, 0]), or linear.second.M[0, 0] of second order."
)


def _text(entry: Expr) -> str:
    """Return an entry as text; of a long one, its size."""
    operations = cost(entry).total
    return str(readable(entry)) if operations <= _LONGEST else f"({counted(operations, 'operation')})"


def _is_zero(matrix: Matrix) -> bool:
    return all(entry.is_zero for entry in matrix.entries)
