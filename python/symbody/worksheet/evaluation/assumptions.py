"""What a sheet assumes of its names: ``assume(m > 0)``, and ``e assuming m > 0``.

All names are real. Names that are positive are replaced for a moment by positive symbols, of which roots, absolute
values and signs become simpler.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Set
from math import prod
from typing import TYPE_CHECKING

from symbody.symbolic import Expr, number, sign, subs, symbols, t
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.value import Listed, MapleSet, Reference, Relation, Sequence, Value

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["is_positive", "positive_names", "under"]

_POSITIVE = frozenset({"positive", "posint"})
_KNOWN = frozenset({"real", "realcons"})
"""What holds for all names."""


def positive_names(session: Session, command: str, conditions: Iterable[Value]) -> frozenset[Expr]:
    """Return the names that conditions say to be positive; a notice tells which conditions are not used."""
    found: set[Expr] = set()
    for condition in _opened(conditions):
        name = _positive(condition)
        if name is not None:
            found |= {name} - {t}  # the time has no other symbol
        elif not _is_known(condition):
            shown = session.text(condition)[:60]
            session.notice(
                f"{command}: {shown} is not used; names count as real, or as positive if that is assumed"
            )
    return frozenset(found)


def _opened(conditions: Iterable[Value]) -> Iterator[Value]:
    """Return conditions one by one; ``m, positive`` is ``m::positive``."""
    items = [item for each in conditions for item in (each.items if isinstance(each, _LISTS) else (each,))]
    while items:
        first = items.pop(0)
        if isinstance(first, Expr) and items and not isinstance(items[0], Relation):
            first = Relation("::", first, items.pop(0))
        yield first


_LISTS = Listed | MapleSet | Sequence


def _positive(condition: Value) -> Expr | None:
    """Return the name of ``m > 0`` and of ``m::positive``."""
    match condition:
        case Relation(operator="<", left=Expr(is_zero=True), right=Expr(kind="symbol") as name):
            return name
        case Relation(operator="::", left=Expr(kind="symbol") as name, right=kind) if (
            _word(kind) in _POSITIVE
        ):
            return name
    return None


def _is_known(condition: Value) -> bool:
    return isinstance(condition, Relation) and condition.operator == "::" and _word(condition.right) in _KNOWN


def _word(kind: Value) -> str:
    return kind.name if isinstance(kind, Reference) else str(kind)


def under(value: Value, positive: Set[Expr]) -> Value:
    """Return a value as it is where names are positive: ``sqrt(m^2)`` is m."""
    if isinstance(value, Expr):
        marks = _marks(positive)
        marked = _without_positive_factors(subs(value, marks), set(marks.values()))
        return subs(marked, {mark: name for name, mark in marks.items()})
    if isinstance(value, Listed | Sequence):
        return type(value)(tuple(under(item, positive) for item in value.items))
    if isinstance(value, Relation):
        return Relation(value.operator, under(value.left, positive), under(value.right, positive))
    return value


def _without_positive_factors(value: Expr, marks: Set[Expr]) -> Expr:
    """Return a value with ``p*abs(k)`` for ``abs(k*p)``, where p is positive."""
    made: dict[Expr, Expr] = {}
    for node in post_order([value], lambda node: node.args, lambda node: node.id):
        if node.kind == "function" and node.name == "Abs" and node.args[0].kind == "product":
            factors = [each for each in node.args[0].args if each in marks]
            outside = prod(factors, start=number(1))
            made[node] = outside * abs(node.args[0] / outside) if factors else node
    return subs(value, made) if made else value


def is_positive(value: Expr, positive: Set[Expr]) -> bool | None:
    """Return whether a value is positive, or negative, where names are positive; None if that isn't known."""
    found = sign(subs(value, _marks(positive)))
    return None if found not in (1, -1) else found == 1


def _marks(positive: Set[Expr]) -> dict[Expr, Expr]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the same names without the mark
        return {name: symbols(name.name, positive=True) for name in sorted(positive, key=str)}
