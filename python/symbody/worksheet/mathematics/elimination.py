"""Polynomial equations in several unknowns, which follow one after the other from equations that are linear in them."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, number
from symbody.worksheet.mathematics.closed_roots import closed_roots, polynomial_in
from symbody.worksheet.values.complex_number import normal
from symbody.worksheet.values.value import Value

__all__ = ["eliminated_roots"]


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
