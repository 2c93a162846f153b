"""Statements: loops, conditions, files, and what statements print."""

from __future__ import annotations

import itertools
import sys
from collections.abc import Callable, Iterable
from collections.abc import Sequence as Listing
from dataclasses import replace
from typing import Any

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, number, time_limit
from symbody.worksheet import builtins
from symbody.worksheet.builtins.files import read_file, save_file
from symbody.worksheet.commands import mbsymba, operators
from symbody.worksheet.evaluation.condition import truth
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter import evaluate
from symbody.worksheet.interpreter.assignment import Assignments
from symbody.worksheet.interpreter.concatenation import concatenation
from symbody.worksheet.interpreter.other_file import in_file
from symbody.worksheet.interpreter.procedure import Leave, Returned
from symbody.worksheet.interpreter.quote import unevaluated
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import names_in_code, statements
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell, ReadFile, Remark, SyntaxMistake
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Quoted,
    Reference,
    String,
    Unevaluated,
    Value,
)

__all__ = ["Interpreter", "Stop"]


class Stop(Exception):
    """``quit``: the end of the sheet."""


class Interpreter:
    """Executes statements in a session.

    >>> from symbody.worksheet.reading import statements
    >>> from symbody.worksheet.sheet.source import Cell, Line
    >>> interpreter = Interpreter()
    >>> cell = Cell((Line("x := 3: y := x^2 + a;", 1),))
    >>> [text for statement in statements(cell) for text in interpreter.execute(statement)]
    ['y := a+9']
    """

    def __init__(self, session: Session | None = None) -> None:
        self.session = session or Session()
        self._assignments = Assignments(self.session)
        evaluate.install(self.session)
        self.session.execute = self._body
        self.session.run = self.run
        self.session.parsed = self.parsed
        self.session.overload = operators.overloaded
        self.session.face = _face
        mbsymba.install(self.session)
        self._level = 0
        self._quiet = 0
        self._methods: dict[type, Callable[[Any], Value]] = {
            syntax.Assignment: self._assignments.execute,
            syntax.Evaluation: lambda node: self._evaluate(node.expression),
            syntax.If: self._if,
            syntax.For: self._for,
            syntax.Return: self._return,
            syntax.Raise: self._raise,
            syntax.Try: self._try,
            syntax.Use: self._use,
            syntax.Next: lambda node: self._leave(whole=False),
            syntax.Break: lambda node: self._leave(whole=True),
            syntax.Read: self._read,
            syntax.Save: self._save,
            syntax.Declaration: self._declaration,
            syntax.Quit: self._quit,
            syntax.Empty: lambda node: NULL,
        }

    def execute(self, statement: syntax.Statement) -> list[str]:
        """Execute a statement of the sheet and return what it prints.

        Raises:
            WorksheetError: what Maple would report; its ``place`` is in the file.
            Stop: the statement is ``quit``.
        """
        session = self.session
        session.lines, session.shown = [], []
        session.unfinished = False
        session.limits.start()
        session.scopes.clear()
        session.resolving.clear()
        session.depends.clear()
        self._level = self._quiet = 0
        frames = sys.getrecursionlimit()
        sys.setrecursionlimit(max(frames, _FRAMES))
        try:
            with time_limit(session.limits.seconds):
                self._statement(statement, shown=statement.shown)
        except Returned:
            pass
        except TimeoutError:
            late = session.limits.exceeded()
            late.place = statement.place
            raise late from None
        except Leave:
            raise WorksheetError("break and next stand in loops only", statement.place) from None
        except RecursionError:
            raise WorksheetError("too many levels of recursion", statement.place) from None
        except WorksheetError as error:
            if error.place is None:
                error.place = statement.place
            raise
        except _FAULTS as error:
            raise WorksheetError(str(error) or type(error).__name__, statement.place) from error
        finally:
            sys.setrecursionlimit(frames)
        return session.lines

    def run(self, name: str, text: str) -> None:
        """Execute the statements of a file, as ``read`` does; a mistake ends it.

        Behind ``read "f":`` they print nothing, however they end.
        """
        file = ReadFile(name, source_cells(text))
        for statement in _statements_of(file.cells, self.session.notice, name):
            with in_file(self.session, file, statement.place):
                self._statement(statement, shown=statement.shown and not self._quiet)

    def parsed(self, text: str) -> Value:
        """Return the value of an expression given as a text."""
        value: Value = NULL
        for statement in _statements_of(source_cells(text), self.session.notice):
            if not isinstance(statement, syntax.Evaluation):
                raise WorksheetError(f"{text[:60]!r} is not an expression")
            value = self.session.evaluate(statement.expression)
        return value

    # --- statements ---------------------------------------------------------------------------------------------------

    def _statement(self, node: syntax.Statement, *, shown: bool) -> Value:
        session = self.session
        value = self._methods[type(node)](node)
        if isinstance(node, syntax.Evaluation | syntax.Assignment):
            session.note(value)
            if shown and not session.scopes and self._level <= session.options.printlevel:
                self._show(node, value)
        return value

    def _show(self, node: syntax.Statement, value: Value) -> None:
        session = self.session
        if isinstance(node, syntax.Assignment):
            names = ", ".join(self._target_text(target) for target in node.targets)
            session.print(f"{names} := {session.text(self._full(value))}")
        elif value != NULL:
            session.shown.append(session.current(value))
            builtins.display(session, value)

    def _full(self, value: Value) -> Value:
        """An assigned value prints in full, not by its last name, unless it was a name."""
        return value if isinstance(value, Reference) else self._printed(value)

    def _printed(self, value: Value) -> Value:
        return self.session.current(value) if isinstance(value, Array) else value

    def _target_text(self, target: syntax.Expression) -> str:
        if isinstance(target, syntax.Name | syntax.Concatenation):
            return builtins.name_text(concatenation(self.session, target))
        value = unevaluated(self.session, target)
        if isinstance(target, syntax.Selection):
            indices = ", ".join(self.session.text(each) for each in self.session.evaluated(target.indices))
            return f"{self._target_text(target.whole)}[{indices}]"
        return self.session.text(value)

    def _body(self, statements: Iterable[syntax.Statement], *, shown: bool = False) -> Value:
        value: Value = NULL
        for statement in statements:
            found = self._statement(statement, shown=shown)
            if found != NULL or not isinstance(statement, syntax.Empty):
                value = found
        return value

    def _evaluate(self, node: syntax.Expression) -> Value:
        if isinstance(node, syntax.Name) and node.name == "restart" and node.name not in self.session.names:
            self.session.restart()
            mbsymba.install(self.session)
            return NULL
        return self.session.evaluate(node)

    # --- control ------------------------------------------------------------------------------------------------------

    def _if(self, node: syntax.If) -> Value:
        for condition, body in node.branches:
            if truth(self.session, self.session.evaluate(condition)):
                return self._nested(body, shown=node.shown)
        return self._nested(node.otherwise, shown=node.shown)

    def _nested(self, body: Iterable[syntax.Statement], *, shown: bool) -> Value:
        self._level += 1
        try:
            return self._body(body, shown=shown)
        finally:
            self._level -= 1

    def _for(self, node: syntax.For) -> Value:
        value: Value = NULL
        for item in self._passes(node):
            self.session.limits.check()
            if node.variable is not None:
                self._assignments.name(node.variable, item, syntax.Name(node.variable, place=node.place))
            if node.condition is not None and not truth(self.session, self.session.evaluate(node.condition)):
                break
            try:
                value = self._nested(node.body, shown=node.shown)
            except Leave as leave:
                if leave.whole:
                    break
        return value

    def _passes(self, node: syntax.For) -> Iterable[Value]:
        if node.items is not None:
            yield from builtins.items_of(self.session, self.session.evaluate(node.items))
            return
        if (
            node.variable is None and node.stop is None
        ):  # nobody counts: numbers of the core are kept for ever
            yield from itertools.repeat(number(1))
        at, step = (self._bound(each) if each is not None else number(1) for each in (node.start, node.step))
        stop = None if node.stop is None else self._bound(node.stop)
        while stop is None or not _beyond(at, stop, step):
            yield at
            at = at + step
        if node.variable is not None:
            self._assignments.name(node.variable, at, syntax.Name(node.variable, place=node.place))

    def _bound(self, node: syntax.Expression) -> Expr:
        value = self.session.evaluate(node)
        if not isinstance(value, Expr) or as_float(value) is None:
            raise WorksheetError(
                f"the bound {self.session.text(value)[:60]} of a loop is not a number", node.place
            )
        return value

    def _return(self, node: syntax.Return) -> Value:
        raise Returned(NULL if node.value is None else self.session.evaluate(node.value))

    def _leave(self, *, whole: bool) -> Value:
        raise Leave(whole=whole)

    def _raise(self, node: syntax.Raise) -> Value:
        values = self.session.evaluated(node.arguments)
        texts = [each.text if isinstance(each, String) else self.session.text(each) for each in values]
        texts = [each.strip("`") for each in texts]  # a text may be a name
        message = texts[0] if texts else "unspecified error"
        if "%" not in message:
            message = ", ".join([message, *texts[1:]])
        for i, text in enumerate(texts[1:], 1):
            message = message.replace(f"%{i}", text)
        raise WorksheetError(message, node.place)

    def _try(self, node: syntax.Try) -> Value:
        try:
            return self._nested(node.body, shown=node.shown)
        except SymbodyError as error:
            self.session.keep_exception(str(error))
            for texts, body in node.handlers:
                if not texts or any(not text or text in str(error) for text in texts):
                    return self._nested(body, shown=node.shown)
            raise
        finally:
            self._nested(node.finally_, shown=node.shown)

    def _use(self, node: syntax.Use) -> Value:
        """Execute statements with the commands of packages."""
        session = self.session
        before = session.packages
        try:
            for each in node.packages:
                if isinstance(each, syntax.Name):
                    session.packages = session.packages | builtins.PACKAGES.get(each.name, {})
                else:
                    raise WorksheetError("use: expected the names of packages", each.place)
            return self._nested(node.body, shown=node.shown)
        finally:
            session.packages = before

    def _read(self, node: syntax.Read) -> Value:
        self._quiet += not node.shown
        try:
            return read_file(self.session, self.session.evaluate(node.file))
        finally:
            self._quiet -= not node.shown

    def _save(self, node: syntax.Save) -> Value:
        *names, file = (unevaluated(self.session, each) for each in node.arguments)
        found = (
            self.session.evaluate(node.arguments[-1])
            if isinstance(file, Expr | Quoted | Unevaluated)
            else file
        )
        return save_file(self.session, *names, found)

    def _declaration(self, node: syntax.Declaration) -> Value:
        for each in node.variables:
            if each.default is not None:
                self._assignments.name(
                    each.name, self.session.evaluate(each.default), syntax.Name(each.name, place=node.place)
                )
        return NULL

    def _quit(self, node: syntax.Quit) -> Value:
        raise Stop


