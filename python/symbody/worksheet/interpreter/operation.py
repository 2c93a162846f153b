"""Operators: of arithmetic, relations, sets and logic, also on each entry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeAlias

from symbody.worksheet import builtins
from symbody.worksheet.builtins.sets import joined_by
from symbody.worksheet.evaluation import arithmetic
from symbody.worksheet.evaluation.assumptions import positive_names, under
from symbody.worksheet.evaluation.condition import can_not_be_decided, compared, truth
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
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
_SETS = {"union", "minus", "intersect", "subset"}


def _prefix(session: Session, node: syntax.Prefix) -> Value:
    value = session.evaluate(node.operand)
    if node.operator == "-":
        return arithmetic.negated(session, value)
    if node.operator == "not":
        found = _decided(session, value)
        if isinstance(found, Relation):
            return Relation(_OPPOSITES[found.operator], found.right, found.left)
        return Boolean(None if found is None else not found)
    if node.operator == "$":
        return builtins.repeated(session, value)
    return value


def _postfix(session: Session, node: syntax.Postfix) -> Value:
    value = session.evaluate(node.operand)
    if node.operator == "!":
        return session.call(symbol("factorial"), (value,))
    array = session.resolve(value)
    if isinstance(array, Array):
        return arithmetic.transposed(array)
    return value


_Decision: TypeAlias = bool | Relation | None
"""Whether a condition holds; None for FAIL, and the relation itself where that can't be told."""

#: What holds, with the sides exchanged, where a relation doesn't.
_OPPOSITES = {"<": "<=", "<=": "<"}


def _infix(session: Session, node: syntax.Infix) -> Value:
    operator = node.operator
    if node.elementwise:
        return _entrywise(session, operator, session.evaluate(node.left), session.evaluate(node.right))
    if operator in ("and", "or", "xor", "implies"):
        return _logical(session, node)
    if operator == "$":
        return builtins.dollar(session, node.left, node.right)
    if operator in _FOLDED:
        return _folded(session, node)
    left = session.evaluate(node.left)
    if operator == "assuming":
        conditions = session.evaluated((node.right,))
        return under(left, positive_names(session, "assuming", conditions))
    return _operated(session, operator, left, session.evaluate(node.right))


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
    if operator == "mod":
        return session.call(symbol("modp"), (left, right))
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


def _logical(session: Session, node: syntax.Infix) -> Value:
    """Return what an operator of logic gives; what can't be decided stays in it."""
    left = _decided(session, session.evaluate(node.left))
    if node.operator == "and" and left is False:
        return Boolean(truth=False)
    if node.operator == "or" and left is True:
        return Boolean(truth=True)
    right = _decided(session, session.evaluate(node.right))
    if isinstance(left, Relation) or isinstance(right, Relation):
        return _undecided(node.operator, left, right)
    if left is None or right is None:
        return Boolean(None)
    results = {
        "and": left and right,
        "or": left or right,
        "xor": left != right,
        "implies": not left or right,
    }
    return Boolean(results[node.operator])


def _decided(session: Session, value: Value) -> _Decision:
    """Return whether a condition holds; a relation of which that can't be told comes back."""
    if isinstance(value, Relation) and value.operator in _OPPOSITES:
        return value if can_not_be_decided(session, value) else truth(session, value)
    return truth(session, value)


def _undecided(operator: str, left: _Decision, right: _Decision) -> Value:
    """Return ``true and c`` and ``false or c`` as c, and other conditions as they stand."""
    neutral = {"and": True, "or": False}.get(operator)
    if isinstance(right, Relation) and left is neutral is not None:
        return right
    if isinstance(left, Relation) and right is neutral is not None:
        return left
    sides = (each if isinstance(each, Relation) else Boolean(each) for each in (left, right))
    return Unevaluated(symbol(operator), tuple(sides))


def _entrywise(session: Session, operator: str, left: Value, right: Value) -> Value:
    a, b = session.resolve(left), session.resolve(right)
    for side in (a, b):
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
