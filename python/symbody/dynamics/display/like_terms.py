"""Terms with equal coefficients, joined: `c*(x1' - x2')` for `c*x1' - c*x2'`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import product

from symbody.symbolic import Expr, number
from symbody.symbolic.calculus.quadratic_form import QuadraticForm
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.reading import nodes_of

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
    terms = [_joined(common, members) for common, members in groups]
    found = _with_sums_squared(terms, reader, {})
    return [reader(common) * _short(total, reader) for common, total in found]


def _joined(common: Expr, members: list[Product]) -> Product:
    if any(ratio.ratio[1] != 1 for ratio, _ in members):
        common, members = common / 2, [(2 * ratio, factor) for ratio, factor in members]
    return common, sum((ratio * factor for ratio, factor in members), start=number(0))


def _short(total: Expr, reader: Reader) -> Expr:
    """Return the form of a sum of products of speeds: flat, or a product if that is much shorter.

    A difference is a product where they have a speed in common: ``(v1' - v2')*v1'``, but ``2*q1'*q2' + q2'**2``; a sum
    with a given rate, and one without squares, likewise: ``(Omega + q1')*q2'``, ``(q1' + q2')*l'``.
    """
    if total.kind in {"power", "time_function"}:
        return total
    form = reader(total)
    is_given = any(leaf.kind == "symbol" for leaf in total.free_symbols)
    is_bilinear = not any(node.kind == "power" for node in nodes_of(total))
    is_difference = form.kind == "product" and ("-" in str(form) or is_given or is_bilinear)
    shorter = reader.length(form) / reader.length(total)
    return form if shorter < (1 if is_difference else _SQUARE) else total


def _with_sums_squared(
    terms: list[Product], reader: Reader, known: dict[Expr, QuadraticForm | None]
) -> list[Product]:
    """Return ``(A - B)*u**2 + B*(u + v)**2`` for ``A*u**2 + B*(2*u*v + v**2)`` where it is shorter.

    The sums are the rates of the angles to which several relative angles add up.

    Args:
        terms: coefficients, and the sums of products of speeds that they multiply.
        reader: the reader that writes them.
        known: the quadratic forms found so far, by sum.
    """
    known |= {total: QuadraticForm.of(total) for _, total in terms if total not in known}
    forms = [known[total] for _, total in terms]
    squares = [place for place, (_, total) in enumerate(terms) if total.kind == "power"]
    sums = [place for place, (_, total) in enumerate(terms) if total.kind == "sum"]
    for first, second in product(squares, sums):
        (a, square), (b, rest) = terms[first], terms[second]
        one, other = forms[first], forms[second]
        if one is None or other is None:
            continue
        for sign in (1, -1):
            root = one.root_with(other, sign)
            if root is not None:
                before = [(a, square), (b, rest)]
                after = [(a - sign * b, square), (sign * b, root**2)]
                if _length(after, reader) < _length(before, reader):
                    changed = dict(zip((first, second), after, strict=True))
                    made = [changed.get(place, term) for place, term in enumerate(terms)]
                    kept = [each for each in made if not each[0].is_zero]
                    return _with_sums_squared(kept, reader, known)
    return terms


def _length(terms: Sequence[Product], reader: Reader) -> int:
    return sum(reader.length(reader(a)) + reader.length(b) for a, b in terms if not a.is_zero)
