"""Sums by the parameters in which they are linear: ``m2*l2**2 + m3*(l2 + l3)**2``, a term for each body."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .common_part import common_parameters
from .derivative import diff
from .fractions_outside import with_fractions_outside
from .reading import is_divisor, nodes_of, parts_of
from .rewrite import short_form


def by_parameters(expression: Expr, parameters: Sequence[Expr], form: Callable[[Expr], Expr]) -> Expr | None:
    """Return the sum of parameters, each with its factor; None if an expression isn't linear in them, or has only one.

    Parameters of proportional factors stand together.

    Args:
        expression: the expression.
        parameters: such as masses and moments of inertia.
        form: finds the form of a factor.
    """
    free = expression.free_symbols
    factors = {each: diff(expression, each) for each in parameters if each in free}
    inside = {leaf for factor in factors.values() for leaf in factor.free_symbols}
    factors = {each: factor for each, factor in factors.items() if each not in inside and not factor.is_zero}
    if len(factors) < _FEW:
        return None
    read = [(parameter, form(factor)) for parameter, factor in factors.items()]
    joined = dict[Expr, Expr]()
    for parameter, factor in sorted(read, key=lambda pair: len(str(pair[1]))):
        known, ratio = next(
            ((known, ratio) for known in joined if (ratio := _multiple(factor, known)) is not None),
            (factor, _core.number(1)),
        )
        joined[known] = joined.get(known, _core.number(0)) + ratio * parameter
    terms = [with_fractions_outside(total * factor) for factor, total in joined.items()]
    found = _core.sum_of(terms)
    return _with_number_outside(terms, found) if found == expression else None


def by_lengths(expression: Expr, masses: Collection[Expr], form: Callable[[Expr], Expr]) -> Expr | None:
    """Return the sum of lengths, each with its factor, in brackets behind their common parameters, such as g.

    Args:
        expression: the expression.
        masses: the parameters that are no lengths.
        form: finds the form of a factor.
    """
    common, (rest,) = common_parameters([expression])
    lengths = [leaf for leaf in rest.free_symbols if leaf.kind == "symbol" and leaf not in masses]
    found = by_parameters(rest, sorted(lengths, key=str), form)
    return None if found is None else common * found


_FEW = 2


def _multiple(factor: Expr, known: Expr) -> Expr | None:
    """Return the parameters by which a known factor is multiplied, as in `I + m*r**2`; None if it isn't, or divided."""
    moving = _moving(factor)
    if moving != _moving(known) or (not moving and factor.free_symbols != known.free_symbols):
        return None
    if any(diff(factor, leaf) * known != factor * diff(known, leaf) for leaf in moving):
        return None  # the ratio moves: found out in less time than its form
    ratio = short_form(factor / known)
    if ratio.is_number:
        return ratio
    if not moving or _moving(ratio) or any(map(is_divisor, nodes_of(ratio))):
        return None
    return ratio


def _moving(expression: Expr) -> set[Expr]:
    return {leaf for leaf in expression.free_symbols if leaf.kind == "time_function"}


def _with_number_outside(terms: Sequence[Expr], found: Expr) -> Expr:
    """Return a sum with the number outside that all its terms have as a factor, but for their signs."""
    numbers = [[part for part in parts_of(term, "product") if part.is_number] for term in terms]
    common = {abs(_core.product_of(each)) for each in numbers}
    if len(common) > 1 or common == {_core.number(1)}:
        return found
    (outside,) = common
    return outside * _core.sum_of([term / outside for term in terms])
