"""Types of Maple that take arguments: ``specfunc(diff)``, ``Or(name, function)``, ``polynom(anything, x)``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from symbody.symbolic import Expr
from symbody.worksheet.mathematics.polynomial import degree
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import Tree, leaves, tree_of, walk
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
    MapleSet,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["STRUCTURED", "is_polynomial_of"]

HasType = Callable[["Session", Value, Value], bool]
"""Whether a value is of a type: what a structured type asks about the parts."""

Structured = Callable[["Session", Value, tuple[Value, ...], HasType], bool]


def _any_of(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
    return any(has_type(session, value, each) for each in kinds)


def _all_of(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
    return all(has_type(session, value, each) for each in kinds)


def _none_of(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
    return not _any_of(session, value, kinds, has_type)


def _identical(session: Session, value: Value, others: tuple[Value, ...], has_type: HasType) -> bool:
    return any(value == each for each in others)


def _call_of(value: Value) -> tuple[str, tuple[Value, ...]] | None:
    """Return the name and the arguments of an unevaluated call; None for anything else."""
    if isinstance(value, Unevaluated):
        return getattr(value.function, "name", ""), value.arguments
    tree = tree_of(value) if isinstance(value, Expr) else None
    if tree is None or tree.kind not in ("function", "derivative"):
        return None
    return (
        "diff" if tree.kind == "derivative" else tree.name,
        tuple(part.value for part in tree.parts),
    )


def _call_of_names(session: Session, value: Value, arguments: tuple[Value, ...], has_type: HasType) -> bool:
    """specfunc(f), specfunc(t, f), f also a set of names: calls of f, with arguments of type t."""
    call = _call_of(value)
    if call is None or not arguments:
        return False
    names = arguments[-1].items if isinstance(arguments[-1], MapleSet) else arguments[-1:]
    if call[0] not in {_name_of(each) for each in names}:
        return False
    return all(has_type(session, part, kind) for kind in arguments[:-1] for part in call[1])


def _name_of(value: Value) -> str:
    return str(getattr(value, "name", ""))


def _call_with(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
    """anyfunc(t, u): calls with as many arguments, of these types."""
    call = _call_of(value)
    return (
        call is not None
        and len(call[1]) == len(kinds)
        and all(has_type(session, part, kind) for part, kind in zip(call[1], kinds, strict=True))
    )


def _call_of_parts(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
    """function(t): calls whose arguments are of a type."""
    call = _call_of(value)
    return call is not None and all(_all_of(session, part, kinds, has_type) for part in call[1])


def _items_of(value: Value) -> tuple[Value, ...]:
    return value.items if isinstance(value, Listed | MapleSet) else ()


def _sequence_of(kind: type[Listed | MapleSet]) -> Structured:
    def check(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
        return isinstance(value, kind) and all(
            _all_of(session, item, kinds, has_type) for item in _items_of(value)
        )

    return check


def _terms(kind: str) -> Structured:
    """Return the type of sums or products all of whose operands are of a type."""

    def check(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
        tree = tree_of(value) if isinstance(value, Expr) else None
        if tree is None or tree.kind != kind:
            return False
        return all(_all_of(session, part.value, kinds, has_type) for part in tree.parts)

    return check


def _power(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
    """Check ``t^u``, as it reaches us: the kinds of the base and of the exponent."""
    tree = tree_of(value) if isinstance(value, Expr) else None
    return (
        tree is not None
        and tree.kind == "power"
        and all(has_type(session, part.value, kind) for part, kind in zip(tree.parts, kinds, strict=False))
    )


def _array(*names: str) -> Structured:
    """Return the type of arrays that are square, or all of whose entries are of a type."""

    def check(session: Session, value: Value, kinds: tuple[Value, ...], has_type: HasType) -> bool:
        if not isinstance(value, Array) or value.kind not in names:
            return False
        square = value.rows == value.columns
        return all(
            square if _name_of(kind) == "square" else _all_of(session, entry, (kind,), has_type)
            for kind in kinds
            for entry in value.entries
        )

    return check


def _variables(value: Value) -> list[Expr]:
    items = value.items if isinstance(value, Listed | MapleSet) else (value,)
    return [each for each in items if isinstance(each, Expr)]


_DEGREES = {"linear": 1, "quadratic": 2, "cubic": 3}


def is_polynomial_of(value: Expr, kind: str, variables: list[Expr] | None = None) -> bool:
    """Whether an expression is a polynomial in variables, or in all its names; of a degree if the type tells one."""
    names = variables or [each for each in leaves(value) if not each.is_number]
    if not all(_is_polynomial(tree_of(value), name) for name in names):
        return False
    expected = _DEGREES.get(kind)
    return expected is None or max((degree(value, name) for name in names), default=0) == expected


def _polynomial(kind: str) -> Structured:
    """Return the type polynom(t, x), or linear(x), quadratic(x): of this degree."""

    def check(session: Session, value: Value, arguments: tuple[Value, ...], has_type: HasType) -> bool:
        given = arguments[-1:] if kind in _DEGREES else arguments[1:]
        variables = _variables(given[0]) if given else None
        return isinstance(value, Expr) and is_polynomial_of(value, kind, variables)

    return check


def _is_polynomial(tree: Tree, variable: Expr) -> bool:
    """Whether a variable occurs in sums, products and whole powers only."""
    if tree.value == variable or not tree.value.has(variable):
        return True
    if tree.kind == "power":
        whole = tree.parts[1].value
        return (
            whole.is_number
            and whole.ratio[1] == 1
            and whole.ratio[0] > 0
            and _is_polynomial(tree.parts[0], variable)
        )
    return tree.kind in ("sum", "product") and all(_is_polynomial(part, variable) for part in tree.parts)


def _free_of(session: Session, value: Value, others: tuple[Value, ...], has_type: HasType) -> bool:
    if not isinstance(value, Expr):
        return False
    nodes = {node.value for node in walk(tree_of(value))}
    return nodes.isdisjoint(each for other in others for each in _variables(other))


def _depends(session: Session, value: Value, others: tuple[Value, ...], has_type: HasType) -> bool:
    return not _free_of(session, value, others, has_type)


def _satisfies(session: Session, value: Value, arguments: tuple[Value, ...], has_type: HasType) -> bool:
    answer = session.call(symbol("evalb"), (session.call(arguments[0], (value,)),))
    found = session.current(answer)
    return isinstance(found, Boolean) and bool(found.truth)


_VECTORS = ("Vector", "RowVector")

STRUCTURED: dict[str, Structured] = {
    "Or": _any_of,
    "And": _all_of,
    "Not": _none_of,
    "identical": _identical,
    "specfunc": _call_of_names,
    "typefunc": _call_of_names,
    "anyfunc": _call_with,
    "function": _call_of_parts,
    "list": _sequence_of(Listed),
    "set": _sequence_of(MapleSet),
    "+": _terms("sum"),
    "*": _terms("product"),
    "^": _power,
    "Matrix": _array("Matrix"),
    "Vector": _array(*_VECTORS),
    "matrix": _array("matrix", "Matrix"),
    **{name: _polynomial(name) for name in ("polynom", *_DEGREES)},
    "freeof": _free_of,
    "dependent": _depends,
    "satisfies": _satisfies,
}
"""Types by name: whether a value fulfils them with their arguments."""
