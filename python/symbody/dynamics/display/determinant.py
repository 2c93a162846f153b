"""A divisor that solved equations share, the determinant of the mass matrix: one form of it, and a name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from symbody.multibody import Variables
from symbody.symbolic import Expr, cos, cost, number, simplify, sin, substitute, symbol
from symbody.symbolic.calculus.quotient import Quotient, powers, quotient
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.expression.traverse import post_order

from .degree import degrees
from .like_terms import joined
from .row import printed, written
from .short_names import Definition, in_order_of_use

_NAMES = ("D", "Delta", "det")
_LONG = 4
"""Operations of a divisor from which on it has a name."""
_MOST, _IN_ALL = 150, 500
"""Operations of a numerator, and of all values, up to which they are brought over a common divisor."""
_RATIOS = tuple(number(ratio) for ratio in (1, -1, 2, -2))


class Divided(NamedTuple):
    """Values over a divisor that has a name.

    Attributes:
        name: the name of the divisor.
        divisor: what it stands for.
        rows: the terms of each value.
    """

    name: Expr
    divisor: Expr
    rows: tuple[tuple[Expr, ...], ...]


def over_determinant(rows: Sequence[Sequence[Expr]], system: Variables, reader: Reader) -> Divided | None:
    """Return values over the longest divisor that two of them share; None if they have none, or are too long.

    Args:
        rows: the terms of each value, of which each is one quotient.
        system: the system to which the values belong.
        reader: which finds the forms.
    """
    terms = [term for row in rows for term in row]
    if cost(terms).total > _IN_ALL or (name := _free_name(system)) is None:
        return None
    quotients = [_reduced(term) for term in terms]
    divisor = _shared(quotients)
    if divisor is None:
        return None
    form = _form(divisor, reader)
    made = iter(
        [_over(term, each, form, name, system, reader) for term, each in zip(terms, quotients, strict=True)]
    )
    return Divided(name, form, tuple(tuple(next(made) for _ in row) for row in rows))


def _free_name(system: Variables) -> Expr | None:
    taken = {leaf.name for leaf in system.leaves}
    return next((symbol(name) for name in _NAMES if name not in taken), None)


def _reduced(term: Expr) -> Quotient:
    """Return a term as a quotient whose numerator has no factor of the denominator, as far as it shows."""
    found = quotient(term)
    if not found.bottom or cost(found.top).total > _MOST:
        return found
    bottom = powers({simplify(base): exponent for base, exponent in found.bottom.items()})
    return quotient(simplify(found.top) / bottom)


def _shared(quotients: Iterable[Quotient]) -> Expr | None:
    """Return the divisor with the most operations, of those that occur twice."""
    counts = Counter[Expr]()
    for each in quotients:
        for base, exponent in each.bottom.items():
            known = next((other for other in counts if _ratio(base, other) is not None), base)
            counts[known] += exponent if cost(base).total >= _LONG else 0
    often = [base for base, count in counts.items() if count > 1]
    return max(often, key=lambda base: cost(base).total, default=None)


def _ratio(base: Expr, other: Expr) -> Expr | None:
    return next((ratio for ratio in _RATIOS if base == ratio * other), None)


def _form(divisor: Expr, reader: Reader) -> Expr:
    """Return the shortest form of a divisor, or of its opposite if that is positive for positive parameters."""
    if _is_negative(divisor):
        divisor = -divisor
    forms = (divisor, reader.form(divisor), reader.simplest_form(divisor), reader.shortest_form(divisor))
    return min(map(_with_squares_of_sines, forms), key=reader.length)


def _with_squares_of_sines(form: Expr) -> Expr:
    """Return a form with ``sin(a)**2`` for ``1 - cos(a)**2``."""
    nodes = post_order([form], lambda node: node.args, lambda node: node.id)
    angles = [node.args[0] for node in nodes if node.kind == "function" and node.name == "cos"]
    return substitute([form], {1 - cos(angle) ** 2: sin(angle) ** 2 for angle in angles})[0]


def _is_negative(divisor: Expr) -> bool:
    leaves = sorted(divisor.free_symbols, key=str)
    return divisor.evaluate({leaf: 1 + place / 10 for place, leaf in enumerate(leaves)}) < 0


def _over(term: Expr, parts: Quotient, divisor: Expr, name: Expr, system: Variables, reader: Reader) -> Expr:
    """Return a term by the name of the divisor; by itself if the divisor isn't in it.

    Args:
        term: the term.
        parts: the term as a quotient.
        divisor: the form of the divisor.
        name: its name.
        system: the system to which the term belongs.
        reader: which finds the forms.
    """
    plain = reader(term)
    others = () if cost(term).total > _MOST else (quotient(reader.shortest_form(term)),)
    forms = (_by_name(each, divisor, name, system, reader) for each in (parts, *others))
    made = [form for form in forms if form is not None and substitute([form], {name: divisor}) == (term,)]
    return min(made, key=reader.length, default=plain)


def _by_name(parts: Quotient, divisor: Expr, name: Expr, system: Variables, reader: Reader) -> Expr | None:
    """Return a quotient by the name of the divisor; None if the divisor isn't in it.

    Args:
        parts: the quotient.
        divisor: the form of the divisor.
        name: its name.
        system: the system to which the quotient belongs.
        reader: which finds the forms.
    """
    ratios = ((base, _ratio(base, divisor)) for base in parts.bottom)
    found, ratio = next((pair for pair in ratios if pair[1] is not None), (None, None))
    if found is None or ratio is None:
        return None
    exponent, others = parts.bottom[found], {base: n for base, n in parts.bottom.items() if base != found}
    top = parts.top / ratio**exponent
    return _numerator(top, system, reader) / powers(others) / name**exponent


def _numerator(top: Expr, system: Variables, reader: Reader) -> Expr:
    """Return the shortest form of a numerator: of the whole, or with one coefficient for each product of speeds."""
    forms = [reader(top), reader.form(top)]
    if cost(top).total <= _MOST:
        forms.append(reader.simplest_form(top))
        (found,) = degrees([top], system.speeds)
        if found is not None:
            terms = joined([*found.quadratic, *found.linear], reader)
            forms.append(sum(terms, start=number(0)) + reader(found.constant))
    return min((form for form in forms if form == top), key=reader.length)


def printed_rows(
    rows: Sequence[Sequence[Expr]],
    divided: Divided | None,
    notation: str,
    system: Variables,
    further: Sequence[Sequence[Expr]] = (),
) -> tuple[list[Definition], list[str]]:
    """Return named quantities and printed rows: over a divisor with a name if that is shorter in all.

    Args:
        rows: the terms of each row.
        divided: the rows over a divisor; None if they have none.
        notation: "text" or "latex".
        system: the system to which the rows belong.
        further: rows that have no divisor.
    """
    plain = _printed([*rows, *further], (), notation, system)
    if divided is None:
        return plain
    named = [(divided.name, divided.divisor)]
    lengths = (
        _length(_printed([*each, *further], pairs, "text", system))
        for each, pairs in ((divided.rows, named), (rows, ()))
    )
    return (
        _printed([*divided.rows, *further], named, notation, system)
        if next(lengths) < next(lengths)
        else plain
    )


def _printed(
    rows: Sequence[Sequence[Expr]], named: Sequence[tuple[Expr, Expr]], notation: str, system: Variables
) -> tuple[list[Definition], list[str]]:
    pairs = [side for pair in named for side in pair]
    shared, texts = printed([*(term for row in rows for term in row), *pairs], notation, system)
    remaining = iter(texts)
    sides = [written(next(remaining) for _ in row) for row in rows]
    names = list(remaining)
    return in_order_of_use([*shared, *zip(names[::2], names[1::2], strict=True)]), sides


def _length(listing: tuple[list[Definition], list[str]]) -> int:
    definitions, sides = listing
    return sum(map(len, [*sides, *(side for pair in definitions for side in pair)]))
