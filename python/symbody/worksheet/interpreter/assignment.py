"""Assignments: to names, entries of tables, lists and matrices, and values of functions."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, UndefinedFunction
from symbody.worksheet.evaluation.select import assigned_entry, key_of
from symbody.worksheet.evaluation.session import Scope, Session
from symbody.worksheet.interpreter.concatenation import concatenation
from symbody.worksheet.interpreter.quote import unevaluated
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import Array, Listed, Reference, Sequence, Table, Value

__all__ = ["Assignments"]

_PROTECTED = frozenset(
    {"Pi", "I", "true", "false", "FAIL", "infinity", "NULL", "sin", "cos", "tan", "diff", "D"}
)


class Assignments:
    """Executes assignments in a session."""

    def __init__(self, session: Session) -> None:
        self.session = session

    def execute(self, node: syntax.Assignment) -> Value:
        """Assign the values of the right side to the targets of the left side, and return them."""
        value = self.session.evaluate(node.value)
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
            self.name(concatenation(self.session, target), value, target)
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

    def name(self, name: str, value: Value, target: syntax.Expression) -> None:
        """Give a name a value: the innermost procedure's that has it, or the session's."""
        session = self.session
        if name in _PROTECTED:
            raise WorksheetError(f"attempting to assign to {name} which is protected", target.place)
        scope = session.scope
        while scope is not None:
            if name in scope.parameters and (given := _given_name(scope.names[name])) is not None:
                self._to_caller(scope, given, value, target)
                return
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

    def _to_caller(self, scope: Scope, given: str, value: Value, target: syntax.Expression) -> None:
        """Give a name that the caller has passed a value there: ``f(x, 'y')`` with ``y := ..`` in f."""
        scopes = self.session.scopes
        place = next((i for i, each in enumerate(scopes) if each is scope), 0)
        inner, scopes[place:] = scopes[place:], []
        try:
            self.name(given, value, target)
        finally:
            scopes.extend(inner)

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
        indices = self.session.evaluated(target.indices)
        if isinstance(target.whole, syntax.Name | syntax.Concatenation):
            name = concatenation(self.session, target.whole)
            held = session.value(name)
        elif isinstance(target.whole, syntax.Selection):
            name, held = "", self.session.evaluate(target.whole)
        else:
            name, held = "", self.session.evaluate(target.whole)
        holder = session.resolve(held)
        if isinstance(holder, Table) and _is_own_name(session, value, name, key_of(session, indices)):
            holder.entries.pop(key_of(session, indices), None)
        elif isinstance(holder, Table | Array):
            assigned_entry(session, holder, indices, value)
        elif isinstance(holder, Listed) and name:
            self.name(name, _with_item(session, holder, indices, value), target)
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
        """Make a name a table with one entry; that of an entry, R[1] of R[1][b], makes R one, too."""
        session = self.session
        table = Table({key_of(session, indices): value})
        if name in session.indexed:
            base, own = session.indexed[name]
            holder = session.resolve(session.value(base))
            if isinstance(holder, Table):
                holder.entries[own] = table
                session.touch(base)
                return
            if isinstance(holder, Expr) and holder.kind == "symbol":
                self._new_table(base, own, table)
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
            head = unevaluated(self.session, target.function)
            name = head.name if isinstance(head, Expr) else ""
        else:
            name = concatenation(self.session, target.function)
        arguments = self.session.evaluated(target.arguments)
        scalars = [each for each in arguments if isinstance(each, Expr)]
        plain = UndefinedFunction(name)(*scalars) if scalars and len(scalars) == len(arguments) else None
        if plain is not None and value == plain:
            session.remembered.get(name, {}).pop(arguments, None)
            session.touch(name)
            return
        session.remember(name, arguments, value)


def _is_own_name(session: Session, value: Value, name: str, key: tuple[Value, ...]) -> bool:
    """Whether an entry is given its own name, ``T[a] := 'T[a]'``, by which it loses its value."""
    return (
        isinstance(value, Expr) and value.kind == "symbol" and session.indexed.get(value.name) == (name, key)
    )


def _given_name(value: Value) -> str | None:
    """Return the name that an argument is, if a procedure can give it a value."""
    return value.name if isinstance(value, Expr) and value.kind == "symbol" else None


def _with_item(session: Session, whole: Listed, indices: tuple[Value, ...], value: Value) -> Value:
    array = Array(len(whole.items), 1, list(whole.items), "Vector")
    if len(indices) == 1 and as_float(indices[0]) == len(whole.items) + 1:  # type: ignore[arg-type]
        return Listed((*whole.items, value))
    assigned_entry(session, array, indices, value)
    return Listed(tuple(array.entries))
