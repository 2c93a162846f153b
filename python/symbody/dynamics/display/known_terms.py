"""Replace terms of a sum by the name of an equal quantity: `c + a*b - d` is `c + n1` where `n1 := a*b - d`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import reduce
from math import gcd, lcm
from typing import NamedTuple

from symbody.symbolic import Expr, number, substitute


class _Monomial(NamedTuple):
    """A product of powers.

    Attributes:
        coefficient: its number.
        powers: its other factors with their exponents; a sum without its common factors.
    """

    coefficient: Fraction
    powers: frozenset[tuple[Expr, int]]

    def over(self, other: _Monomial) -> _Monomial | None:
        """Return the quotient if the other one divides this."""
        powers, less = dict(self.powers), dict(other.powers)
        if any(powers.get(base, 0) < exponent for base, exponent in less.items()):
            return None
        left = ((base, exponent - less.get(base, 0)) for base, exponent in powers.items())
        return _Monomial(self.coefficient / other.coefficient, frozenset(each for each in left if each[1]))

    def times(self, other: _Monomial) -> _Monomial:
        powers = Counter(dict(self.powers))
        powers.update(dict(other.powers))
        return _Monomial(self.coefficient * other.coefficient, frozenset(powers.items()))


class KnownTerms:
    """Named quantities, and the terms of which each is the sum.

    >>> from symbody import symbols
    >>> a, b, c, d, w = symbols("a b c d w")
    >>> known = KnownTerms()
    >>> known.add(w, a * b - d)
    >>> known.rewritten(a * b + c - d), known.rewritten(c - 2 * a**2 * b + 2 * a * d)
    (c + w, c - 2*a*w)
    """

    def __init__(self) -> None:
        self._quantities = list[tuple[Expr, list[_Monomial], set[Expr]]]()
        self._sums = dict[frozenset[_Monomial], tuple[Expr, int]]()
        self._monomials = dict[Expr, _Monomial]()

    def add(self, name: Expr, value: Expr) -> None:
        """Add a quantity."""
        parts = [self._monomial(term) for term in _terms(value)]
        if factors := self._factors(parts):
            self._quantities.append((name, parts, factors))

    def rewritten(self, expression: Expr) -> Expr:
        """Return the expression with names for the terms that add up to a quantity; itself if there are none."""
        given = terms = _terms(expression)
        factors = self._factors(map(self._monomial, terms))
        for name, parts, needed in reversed(self._quantities):
            if needed <= factors:
                terms = self._with_name(terms, name, parts)
        inner = {each: self.rewritten(each) for term in terms for each in _sums_in(term)}
        changed = {old: new for old, new in inner.items() if old is not new}
        if terms is given and not changed:
            return expression
        return sum(substitute(terms, changed) if changed else terms, start=number(0))

    @staticmethod
    def _factors(monomials: Iterable[_Monomial]) -> set[Expr]:
        return {base for each in monomials for base, _ in each.powers}

    def _with_name(self, terms: list[Expr], name: Expr, parts: Sequence[_Monomial]) -> list[Expr]:
        places = {self._monomial(term): place for place, term in enumerate(terms)}
        for each in places if len(parts) <= len(places) else ():
            factor = each.over(parts[0])
            used = [places.get(part.times(factor)) for part in parts] if factor else [None]
            if factor and None not in used:
                left = [term for place, term in enumerate(terms) if place not in used]
                return self._with_name([*left, _product(factor) * name], name, parts)
        return terms

    def _monomial(self, term: Expr) -> _Monomial:
        if term not in self._monomials:
            self._monomials[term] = self._found(term)
        return self._monomials[term]

    def _found(self, term: Expr) -> _Monomial:
        if term.kind == "number":
            return _Monomial(Fraction(*term.ratio), frozenset())
        if term.kind == "product":
            return reduce(_Monomial.times, map(self._monomial, term.args))
        if term.kind == "power" and _is_whole(term.args[1]):
            return reduce(_Monomial.times, [self._monomial(term.args[0])] * term.args[1].ratio[0])
        return self._of_sum(term) if term.kind == "sum" else _Monomial(Fraction(1), frozenset({(term, 1)}))

    def _of_sum(self, total: Expr) -> _Monomial:
        """Return a sum as a product of its common factors and a sum without them, of one sign."""
        terms = [self._monomial(term) for term in total.args]
        common = reduce(Counter.__and__, (Counter(dict(term.powers)) for term in terms))
        numbers = [term.coefficient for term in terms]
        content = Fraction(gcd(*(n.numerator for n in numbers)), lcm(*(n.denominator for n in numbers)))
        factor = _Monomial(content, frozenset(common.items()))
        rest = [quotient for term in terms if (quotient := term.over(factor))]
        opposite = frozenset(each._replace(coefficient=-each.coefficient) for each in rest)
        if opposite not in self._sums:
            made = sum(map(_product, rest), start=number(0))
            self._sums.setdefault(frozenset(rest), (made, 1))
            base, sign = self._sums[frozenset(rest)]
        else:
            base, sign = self._sums[opposite][0], -1
        return factor.times(_Monomial(Fraction(sign), frozenset({(base, 1)})))


def _terms(expression: Expr) -> list[Expr]:
    """Return the terms of a sum; sums, and multiples of sums, among them are opened."""
    if expression.kind == "sum":
        return [term for each in expression.args for term in _terms(each)]
    if expression.kind == "product" and len(expression.args) == 2:
        factor, total = expression.args
        if factor.kind == "number" and total.kind == "sum":
            return [factor * term for term in _terms(total)]
    return [expression]


def _sums_in(term: Expr) -> Iterator[Expr]:
    """Return the sums that are factors of a term, or bases of its factors."""
    for each in term.args if term.kind in {"product", "power"} else ():
        if each.kind == "sum":
            yield each
        else:
            yield from _sums_in(each)


def _is_whole(exponent: Expr) -> bool:
    return exponent.kind == "number" and exponent.ratio[1] == 1 and exponent.ratio[0] > 0


def _product(monomial: _Monomial) -> Expr:
    powers = (base**exponent for base, exponent in sorted(monomial.powers, key=lambda each: str(each[0])))
    return reduce(Expr.__mul__, powers, number(monomial.coefficient))
