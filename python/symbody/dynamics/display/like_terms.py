"""Terms with equal coefficients, joined: `c*(x1' - x2')` for `c*x1' - c*x2'`."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from symbody.symbolic import Expr, number
from symbody.symbolic.calculus.reader import Reader

from .degree import Product

_RATIOS = tuple(number(ratio) for ratio in (1, -1, 2, -2, Fraction(1, 2), Fraction(-1, 2)))
_SIGNS = _RATIOS[:2]
_SQUARE = 0.7
"""The length of the square of a sum of speeds, at most, in relation to that of its terms; others stay flat."""


def joined(products: Iterable[Product], reader: Reader, *, by_sign_only: bool = False) -> list[Expr]:
    """Return the terms of a sum of products, those with proportional coefficients as one term.

    Args:
        products: coefficients, and what they multiply.
        reader: which finds their forms.
        by_sign_only: whether to join terms only whose coefficients are equal or opposite.
    """
    groups: list[tuple[Expr, list[Product]]] = []
    for coefficient, factor in products:
        for common, members in groups:
            ratio = next(
                (r for r in (_SIGNS if by_sign_only else _RATIOS) if coefficient == r * common), None
            )
            if ratio is not None:
                members.append((ratio, factor))
                break
        else:
            groups.append((coefficient, [(number(1), factor)]))
    return [_product(common, members, reader) for common, members in groups]


def _product(common: Expr, members: list[Product], reader: Reader) -> Expr:
    if any(ratio.ratio[1] != 1 for ratio, _ in members):
        common, members = common / 2, [(2 * ratio, factor) for ratio, factor in members]
    total = sum((ratio * factor for ratio, factor in members), start=number(0))
    coefficient = reader(common)
    if len(members) == 1:
        return coefficient * total
    form = reader(total)
    return coefficient * (form if reader.length(form) < _SQUARE * reader.length(total) else total)
