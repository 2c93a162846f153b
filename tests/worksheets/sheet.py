"""A worksheet that is run by a test: its names afterwards, as values of symbody."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from symbody.symbolic import Expr, Matrix, symbol
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.mechanics.objects import kind_of
from symbody.worksheet.reading import names_in_code, read_source, statements
from symbody.worksheet.sheet.source import Remark, SyntaxMistake
from symbody.worksheet.values.value import Array, Listed, MapleSet, Relation, Sequence, Table, Value

VALID = Path(__file__).parent / "valid"


class Sheet:
    """The session of a worksheet that has run without a mistake."""

    def __init__(self, path: Path | str, folder: Path) -> None:
        cells = read_source(VALID / path)
        interpreter = Interpreter()
        self.session, self.lines = interpreter.session, list[str]()
        self.session.folder = folder
        used = names_in_code(cells)
        for cell in cells:
            for statement in statements(cell, used):
                assert not isinstance(statement, SyntaxMistake), statement
                if not isinstance(statement, Remark):
                    self.lines += interpreter.execute(statement)

    def __getitem__(self, name: str) -> Any:
        """Return the value of a name: lists as lists, matrices as matrices, solutions as dictionaries."""
        return self.plain(self.session.names[name])

    def plain(self, value: Value) -> Any:
        """Return a value without the classes of the interpreter."""
        value = self.session.current(self.session.resolve(value))
        match value:
            case Listed(items) | Sequence(items):
                return [self.plain(item) for item in items]
            case MapleSet(items):
                if items and all(
                    isinstance(i, Relation) and getattr(i.left, "is_variable", False) for i in items
                ):
                    return {item.left: self.plain(item.right) for item in items if isinstance(item, Relation)}
                return [self.plain(item) for item in items]
            case Relation("=", left, right):
                return self.plain(left) - self.plain(right)
            case Array():
                entries = [self.session.current(entry) for entry in value.entries]
                return Matrix.from_entries(
                    value.rows, value.columns, [e for e in entries if isinstance(e, Expr)]
                )
            case Table() if kind_of(value):
                name = "coords" if kind_of(value) == "POINT" else "comps"
                return self.plain(value.entries[symbol(name),])[:3, 0]
        return value
