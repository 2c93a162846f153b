"""Sums by the parameters in which they are linear: ``m2*l2**2 + m3*(l2 + l3)**2``, a term for each body."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .common_part import common_parameters
from .derivative import diff
from .reading import parts_of


def by_parameters(expression: Expr, parameters: Sequence[Expr], form: Callable[[Expr], Expr]) -> Expr | None:
    """Return the sum of parameters, each with its factor; None if an expression isn't linear in them, or has only one.

    Parameters of equal factors stand together.

    Args:
        expression: the expression.
        parameters: such as masses and moments of inertia.
        form: finds the form of a factor.
    """
    free = expression.free_symbols
    factors = {each: diff(expression, each) for each in parameters if each in free}
    inside = {leaf for factor in factors.values() for leaf in factor.free_symbols}
    factors = {parameter: factor for parameter, factor in factors.items() if parameter not in inside}
    if len(factors) < _FEW:
        return None
    joined = dict[Expr, Expr]()
    for parameter, factor in factors.items():
        joined[factor] = joined[factor] + parameter if factor in joined else parameter
    terms = [total * form(factor) for factor, total in joined.items()]
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


def _with_number_outside(terms: Sequence[Expr], found: Expr) -> Expr:
    """Return a sum with the number outside that all its terms begin with, if it is one."""
    numbers = {next((part for part in parts_of(term, "product") if part.is_number), None) for term in terms}
    common = numbers.pop() if len(numbers) == 1 else None
    return found if common is None else common * _core.sum_of([term / common for term in terms])
