"""Full evaluation at use: a value with all that was assigned since it was made.

A scalar keeps its symbols. When it is used, those that have a value by now are substituted; the result is remembered
with the count of assignments and the names that it depends on, so that this costs nothing where nothing changed.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from symbody.errors import DivisionByZeroError, ExpressionError, WorksheetError
from symbody.symbolic import Expr, UndefinedFunction, number, t, time_derivative
from symbody.worksheet.evaluation.late_derivative import derivative_at
from symbody.worksheet.evaluation.seen import depend_on, guarded, has_changed
from symbody.worksheet.evaluation.state import Seen, State
from symbody.worksheet.evaluation.variables import CONSTANTS, applications_of, variables_of
from symbody.worksheet.printing.print import sort_key
from symbody.worksheet.values.complex_number import normal
from symbody.worksheet.values.logic_words import LOGIC
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import of_bounded_length
from symbody.worksheet.values.value import (
    Array,
    Builtin,
    Listed,
    MapleSet,
    ProcedureValue,
    Quoted,
    Range,
    Reference,
    Relation,
    Sequence,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["called_again", "current", "is_last_name", "named", "replaced", "resolved", "set_of"]


def is_last_name(value: Value) -> bool:
    """Whether evaluation of a name stops before this value: tables, procedures, matrices of the old kind."""
    return isinstance(value, Table | ProcedureValue) or (
        isinstance(value, Array) and value.kind in ("matrix", "vector", "array")
    )


def resolved(session: State, value: Value) -> Value:
    """Return what a reference, or a bare name, stands for in the session: names of procedures are not among them."""
    for _ in range(100):
        if isinstance(value, Reference) or (isinstance(value, Expr) and value.kind == "symbol"):
            name = value.name
        else:
            return value
        scope = session.scope_of(name) if isinstance(value, Expr) else None
        found = session.names.get(name) if scope is None else scope.names.get(name)
        if found is None:
            return value
        value = found
    return value


def named(session: State, name: str) -> Value:
    """Return what a name in the code stands for, in the procedure that runs, in those around it, or in the session."""
    scope = session.scope
    while scope is not None:
        if name in scope.names:
            return current(session, scope.names[name])
        if name in scope.missing:
            raise WorksheetError(
                f"invalid input: {scope.name} uses its argument {scope.missing[name]}, {name}, which is missing"
            )
        if name in scope.local:
            return symbol(name)
        scope = scope.parent
    return _of_session(session, name)


def _of_session(session: State, name: str) -> Value:
    """Return what a name of the session stands for: its last name if that is a table, a procedure or an old matrix."""
    depend_on(session, (name,))
    alias = session.options.aliases.get(name) if session.options.aliases else None
    if alias is not None:
        return current(session, alias)
    if name not in session.names:
        if name == "I":
            session.options.imaginary = True
        return CONSTANTS.get(name) or symbol(name)
    if name in session.resolving:
        return symbol(name)
    value = session.names[name]
    if is_last_name(value):
        return Reference(name)
    session.resolving.append(name)
    try:
        return current(session, value)
    finally:
        session.resolving.pop()


def current(session: State, value: Value, *, arrays: bool = False) -> Value:
    """Return a value with all that was assigned since it was made; new matrices as they are unless ``arrays``."""
    if isinstance(value, Expr):
        return _scalar(session, value)
    if isinstance(value, Reference):
        return _reference(session, value)
    if isinstance(value, Quoted):
        return session.evaluate(value.body)
    if isinstance(value, Array):
        return _array(session, value) if arrays else value
    return _container(session, value, arrays=arrays)


def _reference(session: State, value: Reference) -> Value:
    found = session.names.get(value.name)
    if found is None:
        return symbol(value.name)
    return value if is_last_name(found) else _of_session(session, value.name)


def _container(session: State, value: Any, *, arrays: bool) -> Value:
    if isinstance(value, Listed | MapleSet | Sequence):
        items = [current(session, item, arrays=arrays) for item in value.items]
        if all(new is old for new, old in zip(items, value.items, strict=True)):
            return value
        flat = flattened(items)
        return set_of(flat) if isinstance(value, MapleSet) else type(value)(tuple(flat))
    if isinstance(value, Relation):
        left, right = (
            current(session, value.left, arrays=arrays),
            current(session, value.right, arrays=arrays),
        )
        return value if left is value.left and right is value.right else Relation(value.operator, left, right)
    if isinstance(value, Range):
        start, stop = current(session, value.start), current(session, value.stop)
        return value if start is value.start and stop is value.stop else Range(start, stop)
    if isinstance(value, Unevaluated):
        arguments = tuple(_argument(session, each, arrays=arrays) for each in value.arguments)
        return _unevaluated(session, value, arguments)
    return value  # type: ignore[no-any-return]


def _unevaluated(session: State, value: Unevaluated, arguments: tuple[Value, ...]) -> Value:
    """Return a call with the function and the arguments of now: ``f(3)(z)`` of ``f(q)(z)``, if q has become 3."""
    function = value.function
    if not isinstance(function, Expr) or function.kind != "symbol":
        head = current(session, function)
        is_drawn = isinstance(head, Builtin) and arguments != value.arguments  # a shape that had no numbers
        return (
            session.call(head, arguments)
            if head != function or is_drawn
            else replace(value, arguments=arguments)
        )
    is_new = function.name in session.names or (function.name in LOGIC and arguments != value.arguments)
    return session.call(function, arguments) if is_new else replace(value, arguments=arguments)


def _argument(session: State, value: Value, *, arrays: bool) -> Value:
    """A field of an object that is shown by a name stays so: ``frame = ground``."""
    match value:
        case Relation("=", _, Expr(kind="symbol")):
            return value
    return current(session, value, arrays=arrays)


def _array(session: State, value: Array) -> Array:
    entries = [current(session, entry) for entry in value.entries]
    if all(new is old for new, old in zip(entries, value.entries, strict=True)):
        made = value
    else:
        made = replace(value, entries=entries)
    return (
        session.face(session, value, made) if value.frame is not None and session.face is not None else made
    )


def flattened(items: Iterable[Value]) -> list[Value]:
    """Return items with sequences among them opened."""
    flat: list[Value] = []
    for item in items:
        if isinstance(item, Sequence):
            flat.extend(item.items)
        else:
            flat.append(item)
    return flat


def set_of(items: Iterable[Value]) -> MapleSet:
    """Return a set: items different by value, in an order that depends on their texts alone."""
    return MapleSet(tuple(sorted(dict.fromkeys(items), key=sort_key)))


# --- scalars ----------------------------------------------------------------------------------------------------------


def _scalar(session: State, value: Expr) -> Value:
    seen = session.seen.get(value.id)
    inside = bool(session.scopes) or bool(session.resolving)
    if seen is not None and not has_changed(session, seen):
        seen.stamp = session.count
        depend_on(session, seen.names)
        return seen.result
    session.depends.append(set())
    try:
        result = _evaluated(session, value)
    finally:
        names = session.depends.pop()
        depend_on(session, names)
    if session.options.imaginary and result is not value and isinstance(result, Expr):
        result = normal(result)
    if not inside or not (names & guarded(session)):
        if len(session.seen) > 500_000:
            session.seen.clear()
        session.seen[value.id] = Seen(session.count, frozenset(names), result)
    return result


def _evaluated(session: State, value: Expr) -> Value:
    if value.kind == "symbol":
        return _symbol(session, value)
    depends = session.depends[-1]
    new: dict[Expr, Value] = {}
    for variable in variables_of(session, value):
        found = _symbol(session, variable) if variable.kind == "symbol" else _function(session, variable)
        if found is not variable:
            new[variable] = found
    for node in applications_of(session, value):
        depends.add(node.name)
        if node.name in session.names or node.name in session.remembered:
            arguments = tuple(current(session, each) for each in node.args)
            called = (
                derivative_at(session, symbol(node.name), node, arguments)
                if any(node.orders)
                else session.call(symbol(node.name), arguments)
            )
            if called is not node and called != node:
                new[node] = called
    scalars = {old: found for old, found in new.items() if isinstance(found, Expr)}
    others = {old: found for old, found in new.items() if not isinstance(found, Expr | Reference)}
    if others:
        return session.rebuild(value, new)
    return replaced(session, value, scalars) if scalars else value


def replaced(session: State, value: Expr, scalars: Mapping[Expr, Expr]) -> Value:
    """Return a scalar with others in place of some.

    The root of what becomes a negative number is complex. What the printed form has cancelled, such as the rate in a
    ratio of rates, is replaced nowhere.
    """
    try:
        return of_bounded_length(value.subs(scalars))
    except (ExpressionError, DivisionByZeroError):
        return session.rebuild(value, dict(scalars))


def _symbol(session: State, value: Expr) -> Value:
    name = value.name
    indexed = session.indexed.get(name)
    if indexed is not None:
        return _indexed(session, value, *indexed)
    opaque = session.opaque.get(name)
    if opaque is not None:
        return _opaque(session, value, opaque)
    if session.scope_of(name) is not None:
        depend_on(session, (name,))  # outside of its procedure, the name is that of the session
        return value
    found = _of_session(session, name)
    return value if found == value or found == Reference(name) else found


def _indexed(session: State, value: Expr, base: str, indices: tuple[Value, ...]) -> Value:
    depend_on(session, (base,))
    is_within = base in session.indexed  # an entry of an entry, T[1][b]
    holder = resolved(session, current(session, symbol(base)) if is_within else symbol(base))
    if isinstance(holder, Table):
        key = tuple(current(session, each) for each in indices)
        if key in holder.entries and base not in session.resolving:
            session.resolving.append(base)
            try:
                return current(session, holder.entries[key])
            finally:
                session.resolving.pop()
        if holder.is_sparse and key not in holder.entries:
            return number(0)
    if isinstance(holder, Array | Listed):
        found = session.select(
            Reference(base) if isinstance(holder, Array) and not is_within else holder, indices
        )
        return value if found == value else current(session, found)
    return value


def _opaque(session: State, value: Expr, content: Value) -> Value:
    found = called_again(session, current(session, content), content)
    return value if found == content else found


def called_again(session: State, value: Value, before: Value) -> Value:
    """Return what a call that nobody knew is with its arguments of now: ``floor(z)``, if z has become a number."""
    if isinstance(value, Unevaluated) and value != before:
        return session.call(value.function, value.arguments)
    return value


def _function(session: State, value: Expr) -> Value:
    """Return the value of a function of time, or of its derivative, if it has one by now."""
    name = value.name
    if name in session.resolving:
        return value
    found = _of_time(session, name)
    if not isinstance(found, Expr):
        return value
    return time_derivative(found, value.order) if value.order else found


def _of_time(session: State, name: str) -> Value | None:
    entry = session.remembered.get(name, {}).get((t,))
    held = session.names.get(name)
    if entry is None and not isinstance(held, ProcedureValue | Expr):
        return None
    session.resolving.append(name)
    try:
        if entry is not None:
            return current(session, entry)
        if isinstance(held, ProcedureValue):
            return session.call(Reference(name), (t,))
        head = current(session, held) if held is not None else None
        if isinstance(head, Expr) and head.is_number:
            return head
        if isinstance(head, Expr) and head.kind == "symbol" and head.name != name:
            return UndefinedFunction(head.name)(t)
        return None
    finally:
        session.resolving.pop()
