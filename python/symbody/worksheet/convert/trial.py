"""A statement as code: it is written, executed, and kept if it gives the values that the worksheet has."""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Iterator, Sequence

from symbody.worksheet.convert.code_calls import is_code
from symbody.worksheet.convert.derivative_rules import (
    PREFIX,
    by_rules,
    has_replaced_rate,
    rule_lines,
    shown_by_rules,
)
from symbody.worksheet.convert.draft import Draft, has
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.printed_values import Recorder, prints_the_same
from symbody.worksheet.convert.same import order_of, same
from symbody.worksheet.convert.statement_kinds import begins_mode, counts
from symbody.worksheet.convert.statements import lines_of
from symbody.worksheet.convert.written_values import write_value
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.printing_statement import prints_code
from symbody.worksheet.values.value import Sequence as Values

__all__ = ["as_code", "prepare"]


def prepare(program: Draft, statement: syntax.Statement, *, keeps: bool) -> None:
    """Write the lines of a statement, before it changes the names of the session."""
    program.code = None
    program.names.as_differences = program.names.as_pairs = False
    program.reason = "differs"
    program.names.late.clear()
    program.snapshot = program.names.snapshot()
    program.text = text = PythonText(program.names, program.last, program.procedures.called)
    program.procedures.text = text
    try:
        program.code = rule_lines(text, statement) or program.procedures.lines(statement)
        if program.code is None:
            program.code = lines_of(statement, text, keeps=keeps)
    except NoText as error:
        program.reason = str(error)
    except Exception as error:  # a statement that can't be written must not affect others
        program.reason = repr(error)
    program.keeps = keeps


def as_code(program: Draft, statement: syntax.Statement, changed: Sequence[str]) -> bool:
    """Execute the code of a statement; keep it if its values are those of the session."""
    done = any(_runs(program, statement, changed) for program.code in _versions(program, changed))
    if program.code is None or not done:
        program.names.restore(program.snapshot)
        program.procedures.drop()
        return False
    for name in changed:
        program.names.made.pop(identifier(name), None)
    if len(changed) == 1 and len(program.code) == 1:
        program.names.made[identifier(changed[0])] = program.code[0]
    if not is_code(getattr(statement, "value", None)):  # texts of code are not compared
        program.known |= dict.fromkeys(changed, program.code if len(changed) == 1 else [])
    program.lines += program.code
    if statement.__class__ is not syntax.Empty and not program.procedures.is_definition(statement):
        values = program.names.values
        program.last = (
            identifier(changed[0]) if changed else "last" if program.keeps and "last" in values else ""
        )
    program.procedures.keep()
    program.written += 1
    return True


def _versions(program: Draft, changed: Sequence[str]) -> Iterator[list[str]]:
    """Return the lines of a statement: as they stand, and as the worksheet's modes and rules change their value."""
    code = program.code
    if code is None:
        return
    yield code
    if program.reason.startswith("differs in"):
        yield from _of_simple_equations(code)
        yield from _to_first_order(program, code, changed)
        yield from _shown_to_first_order(program, code)
        yield from by_rules(program.names, code)
        for shown, lines in shown_by_rules(program.names, program.text.shown, code):
            program.text.shown = shown
            yield lines


_SOLVED = re.compile(r"sb\.solutions\((\w+), ")


def _of_simple_equations(code: Sequence[str]) -> Iterator[list[str]]:
    """Solve simplified equations: components of points are shown in their shortest form by the worksheet."""
    lines = [_SOLVED.sub(r"sb.solutions(sb.simplify(\1), ", line) for line in code]
    if lines != [*code]:
        yield lines


def _to_first_order(program: Draft, code: Sequence[str], changed: Sequence[str]) -> Iterator[list[str]]:
    """Cut an assigned expression behind the first order in the small variables, as the worksheet has it."""
    head, sign, value = code[0].partition(" = ") if len(code) == 1 else ("", "", "")
    is_plain = sign and len(changed) == 1 and head.isidentifier() and not value.startswith("sb.taylor(")
    if program.names.small and is_plain:
        yield [f"{head} = sb.taylor({value})"]


