"""Other operands in the place of some: subsop, applyop."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.builtins.structural import operands
from symbody.worksheet.evaluation.arithmetic import composed
from symbody.worksheet.evaluation.current import flattened
from symbody.worksheet.evaluation.entrywise import with_parts
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.structure import tree_of
from symbody.worksheet.values.value import Listed, MapleSet, Relation, Unevaluated, Value

__all__ = ["COMMANDS"]


def subsop(session: Session, *arguments: Value) -> Value:
    """subsop(i = a, .., e): the i-th operand replaced; i is 0 for the function, [i, j] for an operand of an operand."""
    *rules, value = arguments
    head: Value | None = None
    parts = list(operands(session, value))
    for rule in rules:
        if not isinstance(rule, Relation):
            raise _expected()
        path = list(rule.left.items) if isinstance(rule.left, Listed) else [rule.left]
        place = as_integer(path[0]) if path else None
        if place == 0 and len(path) == 1:
            head = rule.right
            continue
        if place is None or not 0 < abs(place) <= len(parts):
            raise _expected()
        at = place - 1 if place > 0 else place
        inner = Relation("=", Listed(tuple(path[1:])), rule.right)
        parts[at] = rule.right if len(path) == 1 else subsop(session, inner, parts[at])
    return _with_operands(session, value, flattened(parts), head)


def _expected() -> WorksheetError:
    return WorksheetError("subsop: expected equations of a place and a new operand, such as 2 = x")


def _with_operands(session: Session, value: Value, parts: list[Value], head: Value | None) -> Value:
    """Return a value of other operands, place by place: ``f(z, a)`` for ``f(a, a)``.

    Args:
        session: the session.
        value: the value.
        parts: its new operands.
        head: the function in the place of that of a call; None for the same.
    """
    if head is not None:
        is_call = isinstance(value, Unevaluated) or (
            isinstance(value, Expr) and tree_of(value).kind == "function"
        )
        if not is_call:
            raise WorksheetError("subsop: the place 0 is that of the function of a call")
        return session.call(head, tuple(parts))
    if not isinstance(value, Expr):
        return with_parts(value, parts)
    if value.kind == "symbol" and value.name in session.indexed:
        return session.select(symbol(session.indexed[value.name][0]), tuple(parts))
    if not tree_of(value).parts:
        raise WorksheetError(f"subsop: {session.text(value)[:60]} has no operands that could be replaced")
    return composed(session, tree_of(value), parts)


def applied_to_operand(session: Session, function: Value, place: Value, value: Value, *rest: Value) -> Value:
    """applyop(f, i, e): e with f of its operand i in the place of the operand; i may be a set of places."""
    rules = []
    for each in place.items if isinstance(place, MapleSet) else (place,):
        operand = session.call(symbol("op"), (each, value))
        rules.append(Relation("=", each, session.call(function, (operand, *rest))))
    return subsop(session, *rules, value)


COMMANDS: dict[str, Command] = {"subsop": subsop, "applyop": applied_to_operand}
