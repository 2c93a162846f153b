"""Statements without the aliases of the worksheet: ``c(q)`` is ``cos(q)`` behind ``alias(c = cos)``."""

from __future__ import annotations

from typing import Any

from symbody.errors import WorksheetError
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.printing.print import text_of
from symbody.worksheet.reading import statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced
from symbody.worksheet.values.value import Value

__all__ = ["without_aliases"]


def without_aliases(session: Session, statement: Any) -> Any:
    """Return a statement with what each alias stands for."""
    for name, value in session.options.aliases.items():
        node = _written(value)
        statement = statement if node is None else replaced(statement, name, node)
    return statement


def _written(value: Value) -> syntax.Expression | None:
    """Return a value as an expression of a worksheet; None for one that can't be written."""
    try:
        (cell,) = source_cells(f"{text_of(value)};")
        (found,) = statements(cell)
    except (WorksheetError, ValueError):
        return None
    return found.expression if isinstance(found, syntax.Evaluation) else None
