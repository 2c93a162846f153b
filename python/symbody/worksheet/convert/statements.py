"""Statements of Maple as lines of Python."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import FunctionType
from typing import Any

from symbody.symbolic import Expr
from symbody.worksheet.convert.assignments import assignment_lines
from symbody.worksheet.convert.condition import condition
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.late_names import renewed
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.operations import grouped, plain_decimal
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.shown_values import value_lines
from symbody.worksheet.convert.unrolled import at_values
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import mentions

__all__ = ["INDENT", "block", "branch_words", "lines_of"]

INDENT = "    "


def lines_of(statement: syntax.Statement, text: PythonText, *, keeps: bool = True) -> list[str]:
    """Return the lines of a statement.

    Args:
        statement: the statement.
        text: writes its expressions.
        keeps: whether ``last`` is needed, the value of an expression that the next statement calls ``%``.

    Raises:
        NoText: there is no Python for it.
    """
    match statement:
        case syntax.Assignment(targets=targets, value=value):
            return assignment_lines(text, targets, value)
        case syntax.Evaluation(expression=expression):
            return value_lines(text, expression, shown=statement.shown, keeps=keeps)
        case syntax.For():
            return _loop(text, statement)
        case syntax.If():
            return _if(text, statement)
        case syntax.Use(body=body):
            return [line for each in body for line in lines_of(each, text, keeps=False)]
        case syntax.Try(body=body, handlers=handlers):
            return _try(text, body, handlers)
    line = _line(statement, text)
    return [line] if line else []


def _saved(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    """Return what ``save`` does: values by their names, in a file that ``pickle.loads`` reads."""
    *names, file = arguments
    if (
        not names
        or not isinstance(file, syntax.Text)
        or not all(isinstance(each, syntax.Name) for each in names)
    ):
        raise NoText("save")
    written = {each.name: text.text(each) for each in names if isinstance(each, syntax.Name)}
    # Procedures are functions of this program: they can't be pickled.
    known = {
        name: value for name, value in written.items() if not isinstance(text.value(value), FunctionType)
    }
    values = ", ".join(f'"{name}": {value}' for name, value in known.items())
    return f'Path("{Path(file.text).stem}.pickle").write_bytes(pickle.dumps({{{values}}}))'


def _line(statement: syntax.Statement, text: PythonText) -> str:
    """Return a statement that is one line, or nothing."""
    match statement:
        case syntax.Return(value=value):
            return f"return {'None' if value is None else text.text(value)}"
        case syntax.Next():
            return "continue"
        case syntax.Break():
            return "break"
        case syntax.Empty() | syntax.Declaration():
            return ""
        case syntax.Save(arguments=arguments):
            return _saved(text, arguments)
        case syntax.Read(file=syntax.Text(text=file)):  # that this program has saved
            return f'globals().update(pickle.loads(Path("{Path(file).stem}.pickle").read_bytes()))'
        case syntax.Raise(arguments=arguments):
            return f"raise ValueError({_message(text, arguments)})"
    raise NoText(type(statement).__name__)


def _message(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    """Return the message of an error, in which ``%1`` is what stands next in the statement."""
    first, *others = arguments
    if not isinstance(first, syntax.Text) or not re.search(r"%\d", first.text):
        return items(text, arguments[:1])
    values = [text.text(each) for each in others]
    parts = re.split(r"%(\d)", first.text.replace("{", "{{").replace("}", "}}"))
    for k, number in enumerate(parts[1::2]):
        if not 0 < int(number) <= len(values) or any(mark in values[int(number) - 1] for mark in "\"'{}"):
            return items(text, arguments[:1])
        parts[2 * k + 1] = f"{{{values[int(number) - 1]}}}"
    return f"f{''.join(parts)!r}"


def block(
    statements: tuple[syntax.Statement, ...],
    text: PythonText,
    *,
    shown: bool = False,
    variable: str | None = None,
) -> list[str]:
    """Return indented lines; each statement is tried out, so that the next one knows its kinds of values.

    Values of expressions are shown as the terminator of the whole construct says, at its first level only: with
    ``printlevel`` 1, Maple doesn't print those of a loop within a loop.

    Args:
        statements: the statements.
        text: writes their expressions.
        shown: whether values of expressions are printed.
        variable: of a loop, its variable, which is empty if it has none; None of other blocks.
    """
    lines = [] if variable is None else _renewed(text, variable, statements)
    for k, statement in enumerate(statements):
        told = statement
        if isinstance(statement, syntax.Evaluation | syntax.If | syntax.For):
            told = replace(statement, shown=shown and isinstance(statement, syntax.Evaluation))
        written = lines_of(told, text, keeps=False)
        lines += written
        _try_out(written, text.names.values)
        match statement:
            case syntax.Assignment(targets=(syntax.Name(name=name),)) if variable is not None:
                lines += _renewed(text, name, statements[k + 1 :])
    return [f"{INDENT}{line}" for line in lines] or [f"{INDENT}pass"]


def _renewed(text: PythonText, name: str, rest: tuple[syntax.Statement, ...]) -> list[str]:
    lines = renewed(text.names, name, rest) if name else []
    _try_out(lines, text.names.values)
    return lines


def _try_out(lines: list[str], values: dict[str, Any]) -> None:
    quiet: dict[str, Any] = {"print": lambda *items, **options: None}
    with contextlib.suppress(Exception):
        exec("\n".join(lines), values | quiet, values)


def _loop(text: PythonText, loop: syntax.For) -> list[str]:
    """Return a loop, or its statements for each value of the index if names contain it: ``crank||n := ..``."""
    is_counted = (
        loop.variable is not None and loop.items is None and loop.step is None and loop.condition is None
    )
    if not is_counted or not mentions(loop.body, syntax.Concatenation):
        return _for(text, loop)
    before = dict(text.names.values)
    with contextlib.suppress(NoText):
        return _for(text, loop)
    text.names.values.clear()
    text.names.values.update(before)
    assert loop.variable is not None
    lines: list[str] = []
    for body in at_values(text, loop.body, loop.variable, loop.start, loop.stop):
        written = block(body, text, shown=loop.shown, variable="")
        lines += (line.removeprefix(INDENT) for line in written)
    return lines


def _for(text: PythonText, loop: syntax.For) -> list[str]:
    inner = text.names.inner()
    writer = text.within(inner)
    if loop.items is not None and loop.variable:
        over = text.text(loop.items)
        found = text.value(over)
        head = f"for {identifier(loop.variable)} in {over}:"
        if not isinstance(found, list | tuple) or not found:
            raise NoText("for in")
        inner.values[identifier(loop.variable)] = found[0]
    elif loop.variable is None and loop.stop is None and loop.start is None:
        if loop.condition is None:
            raise NoText("do")
        head = f"while {condition(text, loop.condition)}:"
    elif loop.stop is None:
        head = _unbounded(text, loop, inner)
    else:
        head = _counted(text, loop, inner)
    body = block(loop.body, writer, shown=loop.shown, variable=loop.variable or "")
    if loop.condition is not None and not head.startswith("while"):
        body = [f"{INDENT}if not ({condition(writer, loop.condition)}):", f"{INDENT * 2}break", *body]
    before = [
        f"{name} = {{}}"
        for name, made in inner.values.items()
        if (isinstance(made, dict) and not made) or _is_new_table(text, name, made)
    ]
    return [*before, head, *(line for line in body if line.strip() not in before)]


def _is_new_table(text: PythonText, name: str, made: object) -> bool:
    """Whether a name of a body has become a table there."""
    return (
        isinstance(made, dict)
        and not isinstance(text.names.values.get(name), dict)
        and name != "__builtins__"
    )


def _unbounded(text: PythonText, loop: syntax.For, inner: Names) -> str:
    """Return the head of a loop that only its condition ends; it counts from 1 by default."""
    if loop.condition is None:
        raise NoText("do")
    first, step = ("1" if each is None else text.text(each) for each in (loop.start, loop.step))
    if not isinstance(text.value(first), int) or not isinstance(text.value(step), int):
        raise NoText("for from")
    name = identifier(loop.variable or "_")
    inner.values[name] = text.value(first)
    return f"for {name} in itertools.count({first}{'' if step == '1' else f', {step}'}):"


def _counted(text: PythonText, loop: syntax.For, inner: Names) -> str:
    first = "1" if loop.start is None else text.text(loop.start)
    last = "" if loop.stop is None else text.text(loop.stop)
    step = "1" if loop.step is None else text.text(loop.step)
    name = identifier(loop.variable or "_")
    if not last or not isinstance(text.value(first), int):
        raise NoText("for from")
    inner.values[name] = text.value(first)
    if isinstance(text.value(step), Expr) and not step.startswith("-"):
        step = plain_decimal(step)
        return f"for {name} in np.arange({first}, {last} + {grouped(step)}/2, {step}):"
    if step.startswith("-"):
        return f"for {name} in range({first}, {last} - 1, {step}):"
    end = str(int(last) + 1) if last.isdigit() else f"{last} + 1"
    return f"for {name} in range({first}, {end}{'' if step == '1' else f', {step}'}):"


def _if(text: PythonText, statement: syntax.If) -> list[str]:
    lines: list[str] = []
    for word, (case, body) in zip(branch_words(), statement.branches, strict=False):
        inner = text.within(text.names.inner())
        lines += [f"{word} {condition(text, case)}:", *block(body, inner, shown=statement.shown)]
    if statement.otherwise:
        inner = text.within(text.names.inner())
        lines += ["else:", *block(statement.otherwise, inner, shown=statement.shown)]
    return lines


def branch_words() -> Iterator[str]:
    """Return what branches begin with."""
    yield "if"
    while True:
        yield "elif"


def _try(
    text: PythonText,
    body: tuple[syntax.Statement, ...],
    handlers: tuple[tuple[tuple[str, ...], tuple[syntax.Statement, ...]], ...],
) -> list[str]:
    """Return ``try`` with a handler for every error of a sheet; its statements are there for their errors, too."""
    inner = text.within(text.names.inner())
    tried = (line for each in body for line in _attempt(each, inner))
    lines = ["try:", *([f"{INDENT}{line}" for line in tried] or [f"{INDENT}pass"])]
    if len(handlers) != 1:
        raise NoText("try")
    ((_, handler),) = handlers
    return [*lines, "except ValueError:", *block(handler, text.within(text.names.inner()))]


def _attempt(statement: syntax.Statement, text: PythonText) -> list[str]:
    """Return the lines of a statement; a value that nobody sees is computed all the same."""
    lines = [line.removeprefix(INDENT) for line in block((statement,), text)]
    if lines == ["pass"] and isinstance(statement, syntax.Evaluation):
        return [text.text(statement.expression)]
    return lines
