"""Assumptions: which names are positive."""

from __future__ import annotations

from symbody.worksheet.evaluation.assumptions import positive_names
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.value import NULL, Value

__all__ = ["COMMANDS"]


def assume(session: Session, *conditions: Value) -> Value:
    """assume(m > 0, ..): m counts as positive until it is unassigned."""
    session.options.positive |= positive_names(session, "assume", conditions)
    return NULL


COMMANDS: dict[str, Command] = {"assume": assume, "additionally": assume}
