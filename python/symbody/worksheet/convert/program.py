"""The program: each statement is written, executed, and compared with what the worksheet's session has.

What can't be written, or would give something else, is written as the value that the session has. So the program gives
the same equations, however much of the sheet it contains as code.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import sys
from collections.abc import Iterator, Sequence

from symbody.errors import SymbodyError, WorksheetError
from symbody.files.replacement import write_texts
from symbody.worksheet import syntax
from symbody.worksheet.check.printed import functions_in
from symbody.worksheet.convert.python_text import Names, NoText, PythonText, identifier
from symbody.worksheet.convert.same import literal, same
from symbody.worksheet.interpret import Interpreter, Stop
from symbody.worksheet.reading import names_in_code, read_source, statements
from symbody.worksheet.session import Session
from symbody.worksheet.source import Cell, Remark, SyntaxMistake

__all__ = ["convert_file", "program"]

_HEAD = '''"""{title}, converted from a worksheet of MBSymba."""

import symbody as sb

'''
#: How many names are declared on a line.
_PER_LINE = 15

_LOADING = frozenset(
    {"restart", "with", "libname", "declare", "interface", "infolevel", "set_frame_name", "Describe"}
)


def convert_file(options: argparse.Namespace) -> int:
    """Write the program of a worksheet, and return the exit status."""
    try:
        cells = read_source(options.file)
    except (OSError, WorksheetError) as error:
        print(f"symbody convert: {options.file} is not readable: {error}", file=sys.stderr)
        return 3
    session = Session(folder=options.program.parent, source=options.file.parent)
    writer = _Program(cells, Interpreter(session))
    text = writer.write(options.file.stem)
    try:
        write_texts(options.program.parent, {options.program.name: text})
    except (OSError, SymbodyError) as error:
        print(f"symbody convert: {options.program} can't be written: {error}", file=sys.stderr)
        return 3
    print(
        f"{writer.written} statements written as code, {writer.values} as values, {writer.left_out} left out"
    )
    return int(writer.failed > 0)


def program(cells: Sequence[Cell], title: str) -> str:
    """Return the program of a worksheet."""
    return _Program(cells, Interpreter()).write(title)


class _Program:
    def __init__(self, cells: Sequence[Cell], interpreter: Interpreter) -> None:
        self.cells, self.interpreter = cells, interpreter
        self.names = Names(functions=set(_functions(cells)))
        self.lines: list[str] = []
        self.last = ""
        self.known: set[str] = set()
        self.written = self.values = self.left_out = self.failed = 0

    def write(self, title: str) -> str:
        used = names_in_code(self.cells)
        for cell in self.cells:
            self.lines += ["", *(f"# {line}" for text in cell.prose for line in text.split("\n"))]
            for item in statements(cell, used):
                if isinstance(item, SyntaxMistake):
                    self.failed += 1
                    self.lines.append(f"# line {item.place.line} can't be read")
                elif not isinstance(item, Remark) and not self._add(item):
                    return self._text(title)
        return self._text(title)

    def _text(self, title: str) -> str:
        head = [*self._declared("sb.functions_of_time"), *self._declared("sb.symbols")]
        body = "\n".join(self.lines).strip("\n")
        while "\n\n\n" in body:
            body = body.replace("\n\n\n", "\n\n")
        return _HEAD.format(title=title.replace('"', "'")) + "\n".join(head) + "\n\n" + body + "\n"

    def _declared(self, maker: str) -> Iterator[str]:
        """Return the lines that declare symbols, or functions of time."""
        functions = self.names.functions
        pairs = [
            (text, name)
            for text, name in self.names.symbols.items()
            if (name in functions) == (maker == "sb.functions_of_time")
        ]
        plain = [name for text, name in pairs if text == name]
        for begin in range(0, len(plain), _PER_LINE):
            names = plain[begin : begin + _PER_LINE]
            yield f'{", ".join(names)} = {maker}("{" ".join(names)}")'
        yield from (f"{text} = {_made(self.names, name)}" for text, name in pairs if text != name)

    def _add(self, statement: syntax.Statement) -> bool:
        """Add a statement; return whether the sheet goes on."""
        before = dict(self.interpreter.session.assigned)
        if not _is_loading(statement):
            self._prepare(statement)
        try:
            self.interpreter.execute(statement)
        except Stop:
            return False
        except WorksheetError as error:
            self.failed += 1
            self.lines.append(f"# line {statement.place.line} failed: {str(error).splitlines()[0]}")
            return True
        if _is_loading(statement):
            return True
        session = self.interpreter.session
        changed = [name for name in session.names if session.assigned.get(name) != before.get(name)]
        if not self._as_code(statement, changed):
            self._as_values(statement, changed)
        entries = syntax.Selection | syntax.Call
        is_entry = isinstance(statement, syntax.Assignment) and isinstance(statement.targets[0], entries)
        self._update(changed, is_entry=is_entry)
        return True

    def _prepare(self, statement: syntax.Statement) -> None:
        self.code: list[str] = []
        text = PythonText(self.names, self.last)
        with contextlib.suppress(NoText, SymbodyError, ValueError, TypeError):
            self.code = list(_code(statement, text))

    def _as_code(self, statement: syntax.Statement, changed: Sequence[str]) -> bool:
        """Execute the code of a statement; keep it if its values are those of the session."""
        if not self.code:
            return False
        values = {name: made for name, made in self.names.values.items() if name != "last"}
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                exec("\n".join(self.code), values)
        except Exception:
            return False
        session = self.interpreter.session
        for name in changed:
            if not same(session, values.get(identifier(name)), session.names[name]):
                return False
        is_value = isinstance(statement, syntax.Evaluation) and "last" in values
        if is_value and session.last and not same(session, values["last"], session.last[0]):
            return False
        self.names.values = values
        self.known |= set(changed)
        self.lines += self.code
        self.last = identifier(changed[0]) if changed else "last" if "last" in values else ""
        self.written += 1
        return True

    def _as_values(self, statement: syntax.Statement, changed: Sequence[str]) -> None:
        """Write the values that a statement has given to names."""
        self.last = ""
        written = [name for name in changed if self._value(name)]
        if isinstance(statement, syntax.Evaluation) and not changed and self._shown_value(statement):
            written = ["last"]
        if written:
            self.values += 1
            self.lines[-1] += f"  # the value of line {statement.place.line}"
        else:
            self.left_out += 1
            self.lines.append(f"# left out, line {statement.place.line}: {self._source(statement)}")

    def _shown_value(self, statement: syntax.Evaluation) -> bool:
        """Write the value of an expression, and print it."""
        session = self.interpreter.session
        text = literal(session, session.last[0], self.names) if session.last else None
        if text is None:
            return False
        try:
            made = eval(text, self.names.values)
        except Exception:
            return False
        if not same(session, made, session.last[0]):
            return False
        self.names.values["last"], self.last = made, "last"
        self.lines += ["print(last)"] if statement.shown else []
        self.lines.insert(len(self.lines) - statement.shown, f"last = {text}")
        return True

    def _source(self, statement: syntax.Statement) -> str:
        """Return the line of the sheet at which a statement begins."""
        lines = (line for cell in self.cells for line in cell.input if line.line == statement.place.line)
        return next(lines).text.strip()

    def _value(self, name: str) -> bool:
        session = self.interpreter.session
        text = literal(session, session.names[name], self.names)
        if text is None:
            self.names.values.pop(identifier(name), None)
            return False
        try:
            made = eval(text, self.names.values)
        except Exception:
            return False
        if not same(session, made, session.names[name]):
            return False
        self.names.values[identifier(name)] = made
        self.known.add(name)
        self.lines.append(f"{identifier(name)} = {text}")
        return True

    def _update(self, changed: Sequence[str], *, is_entry: bool) -> None:
        """Give names that hold a symbol which has a value now, or an object that has changed, their new values."""
        session = self.interpreter.session
        symbols = {identifier(name) for name in changed} & set(self.names.symbols)
        for name in sorted(self.known - set(changed)) if symbols or is_entry else ():
            if name not in session.names or same(
                session, self.names.values.get(identifier(name)), session.names[name]
            ):
                continue
            text = identifier(name)
            changes = ", ".join(
                f"{_made(self.names, self.names.symbols[each])}: {each}" for each in sorted(symbols)
            )
            line = f"{text} = sb.subs({text}, {{{changes}}})"
            values = dict(self.names.values)
            with contextlib.suppress(Exception):
                exec(line, values)
            if same(session, values.get(text), session.names[name]):
                self.names.values = values
                self.lines.append(line)
            elif not self._value(name):
                self.known.discard(name)


def _made(names: Names, name: str) -> str:
    """Return what makes a symbol, or a function of time; some names of Maple are none in Python."""
    if not name.isidentifier():
        return f"sb.symbolic.{'time_function' if name in names.functions else 'symbol'}({name!r})"
    return f'sb.functions_of_time("{name}")' if name in names.functions else f'sb.symbols("{name}")'


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


def _code(statement: syntax.Statement, text: PythonText) -> Iterator[str]:
    """Return the lines of a statement."""
    match statement:
        case syntax.Assignment(targets=(syntax.Name(name=name),), value=value):
            yield f"{identifier(name)} = {text.text(value)}"
        case syntax.Assignment(targets=targets, value=syntax.SequenceDisplay(items=items)) if all(
            isinstance(target, syntax.Name) for target in targets
        ):
            names = ", ".join(
                identifier(target.name) for target in targets if isinstance(target, syntax.Name)
            )
            yield f"{names} = {text.items(items)}"
        case syntax.Evaluation(
            expression=syntax.Call(
                function=syntax.Name(name="show"), arguments=(syntax.Name() as shown, *options)
            )
        ):
            yield f"sb.show({text.text(shown)}{', synthetic=True' if options else ''})"
        case syntax.Evaluation(expression=expression):
            yield f"last = {text.text(expression)}"
            if statement.shown:
                yield "print(last)"
        case _:
            raise NoText("statement")


def _functions(cells: Sequence[Cell]) -> Iterator[str]:
    """Return the names that the sheet applies to t."""
    for cell in cells:
        for item in statements(cell):
            yield from functions_in(item)
