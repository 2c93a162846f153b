"""Factors of polynomials with rational coefficients, by SymPy; and what a rational function is made of."""

from __future__ import annotations

from collections.abc import Iterable
from importlib.util import find_spec

from symbody.symbolic import Expr, expand, from_sympy, to_sympy
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.mathematics.common_fraction import common_fraction
from symbody.worksheet.values.naming import symbol

__all__ = ["LONGEST", "factors_in", "rational_parts"]

LONGEST = 600
"""Characters of the longest expression that is factored completely; of longer ones, common factors are taken out."""


def factors_in(polynomial: Expr, unknown: Expr) -> list[tuple[Expr, int]]:
    """Return the factors of a polynomial that contain an unknown, and how often each occurs; none if it has one."""
    value = expand(common_fraction(polynomial)[0])
    held = rational_parts(value) if len(str(value)) <= LONGEST and find_spec("sympy") is not None else None
    if not held or unknown not in held:
        return []
    import sympy  # noqa: PLC0415 - optional

    _, found = sympy.factor_list(to_sympy(value.subs(held)))
    names = {new: old for old, new in held.items()}
    made = [(from_sympy(each), times) for each, times in found]
    factors = [(each.subs(names), times) for each, times in made if isinstance(each, Expr)]
    within = [(each, times) for each, times in factors if each.has(unknown)]
    return within if len(within) > 1 or any(times > 1 for _, times in within) else []


def rational_parts(value: Expr) -> dict[Expr, Expr] | None:
    """Return the names and functions of which a rational function is made, with symbols for them; None for another."""
    held: dict[Expr, Expr] = {}
    for node in post_order([value], _inner, lambda node: node.id):
        if node.kind == "number" and node.is_decimal:
            return None
        if node.kind not in ("number", "sum", "product") and not _is_power(node):
            held.setdefault(node, symbol(f"_part{len(held)}"))
    return held


def _is_power(node: Expr) -> bool:
    return node.kind == "power" and node.args[1].is_number and node.args[1].ratio[1] == 1


def _inner(node: Expr) -> Iterable[Expr]:
    if _is_power(node):
        return node.args[:1]
    return node.args if node.kind in ("sum", "product") else ()
