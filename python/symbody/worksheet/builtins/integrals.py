"""Integrals, limits and sums in closed form, which SymPy finds; what it doesn't find comes back as it was written."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, from_sympy, number, t, to_sympy
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mathematics.quadrature import OF_FUNCTION
from symbody.worksheet.mathematics.sympy_refusal import SYMPY_REFUSALS
from symbody.worksheet.values.complex_number import has_i
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Range,
    Reference,
    Relation,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS", "closed_sum"]

_PLACE = symbol("_place")
"""What stands for the variable of an integral, which may be a function such as x(t)."""


def integral(session: Session, value: Value, *ranges: Value) -> Value:
    """int(e, x), int(e, x = a..b), int(e, [x = a..b, y = c..d]): an integral in closed form."""
    if len(ranges) == 1 and isinstance(ranges[0], Range):
        return _integral_of_function(session, value, ranges[0])
    flat = [each for item in ranges for each in (item.items if isinstance(item, Listed) else (item,))]
    if not flat or (isinstance(flat[0], Relation) and not isinstance(flat[0].right, Range)):
        raise WorksheetError("int: expected a variable, or a variable and its range, such as x = 0..L")
    for each in flat:
        if isinstance(each, Expr | Reference | Relation):
            value = _applied(session, "int", value, each, _integral_of)
    return value


def _integral_of_function(session: Session, function: Value, bounds: Range) -> Value:
    """Return ``int(f, a..b)``; of a function that needs a number, as it is written, for evalf."""
    plain = Unevaluated(symbol("int"), (function, bounds))
    try:
        body = session.call(function, (OF_FUNCTION,))
    except SymbodyError:
        return plain
    found = _applied(session, "int", body, Relation("=", OF_FUNCTION, bounds), _integral_of)
    return plain if isinstance(found, Unevaluated) else found


def limit(session: Session, value: Value, place: Value, direction: Value | None = None) -> Value:
    """limit(e, x = a [, left | right]): a limit."""
    if not isinstance(place, Relation):
        raise WorksheetError("limit: expected a variable and its value, such as x = 0")
    side = {"left": "-", "right": "+"}.get(getattr(direction, "name", ""), "+-")
    return _applied(session, "limit", value, place, lambda *parts: _limit_of(*parts, side=side))


def inert(name: str) -> Command:
    """Return a command that does nothing until ``value`` is asked for: Int, Limit, Sum."""

    def command(session: Session, *arguments: Value) -> Value:
        return Unevaluated(symbol(name), arguments)

    command.__doc__ = f"{name}(..): as it is written; value(%) works it out."
    return command


def worked_out(session: Session, value: Value) -> Value:
    """value(e): inert integrals, limits and sums in it worked out."""
    if isinstance(value, Unevaluated):
        name = _INERT.get(getattr(value.function, "name", ""))
        inner = tuple(worked_out(session, each) for each in value.arguments)
        if name == "sum":
            return _sum(session, inner)
        return session.call(symbol(name), inner) if name else Unevaluated(value.function, inner)
    if isinstance(value, Expr):
        held = {each: session.opaque[each.name] for each in value.free_symbols if each.name in session.opaque}
        made: dict[Expr, Value] = {each: worked_out(session, inner) for each, inner in held.items()}
        return session.rebuild(value, made) if made else value
    if isinstance(value, Relation | Listed | MapleSet | Array):
        return entrywise(session, value, lambda each: worked_out(session, each))
    return value


def _sum(session: Session, arguments: tuple[Value, ...]) -> Value:
    """Return a sum over an index that is a name by now."""
    body, place = arguments
    if not isinstance(place, Relation) or not isinstance(place.right, Range) or not isinstance(body, Expr):
        return Unevaluated(symbol("sum"), arguments)
    index = scalar(session, place.left)
    low, high = as_integer(place.right.start), as_integer(place.right.stop)
    if low is None or high is None:
        return closed_sum(session, body, index.name, place.right)
    session.limits.check_items(high - low + 1)
    return sum((body.subs({index: number(k)}) for k in range(low, high + 1)), start=number(0))


_INERT = {"Int": "int", "Limit": "limit", "Sum": "sum", "Diff": "diff"}

_Made = Callable[[Any, Any, Any, Any], Any]


def _applied(session: Session, name: str, value: Value, place: Value, make: _Made) -> Value:
    """Return what SymPy makes of an expression, a variable and its bounds; what it doesn't know, unevaluated.

    Args:
        session: the session.
        name: the command.
        value: the expression, or what holds several.
        place: the variable, or an equation of it and its bounds.
        make: calls SymPy.
    """
    if isinstance(value, Listed | MapleSet | Array | Relation):
        return entrywise(session, value, lambda each: _applied(session, name, each, place, make))
    plain = Unevaluated(symbol(name), (value, place))
    if not isinstance(value, Expr) or has_i(value):
        return plain
    variable = scalar(session, place.left if isinstance(place, Relation) else place)
    bounds = () if not isinstance(place, Relation) else _bounds(session, place.right)
    if any(each.name in session.opaque for each in value.free_symbols if each.kind == "symbol"):
        return plain
    try:
        import sympy  # noqa: PLC0415 - optional
    except ImportError as error:
        raise WorksheetError(f"{name}: it needs SymPy; pip install symbody[sympy]") from error
    standing = _standing((value, *bounds), variable)
    try:
        made = make(
            sympy,
            to_sympy(value.subs({variable: _PLACE, **standing})),
            to_sympy(_PLACE),
            [_number(sympy, b.subs(standing)) for b in bounds],
        )
        if made is None or made.has(sympy.Integral, sympy.Limit, sympy.nan, sympy.zoo, sympy.I):
            return plain
        if made in (sympy.oo, -sympy.oo):
            return symbol("infinity") if made == sympy.oo else -symbol("infinity")
        found = from_sympy(made)
    except SYMPY_REFUSALS:
        return plain
    original = {_PLACE: variable, **{stand: leaf for leaf, stand in standing.items()}}
    return found.subs(original) if isinstance(found, Expr) else plain


def _standing(values: tuple[Expr, ...], variable: Expr) -> dict[Expr, Expr]:
    """Return names for what SymPy has no name for, such as ``a[1]`` or ``q[1](t)``, and doesn't hold the variable."""
    leaves = frozenset[Expr]().union(*(each.free_symbols for each in values)) - {variable}
    others = sorted((leaf for leaf in leaves if not leaf.name.isidentifier()), key=str)
    moving = variable == t
    held = re.compile(rf"\b{re.escape(variable.name)}\b")  # q[k] depends on k
    fixed = [leaf for leaf in others if not held.search(leaf.name) and not (moving and leaf.depends_on_time)]
    return {leaf: symbol(f"_leaf{i}") for i, leaf in enumerate(fixed)}


