"""Operators: of arithmetic, relations, sets and logic, also on each entry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from symbody.worksheet import builtins
from symbody.worksheet.builtins.matrices import hermitian_transpose
from symbody.worksheet.builtins.sets import joined_by
from symbody.worksheet.evaluation import arithmetic
from symbody.worksheet.evaluation.assumptions import positive_names, under
from symbody.worksheet.evaluation.condition import compared
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.logic import joined, negation
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.logic_words import LOGIC
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Range,
    Relation,
    Sequence,
    Unevaluated,
    Value,
)

__all__ = ["METHODS"]

_RELATIONS = {"=", "<>", "<", "<=", "::"}
_TURNED = {">": "<", ">=": "<="}
_ARITHMETIC = {"+", "-", "*", "/", "^", ".", "&*"}
_FOLDED = {"+", "-", "*"}
_FUNCTIONS = {"mod": "modp"}
_SETS = {"union", "minus", "intersect", "subset"}


def _prefix(session: Session, node: syntax.Prefix) -> Value:
    value = session.evaluate(node.operand)
    if node.operator == "-":
        return arithmetic.negated(session, value)
    if node.operator == "not":
        return negation(session, value)
    if node.operator == "$":
        return builtins.repeated(session, value)
    return value


def _postfix(session: Session, node: syntax.Postfix) -> Value:
    value = session.evaluate(node.operand)
    if node.operator == "!":
        return session.call(symbol("factorial"), (value,))
    if node.operator.endswith("H"):
        return hermitian_transpose(session, value)
    array = session.resolve(value)
    return arithmetic.transposed(array) if isinstance(array, Array) else value


def _infix(session: Session, node: syntax.Infix) -> Value:
    operator = node.operator
    if node.elementwise:
        return _entrywise(session, operator, session.evaluate(node.left), session.evaluate(node.right))
    if operator in LOGIC:
        return joined(session, operator, session.evaluate(node.left), lambda: session.evaluate(node.right))
    if operator == "$":
        return builtins.dollar(session, node.left, node.right)
    if operator in _FOLDED:
        return _folded(session, node)
    if operator == "assuming":
        return _assuming(session, node)
    return _operated(session, operator, session.evaluate(node.left), session.evaluate(node.right))


def _assuming(session: Session, node: syntax.Infix) -> Value:
    """Return the value of an expression while some names count as positive."""
    names = positive_names(session, "assuming", session.evaluated((node.right,)))
    held = session.options.positive
    session.options.positive = held | names
    try:
        return under(session.evaluate(node.left), names)
    finally:
        session.options.positive = held


def _operated(session: Session, operator: str, left: Value, right: Value) -> Value:
    """Return the value of an operator between two values."""
    if operator in _ARITHMETIC:
        return arithmetic.binary(session, operator, left, right)
    if operator in _TURNED:
        return Relation(_TURNED[operator], right, left)
    if operator in _RELATIONS:
        return Relation(operator, left, right)
    if operator == "..":
        return Range(left, right)
    if operator in _SETS:
        return joined_by(session, operator, left, right)
    if operator == "in":
        return compared(session, Relation("in", left, right))
    if operator == "mod" or operator.startswith("&"):
        return session.call(symbol(_FUNCTIONS.get(operator, operator)), (left, right))
    return Unevaluated(symbol(operator), (left, right))  # @ and @@


def _folded(session: Session, node: syntax.Infix) -> Value:
    """Return a sum or a product from left to right, however many terms it has."""
    chain: list[syntax.Infix] = []
    first: syntax.Expression = node
    while isinstance(first, syntax.Infix) and first.operator in _FOLDED and not first.elementwise:
        chain.append(first)
        first = first.left
    total = session.evaluate(first)
    for each in reversed(chain):
        total = _operated(session, each.operator, total, session.evaluate(each.right))
    return total


def _entrywise(session: Session, operator: str, left: Value, right: Value) -> Value:
    a, b = session.resolve(left), session.resolve(right)
    for side in (a, b):
        if isinstance(side, MapleSet):
            return set_of(
                _operated(session, operator, item, b) if side is a else _operated(session, operator, a, item)
                for item in side.items
            )
        if isinstance(side, Listed | Array):
            count = len(side.items if isinstance(side, Listed) else side.entries)
            pairs = zip(_repeated(a, count), _repeated(b, count), strict=True)
            entries = [_operated(session, operator, x, y) for x, y in pairs]
            if isinstance(side, Listed):
                return Listed(tuple(entries))
            return replace(side, entries=entries, attributes=(), frame=None)
    return _operated(session, operator, left, right)


def _repeated(value: Value, count: int) -> list[Value]:
    if isinstance(value, Listed | Sequence):
        return list(value.items)
    if isinstance(value, Array):
        return list(value.entries)
    return [value] * count


def _elementwise(session: Session, node: syntax.Elementwise) -> Value:
    return Unevaluated(symbol("~"), (session.evaluate(node.function),))


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Prefix: _prefix,
    syntax.Postfix: _postfix,
    syntax.Infix: _infix,
    syntax.Elementwise: _elementwise,
}
