"""The sheet's own rules of derivatives: ``diff/f`` := proc(..) gives that of f(..), as quasi-velocities need.

A rule takes the arguments of f and the variable. ``diff`` calls it so for each f(..) that it meets. What commands
derive comes here with derivatives of f by its places. They follow from the rule at free arguments if it obeys the chain
rule, and otherwise from what it gives for the time, which is then all that it tells.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, UndefinedFunction, number, t, time_derivative
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Array, ProcedureValue, Reference, Table, Value

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["by_rules", "derived", "with_rules"]

_PREFIX = "diff/"
_PASSES = 12
"""Rules may give derivatives that have rules themselves, but not without end."""


def by_rules(session: Session, value: Expr) -> Expr:
    """Return a scalar with the sheet's rules applied to the derivatives in it."""
    names = _names(session)
    if not names:
        return value
    for _ in range(_PASSES):
        mapping = _of_time(session, value, names) | _of_several(session, value, names)
        if not mapping:
            return value
        value = value.subs(mapping)
    return value


def _names(session: Session) -> set[str]:
    return {name[len(_PREFIX) :] for name in session.rules if name in session.names}


def _of_time(session: Session, value: Expr, names: set[str]) -> dict[Expr, Expr]:
    found: dict[Expr, Expr] = {}
    for variable in value.free_symbols:
        if variable.kind == "time_function" and variable.order and variable.name in names:
            rate = _rate(session, variable.name, (t,), t)
            found[variable] = time_derivative(rate, variable.order - 1) if variable.order > 1 else rate
    return {old: new for old, new in found.items() if new != old}


def _rate(session: Session, name: str, arguments: tuple[Expr, ...], by: Expr) -> Expr:
    """Return what the rule of a function gives for the derivative of f(arguments) by a variable."""
    rate = session.call(Reference(_PREFIX + name), (*arguments, by))
    if isinstance(rate, Expr):
        return rate
    raise WorksheetError(
        f"{_PREFIX}{name} gives {session.text(rate)[:60] or 'nothing'} for the derivative by {session.text(by)}; "
        "expected an expression"
    )


# --- derivatives that the sheet asks for ------------------------------------------------------------------------------


def derived(session: Session, value: Expr, by: Expr) -> Expr:
    """Return the derivative of a scalar by a name; rules are called with the arguments of their functions."""
    held = {node: _stand_in(i, by) for i, node in enumerate(_calls(value, _names(session)))}
    held = {node: function for node, function in held.items() if not node.diff(by).is_zero}
    if not held:
        return by_rules(session, value.diff(by))
    slope = value.subs(held).diff(by)
    rates = {function.diff(by): _rate(session, node.name, node.args, by) for node, function in held.items()}
    back = {function: node for node, function in held.items()}
    return by_rules(session, slope.subs(rates).subs(back))


def _stand_in(place: int, by: Expr) -> Expr:
    """Return a function of the variable alone, of which only the derivative is asked."""
    return UndefinedFunction(f"_held{place}")(by)


def _calls(value: Expr, names: set[str]) -> list[Expr]:
    """Return the outermost f(..) of some names in a scalar."""

    def parts(node: Expr) -> tuple[Expr, ...]:
        return () if node.kind == "application" and node.name in names else tuple(node.args)

    nodes = post_order([value], parts, lambda node: node.id) if names else ()
    return [
        node for node in nodes if node.kind == "application" and node.name in names and not any(node.orders)
    ]


# --- derivatives by places, in what commands derive -------------------------------------------------------------------


def _of_several(session: Session, value: Expr, names: set[str]) -> dict[Expr, Expr]:
    found: dict[Expr, Expr] = {}
    for node in post_order([value], lambda node: node.args, lambda node: node.id):
        if node.kind == "application" and node.name in names and any(node.orders):
            found[node] = _by_places(session, node)
    return {old: new for old, new in found.items() if new != old}


def _by_places(session: Session, node: Expr) -> Expr:
    """Return a derivative D[i, j, ..](f)(arguments)."""
    moving = [argument for argument in node.args if not time_derivative(argument).is_zero]
    slopes = _slopes(session, node)
    if slopes is None and len(moving) == 1:
        return _by_the_time(session, node, moving[0])
    if slopes is None:
        raise WorksheetError(
            f"{_PREFIX}{node.name} doesn't obey the chain rule: its derivative by t is not the sum of those by its "
            "arguments; expected diff(a,t)*.. + diff(b,t)*.. in a rule of several arguments"
        )
    return _of_slopes(node, slopes)


def _of_slopes(node: Expr, slopes: list[Expr]) -> Expr:
    """Return a derivative D[i, j, ..](f)(arguments) of slopes f_i.

    Rules of quasi-coordinates are no derivatives of a function: ``D[1, 2](f)`` may be f_1 by the second argument or f_2
    by the first. With each place in turn as the one that is derived first, the mean is what n derivatives by the time
    make of ``f_1 a' + f_2 b'``.
    """
    dummies, orders = _dummies(node), node.orders
    total = number(0)
    for first, slope in enumerate(slopes):
        part = slope
        for place, order in enumerate(orders):
            for _ in range(max(order - (place == first), 0) if orders[first] else 0):
                part = part.diff(dummies[place])
        total += part * orders[first] / sum(orders)
    return total.subs(dict(zip(dummies, node.args, strict=True)))


def _dummies(node: Expr) -> tuple[Expr, ...]:
    return tuple(symbol(f"_argument{i}") for i in range(len(node.args)))


def _slopes(session: Session, node: Expr) -> list[Expr] | None:
    """Return the derivatives by the arguments, free ones; None if they don't add up to what the rule gives for t."""
    dummies = _dummies(node)
    try:
        slopes = [_rate(session, node.name, dummies, dummy) for dummy in dummies]
    except WorksheetError:
        return None
    rates = [time_derivative(argument) for argument in node.args]
    if all(rate.is_zero for rate in rates):
        return slopes
    at = dict(zip(dummies, node.args, strict=True))
    total = sum((slope.subs(at) * rate for slope, rate in zip(slopes, rates, strict=True)), start=number(0))
    return slopes if total == _rate(session, node.name, node.args, t) else None


def _by_the_time(session: Session, node: Expr, argument: Expr) -> Expr:
    """Return a derivative by the one argument that depends on time, of what the rule gives: df/da = (df/dt)/(da/dt)."""
    speed = time_derivative(argument)
    slope = _rate(session, node.name, node.args, t) / speed
    for _ in range(sum(node.orders) - 1):
        slope = time_derivative(slope) / speed
    return slope


def with_rules(session: Session, value: Value) -> Value:
    """Return what a command gave with the sheet's rules applied; fields of new objects are changed in place."""
    if not session.rules:
        return value
    if isinstance(value, Expr):
        return by_rules(session, value)
    if isinstance(value, Table):
        for key, entry in value.entries.items():
            if not isinstance(entry, Reference) and key != (symbol("frame"),):
                value.entries[key] = with_rules(session, entry)
        return value
    if isinstance(value, Array):
        if value.frame is None:
            value.entries = [with_rules(session, entry) for entry in value.entries]
        return value
    if isinstance(value, Reference | ProcedureValue):
        return value
    return entrywise(session, value, lambda each: by_rules(session, each))
