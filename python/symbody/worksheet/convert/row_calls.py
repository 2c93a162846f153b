"""Elementary operations on rows and columns, and matrices of one entry."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import PRODUCT, grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["ROWS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _rows(text: Writer, node: syntax.Expression, *, columns: bool) -> tuple[str, int]:
    """Return the rows of a matrix, or those of the transposed one, and how many there are."""
    written = text.text(node)
    found = text.value(written)
    if not isinstance(found, Matrix):
        raise NoText("matrix")
    return f"{grouped(written)}{'.T' if columns else ''}.tolist()", found.shape[1 if columns else 0]


def _place(text: Writer, node: syntax.Expression) -> int:
    written = text.text(node)
    if not written.isdigit():
        raise NoText("index")
    return int(written) - 1


def _made(rows: str, *, columns: bool) -> str:
    return f"sb.Matrix({rows}){'.T' if columns else ''}"


def _added(rows: str, changed: int, other: int, factor: str) -> str:
    sums = f"[a + {factor}*b for a, b in zip(row, {rows}[{other}])]"
    return f"[{sums} if k == {changed} else row for k, row in enumerate({rows})]"


def _multiplied(rows: str, changed: int, factor: str) -> str:
    return f"[[{factor}*each for each in row] if k == {changed} else row for k, row in enumerate({rows})]"


def _exchanged(rows: str, count: int, one: int, other: int) -> str:
    order = list(range(count))
    order[one], order[other] = other, one
    return f"[{rows}[k] for k in {order}]"


def _old(name: str, *, columns: bool = False) -> Call:
    """Return the writer of a command of linalg: ``addrow(A, r1, r2, m)``, ``mulrow(A, r, m)``, ``swaprow(A, r, s)``."""

    def write(text: Writer, arguments: Arguments) -> str:
        rows, count = _rows(text, arguments[0], columns=columns)
        if name == "mul":
            factor = grouped(text.text(arguments[2]), PRODUCT)
            return _made(_multiplied(rows, _place(text, arguments[1]), factor), columns=columns)
        one, other = (_place(text, each) for each in arguments[1:3])
        if name == "swap":
            return _made(_exchanged(rows, count, one, other), columns=columns)
        return _made(_added(rows, other, one, grouped(text.text(arguments[3]), PRODUCT)), columns=columns)

    return write


def _new(*, columns: bool) -> Call:
    """Return the writer of ``RowOperation(A, i, s)``, ``(A, [i, j])`` or ``(A, [i, j], s)``."""

    def write(text: Writer, arguments: Arguments) -> str:
        whole, where, *factors = arguments
        if len(factors) > 1 or any(
            isinstance(each, syntax.Infix) and each.operator == "=" for each in factors
        ):
            raise NoText("inplace")
        rows, count = _rows(text, whole, columns=columns)
        nodes = where.items if isinstance(where, syntax.ListDisplay) else (where,)
        places = [_place(text, each) for each in nodes]
        by = [grouped(text.text(each), PRODUCT) for each in factors]
        if len(places) == 1:
            return _made(_multiplied(rows, places[0], by[0]), columns=columns)
        if by:
            return _made(_added(rows, places[0], places[1], by[0]), columns=columns)
        return _made(_exchanged(rows, count, *places), columns=columns)

    return write


def _constant(text: Writer, arguments: Arguments) -> str:
    """Return ``ConstantMatrix(c, n, m)``."""
    entry, *counts = (text.text(each) for each in arguments)
    return f"sb.Matrix([[{entry}]*{counts[-1]}]*{counts[0]})"


def _scalar(text: Writer, arguments: Arguments) -> str:
    """Return ``ScalarMatrix(c, n)``."""
    entry, count = (text.text(each) for each in arguments)
    return f"{grouped(entry, PRODUCT)}*sb.identity({count})"


def _characteristic(text: Writer, arguments: Arguments) -> str:
    """Return ``CharacteristicMatrix(A, s)``: s*1 - A."""
    whole, name = (grouped(text.text(each), PRODUCT) for each in arguments)
    return f"{name}*sb.identity({whole}.shape[0]) - {whole}"


ROWS: Mapping[str, Call] = {
    **{f"{name}row": _old(name) for name in ("add", "mul", "swap")},
    **{f"{name}col": _old(name, columns=True) for name in ("add", "mul", "swap")},
    "RowOperation": _new(columns=False),
    "ColumnOperation": _new(columns=True),
    "ConstantMatrix": _constant,
    "ScalarMatrix": _scalar,
    **dict.fromkeys(("CharacteristicMatrix", "charmat"), _characteristic),
}
"""Writers by the names of commands."""
