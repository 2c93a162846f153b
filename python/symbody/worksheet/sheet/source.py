"""The source of a worksheet: cells, each with its input, what was printed below it, and the prose around."""

from __future__ import annotations

from dataclasses import dataclass

from symbody.worksheet.sheet.syntax import Place

__all__ = ["Cell", "Line", "ReadFile", "Remark", "SyntaxMistake"]


@dataclass(frozen=True, slots=True)
class Line:
    """A line of input, without its prompt.

    Attributes:
        text: the code.
        line: where this begins in the file.
        column: likewise.
        prompted: whether a prompt stands before it.
    """

    text: str
    line: int
    column: int = 1
    prompted: bool = False


@dataclass(frozen=True, slots=True)
class Cell:
    """One execution group.

    Attributes:
        input: the lines of code; the end of a cell ends a statement.
        printed: blocks of printed text below it, as the file has them, cut or not.
        printed_at: the line of each block if blocks stand between the lines of code, else empty.
        doubtful: lines below the code that may be unreadable output, or words of a remark.
        prose: the text before it.
        remarks_lost_marks: text behind the last terminator of a line, without one of its own, is a remark: exports to
            text leave out the marks of remarks.
        unread: input of which the file has no text.
        is_startup: whether Maple executes it when the file is opened, and again behind each ``restart``.
    """

    input: tuple[Line, ...]
    printed: tuple[str, ...] = ()
    prose: tuple[str, ...] = ()
    remarks_lost_marks: bool = True
    unread: tuple[SyntaxMistake, ...] = ()
    is_startup: bool = False
    printed_at: tuple[int, ...] = ()
    doubtful: tuple[Line, ...] = ()


@dataclass(frozen=True, slots=True)
class ReadFile:
    """A file that ``read`` executes."""

    name: str
    cells: tuple[Cell, ...]


@dataclass(frozen=True, slots=True)
class Remark:
    """Text among the code that is no code, though it has no ``#``.

    Attributes:
        place: where it stands.
        text: the text.
        has_code: whether names of the code, numbers or operators are in it, so that it may have been meant as code.
    """

    place: Place
    text: str
    has_code: bool = False

    @property
    def notice(self) -> str:
        """What the user should know; nothing where the text has only words."""
        return f"taken for a remark: {self.text}" if self.has_code else ""


@dataclass(frozen=True, slots=True)
class SyntaxMistake:
    """A statement that can't be read.

    Attributes:
        place: where reading stopped.
        message: where, what was found and what was expected, with a caret.
        is_open: the cell ends before the statement does.
    """

    place: Place
    message: str
    is_open: bool = False
