"""The program: each statement is written, executed, and compared with what the worksheet's session has.

What can't be written, or would give something else, is written as the value that the session has. So the program gives
the same equations, however much of the sheet it contains as code.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import sys
import tempfile
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from symbody.errors import ModelNotice, SymbodyError, WorksheetError
from symbody.files.replacement import write_texts
from symbody.worksheet.convert.declarations import declarations
from symbody.worksheet.convert.expressions import PythonText
from symbody.worksheet.convert.layout import laid_out
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.procedures import Procedures
from symbody.worksheet.convert.same import order_of, same
from symbody.worksheet.convert.sheet_names import functions_of_time, solved_names
from symbody.worksheet.convert.statements import lines_of, mentions
from symbody.worksheet.convert.value_text import literal
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.interpret import Interpreter, Stop
from symbody.worksheet.reading import names_in_code, read_source, statements
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell, Remark, SyntaxMistake
from symbody.worksheet.values.value import Sequence as Values

__all__ = ["Converted", "convert_file", "converted"]

_HEAD = '''"""{title}, converted from a worksheet of MBSymba."""

{imports}import symbody as sb

'''
_LOADING = frozenset(
    {
        *("restart", "with", "libname", "declare", "interface", "infolevel", "set_frame_name", "Describe"),
        *(
            "printlevel",
            "Digits",
            "kernelopts",
            "gc",
            "version",
            "protect",
            "unprotect",
            "userinfo",
            "assume",
        ),
        *("additionally", "time", "undeclare", "alias", "setoptions", "setoptions3d", "GetLicenseStatus"),
    }
)
"""What loads packages, or sets how Maple works and prints: a Python program has no use for it."""
_OF_MODES = frozenset(
    {"VM", "omegaMV", "mframe_flag", "small_vars", "ground", "master_frame", "moving_frame"}
)
"""Names that a mode sets."""


def convert_file(options: argparse.Namespace) -> int:
    """Write the program of a worksheet, and return the exit status."""
    try:
        cells = read_source(options.file)
    except (OSError, WorksheetError) as error:
        print(f"symbody convert: {options.file} is not readable: {error}", file=sys.stderr)
        return 3
    session = Session(folder=options.program.parent, source=options.file.parent)
    made = converted(cells, options.file.stem, session)
    try:
        write_texts(options.program.parent, {options.program.name: made.text})
    except (OSError, SymbodyError) as error:
        print(f"symbody convert: {options.program} can't be written: {error}", file=sys.stderr)
        return 3
    print(f"{made.code} statements written as code, {made.values} as values, {made.left_out} left out")
    return int(made.failed > 0)


@dataclass(frozen=True, slots=True)
class Converted:
    """A worksheet as a program.

    Attributes:
        text: the program.
        code: how many statements are code.
        values: how many are written as the values that they give.
        left_out: how many are remarks.
        failed: how many the worksheet itself can't execute.
    """

    text: str
    code: int
    values: int
    left_out: int
    failed: int


def converted(cells: Sequence[Cell], title: str, session: Session | None = None) -> Converted:
    """Return the program of a worksheet, which is executed in a session."""
    writer = _Program(cells, Interpreter(session))
    text = writer.write(title)
    return Converted(text, writer.written, writer.values, writer.left_out, writer.failed)


class _Program:
    def __init__(self, cells: Sequence[Cell], interpreter: Interpreter) -> None:
        self.cells, self.interpreter = cells, interpreter
        self.names = Names(functions=set(functions_of_time(cells)), solved=set(solved_names(cells)))
        self.procedures = Procedures(self.names)
        self.lines: list[str] = []
        self.last = ""
        self.folder = ""  # where statements write files while the program is tried out
        self.known: dict[
            str, list[str]
        ] = {}  # names that the program has, with the lines that gave them values
        self.written = self.values = self.left_out = self.failed = 0

    def write(self, title: str) -> str:
        """Return the text of the program."""
        with tempfile.TemporaryDirectory() as self.folder, warnings.catch_warnings():
            warnings.simplefilter(
                "ignore", ModelNotice
            )  # attempts make variables that the program doesn't have
            return self._written(title)

    def _written(self, title: str) -> str:
        used = names_in_code(self.cells)
        found = [(cell, statements(cell, used)) for cell in self.cells]
        items = [(cell, item) for cell, listed in found for item in (None, *listed)]
        following = [item for _, item in items if isinstance(item, syntax.Statement)]
        for cell, item in items:
            if item is None:
                self.lines += ["", *(f"# {line}" for text in cell.prose for line in text.split("\n"))]
            elif isinstance(item, SyntaxMistake):
                self.failed += 1
                self.lines.append(f"# line {item.place.line} can't be read")
            elif not isinstance(item, Remark):
                following.pop(0)
                if not self._add(item, keeps=bool(following) and mentions(following[0], syntax.Ditto)):
                    break
        return self._text(title)

    def _text(self, title: str) -> str:
        head = [one for line in declarations(self.names) for one in laid_out(line)]
        lines, left_out = self.procedures.inserted(self.lines)
        self.left_out += left_out
        self.written -= left_out
        written = (one for block in lines for line in block.split("\n") for one in laid_out(line))
        body = "\n".join(written).strip("\n")
        while "\n\n\n" in body:
            body = body.replace("\n\n\n", "\n\n")
        title = title.replace('"', "'")
        return _HEAD.format(title=title, imports=_imports(body)) + "\n".join(head) + "\n\n" + body + "\n"

    def _add(self, statement: syntax.Statement, *, keeps: bool) -> bool:
        """Add a statement; return whether the sheet goes on."""
        before = dict(self.interpreter.session.assigned)
        is_loading = _is_loading(statement)
        if not is_loading:
            self._prepare(statement, keeps=keeps)
        try:
            self.interpreter.execute(statement)
        except Stop:
            return False
        except WorksheetError as error:
            self.failed += 1
            self.lines.append(f"# line {statement.place.line} failed: {str(error).splitlines()[0]}")
            return True
        if is_loading:
            if _is_restart(statement):
                self._restart()
            return True
        session = self.interpreter.session
        changed = [name for name in session.names if session.assigned.get(name) != before.get(name)]
        loops = {statement.variable} if isinstance(statement, syntax.For) else set()
        changed = [name for name in changed if name not in _OF_MODES | loops]
        if not self._as_code(statement, changed):
            self._as_values(statement, changed)
        entries = syntax.Selection | syntax.Call
        is_entry = isinstance(statement, syntax.Assignment) and isinstance(statement.targets[0], entries)
        self._update(changed, is_entry=is_entry)
        return True

    def _restart(self) -> None:
        """Forget all values: names that have had one are declared again where they are used."""
        self.names.restart()
        self.known.clear()
        self.last = ""

    def _prepare(self, statement: syntax.Statement, *, keeps: bool) -> None:
        """Write the lines of a statement, before it changes the names of the session."""
        self.code: list[str] | None = None
        self.names.as_differences = False
        self.reason = "differs"
        self.names.late.clear()
        self.snapshot = self.names.snapshot()
        self.text = text = PythonText(self.names, self.last, self.procedures.called)
        self.procedures.text = text
        try:
            self.code = self.procedures.lines(statement)
            if self.code is None:
                self.code = lines_of(statement, text, keeps=keeps)
        except NoText as error:
            self.reason = str(error)
        except (SymbodyError, ValueError, TypeError, AttributeError, LookupError) as error:
            self.reason = repr(error)
        self.keeps = keeps

    def _as_code(self, statement: syntax.Statement, changed: Sequence[str]) -> bool:
        """Execute the code of a statement; keep it if its values are those of the session."""
        if self.code is None or not self._runs(statement, changed):
            self.names.restore(self.snapshot)
            self.procedures.drop()
            return False
        self.known |= dict.fromkeys(changed, self.code if len(changed) == 1 else [])
        self.lines += [*self.names.late, *self.code]
        if statement.__class__ is not syntax.Empty and not self.procedures.is_definition(statement):
            values = self.names.values
            self.last = (
                identifier(changed[0]) if changed else "last" if self.keeps and "last" in values else ""
            )
        self.procedures.keep()
        self.written += 1
        return True

    def _runs(self, statement: syntax.Statement, changed: Sequence[str]) -> bool:
        values, session = self.names.values, self.interpreter.session
        values.pop("last", None) if self.keeps else None
        try:
            with contextlib.redirect_stdout(io.StringIO()), contextlib.chdir(self.folder):
                exec("\n".join([*self.names.late, *(self.code or ())]), values)
        except Exception as error:
            self.reason = repr(error)
            return False
        for name in changed:
            if identifier(name) not in values and self.procedures.knows(name):
                continue
            if identifier(name) not in values and _begins_mode(statement):
                if not self._value(name):
                    self.reason = f"value of {name}"
                    return False
                (self.code or []).append(self.lines.pop())
            elif not self._has(name) and not self._sorted(name):
                self.reason = f"differs in {name}"
                return False
        if isinstance(statement, syntax.Evaluation) and self.text.shown and session.last:
            return self._shows_the_same(statement.expression)
        return True

    def _shows_the_same(self, expression: syntax.Expression) -> bool:
        """Whether the last expression that the code shows has the value of the statement."""
        if _counts(expression):
            return True
        session, value = self.interpreter.session, self.interpreter.session.last[0]
        made = [self.names.value("last" if self.keeps else text) for text in self.text.shown]
        last = value.items[-1] if isinstance(value, Values) and len(made) > 1 and value.items else value
        if same(session, made[-1], value, self.names.small) or same(
            session, made[-1], last, self.names.small
        ):
            return True
        self.reason = "differs in %"
        return False

    def _as_values(self, statement: syntax.Statement, changed: Sequence[str]) -> None:
        """Write the values that a statement has given to names."""
        self.last = ""
        place = len(self.lines)
        written = [name for name in changed if self._value(name)]
        if isinstance(statement, syntax.Evaluation) and not changed and self._shown_value(statement):
            written = ["last"]
        if written:
            self.values += 1
            self.lines.insert(place, f"# values of line {statement.place.line}: {self._source(statement)}")
        else:
            self.left_out += 1
            self.lines.append(f"# left out, line {statement.place.line}: {self._source(statement)}")

    def _shown_value(self, statement: syntax.Evaluation) -> bool:
        """Write the value of an expression, and print it."""
        session = self.interpreter.session
        text = self._literal(session.last[0]) if session.last else ""
        if not text or not self._is_value(text, session.last[0]):
            return False
        self.names.values["last"], self.last = self.names.value(text), "last"
        self.lines += [f"last = {text}"] if self.keeps else []
        self.lines += [f"print({'last' if self.keeps else text})"] if statement.shown else []
        return statement.shown or self.keeps

    def _literal(self, value: Any) -> str:
        """Return a value as text; nothing if Python has none like it."""
        try:
            return literal(self.interpreter.session, value, self.names)
        except (NoText, SymbodyError):
            return ""

    def _is_value(self, text: str, value: Any) -> bool:
        made = self.names.value(text)
        return made is not None and same(self.interpreter.session, made, value, self.names.small)

    def _source(self, statement: syntax.Statement) -> str:
        """Return the line of the sheet at which a statement begins."""
        lines = (line for cell in self.cells for line in cell.input if line.line == statement.place.line)
        return next(lines).text.strip()

    def _value(self, name: str) -> bool:
        session = self.interpreter.session
        text = self._literal(session.names[name])
        if not text or not self._is_value(text, session.names[name]):
            self.names.values.pop(identifier(name), None)
            return False
        self.names.values[identifier(name)] = self.names.value(text)
        self.known[name] = []
        self.lines.append(f"{identifier(name)} = {text}")
        return True

    def _update(self, changed: Sequence[str], *, is_entry: bool) -> None:
        """Give names that hold a symbol which has a value now, or an object that has changed, their new values."""
        session, values = self.interpreter.session, self.names.values
        symbols = {identifier(name) for name in changed} & set(self.names.symbols)
        again = self.known.keys() & set(changed)
        for name in list(self.known) if symbols or is_entry or again else ():
            text = identifier(name)
            if name in changed or name not in session.names or self._has(name):
                continue
            if self._made_again(name):
                continue
            changes = ", ".join(
                f"{self.names.declaration(self.names.symbols[each])}: {each}" for each in sorted(symbols)
            )
            line, before = f"{text} = sb.subs({text}, {{{changes}}})", values.get(text)
            with contextlib.suppress(Exception):
                exec(line, values)
            if symbols and self._has(name):
                self.lines.append(line)
                continue
            values[text] = before
            if not self._value(name):
                del self.known[name]

    def _sorted(self, name: str) -> bool:
        """Give a list that was a set the order of the worksheet."""
        text, values = identifier(name), self.names.values
        order = order_of(self.interpreter.session, values.get(text), self.interpreter.session.names[name])
        if order is None:
            return False
        line = f"{text} = [{text}[k] for k in {tuple(order)}]  # the order of the worksheet"
        exec(line, values)
        (self.code or []).append(line)
        return True

    def _has(self, name: str) -> bool:
        """Whether the program has the value that the session has."""
        session = self.interpreter.session
        return same(session, self.names.values.get(identifier(name)), session.names[name], self.names.small)

    def _made_again(self, name: str) -> bool:
        """Repeat the line that gave a name its value, if that gives what the name means now."""
        lines, before = self.known[name], dict(self.names.values)
        if not lines or len(lines) > 1:
            return False
        with contextlib.suppress(Exception):
            exec(lines[0], self.names.values)
        if self._has(name):
            self.lines.append(lines[0])
            return True
        self.names.values.clear()
        self.names.values.update(before)
        return False


def _counts(expression: syntax.Expression) -> bool:
    """Whether operations are counted: Maple and symbody have other forms."""
    match expression:
        case syntax.Call(
            function=syntax.Name(name="cost")
            | syntax.Selection(whole=syntax.Name(name="codegen"), indices=(syntax.Name(name="cost"),))
        ):
            return True
    return False


def _imports(body: str) -> str:
    """Return the lines that import what the program needs of the standard library."""
    needed = {"pickle.": "import pickle\n", "Path(": "from pathlib import Path\n"}
    lines = "".join(line for word, line in needed.items() if word in body)
    return f"{lines}\n" if lines else ""


def _is_restart(statement: syntax.Statement) -> bool:
    return (
        isinstance(statement, syntax.Evaluation)
        and isinstance(statement.expression, syntax.Name)
        and statement.expression.name == "restart"
    )


def _begins_mode(statement: syntax.Statement) -> bool:
    """Whether a statement begins a mode, whose value is written as it is."""
    match statement:
        case syntax.Assignment(value=syntax.Call(function=syntax.Name(name=name))):
            return name in {"use_moving_frame", "USE_master_frame"}
    return False


def _is_loading(statement: syntax.Statement) -> bool:
    """Whether a statement loads a package, or sets how Maple prints."""
    match statement:
        case syntax.Assignment(
            targets=(syntax.Name(name=name) | syntax.Selection(whole=syntax.Name(name=name)),)
        ):
            return name in _LOADING
        case syntax.Evaluation(
            expression=syntax.Name(name=name) | syntax.Call(function=syntax.Name(name=name))
        ):
            return name in _LOADING
        case syntax.Evaluation(
            expression=syntax.Call(function=syntax.Selection(indices=(syntax.Name(name=name),)))
        ):
            return name in _LOADING
    return isinstance(statement, syntax.Empty)
