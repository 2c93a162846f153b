"""Operators of logic: what can't be decided stays in them until its names have values."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.evaluation.condition import can_not_be_decided, truth
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Boolean, Relation, Unevaluated, Value

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["decided", "joined", "negation"]

Decision: TypeAlias = bool | Relation | Expr | Unevaluated | None
"""Whether a condition holds; None for FAIL, and the condition itself where that can't be told."""

#: What holds, with the sides exchanged, where an inequality doesn't.
_OPPOSITES = {"<": "<=", "<=": "<"}

#: The side with which an operator is its other side.
_NEUTRAL = {"and": True, "or": False}


def negation(session: Session, value: Value) -> Value:
    """Return ``not c``."""
    match decided(session, value):
        case Relation(operator, left, right):
            return Relation(_OPPOSITES[operator], right, left)
        case Unevaluated(Expr(name="not"), (condition,)):
            return condition
        case bool() | None as found:
            return Boolean(None if found is None else not found)
        case condition:
            return Unevaluated(symbol("not"), (condition,))


def joined(session: Session, operator: str, left: Value, right: Callable[[], Value]) -> Value:
    """Return what an operator of logic gives of two conditions.

    Args:
        session: the session.
        operator: and, or, xor, implies.
        left: the first condition.
        right: the value of the second one, which is not asked for where the first one decides.
    """
    a = decided(session, left)
    if isinstance(a, bool) and _NEUTRAL.get(operator) is (not a):
        return Boolean(a)
    b = decided(session, right())
    if isinstance(b, bool) and _NEUTRAL.get(operator) is (not b):
        return Boolean(b)
    if _is_open(a) or _is_open(b):
        return _undecided(operator, a, b)
    if a is None or b is None:
        return Boolean(None)
    return Boolean({"and": a and b, "or": a or b, "xor": a != b, "implies": not a or b}[operator])  # type: ignore[arg-type]


def decided(session: Session, value: Value) -> Decision:
    """Return whether a condition holds; a condition of which that can't be told comes back."""
    if isinstance(value, Relation) and value.operator in _OPPOSITES:
        return value if can_not_be_decided(session, value) else truth(session, value)
    if isinstance(value, Expr) and value.kind in {"symbol", "time_function", "application"}:
        return value
    if isinstance(value, Unevaluated):
        return value
    return truth(session, value)


def _is_open(side: Decision) -> bool:
    return not (side is None or isinstance(side, bool))


def _undecided(operator: str, left: Decision, right: Decision) -> Value:
    """Return ``true and c`` and ``false or c`` as c, and other conditions as they stand."""
    neutral = _NEUTRAL.get(operator)
    sides = tuple(Boolean(each) if each is None or isinstance(each, bool) else each for each in (left, right))
    if left is neutral is not None:
        return sides[1]
    if right is neutral is not None or (operator in _NEUTRAL and left == right):
        return sides[0]
    return Unevaluated(symbol(operator), sides)
