"""Whether a condition holds for all operands, or for one of them."""

from __future__ import annotations

from symbody.worksheet.builtins.structural import operands
from symbody.worksheet.evaluation.condition import truth
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.value import Boolean, Value

__all__ = ["COMMANDS"]


def for_all(session: Session, condition: Value, value: Value, *rest: Value) -> Value:
    """andmap(f, e, ..): whether f is true for all operands of e."""
    parts = operands(session, session.resolve(value))
    return Boolean(all(truth(session, session.call(condition, (each, *rest))) is True for each in parts))


def for_one(session: Session, condition: Value, value: Value, *rest: Value) -> Value:
    """ormap(f, e, ..): whether f is true for one of the operands of e."""
    parts = operands(session, session.resolve(value))
    return Boolean(any(truth(session, session.call(condition, (each, *rest))) is True for each in parts))


COMMANDS: dict[str, Command] = {"andmap": for_all, "ormap": for_one}
