"""Expressions that hold functions of time without depending on them: ``cos(q + a)*cos(q) + sin(q + a)*sin(q)``."""

from __future__ import annotations

from symbody.symbolic import Expr, number


def constant_form(value: Expr) -> Expr | None:
    """Return a constant without functions of time; None if the value changes with time.

    If a value is the same at one position as at all others, then it is what it is there.
    """
    if not value.depends_on_time:
        return value
    here = value.subs({leaf: number(0) for leaf in value.free_symbols if leaf.depends_on_time})
    return here if here == value else None
