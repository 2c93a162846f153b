"""The command assign: solutions as values of their names."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.select import assigned_entry
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    MapleSet,
    Relation,
    Sequence,
    Table,
    Value,
)

__all__ = ["COMMANDS"]


def assign(session: Session, *solutions: Value) -> Value:
    """assign(solution): each name on the left gets the value on the right."""
    if len(solutions) == 2 and isinstance(solutions[0], Expr):
        solutions = (Relation("=", solutions[0], solutions[1]),)
    for solution in solutions:
        found = session.resolve(solution)
        items = found.items if isinstance(found, Listed | MapleSet | Sequence) else (found,)
        for item in items:
            if isinstance(item, Listed | MapleSet):
                assign(session, item)
            elif isinstance(item, Relation):
                _assign_one(session, scalar(session, item.left), item.right)
            else:
                raise WorksheetError(f"assign: {session.text(item)[:60]}; expected equations, such as x = 2")
    return NULL


def _assign_entry(session: Session, base: str, indices: tuple[Value, ...], right: Value) -> None:
    """Give an entry of a table or a matrix a value; a name without value becomes a table."""
    holder = session.holder(base)
    if not isinstance(holder, Table | Array):
        _assign_one(session, symbol(base), Table({indices: right}))
        return
    assigned_entry(session, holder, indices, right)
    session.touch_entry(base)


def _assign_one(session: Session, left: Expr, right: Value) -> None:
    if left.kind == "symbol" and left.name in session.indexed:
        _assign_entry(session, *session.indexed[left.name], right)
    elif left.kind == "symbol":
        session.give(left.name, right)
    elif left.kind in ("time_function", "application") and not (left.kind == "time_function" and left.order):
        arguments = left.args or (symbol("t"),)
        session.remember(left.name, tuple(arguments), right)
    else:
        raise WorksheetError(
            f"assign: {session.text(left)[:60]} can't be assigned; expected a name or a function"
        )


COMMANDS: dict[str, Command] = {"assign": assign}
