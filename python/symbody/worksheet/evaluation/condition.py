"""Conditions: equality by value, of lists and matrices entry by entry."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.assumptions import is_positive
from symbody.worksheet.evaluation.types import has_type
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
    MapleSet,
    Reference,
    Relation,
    Sequence,
    Table,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["can_not_be_decided", "compared", "equal", "is_type", "truth"]


def truth(session: Session, value: Value) -> bool | None:
    """Return whether a condition holds; None for what Maple calls FAIL."""
    if isinstance(value, Boolean):
        return value.truth
    if isinstance(value, Relation):
        return compared(session, value).truth
    raise WorksheetError(f"{session.text(value)[:60]} is not a condition; expected true, false or a relation")


def compared(session: Session, relation: Relation) -> Boolean:
    """Return whether a relation holds."""
    left, right = session.current(relation.left), session.current(relation.right)
    if relation.operator == "=":
        return Boolean(equal(session, left, right))
    if relation.operator == "<>":
        return Boolean(not equal(session, left, right))
    if relation.operator == "in":
        items = right.items if isinstance(right, Listed | MapleSet | Sequence) else ()
        return Boolean(any(equal(session, left, item) for item in items))
    if relation.operator == "::":
        return Boolean(is_type(session, left, right))
    found = _is_less(session, left, right, or_equal=relation.operator == "<=")
    if found is None:
        raise WorksheetError(
            f"cannot determine if this expression is true or false: {session.text(relation)[:80]}"
        )
    return Boolean(found)


def can_not_be_decided(session: Session, relation: Relation) -> bool:
    """Whether an inequality holds for some values of its names, and not for others, as far as is known."""
    left, right = session.current(relation.left), session.current(relation.right)
    return _is_less(session, left, right, or_equal=relation.operator == "<=") is None


def _is_less(session: Session, left: Value, right: Value, *, or_equal: bool) -> bool | None:
    if not isinstance(left, Expr) or not isinstance(right, Expr):
        return None
    a, b = as_float(left), as_float(right)
    if a is None or b is None:
        return is_positive(right - left, session.options.positive)
    return a <= b if or_equal else a < b


def equal(session: Session, left: Value, right: Value) -> bool:
    """Return whether two values are equal by value."""
    if left is right or left == right:
        return True
    a, b = session.resolve(left), session.resolve(right)
    if isinstance(a, Array) and isinstance(b, Array | Expr):
        return _equal_arrays(session, a, b)
    if isinstance(a, Listed | Sequence) and type(a) is type(b):
        return len(a.items) == len(b.items) and all(
            equal(session, x, y) for x, y in zip(a.items, b.items, strict=True)
        )
    if isinstance(a, Relation) and isinstance(b, Relation):
        return (
            a.operator == b.operator and equal(session, a.left, b.left) and equal(session, a.right, b.right)
        )
    if isinstance(left, Reference | Expr) and isinstance(right, Reference | Expr):
        return _name(left) == _name(right) != ""
    if isinstance(a, Table) or isinstance(b, Table):
        return a is b
    return a == b and type(a) is type(b)


def _name(value: Reference | Expr) -> str:
    return str(value.name) if isinstance(value, Reference) or value.kind == "symbol" else ""


def _equal_arrays(session: Session, a: Array, b: Array | Expr) -> bool:
    """Compare two matrices, or a matrix and zero."""
    entries = [session.current(each) for each in a.entries]
    if isinstance(b, Expr):
        return b.is_zero and all(equal(session, each, b) for each in entries)
    return (a.rows, a.columns) == (b.rows, b.columns) and all(
        equal(session, x, session.current(y)) for x, y in zip(entries, b.entries, strict=True)
    )


def is_type(session: Session, value: Value, kind: Value) -> bool:
    """Return whether a value is of a type."""
    return has_type(session, value, kind)