def _shown_to_first_order(program: Draft, code: Sequence[str]) -> Iterator[list[str]]:
    """Cut the only expression that is shown behind the first order in the small variables."""
    before = program.text.shown
    if not program.names.small or len(before) != 1 or before[0].startswith("*"):
        return
    (shown,) = before
    if sum(line.count(shown) for line in code) == 1:
        program.text.shown = [f"sb.taylor({shown})"]
        yield [line.replace(shown, f"sb.taylor({shown})") for line in code]
        program.text.shown = before


_READS_LAST = re.compile(r"\blast\b(?! = )")


def _runs(program: Draft, statement: syntax.Statement, changed: Sequence[str]) -> bool:
    values, session = program.names.values, program.interpreter.session
    if program.keeps and not any(_READS_LAST.search(line) for line in program.code or ()):
        values.pop("last", None)
    try:
        with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.chdir(program.folder):
            values["print"] = recorder = Recorder(printed)
            exec("\n".join([*program.names.late, *(program.code or ())]), values)
    except Exception as error:
        program.reason = repr(error)
        return False
    finally:
        values.pop("print", None)
    for name in changed:
        if name.startswith(PREFIX) or is_code(getattr(statement, "value", None)):
            continue
        if identifier(name) not in values and program.procedures.knows(name):
            continue
        if identifier(name) not in values and begins_mode(statement):
            if not write_value(program, name):
                program.reason = f"value of {name}"
                return False
            (program.code or []).append(program.lines.pop())
        elif not has(program, name) and not _sorted(program, name) and not _shared(program, name, changed):
            program.reason = f"differs in {name}"
            return False
    if has_replaced_rate(session.names, printed.getvalue()):
        program.reason = "differs in %"
        return False
    if isinstance(statement, syntax.Evaluation) and program.text.shown and session.last:
        return _shows_the_same(program, statement.expression)
    if prints_code(statement) or prints_the_same(session, recorder, statement, program.names.small):
        return True
    program.reason = "differs in what is printed"
    return False


def _shows_the_same(program: Draft, expression: syntax.Expression) -> bool:
    """Whether the last expression that the code shows has the value of the statement."""
    if counts(expression) or is_code(expression):
        return True
    session, value = program.interpreter.session, program.interpreter.session.last[0]
    with contextlib.chdir(program.folder):
        *texts, last = program.text.shown
        made = [
            each
            for text in (*texts, "last" if program.keeps else last)
            for each in (program.names.value(f"[{text}]") or [None])
        ]
    if same(session, made[-1], value, program.names.small):
        return True
    items = value.items if isinstance(value, Values) else ()
    pairs = list(
        zip(reversed(made), reversed(items), strict=False)
    )  # what stands before show is not compared
    if 0 < len(made) <= len(items) and all(same(session, *pair, program.names.small) for pair in pairs):
        return len(made) > 1
    program.reason = "differs in %"
    return False


def _shared(program: Draft, name: str, changed: Sequence[str]) -> bool:
    """Give a name the object that another one has, which has changed: in the worksheet it is the same object."""
    session, values = program.interpreter.session, program.names.values
    named = (each for each in dict.fromkeys([*changed, *program.known]) if each in session.names)
    for other in named:
        if other != name and _thing(session, other) is _thing(session, name) and has(program, other):
            line = f"{identifier(name)} = {identifier(other)}"
            exec(line, values)
            (program.code or []).append(line)
            return has(program, name)
    return False


def _thing(session: Session, name: str) -> object:
    return session.resolve(session.names[name])


def _sorted(program: Draft, name: str) -> bool:
    """Give a list that was a set the order of the worksheet."""
    text, values = identifier(name), program.names.values
    order = order_of(program.interpreter.session, values.get(text), program.interpreter.session.names[name])
    if order is None:
        return False
    listed = f"[{text}[k] for k in {tuple(order)}]"
    listed = f"tuple({listed})" if isinstance(values[text], tuple) else listed
    line = f"{text} = {listed}  # the order of the worksheet"
    exec(line, values)
    (program.code or []).append(line)
    return True
