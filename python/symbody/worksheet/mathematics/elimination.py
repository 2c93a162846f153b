"""Equations in several unknowns, which follow one after the other from equations that are linear in them."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, number
from symbody.symbolic.linear.elimination import eliminated, is_linear
from symbody.worksheet.mathematics.closed_roots import closed_roots, polynomial_in
from symbody.worksheet.values.complex_number import normal
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Value

__all__ = ["eliminated_in_turn", "eliminated_roots"]


def eliminated_in_turn(equations: Sequence[Expr], unknowns: Sequence[Expr]) -> dict[Expr, Expr] | None:
    """Return the unknowns of equations that are linear in rates, and then in accelerations; None for other equations.

    The equations of accelerations may hold products of rates, for which those of the rates are solved first.
    """
    names = {
        x: symbol(f"_unknown{i}") for i, x in enumerate(unknowns)
    }  # a rate is independent of its derivative
    found: dict[Expr, Expr] = {}
    rest, left = [each.subs(names) for each in equations], list(unknowns)
    for order in sorted({_order(each) for each in unknowns}):
        group = [names[each] for each in left if _order(each) <= order]
        higher = {names[each] for each in left} - {*group}
        known = [each for each in rest if not each.free_symbols & higher]
        solution = eliminated(known, group) if is_linear(known, group) else None
        if solution is None:
            return None
        found |= {x: value for x, value in solution.items() if value != x}
        rest = [each.subs(found) for each in rest if each not in known]
        left = [each for each in left if names[each] not in found]
    back = {name: x for x, name in names.items()}
    return None if rest else {back[x]: value.subs(found).subs(back) for x, value in found.items()}


def _order(unknown: Expr) -> int:
    return unknown.order if unknown.kind == "time_function" else 0


def eliminated_roots(residuals: Sequence[Expr], unknowns: Sequence[Expr]) -> list[dict[Expr, Value]] | None:
    """Return the solutions, complex ones too; None if there is no form for them."""
    if len(residuals) != len(unknowns):
        return None
    if len(residuals) == 1:
        roots = closed_roots(residuals[0], unknowns[0])
        return None if roots is None else [{unknowns[0]: root} for root in roots]
    found = _linear(residuals, unknowns)
    if found is None:
        return None
    place, x, value = found
    others = [each.subs({x: value}) for k, each in enumerate(residuals) if k != place]
    solved = eliminated_roots(others, [each for each in unknowns if each != x])
    if solved is None or not all(isinstance(each, Expr) for one in solved for each in one.values()):
        return None
    return [{**one, x: normal(value.subs(one))} for one in solved]


def _linear(residuals: Sequence[Expr], unknowns: Sequence[Expr]) -> tuple[int, Expr, Expr] | None:
    """Return an equation that is linear in an unknown with a constant factor, this unknown, and its value."""
    for place, residual in enumerate(residuals):
        for x in unknowns:
            known = polynomial_in(residual, x)
            if known is not None and len(known) == 2 and not known[1].free_symbols & {*unknowns}:
                return place, x, number(-1) * known[0] / known[1]
    return None
