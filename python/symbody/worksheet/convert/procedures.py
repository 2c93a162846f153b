"""Procedures of a worksheet as functions: each is written when it is first called, for the kinds of values there."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from typing import Any

from symbody.symbolic import Expr, symbols
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.functions import definition
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import nodes_in

__all__ = ["Procedures"]

_MARK = "#: the procedure "


class Procedures:
    """The procedures of a program, and the places at which they are defined.

    Attributes:
        names: the names of the program.
        text: writes the expressions of the statement at hand.
    """

    def __init__(self, names: Names) -> None:
        self.names = names
        self.text = PythonText(names)
        self._open: dict[str, tuple[str, syntax.Procedure | syntax.Arrow]] = {}
        self._lines: dict[str, list[str]] = {}
        self._tried: list[tuple[str, tuple[str, syntax.Procedure | syntax.Arrow]]] = []
        self._writing: list[str] = []
        self._numbers = count()

    def lines(self, statement: syntax.Statement) -> list[str] | None:
        """Return a mark at which a procedure will be defined; None for another statement."""
        match statement:
            case syntax.Assignment(
                targets=(syntax.Name(name=name),), value=syntax.Procedure() | syntax.Arrow() as made
            ):
                if name in self._open:  # nothing has called the one before
                    self._try(name, self._open[name][1])
                mark = f"{_MARK}{name} {next(self._numbers)}"
                self._open[name] = mark, made
                self.names.acting -= {name}
                self.names.acting |= {name} if isinstance(made, syntax.Procedure) and _acts(made) else set()
                self.names.forget(name)
                return [mark]
        return None

    def is_definition(self, statement: syntax.Statement) -> bool:
        """Whether a statement defines a procedure."""
        return isinstance(statement, syntax.Assignment) and isinstance(
            statement.value, syntax.Procedure | syntax.Arrow
        )

    def knows(self, name: str) -> bool:
        """Whether a name is that of a procedure which hasn't been called."""
        return name in self._open

    def called(self, text: Writer, name: str, arguments: tuple[syntax.Expression, ...]) -> str | None:
        """Return the identifier of a procedure, which is written with its first call; None for another name."""
        if name in self._writing:
            return identifier(name)
        if name not in self._open:
            return None
        values = [text.value(text.text(each)) for each in arguments if not _is_keyword(each)]
        keywords = dict(_keyword(text, each) for each in arguments if _is_keyword(each))
        self._write(name, values, keywords)
        return identifier(name)

    def _write(self, name: str, values: Sequence[Any], keywords: dict[str, Any]) -> None:
        opened = self._open[name]
        mark, procedure = opened
        self._writing.append(name)
        try:
            lines = definition(name, procedure, self.names, self.text, values, keywords)
        finally:
            self._writing.pop()
        exec("\n".join(lines), self.names.values)
        del self._open[name]
        self._lines[mark] = lines
        self._tried.append((name, opened))

    def keep(self) -> None:
        """The statement that called procedures gives what it should."""
        self._tried.clear()

    def drop(self) -> None:
        """The statement doesn't: the procedures that it called first are not defined."""
        for name, (mark, procedure) in self._tried:
            self._lines.pop(mark, None)
            self._open[name] = mark, procedure
        self._tried.clear()

    def inserted(self, lines: Sequence[str]) -> tuple[list[str], int]:
        """Return the lines of the program with the definitions at their places, and how many are left out."""
        for name, (_, procedure) in list(self._open.items()):
            self._try(name, procedure)
        found, left_out = list[str](), 0
        for line in lines:
            if not line.startswith(_MARK):
                found.append(line)
            elif line in self._lines:
                found += ["", *self._lines[line], ""]
            else:
                left_out += 1
                found.append(f"# left out: {line.removeprefix(_MARK).split()[0]}")
        return found, left_out

    def _try(self, name: str, procedure: syntax.Procedure | syntax.Arrow) -> None:
        """Write a procedure that is never called for arguments that are symbols."""
        try:
            values: list[Expr] = [symbols(identifier(each.name)) for each in procedure.parameters]
            self._write(name, values, {})
        except Exception:  # whatever is wrong with symbols in the place of what is expected
            return


def _acts(procedure: syntax.Procedure) -> bool:
    """Whether a procedure changes entries of a table or names outside, or prints."""
    changed = (
        target
        for node in nodes_in(procedure.body)
        if isinstance(node, syntax.Assignment)
        for target in node.targets
    )
    prints = (
        node for node in nodes_in(procedure.body) if isinstance(node, syntax.Name) and node.name in _PRINTING
    )
    return (
        bool(procedure.shared) or any(isinstance(each, syntax.Selection) for each in changed) or any(prints)
    )


_PRINTING = frozenset({"print", "printf", "lprint"})


def _is_keyword(node: syntax.Expression) -> bool:
    return isinstance(node, syntax.Infix) and node.operator == "=" and isinstance(node.left, syntax.Name)


def _keyword(text: Writer, node: syntax.Expression) -> tuple[str, Any]:
    if not isinstance(node, syntax.Infix) or not isinstance(node.left, syntax.Name):
        raise NoText("keyword")
    return node.left.name, text.value(text.text(node.right))
