"""The sheet's own rules of derivatives: ``diff/f`` := proc(t) .. gives that of f(t), as quasi-velocities need.

A rule of one argument gives d/dt f(t); one that takes the arguments and the variable gives the derivative by it. Both
act on results, by substitution: the derivatives of f become what the rule says, also the second one, and by the chain
rule.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.symbolic import Expr, t, time_derivative
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Array, ProcedureValue, Reference, Table, Value

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["by_rules", "with_rules"]

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
            rate = session.call(Reference(_PREFIX + variable.name), (t, t))
            if isinstance(rate, Expr):
                found[variable] = time_derivative(rate, variable.order - 1) if variable.order > 1 else rate
    return {old: new for old, new in found.items() if new != old}


def _of_several(session: Session, value: Expr, names: set[str]) -> dict[Expr, Expr]:
    found: dict[Expr, Expr] = {}
    for node in post_order([value], lambda node: node.args, lambda node: node.id):
        if node.kind != "application" or node.name not in names or not any(node.orders):
            continue
        dummies = [symbol(f"_argument{i}") for i in range(len(node.args))]
        rate: Value | None = None
        for place, order in enumerate(node.orders):
            for _ in range(order):
                if rate is None:
                    rate = session.call(Reference(_PREFIX + node.name), (*dummies, dummies[place]))
                elif isinstance(rate, Expr):
                    rate = rate.diff(dummies[place])
        if isinstance(rate, Expr):
            found[node] = rate.subs(dict(zip(dummies, node.args, strict=True)))
    return {old: new for old, new in found.items() if new != old}


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
