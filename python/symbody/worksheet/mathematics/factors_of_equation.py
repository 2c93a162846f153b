"""Equations in one unknown that split into simpler ones: products, and polynomials in one function of the unknown.

A product is zero where a factor is: ``a*sin(x)*cos(x) = 0``. A polynomial in ``u = f(x)`` is solved for u first:
``2*cos(x)^2 - cos(x) - 1 = 0``. Squares of sines and cosines of one angle are expressed by each other.
"""

from __future__ import annotations

from collections.abc import Iterator

from symbody.symbolic import Expr, atan, coeff, cos, expand, factor_terms, sin
from symbody.worksheet.mathematics.closed_roots import polynomial_in, roots_of
from symbody.worksheet.mathematics.common_fraction import common_fraction
from symbody.worksheet.mathematics.polynomial import reduced
from symbody.worksheet.values.complex_number import has_i
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import Tree, tree_of, walk

__all__ = ["is_pole", "simpler_equations"]

_VALUE = symbol("_value")


def simpler_equations(residual: Expr, unknown: Expr) -> list[Expr] | None:
    """Return equations whose solutions together are those of an equation; None if it doesn't split."""
    if polynomial_in(residual, unknown) is not None:
        return None
    angle = _by_tangent(residual, unknown)
    if angle is not None:
        return [angle]
    factors = _factors(residual, unknown)
    if factors is not None:
        return factors
    for form in _forms(residual, unknown):
        found = _by_function(form, unknown)
        if found is not None:
            return found
    return None


def _by_tangent(residual: Expr, unknown: Expr) -> Expr | None:
    """Return ``A + atan(c/s)`` of ``s*sin(A) + c*cos(A)``, by the tangent; None for another equation."""
    angles = {node.args[0] for node in _functions(residual, unknown) if node.name in {"sin", "cos"}}
    if len(angles) != 1:
        return None
    (angle,) = angles
    value = expand(residual)
    s, c = coeff(value, sin(angle), 1), coeff(value, cos(angle), 1)
    if s.is_zero or c.is_zero or s.has(unknown) or c.has(unknown):
        return None
    return None if not expand(value - s * sin(angle) - c * cos(angle)).is_zero else angle + atan(c / s)


def is_pole(residual: Expr, unknown: Expr, root: object) -> bool:
    """Whether a denominator of an equation is zero at a root of its numerator: 1 of ``(x^2 - 1)/(x - 1) = 0``."""
    below = common_fraction(residual)[1]
    return isinstance(root, Expr) and below.has(unknown) and expand(below.subs({unknown: root})).is_zero


def _factors(residual: Expr, unknown: Expr) -> list[Expr] | None:
    """Return the factors of a product that can be zero, each once; None if a single factor contains the unknown."""
    tree = tree_of(factor_terms(residual))
    parts = [part for part in (tree.parts if tree.kind == "product" else (tree,)) if part.value.has(unknown)]
    found = [_zero_of(part) for part in parts]
    if len(parts) == 1 and found[0] == parts[0].value:
        return None
    return list(dict.fromkeys(factor for factor in found if factor is not None))


def _zero_of(part: Tree) -> Expr | None:
    """Return an expression that is zero where a factor is; None for a factor without zeros."""
    if part.kind == "power" and part.parts[1].value.is_number:
        return part.parts[0].value if part.parts[1].value.ratio[0] > 0 else None
    return None if part.kind == "function" and part.name == "exp" else part.value


def _forms(residual: Expr, unknown: Expr) -> Iterator[Expr]:
    """Yield the given equation, the equation without squares of sines, and the one without squares of cosines."""
    yield residual
    angles = {node.args[0] for node in _functions(residual, unknown) if node.name in {"sin", "cos"}}
    if len(angles) == 1:
        (angle,) = angles
        c, s = cos(angle), sin(angle)
        yield reduced(expand(residual), s**2, 1 - c**2, [])
        yield reduced(expand(residual), c**2, 1 - s**2, [])


def _functions(residual: Expr, unknown: Expr) -> list[Expr]:
    """Return the functions in an equation that depend on the unknown, inner ones first."""
    nodes = (node.value for node in walk(tree_of(residual)))
    return list(dict.fromkeys(n for n in nodes if n.kind == "function" and n.has(unknown)))


def _by_function(residual: Expr, unknown: Expr) -> list[Expr] | None:
    """Return ``f(x) - u`` for the roots u of a polynomial in f(x) of degree two or more."""
    functions = _functions(residual, unknown)
    for function in functions:
        by_value = residual.subs(_powers_of(function, functions))
        known = None if by_value.has(unknown) else polynomial_in(expand(by_value), _VALUE)
        if known is None or len(known) < 3:
            continue
        roots = [root for root in roots_of(known) if isinstance(root, Expr) and not has_i(root)]
        return (
            [_equal(function, root) for root in dict.fromkeys(roots)]
            if len(roots) == len(known) - 1
            else None
        )
    return None


def _equal(function: Expr, value: Expr) -> Expr:
    """Return an expression that is zero where a function has a value; for a tangent, in terms of its angle."""
    return function.args[0] - atan(value) if function.name == "tan" else function - value


def _powers_of(function: Expr, functions: list[Expr]) -> dict[Expr, Expr]:
    """Return the replacements of a function by the value, and of ``exp(2*x)`` by its square beside ``exp(x)``."""
    made = {function: _VALUE}
    for other in functions if function.name == "exp" else ():
        ratio = other.args[0] / function.args[0]
        if ratio.is_number and ratio.ratio[1] == 1:
            made[other] = _VALUE ** ratio.ratio[0]
    return made