def _bounds(session: Session, value: Value) -> tuple[Expr, ...]:
    if isinstance(value, Range):
        return scalar(session, value.start), scalar(session, value.stop)
    return (scalar(session, value),)


def _number(sympy: Any, value: Expr) -> Any:
    return to_sympy(value).subs(to_sympy(symbol("infinity")), sympy.oo)


def _integral_of(sympy: Any, value: Any, variable: Any, bounds: list[Any]) -> Any:
    # Of a positive symbol, SymPy doesn't ask whether it is zero.
    names = value.free_symbols.union(*(each.free_symbols for each in bounds)) - {variable}
    positive = {each: sympy.Symbol(each.name, positive=True) for each in names}
    place = (variable, *(each.subs(positive) for each in bounds)) if bounds else variable
    made = sympy.integrate(value.subs(positive), place, conds="none")
    return made.subs({new: old for old, new in positive.items()})


def _limit_of(sympy: Any, value: Any, variable: Any, bounds: list[Any], *, side: str) -> Any:
    """Return the limit of an expression.

    Args:
        sympy: the module.
        value: the expression.
        variable: its variable.
        bounds: the place.
        side: from where the variable comes, "+", "-" or "+-"; infinite places have one side.
    """
    return sympy.limit(value, variable, bounds[0], side if bounds[0].is_finite else "+")


def closed_sum(session: Session, value: Value, name: str, bounds: Range) -> Value:
    """Return ``sum(e, k = a..n)`` with a bound that is no number."""
    place = Relation("=", symbol(name), bounds)
    return _applied(session, "sum", value, place, _sum_of)


def _sum_of(sympy: Any, value: Any, variable: Any, bounds: list[Any]) -> Any:
    made = sympy.summation(value, (variable, *bounds))
    return None if made.has(sympy.Sum, sympy.Piecewise) else made


COMMANDS: dict[str, Command] = {
    "int": integral,
    "limit": limit,
    "Int": inert("Int"),
    "Limit": inert("Limit"),
    "Sum": inert("Sum"),
    "value": worked_out,
}
