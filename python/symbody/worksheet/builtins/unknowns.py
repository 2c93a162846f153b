"""Unknowns of ``solve`` that are expressions, ``diff(x(t),t)^2`` or ``x*y``, and are treated like names."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from symbody.symbolic import Expr
from symbody.worksheet.builtins.substitution import substituted
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mathematics.polynomial import reduced
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import Tree, tree_of, walk
from symbody.worksheet.values.value import Value

__all__ = ["names_of_unknowns", "with_names"]

_NAMES = frozenset({"symbol", "time_function"})
_CALLS = frozenset({"application", "function"})

#: How deeply nested in brackets an unknown is searched.
_DEEPEST = 8


def names_of_unknowns(session: Session, unknowns: Sequence[Expr]) -> dict[Expr, Expr]:
    """Return names for the unknowns that are not names, such as ``laplace(x(t), t, s)``, ``cos(x)`` and ``x*y``."""
    found = {x: symbol(f"_unknown{k}") for k, x in enumerate(unknowns) if x.kind not in _NAMES}
    composed = [session.text(x) for x in found if x.kind not in _CALLS]
    if composed:
        verb = "is" if len(composed) == 1 else "are each"
        session.notice(
            f"solve: {', '.join(composed)} {verb} treated like a name; other terms in its variables count as known"
        )
    return found


def with_names(session: Session, residual: Expr, names: dict[Expr, Expr]) -> Expr:
    """Return an equation with names in place of unknowns and of their powers; sums are replaced by division."""
    for unknown, name in names.items():
        if unknown.kind in _CALLS:
            residual = residual.subs({unknown: name})
        elif unknown.kind == "sum":
            residual = reduced(residual, unknown, name, [])
        else:
            residual = _with_multiples(session, residual, unknown, name)
    return residual


def _with_multiples(session: Session, residual: Expr, unknown: Expr, name: Expr) -> Expr:
    """Return an equation with powers of a name in place of powers of a product: ``x^2*y^3`` is ``(x*y)^2*y``."""
    own = _exponents(tree_of(unknown))
    for _ in range(_DEEPEST):
        made: dict[Value, Value] = {}
        for node in walk(tree_of(residual)):
            power = _power(_exponents(node), own)
            if power:
                made[node.value] = node.value * (name / unknown) ** power
        if not made:
            break
        residual = scalar(session, substituted(session, residual, made))
    return residual


def _exponents(tree: Tree) -> dict[Expr, Fraction]:
    """Return the numeric exponents in a product by their bases."""
    found = {}
    for part in tree.parts if tree.kind == "product" else (tree,):
        base, exponent = (
            (part.parts[0].value, part.parts[1].value) if part.kind == "power" else (part.value, None)
        )
        if exponent is None and part.kind != "number":
            found[base] = Fraction(1)
        elif exponent is not None and exponent.is_number and not exponent.is_decimal:
            found[base] = Fraction(*exponent.ratio)
    return found


def _power(exponents: dict[Expr, Fraction], own: dict[Expr, Fraction]) -> int:
    """Return which power of an unknown a product contains; 0 if it contains none."""
    ratios = [exponents.get(base, Fraction(0)) / n for base, n in own.items()]
    if len(own) == 1:
        return int(ratios[0]) if ratios[0].denominator == 1 else 0
    low, high = min(ratios), max(ratios)
    return int(low) if low > 0 else int(high) if high < 0 else 0
