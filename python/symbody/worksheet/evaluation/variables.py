"""The variables of scalars, and the functions called in them, that may have a value in the session."""

from __future__ import annotations

from symbody.symbolic import Expr, free_symbols, pi
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.evaluation.seen import depend_on
from symbody.worksheet.evaluation.state import State
from symbody.worksheet.values.value import NULL, Boolean, Value

__all__ = ["CONSTANTS", "applications_of", "names_of", "variables_of"]

CONSTANTS: dict[str, Value] = {
    "Pi": pi,
    "true": Boolean(truth=True),
    "false": Boolean(truth=False),
    "FAIL": Boolean(truth=None),
    "NULL": NULL,
}
"""The names that have a value of their own."""


def variables_of(session: State, value: Expr) -> list[Expr]:
    """Return the variables that may have a value, in a fixed order; the scalar depends on all of them."""
    names = names_of(session, value)
    depend_on(session, names)
    known = names & _named_somewhere(session)
    if not known:
        return []
    found = [each for each in free_symbols([value]) if each.name in known]
    return sorted(found, key=lambda each: (each.name, each.kind, each.kind != "symbol" and each.order))


def _named_somewhere(session: State) -> set[str]:
    held = (
        session.names,
        session.remembered,
        session.indexed,
        session.opaque,
        session.options.aliases,
        CONSTANTS,
    )
    return set().union(*(each.keys() for each in held if each))


_FEW = 8


def names_of(session: State, value: Expr) -> frozenset[str]:
    """Return the names of the variables in a scalar; those of its parts, if they are known, save a walk."""
    known = session.variables.get(value.id)
    if known is None:
        parts = value.args
        of_parts = [session.variables.get(part.id) for part in parts[:_FEW] if part.args or part.is_variable]
        if parts and len(parts) <= _FEW and None not in of_parts:
            known = frozenset().union(*(each for each in of_parts if each is not None))
        else:
            known = frozenset(each.name for each in free_symbols([value]))
        if len(session.variables) > 500_000:
            session.variables.clear()
        session.variables[value.id] = known
    return known


def applications_of(session: State, value: Expr) -> list[Expr]:
    """Return the calls in a scalar whose function may have a value; the scalar depends on these functions."""
    known = session.applied & (session.names.keys() | session.remembered.keys())
    if not known:
        if session.applied:
            session.depends[-1].update(session.applied)
        return []
    nodes = post_order([value], lambda node: node.args, lambda node: node.id)
    found = [node for node in nodes if node.kind == "application"]
    session.depends[-1].update(node.name for node in found)
    return found
