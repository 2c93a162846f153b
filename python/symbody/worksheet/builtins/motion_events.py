"""Events of ``dsolve(.., numeric, events = [[trigger, action], ..])``: what ends a motion, or begins another one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.value import Listed, MapleSet, Relation, Unevaluated, Value

__all__ = ["Rule", "rules_of"]

Internal = Callable[[Expr], Expr]
"""Returns an expression of the sheet in the variables of the equations."""


@dataclass(frozen=True, slots=True)
class Rule:
    """An event.

    Attributes:
        trigger: the expression whose zeros are events.
        conditions: what must be positive there.
        resets: states with their values after the event, one after the other.
        is_end: whether the motion ends there.
    """

    trigger: Expr
    conditions: tuple[Expr, ...]
    resets: tuple[tuple[Expr, Expr], ...]
    is_end: bool


def rules_of(session: Session, value: Value, internal: Internal) -> tuple[Rule, ...]:
    """Return the events of an option, ``[[x(t) = 0, halt], [[y(t), diff(y(t),t) < 0], diff(y(t),t) = -v]]``."""
    return tuple(_rule(session, session.current(each), internal) for each in _items(session, value))


def _items(session: Session, value: Value) -> tuple[Value, ...]:
    found = session.current(session.resolve(value))
    if not isinstance(found, Listed | MapleSet):
        raise WorksheetError(
            f"dsolve, events: {session.text(found)[:60]}; expected a list such as [[x(t) = 0, halt]]"
        )
    return found.items


def _rule(session: Session, value: Value, internal: Internal) -> Rule:
    parts = [session.current(each) for each in _items(session, value)]
    if len(parts) != 2:
        raise WorksheetError(
            f"dsolve, events: {session.text(value)[:60]}; expected [trigger, action], such as [x(t) = 0, halt]"
        )
    trigger, action = parts
    first, *conditions = _items(session, trigger) if isinstance(trigger, Listed) else (trigger,)
    is_end = isinstance(action, Expr) and str(action) == "halt"
    resets = () if is_end or str(action) == "none" else _resets(session, action, internal)
    distances = tuple(internal(each) for one in conditions for each in _distances(session, one))
    return Rule(internal(_zero(session, first)), distances, resets, is_end)


def _zero(session: Session, trigger: Value) -> Expr:
    """Return the expression that is zero at an event."""
    found = session.current(trigger)
    sides = (found.left, found.right) if isinstance(found, Relation) and found.operator == "=" else (found,)
    values = [session.current(each) for each in sides]
    one, other = (values[0], values[-1])
    if not isinstance(one, Expr) or not isinstance(other, Expr):
        raise WorksheetError(
            f"dsolve, events: the trigger {session.text(found)[:60]}; expected an expression or an equation, such as "
            "x(t) = 0"
        )
    return one if len(values) == 1 else one - other


def _distances(session: Session, condition: Value) -> tuple[Expr, ...]:
    """Return what is positive where a condition holds."""
    match session.current(condition):
        case Relation("<" | "<=", left, right):
            less, more = session.current(left), session.current(right)
            if isinstance(less, Expr) and isinstance(more, Expr):
                return (more - less,)
        case Unevaluated(Expr(name="and"), (one, other)):
            return (*_distances(session, one), *_distances(session, other))
    raise WorksheetError(
        f"dsolve, events: the condition {session.text(condition)[:60]}; expected inequalities, such as "
        "diff(x(t),t) < 0, which and may join"
    )


def _resets(session: Session, action: Value, internal: Internal) -> tuple[tuple[Expr, Expr], ...]:
    equations = _items(session, action) if isinstance(action, Listed | MapleSet) else (action,)
    found = []
    for each in equations:
        equation = session.current(each)
        given = (equation.left, equation.right) if isinstance(equation, Relation) else ()
        sides = [side for side in map(session.current, given) if isinstance(side, Expr)]
        if len(sides) != 2:
            raise WorksheetError(
                f"dsolve, events: the action {session.text(equation)[:60]}; expected halt, none, or new values, such "
                "as diff(x(t),t) = -diff(x(t),t)"
            )
        found.append((internal(sides[0]), internal(sides[1])))
    return tuple(found)
