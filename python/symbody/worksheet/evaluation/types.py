"""The types of Maple that procedures and ``type`` ask for, and those that MBSymba registers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, t
from symbody.worksheet.evaluation.structured_types import STRUCTURED, is_polynomial_of
from symbody.worksheet.values.complex_number import as_complex
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
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["UnknownTypeError", "has_type"]

Check = Callable[[Value], bool]


def _number(check: Callable[[Expr], bool]) -> Check:
    return lambda value: isinstance(value, Expr) and value.is_number and check(value)


def _whole(check: Callable[[int], bool]) -> Check:
    """Return the check of whole numbers that are no decimals."""
    return lambda value: (
        isinstance(value, Expr)
        and value.is_number
        and value.ratio[1] == 1
        and not value.is_decimal
        and check(value.ratio[0])
    )


def _node(*kinds: str) -> Check:
    return lambda value: isinstance(value, Expr) and tree_of(value).kind in kinds


def _is_name(value: Value) -> bool:
    """Whether a value is a name; Pi is one, and I is none."""
    return isinstance(value, Reference) or (
        isinstance(value, Expr) and value.kind in ("symbol", "constant") and getattr(value, "name", "") != "I"
    )


def _array(*kinds: str) -> Check:
    return lambda value: isinstance(value, Array) and value.kind in kinds


def _call_of(*names: str) -> Check:
    """Return the check of calls of some functions."""
    return lambda value: (
        isinstance(value, Expr) and tree_of(value).kind == "function" and tree_of(value).name in names
    )


def _structured(name: str) -> Check:
    """Return the check of a structured type without arguments, that of polynomials in all names."""
    return lambda value: isinstance(value, Expr) and is_polynomial_of(value, name)


def _relation(*operators: str) -> Check:
    return lambda value: isinstance(value, Relation) and value.operator in operators


def _root(*halves: int) -> Check:
    """Return the check of powers to a fraction, of one half for square roots."""

    def check(value: Value) -> bool:
        tree = tree_of(value) if isinstance(value, Expr) else None
        if tree is None or tree.kind != "power" or not tree.parts[1].value.is_number:
            return False
        below = tree.parts[1].value.ratio[1]
        return below != 1 and (not halves or below in halves)

    return check


_TRIG = ("sin", "cos", "tan", "sec", "csc", "cot")


_CHECKS: dict[str, Check] = {
    "anything": lambda value: True,
    "algebraic": lambda value: isinstance(value, Expr | Unevaluated),
    "scalar": lambda value: isinstance(value, Expr),
    "integer": _whole(lambda n: True),
    "posint": _whole(lambda n: n > 0),
    "nonnegint": _whole(lambda n: n >= 0),
    "negint": _whole(lambda n: n < 0),
    "even": _whole(lambda n: n % 2 == 0),
    "odd": _whole(lambda n: n % 2 == 1),
    "fraction": _number(lambda value: value.ratio[1] != 1 and not value.is_decimal),
    "rational": _number(lambda value: not value.is_decimal),
    "float": _number(lambda value: value.is_decimal),
    "numeric": _number(lambda value: True),
    "realcons": lambda value: isinstance(value, Expr) and value.is_constant,
    "constant": lambda value: isinstance(value, Expr) and value.is_constant,
    "positive": _number(lambda value: value.ratio[0] > 0),
    "negative": _number(lambda value: value.ratio[0] < 0),
    "nonnegative": _number(lambda value: value.ratio[0] >= 0),
    "nonposint": _whole(lambda n: n <= 0),
    "complex": lambda value: isinstance(value, Expr) and as_complex(value) is not None,
    "complexcons": lambda value: isinstance(value, Expr) and as_complex(value) is not None,
    "nonreal": lambda value: isinstance(value, Expr) and bool((as_complex(value) or 0j).imag),
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
    "**": _node("power"),
    "trig": _call_of(*_TRIG),
    "arctrig": _call_of(*(f"arc{name}" for name in _TRIG)),
    "radical": _root(),
    "sqrt": _root(2),
    **{name: _structured(name) for name in ("polynom", "linear", "quadratic", "cubic")},
    **{operator: _relation(operator) for operator in ("<", "<=", "<>", "::")},
    "atomic": lambda value: isinstance(value, Expr | String) and not getattr(value, "args", ()),
    "uneval": lambda value: True,
    "evaln": lambda value: True,
    "exprseq": lambda value: isinstance(value, Sequence),
    "indexable": lambda value: isinstance(value, Listed | MapleSet | Table | Array),
    "last_name_eval": lambda value: isinstance(value, Table | ProcedureValue),
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


class UnknownTypeError(WorksheetError):
    """Nobody knows a type."""


def has_type(session: Session, value: Value, kind: Value) -> bool:
    """Return whether a value is of a type.

    Raises:
        UnknownTypeError: nobody knows the type.
    """
    if isinstance(kind, MapleSet):
        return any(has_type(session, value, each) for each in kind.items)
    if isinstance(kind, Listed | Relation | Range):
        return _has_parts(session, session.resolve(value), kind)
    if isinstance(kind, Expr) and kind.kind == "power":
        return STRUCTURED["^"](session, session.resolve(value), kind.args, has_type)
    arguments: tuple[Value, ...] = ()
    if isinstance(kind, Unevaluated):
        name, arguments = getattr(kind.function, "name", ""), kind.arguments
    elif isinstance(kind, Expr) and kind.kind in ("application", "time_function"):
        name, arguments = kind.name, kind.args or (t,)
    elif hasattr(kind, "name"):
        name = kind.name
    else:
        return value == kind
    return _has_named_type(session, value, name, arguments)


def _has_parts(session: Session, found: Value, kind: Listed | Relation | Range) -> bool:
    """Whether a value is a list, an equation or a range whose parts are of the types at their places."""
    if isinstance(kind, Relation) and not (isinstance(found, Relation) and found.operator == kind.operator):
        return False
    if type(found) is not type(kind):
        return False
    parts, kinds = _parts(found), _parts(kind)
    return len(parts) == len(kinds) and all(
        has_type(session, part, each) for part, each in zip(parts, kinds, strict=True)
    )


def _parts(value: Value) -> tuple[Value, ...]:
    if isinstance(value, Listed):
        return value.items
    if isinstance(value, Relation):
        return value.left, value.right
    assert isinstance(value, Range)
    return value.start, value.stop


def _has_named_type(session: Session, value: Value, name: str, arguments: tuple[Value, ...]) -> bool:
    found = value if name in _UNRESOLVED else session.resolve(value)
    if name in _OBJECTS:
        tag = found.entries.get((symbol("obj"),)) if isinstance(found, Table) else None
        return tag == symbol(name)
    if arguments and name in STRUCTURED:
        return STRUCTURED[name](session, found, arguments, has_type)
    check = _CHECKS.get(name)
    if check is not None:
        return check(found)
    own = session.resolve(symbol(f"type/{name}"))
    if isinstance(own, ProcedureValue):
        answer = session.current(session.call(own, (value, *arguments)))
        return isinstance(answer, Boolean) and bool(answer.truth)
    raise UnknownTypeError(
        f"type: {name} is not a type that is known here; expected one of Maple's, such as name, or one of the "
        f"sheet's own, `type/{name}` := e -> .."
    )
