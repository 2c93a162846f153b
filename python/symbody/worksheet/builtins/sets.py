"""Union, difference and intersection, of sets, and of lists as MBSymba has it; operators as functions."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import number
from symbody.worksheet.evaluation.arithmetic import binary
from symbody.worksheet.evaluation.condition import equal
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.value import Array, Boolean, Listed, MapleSet, Range, Relation, Sequence, Value

__all__ = ["COMMANDS", "joined_by"]


def joined_by(session: Session, operator: str, left: Value, right: Value) -> Value:
    """Return ``left operator right`` for union, minus, intersect and subset; lists keep their order."""
    a, b = (_items(session, operator, each) for each in (left, right))
    ordered = isinstance(session.resolve(left), Listed)
    if operator == "union":
        return Listed((*a, *b)) if ordered else set_of([*a, *b])
    if operator == "subset":
        return Boolean(all(_inside(session, each, b) for each in a))
    keeps = operator == "intersect"
    items = [each for each in a if _inside(session, each, b) is keeps]
    return Listed(tuple(items)) if ordered else set_of(items)


def _inside(session: Session, item: Value, items: tuple[Value, ...]) -> bool:
    return any(equal(session, item, each) for each in items)


def _items(session: Session, operator: str, value: Value) -> tuple[Value, ...]:
    found = session.resolve(value)
    if isinstance(found, MapleSet | Listed | Sequence):
        return found.items
    if isinstance(found, Array):
        return tuple(session.current(each) for each in found.entries)
    raise WorksheetError(f"{operator}: {session.text(value)[:60]} is neither a set nor a list")


def _command(operator: str) -> Command:
    def command(session: Session, *values: Value) -> Value:
        if not values:
            return MapleSet(())
        total = values[0]
        for value in values[1:]:
            total = joined_by(session, operator, total, value)
        return total

    return command


def _arithmetic(operator: str, neutral: int) -> Command:
    def command(session: Session, *values: Value) -> Value:
        if len(values) == 1 and operator == "-":
            return binary(session, "*", number(-1), values[0])
        total = values[0] if values else number(neutral)
        for value in values[1:]:
            total = binary(session, operator, total, value)
        return total

    return command


def _relation(operator: str) -> Command:
    def command(session: Session, left: Value, right: Value) -> Value:
        return Relation(operator, left, right)

    return command


COMMANDS: dict[str, Command] = {
    **{name: _command(name) for name in ("union", "minus", "intersect")},
    **{
        name: _arithmetic(name, neutral)
        for name, neutral in (("+", 0), ("-", 0), ("*", 1), ("/", 1), ("^", 1), (".", 1))
    },
    **{name: _relation(name) for name in ("=", "<>", "<", "<=")},
    ">": lambda session, left, right: Relation("<", right, left),
    ">=": lambda session, left, right: Relation("<=", right, left),
    "..": lambda session, start, stop: Range(start, stop),
    "[]": lambda session, *items: Listed(items),
    "{}": lambda session, *items: set_of(items),
}
"""Operators as functions: `+`(a, b)."""
