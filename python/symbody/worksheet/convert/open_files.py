"""Files that a worksheet opens: the program writes all that the sheet writes to one, or leaves it alone."""

from __future__ import annotations

import io
import tokenize
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import fields, is_dataclass
from typing import Any

from symbody.worksheet.convert.draft import Draft, FileUse
from symbody.worksheet.convert.names import identifier
from symbody.worksheet.convert.written_values import source_of
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import mentions
from symbody.worksheet.values.value import ProcedureValue

__all__ = ["leave_alone", "note_files"]


def note_files(program: Draft, statement: syntax.Statement, first: int) -> None:
    """Note the open files that a statement uses.

    Args:
        program: the program.
        statement: the statement, whose lines are written.
        first: the place of its first line.
    """
    through = _procedures(program, statement)
    names = set(_names((statement, *through.values())))
    opened = set(_opened(statement))
    for name in opened:
        program.openings[name] = statement.place.line, statement.place.column
    used = names & program.openings.keys()
    if used and program.is_code and first == len(program.lines) and _calls(statement):
        program.is_code = False  # a call without a value that is shown, of which nothing is written
        program.written -= 1
        program.left_out += 1
        line = statement.place.line
        program.lines.append(f"# left out, line {line}: {source_of(program, statement)}")
    for name in sorted(used):
        lines = range(first, len(program.lines))
        acting = [each for each, body in through.items() if name in _names(body)]
        written_by = tuple(map(identifier, (name, *acting)))
        use = FileUse(written_by, statement.place.line, source_of(program, statement), lines)
        program.uses.setdefault((name, *program.openings[name]), []).append(use)
        if not program.is_code:
            program.unwritten.add((name, *program.openings[name]))


def leave_alone(program: Draft) -> None:
    """Make remarks of the lines that open, write and close files which the program would leave incomplete."""
    for file in sorted(program.unwritten):
        for use in program.uses[file]:
            changed = [at for at in use.lines if _uses(program.lines[at], use.names)]
            for at in changed:
                line = program.lines[at]
                indent = line[: len(line) - len(line.lstrip())]
                program.lines[at] = (
                    f"{indent}{'pass  ' if indent else ''}# left out, line {use.line}: {use.source}"
                )
            if changed and len(changed) == len(use.lines):
                program.written -= 1
                program.left_out += 1


def _uses(line: str, names: Iterable[str]) -> bool:
    code = line.strip()
    return not code.startswith("#") and not _words(code).isdisjoint(names)


def _words(code: str) -> set[str]:
    """Return the names in a line of Python, which may be the head of a block or a part of a statement."""
    found = set()
    with suppress(tokenize.TokenError, IndentationError):
        for token in tokenize.generate_tokens(io.StringIO(code).readline):
            found |= {token.string} if token.type == tokenize.NAME else set()
    return found


def _calls(statement: syntax.Statement) -> bool:
    return isinstance(statement, syntax.Evaluation) and mentions(statement.expression, syntax.Call)


def _procedures(program: Draft, statement: syntax.Statement) -> dict[str, Any]:
    """Return the definitions of the procedures that a statement calls, and of those that these call."""
    session = program.interpreter.session
    found: dict[str, Any] = {}
    left = list(_names(statement))
    while left:
        name = left.pop()
        value = session.names.get(name) if name not in found else None
        if isinstance(value, ProcedureValue):
            found[name] = value.definition
            left += _names(value.definition)
    return found


def _opened(node: Any) -> Iterator[str]:
    """Return the names that get opened files in a statement."""
    match node:
        case syntax.Assignment(
            targets=(syntax.Name(name=name),), value=syntax.Call(function=syntax.Name(name="fopen"))
        ):
            yield name
    for each in _parts(node):
        yield from _opened(each)


def _names(node: Any) -> Iterator[str]:
    if isinstance(node, syntax.Name):
        yield node.name
    for each in _parts(node):
        yield from _names(each)


def _parts(node: Any) -> Iterator[Any]:
    if isinstance(node, tuple):
        yield from node
    elif is_dataclass(node):
        yield from (getattr(node, each.name) for each in fields(node))
