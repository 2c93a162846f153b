"""Statements that are written as the values that they give, and values that have changed since."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Sequence
from typing import Any

from symbody.errors import SymbodyError
from symbody.symbolic import Expr
from symbody.worksheet.convert.draft import Draft, has
from symbody.worksheet.convert.item_values import item_lines
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.printed_values import shown_items
from symbody.worksheet.convert.same import same
from symbody.worksheet.convert.small_variables import on_the_master
from symbody.worksheet.convert.statement_kinds import acts
from symbody.worksheet.convert.value_text import literal
from symbody.worksheet.sheet import syntax

__all__ = ["as_values", "source_of", "update", "write_value"]


def as_values(program: Draft, statement: syntax.Statement, changed: Sequence[str]) -> None:
    """Write the values that a statement has given to names."""
    program.last = ""
    place = len(program.lines)
    lines, is_mostly_code = (
        ([], False) if changed else item_lines(program, statement, _value_text, source_of(program, statement))
    )
    if lines:
        program.lines += lines
        program.written += is_mostly_code
        program.values += not is_mostly_code
        return
    written = [name for name in changed if write_value(program, name)]
    if isinstance(statement, syntax.Evaluation) and not changed and _shown_value(program, statement):
        written = ["last"]
    elif not _acts(statement) and _printed_values(program):
        written = [*written, "print"]
    if written:
        program.values += 1
        program.lines.insert(
            place, f"# values of line {statement.place.line}: {source_of(program, statement)}"
        )
    else:
        program.left_out += 1
        program.lines.append(f"# left out, line {statement.place.line}: {source_of(program, statement)}")


def _shown_value(program: Draft, statement: syntax.Evaluation) -> bool:
    """Write the value of an expression, and print it."""
    session = program.interpreter.session
    if acts(statement.expression):
        return False
    has_value = session.last and session.last != program.before  # NULL leaves the last value alone
    text = _value_text(program, session.last[0]) if has_value else ""
    if not text:
        return False
    program.names.values["last"], program.last = program.names.value(text), "last"
    program.lines += [f"last = {text}"] if program.keeps else []
    program.lines += [f"print({'last' if program.keeps else text})"] if statement.shown else []
    return statement.shown or program.keeps


def _value_text(program: Draft, value: Any) -> str:
    """Return a value as text that gives it; nothing if Python has none like it."""
    text = _literal(program, value)
    return text if text and _is_value(program, text, value) else ""


def _acts(statement: syntax.Statement) -> bool:
    return isinstance(statement, syntax.Evaluation) and acts(statement.expression)


def _printed_values(program: Draft) -> bool:
    """Write what a loop, a branch or ``print`` has printed; return whether all of it has a text."""
    found = [*shown_items(program.interpreter.session.shown)]
    texts = [repr(each) if isinstance(each, str) else _literal(program, each) for each in found]
    if not texts or any(not text or program.names.value(f"[{text}]") is None for text in texts):
        return False
    program.lines += [
        f"print({text}, end='')" if isinstance(each, str) else f"print({text})"
        for text, each in zip(texts, found, strict=True)
    ]
    return True


def write_value(program: Draft, name: str) -> bool:
    """Write the value of a name; return whether it has a text that gives it."""
    session = program.interpreter.session
    text = _value_text(program, session.names[name])
    if not text:
        program.names.values.pop(identifier(name), None)
        return False
    program.names.values[identifier(name)] = program.names.value(text)
    program.known[name] = []
    program.names.made.pop(identifier(name), None)
    program.lines.append(f"{identifier(name)} = {text}")
    return True


def _literal(program: Draft, value: Any) -> str:
    """Return a value as text; nothing if Python has none like it."""
    try:
        return literal(program.interpreter.session, value, program.names)
    except (NoText, SymbodyError):
        return ""


def _is_value(program: Draft, text: str, value: Any) -> bool:
    made = program.names.value(text)
    return made is not None and same(program.interpreter.session, made, value, program.names.small)


def source_of(program: Draft, statement: syntax.Statement) -> str:
    """Return the text of the line of the sheet at which a statement begins."""
    lines = (line for cell in program.cells for line in cell.input if line.line == statement.place.line)
    return next(lines).text.strip()


def update(program: Draft, changed: Sequence[str], *, is_entry: bool) -> None:
    """Give names that hold a symbol which has a value now, or an object that has changed, their new values."""
    session, values = program.interpreter.session, program.names.values
    symbols = {identifier(name) for name in changed} & set(program.names.symbols)
    again = program.known.keys() & set(changed)
    _renew_master(program, symbols)
    for name in list(program.known) if symbols or is_entry or again else ():
        text = identifier(name)
        if name in changed or name not in session.names or has(program, name):
            continue
        if isinstance(values.get(text), dict) and symbols:
            del program.known[name]  # a solution whose unknowns have values now says nothing more
            continue
        if _made_again(program, name):
            continue
        changes = ", ".join(f"{program.names.declared(each)}: {each}" for each in sorted(symbols))
        line, before = f"{text} = sb.subs({text}, {{{changes}}})", values.get(text)
        with contextlib.suppress(Exception):
            exec(line, values)
        if symbols and has(program, name):
            program.lines.append(line)
            continue
        values[text] = before
        if not write_value(program, name):
            del program.known[name]


def _renew_master(program: Draft, symbols: Iterable[str]) -> None:
    """Make the moving frame again, and what hangs on it, if its velocities contain symbols that have a value now."""
    names = program.names
    given = {each: names.values.get(each) for each in symbols}
    changes = {names.plain(each): value for each, value in given.items() if isinstance(value, Expr)}
    lines = [names.made[name] for name in on_the_master(names, changes)] if changes else []
    with contextlib.suppress(Exception):
        exec("\n".join(lines), names.values)
        program.lines += lines


def _made_again(program: Draft, name: str) -> bool:
    """Repeat the line that gave a name its value, if that gives what the name means now."""
    lines, before = program.known[name], dict(program.names.values)
    if not lines or len(lines) > 1:
        return False
    with contextlib.suppress(Exception):
        exec(lines[0], program.names.values)
    if has(program, name):
        program.lines.append(lines[0])
        return True
    program.names.values.clear()
    program.names.values.update(before)
    return False
