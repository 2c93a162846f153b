"""Leaves of expressions: numbers, names, texts, and the last values."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symbody.errors import WorksheetError
from symbody.symbolic import number
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import NULL, String, Value

__all__ = ["METHODS", "named"]


def _decimal(session: Session, node: syntax.Decimal) -> Value:
    text = node.text
    mantissa, _, exponent = text.lower().partition("e")
    if len(exponent.lstrip("+-")) > 4:
        raise WorksheetError(f"the number {text} is out of range")
    value = number((mantissa if mantissa.strip(".") else "0") + (f"e{exponent}" if exponent else ""))
    figures = len(mantissa.replace(".", "").lstrip("0"))
    if value.is_decimal and figures > session.options.digits:
        session.options.precise[value] = figures
    return value if value.is_decimal else number(float(text)) if "." in text or exponent else value


#: The names that have a value in each call of a procedure.
OF_CALLS = frozenset({"args", "nargs", "procname"})


def _name(session: Session, node: syntax.Name) -> Value:
    return named(session, node.name)


def named(session: Session, name: str) -> Value:
    """Return what a name stands for, also those that Maple gives a meaning: args, Digits."""
    if name in OF_CALLS and session.scopes:
        scope = session.scopes[-1]
        if name == "procname":
            return symbol(scope.name)
        return sequence(scope.arguments) if name == "args" else number(len(scope.arguments))
    if name == "Digits" and name not in session.names:
        return number(session.options.digits)
    return session.value(name)


def _ditto(session: Session, node: syntax.Ditto) -> Value:
    lasts = session.lasts
    if len(lasts) < node.level:
        return NULL
    return session.current(lasts[node.level - 1])


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Integer: lambda session, node: number(node.value),
    syntax.Decimal: _decimal,
    syntax.Name: _name,
    syntax.Text: lambda session, node: String(node.text),
    syntax.Ditto: _ditto,
}
