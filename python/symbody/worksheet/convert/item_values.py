"""A statement of several items, ``a, b, c;``: an item that has no text in Python is written as its value."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Callable
from typing import Any

from symbody.worksheet.convert.draft import Draft
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.same import same
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.value import Sequence, Value

__all__ = ["item_lines"]

Literal = Callable[[Draft, Value], str]


def item_lines(
    program: Draft, statement: syntax.Statement, literal: Literal, source: str
) -> tuple[list[str], bool]:
    """Return the lines that print several items, and whether most of them are code; no lines for other statements.

    Args:
        program: the program.
        statement: the statement, which the session has executed.
        literal: returns the text of a value; nothing for a value that Python doesn't have.
        source: the text of the statement.
    """
    session = program.interpreter.session
    match statement:
        case syntax.Evaluation(expression=syntax.SequenceDisplay(items=nodes), shown=True) if (
            session.last and not program.keeps
        ):
            found = session.last[0]
        case _:
            return [], False
    if not isinstance(found, Sequence) or len(found.items) != len(nodes):
        return [], False
    pairs = list(zip(nodes, found.items, strict=True))
    codes = [_code(program, node, value) for node, value in pairs]
    texts = [code or literal(program, value) for code, (_, value) in zip(codes, pairs, strict=True)]
    places = [k for k, code in enumerate(codes, 1) if not code]
    if not all(texts) or len(places) == len(codes):
        return [], False
    of = f"{'item' if len(places) == 1 else 'items'} {', '.join(map(str, places))} of line"
    told = f"# values of {of} {statement.place.line}: {source}"
    return [told, f"print({', '.join(texts)})"], 2 * len(places) < len(codes)


def _code(program: Draft, node: syntax.Expression, value: Value) -> str:
    """Return an item as code; nothing if it has no text, or the text gives another value."""
    names, before = program.names, program.names.snapshot()
    with contextlib.suppress(Exception), contextlib.redirect_stdout(io.StringIO()):
        text = PythonText(names, program.last, program.procedures.called).text(node)
        made: Any = names.value(text)
        if made is not None and same(program.interpreter.session, made, value, names.small):
            return text
    names.restore(before)
    return ""
