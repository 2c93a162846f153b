"""The types of Maple that procedures and ``type`` ask for, and those that MBSymba registers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from symbody.symbolic import Expr
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import tree_of
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
    MapleSet,
    Plot,
    ProcedureValue,
    Range,
    Reference,
    Relation,
    String,
    Table,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["has_type"]

Check = Callable[[Value], bool]


def _number(check: Callable[[Expr], bool]) -> Check:
    return lambda value: isinstance(value, Expr) and value.is_number and check(value)


def _node(*kinds: str) -> Check:
    return lambda value: isinstance(value, Expr) and tree_of(value).kind in kinds


def _is_name(value: Value) -> bool:
    return isinstance(value, Reference) or (isinstance(value, Expr) and value.kind == "symbol")


def _array(*kinds: str) -> Check:
    return lambda value: isinstance(value, Array) and value.kind in kinds


_CHECKS: dict[str, Check] = {
    "anything": lambda value: True,
    "algebraic": lambda value: isinstance(value, Expr | Unevaluated),
    "scalar": lambda value: isinstance(value, Expr),
    "integer": _number(lambda value: value.ratio[1] == 1 and not value.is_decimal),
    "posint": _number(lambda value: value.ratio[1] == 1 and value.ratio[0] > 0),
    "nonnegint": _number(lambda value: value.ratio[1] == 1 and value.ratio[0] >= 0),
    "negint": _number(lambda value: value.ratio[1] == 1 and value.ratio[0] < 0),
    "even": _number(lambda value: value.ratio[1] == 1 and value.ratio[0] % 2 == 0),
    "odd": _number(lambda value: value.ratio[1] == 1 and value.ratio[0] % 2 == 1),
    "fraction": _number(lambda value: value.ratio[1] != 1 and not value.is_decimal),
    "rational": _number(lambda value: not value.is_decimal),
    "float": _number(lambda value: value.is_decimal),
    "numeric": _number(lambda value: True),
    "realcons": lambda value: isinstance(value, Expr) and value.is_constant,
    "constant": lambda value: isinstance(value, Expr) and value.is_constant,
    "positive": _number(lambda value: value.ratio[0] > 0),
    "negative": _number(lambda value: value.ratio[0] < 0),
    "nonnegative": _number(lambda value: value.ratio[0] >= 0),
    "name": _is_name,
    "symbol": lambda value: _is_name(value) and "[" not in getattr(value, "name", ""),
    "indexed": lambda value: _is_name(value) and "[" in getattr(value, "name", ""),
    "string": lambda value: isinstance(value, String),
    "list": lambda value: isinstance(value, Listed),
    "set": lambda value: isinstance(value, MapleSet),
    "listlist": lambda value: (
        isinstance(value, Listed) and all(isinstance(each, Listed) for each in value.items)
    ),
    "equation": lambda value: isinstance(value, Relation) and value.operator == "=",
    "=": lambda value: isinstance(value, Relation) and value.operator == "=",
    "relation": lambda value: isinstance(value, Relation),
    "range": lambda value: isinstance(value, Range),
    "..": lambda value: isinstance(value, Range),
    "boolean": lambda value: isinstance(value, Boolean | Relation),
    "truefalse": lambda value: isinstance(value, Boolean),
    "table": lambda value: isinstance(value, Table),
    "procedure": lambda value: isinstance(value, ProcedureValue),
    "+": _node("sum"),
    "*": _node("product"),
    "^": _node("power"),
    "function": lambda value: isinstance(value, Unevaluated | Plot) or _node("function", "derivative")(value),
    "Matrix": _array("Matrix"),
    "Vector": _array("Vector", "RowVector"),
    "matrix": _array("matrix", "Matrix"),
    "vector": _array("vector", "Vector", "RowVector"),
    "array": _array("matrix", "vector", "array"),
    "rtable": _array("Matrix", "Vector", "RowVector"),
    "Array": _array("Matrix", "Vector", "RowVector", "Array"),
    "frame": lambda value: isinstance(value, Array) and (value.rows, value.columns) == (4, 4),
    "mframe": lambda value: isinstance(value, Array) and (value.rows, value.columns) == (4, 4),
    "OBJECT": lambda value: isinstance(value, Table) and (symbol("obj"),) in value.entries,
}

_OBJECTS = ("POINT", "VECTOR", "BODY", "FORCE", "TORQUE", "CONSTRAINT", "TIRE")
"""Types that are the field ``obj`` of a table."""

_UNRESOLVED = frozenset({"name", "symbol", "indexed", "uneval", "evaln", "anything"})


def has_type(session: Session, value: Value, kind: Value) -> bool:
    """Return whether a value is of a type; a type that isn't known counts as fulfilled."""
    if isinstance(kind, MapleSet):
        return any(has_type(session, value, each) for each in kind.items)
    if isinstance(kind, Listed):
        found = session.resolve(value)
        return (
            isinstance(found, Listed)
            and len(found.items) == len(kind.items)
            and all(has_type(session, item, each) for item, each in zip(found.items, kind.items, strict=True))
        )
    arguments: tuple[Value, ...] = ()
    if isinstance(kind, Unevaluated):
        name, arguments = getattr(kind.function, "name", ""), kind.arguments
    elif isinstance(kind, Expr) and kind.kind in ("application", "time_function"):
        name, arguments = kind.name, kind.args
    elif isinstance(kind, Expr | Reference) and hasattr(kind, "name"):
        name = kind.name
    else:
        return value == kind
    return _has_named_type(session, value, name, arguments)


def _has_named_type(session: Session, value: Value, name: str, arguments: tuple[Value, ...]) -> bool:
    found = value if name in _UNRESOLVED else session.resolve(value)
    if name in _OBJECTS:
        tag = found.entries.get((symbol("obj"),)) if isinstance(found, Table) else None
        return tag == symbol(name)
    check = _CHECKS.get(name)
    if check is None:
        return True
    if not check(found):
        return False
    if arguments and name in ("list", "set") and isinstance(found, Listed | MapleSet):
        return all(has_type(session, item, arguments[0]) for item in found.items)
    return True
