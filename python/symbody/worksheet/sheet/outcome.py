"""What became of a statement."""

from __future__ import annotations

from dataclasses import dataclass

from symbody.worksheet.sheet.syntax import Statement

__all__ = ["Outcome"]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a statement, or of a text that is none.

    Attributes:
        cell: the number of its cell, from 0.
        line: its line in the file.
        statement: the statement, unless it can't be read.
        printed: what it printed.
        error: why it failed, with the place; "" if it didn't.
        notices: what the user should know that Maple doesn't print.
        remark: text that was taken for a remark; then there is no statement, and notices tell of code in it.
        aliases: what names stand for behind the statement, by ``alias``, as texts.
    """

    cell: int
    line: int
    statement: Statement | None = None
    printed: tuple[str, ...] = ()
    error: str = ""
    notices: tuple[str, ...] = ()
    remark: str | None = None
    aliases: tuple[tuple[str, str], ...] = ()