def _statements_of(
    cells: Listing[Cell], note: Callable[[str], None], file: str = ""
) -> Iterable[syntax.Statement]:
    """Return the statements of a file that is read; a mistake ends it, and ``note`` is told what may be code."""
    used = names_in_code(cells)
    for cell in cells:
        for statement in statements(cell, used):
            if isinstance(statement, SyntaxMistake):
                raise WorksheetError(f'in "{file}", {statement.message}' if file else statement.message)
            if not isinstance(statement, Remark):
                yield statement
            elif statement.notice:
                note(
                    f'in "{file}", line {statement.place.line}: {statement.notice}'
                    if file
                    else statement.notice
                )


def _face(session: Session, before: Array, after: Array) -> Array:
    """Return an evaluated matrix with the evaluated chain of the one before."""
    chain = frame_face.current(session, before.frame)
    if after is before and chain is before.frame:
        return before
    return replace(after, frame=chain)


_FRAMES = 20_000
"""Calls of Python inside each other: some ten for each call of a procedure, and for each pair of parentheses."""

_FAULTS: tuple[type[Exception], ...] = (
    *(SymbodyError, ArithmeticError, AssertionError, AttributeError, LookupError, MemoryError),
    *(OSError, RuntimeError, StopIteration, TypeError, ValueError),
)
"""What a value that a command doesn't expect may raise in it; the next statement runs."""


def _beyond(at: Expr, stop: Expr, step: Expr) -> bool:
    a, b, c = as_float(at), as_float(stop), as_float(step)
    if a is None or b is None or c is None:
        return True
    if c == 0:
        raise WorksheetError("the step of a loop is zero")
    return a > b if c > 0 else a < b
