"""Inequalities in one unknown: the intervals between the zeros of the two sides' difference where they hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.evaluation.session import sequence as in_sequence
from symbody.worksheet.mathematics.closed_roots import polynomial_in
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.value import Listed, MapleSet, Relation, Unevaluated, Value

__all__ = ["inequalities_of", "solved_inequalities"]

_ORDER = ("<", "<=")

Roots: TypeAlias = Callable[[Expr, Expr], list[Value]]


@dataclass(frozen=True, slots=True)
class _Interval:
    """What lies between two places; one that is None is at infinity, and both may be the same place."""

    low: Expr | None
    high: Expr | None
    with_low: bool
    with_high: bool

    def relations(self, unknown: Expr) -> tuple[Relation, ...]:
        """Return the interval as relations of its unknown."""
        if self.low is not None and self.low is self.high:
            return (Relation("=", unknown, self.low),)
        below = () if self.low is None else (Relation(_ORDER[self.with_low], self.low, unknown),)
        above = () if self.high is None else (Relation(_ORDER[self.with_high], unknown, self.high),)
        return below + above

    def value(self, unknown: Expr) -> Value:
        """Return the interval as ``RealRange(a, b)``, where ``Open(a)`` is an end that does not belong to it."""
        if self.low is not None and self.low is self.high:
            return self.low
        if self.low is self.high is None:
            return unknown
        low = _end(self.low, -symbol("infinity"), is_closed=self.with_low)
        high = _end(self.high, symbol("infinity"), is_closed=self.with_high)
        return Unevaluated(symbol("RealRange"), (low, high))


def _end(place: Expr | None, infinite: Expr, *, is_closed: bool) -> Value:
    if place is None:
        return infinite
    return place if is_closed else Unevaluated(symbol("Open"), (place,))


def inequalities_of(session: Session, equations: Value) -> list[Relation]:
    """Return the relations of a problem for ``solve`` if one of them is an inequality; else none."""
    found = session.resolve(equations)
    items = found.items if isinstance(found, Listed | MapleSet) else (found,)
    relations = [each for each in map(session.resolve, items) if isinstance(each, Relation)]
    if len(relations) < len(items) or all(each.operator == "=" for each in relations):
        return []
    return relations


def solved_inequalities(
    session: Session,
    relations: Sequence[Relation],
    unknowns: Value | None,
    roots: Roots,
    *,
    in_sets: bool,
) -> Value:
    """Return where relations between expressions of one unknown hold: as ranges, or as sets of relations.

    Args:
        session: the session.
        relations: the relations, which all hold.
        unknowns: what is solved for; None for the only name.
        roots: gives the zeros of an expression of an unknown.
        in_sets: whether the relations were given in a set or a list.

    Raises:
        WorksheetError: there are several unknowns, or other names, whose values decide.
    """
    sides = [scalar(session, each.left) - scalar(session, each.right) for each in relations]
    names = sorted({x for side in sides for x in side.free_symbols}, key=str)
    given = session.resolve(unknowns) if unknowns is not None else None
    wanted = list(given.items) if isinstance(given, Listed | MapleSet) else [] if given is None else [given]
    if len(names) != 1 or wanted not in ([], names):
        found = ", ".join(map(session.text, names)) or "no name"
        raise WorksheetError(
            f"solve: inequalities in {found}; expected one unknown, and numbers for all other names"
        )
    (unknown,) = names
    for relation, side in zip(relations, sides, strict=True):
        if not _is_continuous(side, unknown):
            raise WorksheetError(
                f"solve: {session.text(relation)[:60]} is not a polynomial inequality; expected powers of "
                f"{session.text(unknown)} and absolute values"
            )
    intervals = _intervals(relations, sides, unknown, roots)
    if not intervals:
        session.notice("solve: no solution was found; the result is NULL")
    if in_sets or isinstance(given, MapleSet | Listed):
        return in_sequence([MapleSet(each.relations(unknown)) for each in intervals])
    return in_sequence([each.value(unknown) for each in intervals])


def _intervals(
    relations: Sequence[Relation], sides: Sequence[Expr], unknown: Expr, roots: Roots
) -> list[_Interval]:
    """Return where all relations hold, from the signs at the zeros and between them."""
    places = _zeros(sides, unknown, roots)
    numbers = [place for place, _ in places]
    holds_at = [_hold(relations, sides, unknown, place, at_zero=zero) for place, zero in places]
    probes = _between(numbers)
    holds_between = [_hold(relations, sides, unknown, probe) for probe in probes]
    ends: list[Expr | None] = [None, *(zero for _, zero in places), None]
    found: list[_Interval] = []
    begun: _Interval | None = None
    for k, inside in enumerate(holds_between):
        before = k > 0 and holds_at[k - 1]
        after = k < len(places) and holds_at[k]
        if inside:
            joined = begun is not None and before
            begun = _Interval(
                begun.low if joined and begun else ends[k],
                ends[k + 1],
                begun.with_low if joined and begun else before,
                after,
            )
            if joined:
                found.pop()
            found.append(begun)
        else:
            begun = None
            if before and not holds_between[k - 1]:
                found.append(_Interval(ends[k], ends[k], with_low=True, with_high=True))
    return found


def _is_continuous(side: Expr, unknown: Expr) -> bool:
    """Whether an expression is made of powers of the unknown and absolute values, so that signs change at zeros."""
    nodes = post_order([side], lambda node: node.args, lambda node: node.id)
    sizes = (node for node in nodes if node.kind == "function" and node.name == "Abs")
    inner = {node: symbol(f"_size{node.id}") for node in sizes}
    plain = side.subs(inner)
    names = [unknown, *inner.values()]
    return all(_is_polynomial(plain, name) for name in names) and all(
        _is_continuous(size.args[0], unknown) for size in inner
    )


def _is_polynomial(value: Expr, variable: Expr) -> bool:
    coefficients = polynomial_in(value, variable) or []
    terms = (coefficient * variable**k for k, coefficient in enumerate(coefficients))
    return bool((value - sum(terms, start=number(0))).is_zero)


def _zeros(sides: Sequence[Expr], unknown: Expr, roots: Roots) -> list[tuple[float, Expr]]:
    """Return the real zeros of the differences, in order."""
    found: dict[float, Expr] = {}
    for root in (root for side in sides if side.free_symbols for root in roots(side, unknown)):
        if isinstance(root, Unevaluated):
            raise WorksheetError("solve: an inequality whose zeros have no closed form; use fsolve for them")
        place = as_float(root) if isinstance(root, Expr) else None
        if place is not None and isinstance(root, Expr):
            found.setdefault(place, root)
    return sorted(found.items(), key=lambda each: each[0])


def _between(numbers: Sequence[float]) -> list[float]:
    """Return a number below all of some numbers, one between each two, and one above all."""
    if not numbers:
        return [0.5]
    return [numbers[0] - 1, *((a + b) / 2 for a, b in pairwise(numbers)), numbers[-1] + 1]


def _hold(
    relations: Sequence[Relation],
    sides: Sequence[Expr],
    unknown: Expr,
    place: float,
    *,
    at_zero: Expr | None = None,
) -> bool:
    """Whether all relations hold at a number.

    Args:
        relations: the relations.
        sides: the differences of their sides.
        unknown: the unknown.
        place: the number.
        at_zero: the same number in closed form, at which one of the differences is zero.
    """
    for relation, side in zip(relations, sides, strict=True):
        is_zero = at_zero is not None and side.subs({unknown: at_zero}).is_zero
        size = 0.0 if is_zero else side.evaluate({unknown: place}) if side.free_symbols else as_float(side)
        if size is None or not _HOLDS[relation.operator](size):
            return False
    return True


_HOLDS = {
    "<": lambda x: x < 0,
    "<=": lambda x: x <= 0,
    ">": lambda x: x > 0,
    ">=": lambda x: x >= 0,
    "=": lambda x: x == 0,
    "<>": lambda x: x != 0,
}
