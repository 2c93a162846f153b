"""Sums by products of lengths and functions: ``1/3*(m1 + 3*m2)*l1**2 + 1/2*l1*l2*m2*cos(q)``, one fraction a term."""

from __future__ import annotations

from collections.abc import Collection

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .fractions_outside import with_number_outside
from .reading import nodes_of, parts_of
from .rewrite import expand
from .summands import summands
from .terms import number_of_terms

_MOST = 60
"""The terms of a sum up to which it is multiplied out."""


def by_products(expression: Expr, masses: Collection[Expr]) -> Expr | None:
    """Return the sum of products of lengths and functions, each with its masses; None if it has too many terms.

    Functions with the same factors are added, as in ``1/2*m*l**2*(cos(p) + cos(q))``.

    Args:
        expression: the expression.
        masses: the parameters that are masses and moments of inertia.

    >>> from symbody import cos, functions_of_time, symbols
    >>> q, (m1, m2, l1, l2) = functions_of_time("q"), symbols("m1 m2 l1 l2")
    >>> by_products((m1 * l1**2 + m2 * (3 * l1**2 + l1 * l2 * cos(q))) / 3, [m1, m2])
    (m1 + 3*m2)*l1**2/3 + l1*l2*m2*cos(q)/3
    """
    if number_of_terms(expression) > _MOST:
        return None
    factors = dict[Expr, Expr]()
    for term in summands(expand(expression)):
        numbers_and_masses, others = _core.number(1), _core.number(1)
        for part in parts_of(term, "product"):
            if part.is_number or part in masses:
                numbers_and_masses *= part
            else:
                others *= part
        factors[others] = factors.get(others, _core.number(0)) + numbers_and_masses
    joined = dict[tuple[Expr, Expr, bool], Expr]()
    for others, total in factors.items():
        lengths, functions = _lengths_and_functions(others)
        key = (total, lengths, functions.is_number)
        joined[key] = joined.get(key, _core.number(0)) + functions
    terms = (
        (with_number_outside(total), lengths * functions) for (total, lengths, _), functions in joined.items()
    )
    found = _core.sum_of([part if others.is_number else others * part for part, others in terms])
    return found if found == expression else None


def _lengths_and_functions(product: Expr) -> tuple[Expr, Expr]:
    """Return the factors of a product that are constant, and those that depend on time."""
    lengths, functions = _core.number(1), _core.number(1)
    for part in parts_of(product, "product"):
        if any(leaf.kind == "time_function" for leaf in part.free_symbols):
            functions *= part
        else:
            lengths *= part
    return lengths, functions


def has_common_fraction(form: Expr) -> bool:
    """Return whether a fraction stands before a sum of several kinds of terms: ``1/6*(2*l2 + 3*l1*cos(q))``.

    >>> from symbody import functions_of_time, sin, symbols
    >>> q, (m, M, l) = functions_of_time("q"), symbols("m M l")
    >>> has_common_fraction((m * l**2 + 3 * M * sin(q)) / 3), has_common_fraction((m + 3 * M) * l**2 / 3)
    (True, False)
    """
    return any(map(_is_common_fraction, nodes_of(form)))


def _is_common_fraction(node: Expr) -> bool:
    factors = parts_of(node, "product")
    fractions = [part for part in factors if part.is_number and not part.is_decimal and part.ratio[1] > 1]
    return any(
        part.kind == "sum" and not _is_coefficient(part, fractions[0]) for part in factors if fractions
    )


def _is_coefficient(total: Expr, fraction: Expr) -> bool:
    """Return whether a sum is of parameters, each to the first power, or of functions with equal denominators.

    So is ``3*cos(q) + cos(p)`` behind 1/2, but ``2 + 3*cos(q)`` isn't behind 1/6, of which it leaves 1/3 and 1/2.
    """
    terms = [parts_of(term, "product") for term in summands(total)]
    others = [[part for part in parts if not part.is_number] for parts in terms]
    if all(len(parts) <= 1 and all(part.kind == "symbol" for part in parts) for parts in others):
        return True
    if any(leaf.kind == "symbol" for leaf in total.free_symbols):
        return False
    numbers = [next((part for part in parts if part.is_number), _core.number(1)) for parts in terms]
    return len({(fraction * each).ratio[1] for each in numbers if not each.is_decimal}) == 1
