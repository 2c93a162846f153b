"""A program while it is written: its lines, and what its names hold so far."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.names import Names, identifier
from symbody.worksheet.convert.procedures import Procedures
from symbody.worksheet.convert.same import same
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.sheet.source import Cell

__all__ = ["Draft", "FileUse", "has"]


@dataclass(frozen=True, slots=True)
class FileUse:
    """A statement that opens, writes or closes a file.

    Attributes:
        names: the variable that holds the file, and procedures through which the statement writes to it.
        line: the line of the statement.
        source: its text in the worksheet.
        lines: the places of its lines in the program.
    """

    names: tuple[str, ...]
    line: int
    source: str
    lines: range


@dataclass
class Draft:
    """A program, and the worksheet that runs beside it.

    Attributes:
        cells: the worksheet.
        interpreter: executes its statements.
        names: the names of the program and their values.
        text: writes the expressions of the statement at hand.
        procedures: functions of the sheet, written when they are first called.
        lines: the program so far.
        last: the variable that holds what ``%`` means.
        folder: where statements write files while the program is tried out.
        known: names that the program has, with the lines that gave them values.
        code: the lines of the statement at hand, or None if it can't be written.
        keeps: whether the next statement uses the value of this one, by ``%``.
        reason: why the code of the statement at hand is not kept.
        snapshot: the names before the statement.
        before: the last values before the statement.
        written: how many statements are code.
        values: how many are written as the values that they give.
        left_out: how many are remarks.
        failed: how many the worksheet itself can't execute.
        is_code: whether the statement at hand is written as code.
        openings: the places at which the names of files were last opened.
        uses: the statements of each file, by its name and the place at which it is opened.
        loads_code: whether the commands of CodeGeneration are called by their own names.
        unwritten: files to which a statement writes that is not code.
    """

    cells: tuple[Cell, ...]
    interpreter: Interpreter
    names: Names
    text: PythonText
    procedures: Procedures
    lines: list[str] = field(default_factory=list)
    last: str = ""
    folder: str = ""
    known: dict[str, list[str]] = field(default_factory=dict)
    code: list[str] | None = None
    keeps: bool = False
    reason: str = ""
    snapshot: Any = None
    before: list[Any] = field(default_factory=list)
    written: int = 0
    values: int = 0
    left_out: int = 0
    failed: int = 0
    is_code: bool = False
    openings: dict[str, tuple[int, int]] = field(default_factory=dict)
    uses: dict[tuple[str, int, int], list[FileUse]] = field(default_factory=dict)
    loads_code: bool = False
    unwritten: set[tuple[str, int, int]] = field(default_factory=set)


def has(program: Draft, name: str) -> bool:
    """Whether the program has the value that the session has."""
    session = program.interpreter.session
    return same(session, program.names.values.get(identifier(name)), session.names[name], program.names.small)
