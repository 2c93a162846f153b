"""Forms for the reader: the shortest text of a few forms, without brackets inside brackets of one factor."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import prod

from symbody.symbolic._core import Expr

from .by_rates import by_rates
from .cost import cost
from .over_divisors import over_divisors
from .reading import awkward_terms, multiples_of_angles, parts_of, reading, waves_in
from .rewrite import expand, expand_trig, short_form, simplify, textbook_form
from .standard_names import standard_names
from .terms import MOST as _TERMS
from .terms import number_of_terms

__all__ = ["coefficient_form", "shortest_text"]

_OF_COEFFICIENT = 1000
"""The same of one coefficient among many."""
_READ = 250
"""Operations of an expression up to which all forms are tried."""
_LONG = 20_000
"""Characters from which on an expression is as long in any form."""
_FLAT = 8
"""Characters by which a form without nested brackets may be longer than the simplest one."""


def shortest_text(expression: Expr) -> Expr:
    """Return the form that reads shortest; from that of a short expression, no shorter one is found."""
    for _ in range(_ROUNDS if cost(expression).total <= _SHORT else 1):
        found = _over_divisors(_more_readable(expression))
        if found.same_form(expression):
            break
        expression = found
    return expression


_ROUNDS, _SHORT = 4, 30
"""How often a form is looked for, at most, and the operations up to which it is: each is found from the one before."""


def _over_divisors(form: Expr) -> Expr:
    """Return a form with the terms of one divisor over it, unless that is longer: entries of a matrix are alike so."""
    found = over_divisors(form)
    return found if len(str(found)) <= len(str(form)) and found == form else form


def _more_readable(expression: Expr) -> Expr:
    """Return the form that reads shortest in standard names, unless another one is shorter in the names of the user."""
    form = short_form(expression)
    if form.is_variable or form.is_number or len(str(form)) > _LONG:
        return form
    names = standard_names([], [expression])
    standard = names.standard(expression)
    found = _best((names.original(_shortest(standard)), form), expression)
    return _unless_longer(found, _simplest(expression))


def _shortest(expression: Expr) -> Expr:
    """Return the form that reads shortest; of equals, the first one."""
    form, simplest = short_form(expression), _simplest(expression)
    known = form if simplest.same_form(expression) else None
    found = _best((form, *_flat(simplest, known), *_forms(expression, form)), expression)
    return _unless_longer(found, simplest)


def _unless_longer(found: Expr, simplest: Expr) -> Expr:
    """Return a form, or the simplest one if that is shorter and has no more multiples of angles."""
    more = 0 if awkward_terms(found) else _FLAT
    is_shorter = len(str(simplest)) + more < len(str(found))
    return simplest if is_shorter and multiples_of_angles(simplest) <= multiples_of_angles(found) else found


def _forms(expression: Expr, form: Expr) -> Iterator[Expr]:
    """Yield further forms of an expression, whose short form is known."""
    if awkward_terms(form):
        yield textbook_form(expression)
        if number_of_terms(expression) <= _TERMS:
            yield expand(expression)
    found = by_rates(expression, coefficient_form) if cost(expression).total <= _READ else None
    if found is not None:
        yield found


def _simplest(expression: Expr, most: int = _TERMS) -> Expr:
    """Return the simplest form that is found from the terms; what has too many stays as it is."""
    return simplify(expand(expression)) if number_of_terms(expression) <= most else expression


def _flat(simplest: Expr, known: Expr | None = None) -> Iterator[Expr]:
    """Yield flat forms of the simplest one; its short form may be known."""
    yield simplest
    yield short_form(simplest) if known is None else known
    if multiples_of_angles(simplest) and _terms_of_opened(simplest) <= _OPENED:
        yield short_form(expand_trig(simplest))


def coefficient_form(expression: Expr) -> Expr:
    """Return the form that reads shortest of a few that are found in no time.

    >>> from symbody import cos, sin, symbols
    >>> a, b = symbols("a b")
    >>> coefficient_form(a * sin(b) ** 2 + a * cos(b) ** 2)
    a
    """
    return _best((textbook_form(expression), *_flat(_simplest(expression, _OF_COEFFICIENT))), expression)


def _best(forms: Iterable[Expr], given: Expr) -> Expr:
    """Return the form that reads best, of those that have the value of the given expression; of equals the first."""
    angles = multiples_of_angles(given)
    best, least = given, reading(given, angles)
    for form in forms:
        if len(str(form)) < least and form == given and (length := reading(form, angles)) < least:
            best, least = form, length
    return best


def _terms_of_opened(expression: Expr) -> int:
    """Return about how many terms the expansion of a sine has: a factor 2 for each term, n for a multiple n."""
    counts = dict[int, int]()
    for wave in waves_in(expression):
        (angle,) = wave.args
        if number_of_terms(angle) > _OPENED:
            return _OPENED + 1
        terms = parts_of(expand(angle), "sum")
        inside = max((counts[inner.id] for inner in waves_in(angle)), default=1)
        factors = (part for term in terms for part in parts_of(term, "product") if part.is_number)
        multiples = prod(max(abs(top), 1) for top, _ in (factor.ratio for factor in factors))
        counts[wave.id] = 2 ** min(len(terms) * inside, _OPENED) * multiples
    return max(counts.values(), default=1)


_OPENED = 200
"""The largest number of terms to which a sine is expanded; an expansion with more is longer than the sine."""
