"""Operators of logic as functions: ``map(`not`, L)``; what they are again when names in them have values."""

from __future__ import annotations

from symbody.worksheet.evaluation.logic import joined, negation
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.value import Value

__all__ = ["COMMANDS"]


def _joint(operator: str) -> Command:
    def command(session: Session, left: Value, right: Value) -> Value:
        return joined(session, operator, left, lambda: right)

    return command


COMMANDS: dict[str, Command] = {
    "not": negation,
    **{operator: _joint(operator) for operator in ("and", "or", "xor", "implies")},
}
