"""Forms that are shown: without symbols on which the value doesn't depend, and without nested rotations.

Derivations leave products of rotations in brackets, ``cos(q2)*(l*q1'' + g*cos(q1)) + sin(q2)*(l*q1'**2 - g*sin(q1))``,
and brackets in which the factor before them occurs again, ``m*l**2 + l*(l*m + l*m*cos(q2))``: the form of the
computation. What is shown is the form for the reader. The entries of a matrix are read together, so that a quantity
that occurs in two of them has one form.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from symbody.errors import SymbodyError
from symbody.symbolic._core import Expr

from .by_rates import by_rates
from .cost import cost
from .derivative import substitute
from .energy_form import energy_form, flat_inertia
from .idle import idle_symbols, without_idle_symbols
from .reading import WAVES, awkward_parts, functions_within_functions, multiples_of_angles, nodes_of, parts_of
from .rewrite import textbook_form
from .shortest_text import coefficient_form, shortest_text

__all__ = ["ShownForms", "shown_form"]


def shown_form(expression: Expr) -> Expr:
    """Return an expression as it is, or a form for the reader.

    An expression has another form if it holds symbols on which its value doesn't depend, or products of rotations in
    brackets whose form for the reader is much shorter.

    >>> from symbody import cos, functions_of_time, sin, symbols
    >>> a, b, c = symbols("a b c")
    >>> shown_form(a * (b + c) - a * c), shown_form(a * (b + c))
    (a*b, a*(b + c))
    >>> p, q = functions_of_time("p q")
    >>> shown_form(sin(p) * (a * sin(q) + b * sin(p) * cos(q)) + cos(p) * (b * cos(p) * cos(q) - a * cos(q)))
    b*cos(q) - a*cos(p + q)
    """
    return ShownForms()(expression)


class ShownForms:
    """Finds the forms that are shown of the expressions in one thing; the time for all of them is bounded.

    >>> from symbody import symbols
    >>> a, b, c = symbols("a b c")
    >>> forms = ShownForms()
    >>> forms(a * (b + c) - a * c), forms(b)
    (a*b, b)
    """

    def __init__(self) -> None:
        self._known: dict[int, Expr] = {}
        self._left = _TOTAL

    def __call__(self, expression: Expr) -> Expr:
        """Return an expression as it is, or a form for the reader."""
        known = self._known.get(expression.id)
        if known is None:
            known = self._known[expression.id] = self._form(expression)
        return known

    def read_together(self, entries: Iterable[Expr]) -> None:
        """Find the forms of the entries of a matrix: if one of them is derived, all of them have forms for the reader.

        >>> from symbody import cos, functions_of_time, symbols
        >>> q, (m, l) = functions_of_time("q"), symbols("m l")
        >>> forms, coupling = ShownForms(), m * l**2 + m * l**2 * cos(q)
        >>> forms.read_together([m * l**2 + l * (2 * l * m + 2 * l * m * cos(q)), coupling])
        >>> forms(coupling)
        m*l**2*(1 + cos(q))
        """
        new, left = dict[int, Expr](), self._left
        for entry in entries:
            operations = cost(entry).total
            is_known = entry.id in self._known or entry.id in new
            if not is_known and operations <= min(left, _ROTATED) and not idle_symbols([entry]):
                new[entry.id] = entry
                left -= operations
        derived = [entry for entry in new.values() if _is_derived(entry)]
        if any(_is_better(_coefficient(entry), entry) for entry in derived):
            self._known |= {place: flat_inertia(entry, _coefficient(entry)) for place, entry in new.items()}
            self._left = left

    def _form(self, expression: Expr) -> Expr:
        if idle_symbols([expression]):
            return min(_forms(expression), key=lambda form: len(idle_symbols([form])))
        operations = cost(expression).total
        if operations > min(self._left, _ROTATED) or functions_within_functions(expression) > _DEEP:
            return expression
        energy = energy_form(expression)
        if energy is not None or not _is_nested(expression):
            self._left -= operations if energy is not None else 0
            return expression if energy is None else energy
        self._left -= operations
        return _without_rotations(expression)


_ROTATED, _TOTAL = 120, 700
"""The operations of one expression with products of rotations, and of all of them together, up to which the form for
the reader is looked for: about a second."""


_DEEP = 8
"""Functions within functions up to which another form is looked for, as each is one in its argument as well."""


def _without_rotations(expression: Expr) -> Expr:
    """Return the form for the reader of an expression with products of rotations, if it is much shorter or flatter."""
    found = _read(expression)
    return found if _is_better(found, expression) else expression


def _read(expression: Expr) -> Expr:
    """Return the form for the reader: with the terms of speeds and of gravity apart, unless that is much longer."""
    apart = by_rates(expression, _coefficient)
    if cost(expression).total > _SHORT:
        return _coefficient(expression) if apart is None else apart
    found = flat_inertia(expression, shortest_text(expression))
    return apart if apart is not None and len(str(apart)) <= _APART * len(str(found)) else found


def _coefficient(expression: Expr) -> Expr:
    """Return the form of a coefficient: ``2*sin(q)*cos(q)``, as double angles belong to no frame."""
    found = coefficient_form(expression)
    if not multiples_of_angles(found) - multiples_of_angles(expression):
        return found
    flat = textbook_form(expression)
    is_shorter = len(str(flat)) <= _SINGLE * len(str(found))
    return flat if is_shorter and not multiples_of_angles(flat) else found


_SHORT = 40
"""Operations up to which all forms for the reader are looked for."""
_SINGLE = 1.5
"""The length of a form without new multiples of angles, at most, in relation to one that has them."""
_APART, _SHORTER = 1.5, 0.9
"""The length of a form with the terms of speeds and of gravity apart, at most, in relation to the shortest one; and of
the form that is shown in relation to the given one."""


def _is_nested(expression: Expr) -> bool:
    """Return whether an expression that moves is in a form of the computation."""
    if any(map(_is_rotated, nodes_of(expression))):
        return True
    is_moving = any(leaf.kind == "time_function" for leaf in expression.free_symbols)
    return is_moving and (awkward_parts(expression) > 0 or any(map(_has_like_brackets, nodes_of(expression))))


def _is_better(form: Expr, entry: Expr) -> bool:
    """Return whether a form is much shorter than an entry, or as long with fewer awkward terms or operations."""
    most = _FLATTER if awkward_parts(form) < awkward_parts(entry) else _SHORTER
    length, given = len(str(form)), len(str(entry))
    return length <= most * given or (length <= given and cost(form).total < cost(entry).total)


_FLATTER = 1.2
"""The length of a form with fewer awkward terms, at most, in relation to the given one."""


def _is_derived(entry: Expr) -> bool:
    """Return whether an entry of a matrix is in a form of the computation."""
    return _is_nested(entry) or any(map(_is_expanded, nodes_of(entry)))


def _is_expanded(node: Expr) -> bool:
    """Return whether a node is a sum of products of waves, or of terms with a factor to take out."""
    terms = [parts_of(term, "product") for term in parts_of(node, "sum")] if node.kind == "sum" else []
    turned = [factors for factors in terms if sum(map(_waves, factors)) >= _PRODUCT]
    return len(turned) > 1 or _has_like_brackets(node)


def _has_like_brackets(node: Expr) -> bool:
    """Return whether brackets in a product have a factor to take out, or a sum has one beside brackets."""
    if node.kind == "product":
        sums = (factor for factor in parts_of(node, "product") if factor.kind == "sum")
        return any(map(_has_factor_of_all_terms, sums))
    terms = [parts_of(term, "product") for term in parts_of(node, "sum")] if node.kind == "sum" else []
    return any(_has_factor_in_common(factors, terms) for factors in terms)


def _has_factor_in_common(factors: list[Expr], terms: list[list[Expr]]) -> bool:
    """Return whether a term with brackets has a factor, or one in its brackets, that another term of the sum has."""
    if not any(factor.kind == "sum" for factor in factors):
        return False
    bare = {factor.id for factor in factors if factor.kind in {"symbol", "time_function"}}
    return any(bare & {factor.id for factor in other} for other in terms if other is not factors)


def _has_factor_of_all_terms(total: Expr) -> bool:
    """Return whether all terms of a sum have one factor, as those of ``a*M + a*m``."""
    terms = ({factor.id for factor in parts_of(term, "product")} for term in parts_of(total, "sum"))
    return bool(set.intersection(*terms))


def _is_rotated(node: Expr) -> bool:
    """Return whether a product has brackets in which products of sines and cosines stand, with those before it."""
    if node.kind != "product":
        return False
    factors = parts_of(node, "product")
    outside = sum(map(_waves, factors))
    terms = (term for factor in factors if factor.kind == "sum" for term in parts_of(factor, "sum"))
    return any(outside + sum(map(_waves, parts_of(term, "product"))) >= _PRODUCT for term in terms)


def _waves(factor: Expr) -> int:
    """Return the number of sines and cosines that a factor is, two for a power."""
    if factor.kind == "power":
        return _PRODUCT * any(map(_waves, parts_of(factor.args[0], "product")))
    return int(factor.kind == "function" and factor.name in WAVES)


_PRODUCT = 2


def _forms(expression: Expr) -> Iterator[Expr]:
    """Yield forms of the same value; the given one comes last."""
    is_short = cost(expression).total <= _READ
    if is_short:
        yield _read(expression)
    (shorter,) = without_idle_symbols([expression])
    yield shorter
    for place in _PLACES:
        found = _at(place, expression)
        if found is not None and found == expression:
            yield _read(found) if is_short else found
    yield expression


_READ = 250
"""Operations of an expression up to which the form for the reader is looked for; it takes seconds for longer ones."""
_PLACES = (1, 2)
"""Numbers that take the place of idle symbols."""


def _at(place: int, expression: Expr) -> Expr | None:
    try:
        return substitute([expression], dict.fromkeys(idle_symbols([expression]), place))[0]
    except SymbodyError:  # undefined there
        return None
