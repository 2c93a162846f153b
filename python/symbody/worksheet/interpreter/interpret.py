"""Statements: assignments, loops, conditions, and what they print."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, UndefinedFunction, number, time_limit
from symbody.worksheet import builtins
from symbody.worksheet.builtins.files import read_file, save_file
from symbody.worksheet.commands import mbsymba, operators
from symbody.worksheet.evaluation.condition import truth
from symbody.worksheet.evaluation.select import assigned_entry, key_of
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.evaluate import Evaluator
from symbody.worksheet.interpreter.procedure import Leave, Returned
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Remark, SyntaxMistake
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    Quoted,
    Reference,
    Sequence,
    String,
    Table,
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
        self.evaluator = Evaluator(self.session)
        self.evaluator.execute = self._body
        self.session.run = self.run
        self.session.parsed = self.parsed
        self.session.overload = operators.overloaded
        self.session.face = _face
        mbsymba.install(self.session)
        self._level = 0
        self._quiet = 0
        self._methods: dict[type, Callable[[Any], Value]] = {
            syntax.Assignment: self._assignment,
            syntax.Evaluation: lambda node: self._evaluate(node.expression),
            syntax.If: self._if,
            syntax.For: self._for,
            syntax.Return: self._return,
            syntax.Raise: self._raise,
            syntax.Try: self._try,
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
        session.lines = []
        session.unfinished = False
        session.limits.start()
        session.scopes.clear()
        session.resolving.clear()
        session.depends.clear()
        self._level = self._quiet = 0
        self.evaluator.depth = 0
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

    def run(self, text: str) -> None:
        """Execute the statements of a text, as ``read`` does; a mistake ends it.

        Behind ``read "f":`` they print nothing, however they end.
        """
        for statement in _statements_of(text):
            self._statement(statement, shown=statement.shown and not self._quiet)

    def parsed(self, text: str) -> Value:
        """Return the value of an expression given as a text."""
        value: Value = NULL
        for statement in _statements_of(text):
            if not isinstance(statement, syntax.Evaluation):
                raise WorksheetError(f"{text[:60]!r} is not an expression")
            value = self.evaluator.evaluate(statement.expression)
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
            builtins.display(session, value)

    def _full(self, value: Value) -> Value:
        """An assigned value prints in full, not by its last name, unless it was a name."""
        return value if isinstance(value, Reference) else self._printed(value)

    def _printed(self, value: Value) -> Value:
        return self.session.current(value) if isinstance(value, Array) else value

    def _target_text(self, target: syntax.Expression) -> str:
        if isinstance(target, syntax.Name | syntax.Concatenation):
            return builtins.name_text(self.evaluator.concatenation(target))
        value = self.evaluator.unevaluated(target)
        if isinstance(target, syntax.Selection):
            indices = ", ".join(self.session.text(each) for each in self.evaluator.arguments(target.indices))
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
        return self.evaluator.evaluate(node)

    # --- assignment ---------------------------------------------------------------------------------------------------

    def _assignment(self, node: syntax.Assignment) -> Value:
        value = self.evaluator.evaluate(node.value)
        if len(node.targets) == 1:
            self._assign(node.targets[0], value)
            return value
        values = value.items if isinstance(value, Sequence) else (value,)
        if len(values) != len(node.targets):
            raise WorksheetError(
                f"ambiguous multiple assignment: {len(node.targets)} names for {len(values)} values",
                node.place,
            )
        for target, each in zip(node.targets, values, strict=True):
            self._assign(target, each)
        return value

    def _assign(self, target: syntax.Expression, value: Value) -> None:
        if isinstance(target, syntax.Delayed):
            target = target.body
        if isinstance(target, syntax.Name | syntax.Concatenation):
            self._assign_name(self.evaluator.concatenation(target), value, target)
        elif isinstance(target, syntax.Selection):
            self._assign_entry(target, value)
        elif isinstance(target, syntax.Call) and isinstance(
            target.function, syntax.Name | syntax.Concatenation | syntax.Selection
        ):
            self._assign_call(target, value)
        elif isinstance(target, syntax.Infix) and target.operator == "::":
            self._assign(target.left, value)
        else:
            raise WorksheetError(
                "invalid left side of an assignment; expected a name, an entry such as a[1], or x(t)",
                target.place,
            )

    def _assign_name(self, name: str, value: Value, target: syntax.Expression) -> None:
        session = self.session
        if name in _PROTECTED:
            raise WorksheetError(f"attempting to assign to {name} which is protected", target.place)
        scope = session.scope
        while scope is not None:
            if name in scope.names or name in scope.local:
                scope.names[name] = value
                return
            scope = scope.parent
        if name in ("Digits", "printlevel") and isinstance(value, Expr) and (amount := as_float(value)):
            self._set_option(name, int(amount))
        if isinstance(value, Expr) and value.kind == "symbol" and value.name == name:
            session.unassign(name)
            return
        if isinstance(value, Reference) and value.name == name:
            return  # of the table that it is already
        session.assign(name, self._without_cycle(name, value, target))

    def _set_option(self, name: str, amount: int) -> None:
        if name == "Digits":
            self.session.options.digits = min(max(amount, 1), 1000)
        else:
            self.session.options.printlevel = amount

    def _without_cycle(self, name: str, value: Value, target: syntax.Expression) -> Value:
        """A value that holds its own name uses the old value; there is none of a name that had no value."""
        if not isinstance(value, Expr):
            return value
        own = [each for each in value.free_symbols if each.kind == "symbol" and each.name == name]
        if not own:
            return value
        old = self.session.names.get(name)
        if isinstance(old, Expr):
            return value.subs({own[0]: old})
        raise WorksheetError(
            f"recursive assignment: {name} has no value that its new value could use", target.place
        )

    def _assign_entry(self, target: syntax.Selection, value: Value) -> None:
        session = self.session
        indices = self.evaluator.arguments(target.indices)
        if isinstance(target.whole, syntax.Name | syntax.Concatenation):
            name = self.evaluator.concatenation(target.whole)
            held = session.value(name)
        elif isinstance(target.whole, syntax.Selection):
            name, held = "", self.evaluator.evaluate(target.whole)
        else:
            name, held = "", self.evaluator.evaluate(target.whole)
        holder = session.resolve(held)
        if isinstance(holder, Table | Array):
            assigned_entry(session, holder, indices, value)
        elif isinstance(holder, Listed) and name:
            self._assign_name(name, _with_item(session, holder, indices, value), target)
        elif isinstance(holder, Expr) and holder.kind == "symbol":
            self._new_table(holder.name, indices, value)
        else:
            raise WorksheetError(
                f"{session.text(held)[:60]} has no entries that could be assigned", target.place
            )
        base = held.name if isinstance(held, Reference) else name
        if base:
            session.touch(base)

    def _new_table(self, name: str, indices: tuple[Value, ...], value: Value) -> None:
        session = self.session
        table = Table({key_of(session, indices): value})
        if name in session.indexed:
            base, own = session.indexed[name]
            holder = session.resolve(session.value(base))
            if isinstance(holder, Table):
                holder.entries[own] = table
                session.touch(base)
                return
        scope = session.scope
        while scope is not None:
            if name in scope.names or name in scope.local:
                scope.names[name] = table
                return
            scope = scope.parent
        session.assign(name, table)

    def _assign_call(self, target: syntax.Call, value: Value) -> None:
        session = self.session
        if isinstance(target.function, syntax.Selection):
            head = self.evaluator.unevaluated(target.function)
            name = head.name if isinstance(head, Expr) else ""
        else:
            name = self.evaluator.concatenation(target.function)
        arguments = self.evaluator.arguments(target.arguments)
        scalars = [each for each in arguments if isinstance(each, Expr)]
        plain = UndefinedFunction(name)(*scalars) if scalars and len(scalars) == len(arguments) else None
        if plain is not None and value == plain:
            session.remembered.get(name, {}).pop(arguments, None)
            session.touch(name)
            return
        session.remember(name, arguments, value)

    # --- control ------------------------------------------------------------------------------------------------------

    def _if(self, node: syntax.If) -> Value:
        for condition, body in node.branches:
            if truth(self.session, self.evaluator.evaluate(condition)):
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
                self._assign_name(node.variable, item, syntax.Name(node.variable, place=node.place))
            if node.condition is not None and not truth(
                self.session, self.evaluator.evaluate(node.condition)
            ):
                break
            try:
                value = self._nested(node.body, shown=node.shown)
            except Leave as leave:
                if leave.whole:
                    break
        return value

    def _passes(self, node: syntax.For) -> Iterable[Value]:
        if node.items is not None:
            yield from builtins.items_of(self.session, self.evaluator.evaluate(node.items))
            return
        at, step = (self._bound(each) if each is not None else number(1) for each in (node.start, node.step))
        stop = None if node.stop is None else self._bound(node.stop)
        while stop is None or not _beyond(at, stop, step):
            yield at
            at = at + step
        if node.variable is not None:
            self._assign_name(node.variable, at, syntax.Name(node.variable, place=node.place))

    def _bound(self, node: syntax.Expression) -> Expr:
        value = self.evaluator.evaluate(node)
        if not isinstance(value, Expr) or as_float(value) is None:
            raise WorksheetError(
                f"the bound {self.session.text(value)[:60]} of a loop is not a number", node.place
            )
        return value

    def _return(self, node: syntax.Return) -> Value:
        raise Returned(NULL if node.value is None else self.evaluator.evaluate(node.value))

    def _leave(self, *, whole: bool) -> Value:
        raise Leave(whole=whole)

    def _raise(self, node: syntax.Raise) -> Value:
        values = self.evaluator.arguments(node.arguments)
        texts = [each.text if isinstance(each, String) else self.session.text(each) for each in values]
        message = texts[0] if texts else "unspecified error"
        for i, text in enumerate(texts[1:], 1):
            message = message.replace(f"%{i}", text)
        raise WorksheetError(message, node.place)

    def _try(self, node: syntax.Try) -> Value:
        try:
            return self._nested(node.body, shown=node.shown)
        except SymbodyError as error:
            self.session.assign("lastexception", Sequence((symbol("unknown"), String(str(error)))))
            for texts, body in node.handlers:
                if not texts or any(not text or text in str(error) for text in texts):
                    return self._nested(body, shown=node.shown)
            raise
        finally:
            self._nested(node.finally_, shown=node.shown)

    def _read(self, node: syntax.Read) -> Value:
        self._quiet += not node.shown
        try:
            return read_file(self.session, self.evaluator.evaluate(node.file))
        finally:
            self._quiet -= not node.shown

    def _save(self, node: syntax.Save) -> Value:
        *names, file = (self.evaluator.unevaluated(each) for each in node.arguments)
        found = (
            self.evaluator.evaluate(node.arguments[-1])
            if isinstance(file, Expr | Quoted | Unevaluated)
            else file
        )
        return save_file(self.session, *names, found)

    def _declaration(self, node: syntax.Declaration) -> Value:
        for each in node.variables:
            if each.default is not None:
                self._assign_name(
                    each.name, self.evaluator.evaluate(each.default), syntax.Name(each.name, place=node.place)
                )
        return NULL

    def _quit(self, node: syntax.Quit) -> Value:
        raise Stop


def _statements_of(text: str) -> Iterable[syntax.Statement]:
    for cell in source_cells(text):
        for statement in statements(cell):
            if isinstance(statement, SyntaxMistake):
                raise WorksheetError(statement.message)
            if not isinstance(statement, Remark):
                yield statement


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

_PROTECTED = frozenset(
    {"Pi", "I", "true", "false", "FAIL", "infinity", "NULL", "sin", "cos", "tan", "diff", "D"}
)


def _beyond(at: Expr, stop: Expr, step: Expr) -> bool:
    a, b, c = as_float(at), as_float(stop), as_float(step)
    if a is None or b is None or c is None:
        return True
    if c == 0:
        raise WorksheetError("the step of a loop is zero")
    return a > b if c > 0 else a < b


def _with_item(session: Session, whole: Listed, indices: tuple[Value, ...], value: Value) -> Value:
    array = Array(len(whole.items), 1, list(whole.items), "Vector")
    if len(indices) == 1 and as_float(indices[0]) == len(whole.items) + 1:  # type: ignore[arg-type]
        return Listed((*whole.items, value))
    assigned_entry(session, array, indices, value)
    return Listed(tuple(array.entries))
