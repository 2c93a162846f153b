"""Forms for the reader, one for each value: a quantity that occurs again is written as before."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from symbody.errors import ExpressionError
from symbody.symbolic._core import Expr, number, product_of
from symbody.symbolic.expression.functions import Abs, sign

from .by_parameters import by_lengths, by_parameters
from .by_products import by_products, has_common_fraction
from .cost import cost
from .derivative import substitute
from .difference import by_differences, with_differences
from .fractions_outside import (
    with_decimal_outside,
    with_fraction_inside,
    with_fractions_outside,
    with_numbers_inside,
)
from .phases import with_phases
from .reading import (
    angles_in,
    is_divisor,
    levels,
    multiples_of_angles,
    nodes_of,
    parts_of,
    reading,
)
from .rewrite import expand, expand_trig, factor_terms, short_form, simplify, textbook_form
from .shortest_text import shortest_text
from .squares import squared_sums, with_squares
from .standard_names import AS_GIVEN, StandardNames
from .summands import summands
from .sums_of_angles import in_sums_of_angles
from .terms import MOST, number_of_terms

_LARGE = 100
"""Operations from which on an expression stays as it is: nobody reads it."""
_PART_BY_PART = 400
"""Operations up to which such an expression is shortened part by part."""
_TOTAL = 1800
"""Operations of all expressions together, after which only small ones are rewritten."""
_SMALL = 20
_EXPANDED = 40
"""Operations up to which `textbook_form` looks for the form from the expanded expression, too."""
_LONGER = 2
"""How many times longer than an expression of more operations than `_EXPANDED` its form may be."""
_OF_BODIES, _SHORT = 100, 35
"""Operations up to which, and characters from which on, a form with a term for each body is looked for."""
_DIVIDED, _SAME = 0.95, 1.2
"""The length of a form with a term for each body, at most, in relation to another one; and if a known form has the
square of one of its sums, such as the distance of a mass from an axis, which stays the same in all equations."""
_FLAT = 1.25
"""The length of a form with a term for each length, at most, in relation to one with brackets in brackets."""
_OPENED = 200
"""Terms of an expression up to which the waves of sums of angles are multiplied out."""
_NESTED = 2
"""The levels of brackets of a form with a term for each body: ``m1*l1**2 + m2*(l1**2 + l2**2 + 2*l1*l2*cos(q))``."""
_ANGLE = 20
"""Characters by which an angle that is neither in the expression nor that of a frame makes a form longer."""
_RATIOS = (Fraction(-1), Fraction(2), Fraction(-2), Fraction(1, 2), Fraction(-1, 2))
"""What a known form may be multiplied by, as the same term occurs with other numbers."""


class Reader:
    """Finds the forms of a set of equations; opposite and doubled values have opposite and doubled forms.

    Differences that the user wrote stay together, where a form with them is no longer. The work is bounded by the
    operations of what is read, so that the result depends on the equations alone; it is done in standard names, so that
    other names give the same terms.
    """

    def __init__(
        self,
        names: StandardNames = AS_GIVEN,
        differences: Sequence[Expr] = (),
        inertias: Iterable[Expr] = (),
        angles: Iterable[Expr] = (),
    ) -> None:
        self._names = names
        self._inertias = sorted(map(names.standard, inertias), key=str)
        self._angles = tuple(map(names.standard, angles))
        self._differences = tuple(map(names.standard, differences))
        self._phases = {*self._angles}
        self._known: dict[Expr, Expr] = {}
        self._lengths: dict[int, int] = {}
        self._distances: set[Expr] = set()
        self._read = 0

    def all_of(self, expressions: Sequence[Expr]) -> list[Expr]:
        """Return the forms of expressions; short ones come first if all together take too much work."""
        sizes = [cost(each).total for each in expressions]
        order = range(len(expressions))
        for k in sorted(order, key=sizes.__getitem__) if sum(sizes) > _TOTAL else order:
            self(expressions[k])
        return [self(each) for each in expressions]

    def __call__(self, expression: Expr) -> Expr:
        """Return the form for the reader."""
        return self._names.original(self._read_standard(self._names.standard(expression)))

    def length(self, expression: Expr) -> int:
        """Return the length of an expression in standard names."""
        known = self._lengths.get(expression.id)  # expressions of one value may have several forms
        if known is None:
            known = self._lengths[expression.id] = _length(self._names.standard(expression))
        return known

    def form(self, expression: Expr) -> Expr:
        """Return the form for the reader of an expression by itself, which is read however long it is."""
        return self._names.original(self._in_phases(_flat_form(self._names.standard(expression))))

    def in_phases(self, expression: Expr) -> Expr:
        """Return an expression as it is, with one wave for waves of one angle."""
        return self._names.original(self._in_phases(self._names.standard(expression)))

    def form_of_large(self, expression: Expr) -> Expr:
        """Return the form for the reader; an expression that is too large is only shortened part by part.

        This finds the sums of angles in the weight of a long chain, whose rotations are nested.
        """
        operations = cost(expression).total
        if not _LARGE < operations <= _PART_BY_PART:
            return self(expression)
        return self._names.original(short_form(self._names.standard(expression)))

    def shortest_form(self, expression: Expr) -> Expr:
        """Return the form of a term of equations, or the form of a single expression if that is shorter."""
        standard = self._names.standard(expression)
        forms = [self._read_standard(standard)]
        if _SMALL < cost(standard).total <= _LARGE:
            forms.append(shortest_text(standard))
        return self._names.original(min(forms, key=_length))

    def simplest_form(self, expression: Expr) -> Expr:
        """Return the same of its simplest form."""
        return self._names.original(textbook_form(simplify(self._names.standard(expression))))

    def _read_standard(self, expression: Expr) -> Expr:
        known = self._known.get(expression)
        if known is None:
            known = self._multiple_of_known(expression)
            if known is None:
                known = self._in_phases(self._form(expression))
            self._known[expression] = known
        return known

    def _in_phases(self, form: Expr) -> Expr:
        """Return a form with one wave for waves of one angle, by angles of frames and of known forms if possible."""
        found = with_phases(form, self._phases)
        if found is not form:
            self._phases |= angles_in(found)
        return found

    def _multiple_of_known(self, expression: Expr) -> Expr | None:
        for ratio in _RATIOS:
            form = self._known.get(expression / ratio)
            if form is not None and (ratio == -1 or not (form.kind == "sum" or _has_fractions(-form))):
                return ratio * form
        return None

    def _form(self, expression: Expr) -> Expr:
        operations = cost(expression).total
        if operations > (_LARGE if self._read <= _TOTAL else _SMALL):
            return expression
        self._read += operations
        form = self._in_one_set_of_angles(expression)
        if operations > _EXPANDED and _length(form) > _LONGER * _length(expression):
            return short_form(expression)
        if operations > _EXPANDED >= cost(form).total:
            form = textbook_form(form)  # which is short enough now for all rules
        form = _with_factor_outside(
            self._by_bodies(expression, _by_signs(_with_positive_outside(form)), operations)
        )
        form = with_numbers_inside(self._by_products(form))
        shorter, used = by_differences(expression, self._differences)
        if used:
            other = with_differences(textbook_form(shorter), used)
            return _best((other, form), expression)
        return form

    def _by_bodies(self, expression: Expr, form: Expr, operations: int) -> Expr:
        """Return the form with a term for each body, if it is shorter: a square of a distance, and no part of it."""
        if not self._inertias or operations > _OF_BODIES or _length(form) < _SHORT:
            return form
        angles = multiples_of_angles(expression)
        best = _best((with_squares(form), form), expression)
        other = by_parameters(expression, self._inertias, self._shortest_factor)
        flat = by_lengths(expression, self._inertias, self._shortest_factor)
        if other is not None:
            nodes = nodes_of(other)
            is_same = flat is None and self._distances & set(nodes) and not any(map(is_divisor, nodes))
            most = (_SAME if is_same else _DIVIDED) * reading(best, angles)
            best = other if reading(other, angles) <= most else best
        is_flatter = flat is not None and levels(flat) < levels(best)
        best = flat if flat is not None and is_flatter and _length(flat) <= _FLAT * _length(best) else best
        self._distances |= squared_sums(best)
        return best

    def _shortest_factor(self, expression: Expr) -> Expr:
        """Return the form of what a mass multiplies; the derivative of a square is short as it is."""
        form = self._in_one_set_of_angles(expression)
        return _best((with_squares(form), expression), expression)

    def _in_one_set_of_angles(self, expression: Expr) -> Expr:
        """Return the textbook form by the angles of joints, or by those of frames if that is shorter."""
        form = _flat_form(expression)
        other = in_sums_of_angles(expression, self._angles, _form_with_sums) if self._angles else None
        if other is None:
            return form
        known = angles_in(expression) | {*self._angles}
        multiples = multiples_of_angles(expression)
        is_worth = bool(multiples_of_angles(form) - multiples) > bool(multiples_of_angles(other) - multiples)
        if is_worth and _length(other) <= _FLAT * _length(form):
            return other
        return min((form, other), key=lambda each: _length(each) + _ANGLE * len(angles_in(each) - known))

    def _by_products(self, form: Expr) -> Expr:
        """Return the form with a fraction for each term, in the place of one before brackets, or of nested ones."""
        has_fraction = has_common_fraction(form)
        if not self._inertias or not (has_fraction or levels(form) > _NESTED) or _is_divided(form):
            return form
        flat = by_products(form, self._inertias)
        if flat is None or _length(flat) > (_FLAT if has_fraction else 1) * _length(form):
            return form
        is_better = levels(flat) < levels(form) or len({*map(_number_of, summands(flat))}) > 1
        inside = with_fraction_inside(form) if is_better else None
        if inside is not None and inside == form and _length(inside) < _length(flat):
            return inside
        return flat if is_better else form


def _flat_form(expression: Expr) -> Expr:
    """Return the textbook form; a coordinate has flat squares, too: ``l**2 + 2*a*l*cos(q) + a**2``."""
    form = textbook_form(expression)
    if not any(map(_hides_a_square, nodes_of(form))) or number_of_terms(form) > _OPENED:
        return form
    return _best((textbook_form(expand(form)), form), expression)


def _hides_a_square(node: Expr) -> bool:
    """Return whether a product has a factor that is a term of its brackets, as ``a*(b + a)``."""
    factors = parts_of(node, "product")
    terms = [term for factor in factors if factor.kind == "sum" for term in parts_of(factor, "sum")]
    return any(factor in terms for factor in factors)


def _form_with_sums(expression: Expr) -> Expr:
    """Return the textbook form of an expression in which sums of angles have names; other angles are looked for."""
    form = textbook_form(expression)
    if all(angle.is_variable for angle in angles_in(form)) or cost(expression).total > _LARGE:
        return form
    try:
        opened = [expand_trig(expression)] if number_of_terms(expression) <= _OPENED else []
    except ExpressionError:  # too many terms
        opened = []
    opened = [each for each in opened if number_of_terms(each) <= MOST]
    others = (with_squares(textbook_form(simplify(each))) for each in (expression, *opened))
    return _best((form, *(other for other in others if not _has_fractions_inside(other))), expression)


def _with_factor_outside(form: Expr) -> Expr:
    """Return a sum with the factor outside that all terms have: ``m*(x**2/y**2 + 1)``; a sum in a product likewise.

    Lengths stay in a sum that multiplies a mass, ``m*(l2**2 + l1*l2*cos(q2))``; coordinates don't.
    """
    if form.kind == "product":
        made = number(1)
        for factor in form.args:
            made *= with_decimal_outside(_taken_out(factor, of_coordinates=True))
        return made if made == form and _length(made) <= _length(form) else form
    return _taken_out(form)


_COORDINATE = 3
"""The characters by which a sum may be longer with a coordinate outside."""


def _taken_out(form: Expr, *, of_coordinates: bool = False) -> Expr:
    if form.kind != "sum" or any(_has_brackets(term) for term in parts_of(form, "sum")):
        return form
    other = with_fractions_outside(factor_terms(form))
    shared = [part for part in parts_of(other, "product") if part.kind not in {"number", "sum"}]
    if of_coordinates:
        shared = [part for part in shared if any(leaf.kind == "time_function" for leaf in part.free_symbols)]
    most = _length(form) + (_COORDINATE if of_coordinates else 1)
    return other if shared and _length(other) <= most else form


def _has_brackets(term: Expr) -> bool:
    """Return whether a term has a sum in it, other than a sum of parameters as a factor."""
    factors = parts_of(term, "product")
    sums = [factor for factor in factors if factor.kind == "sum"]
    within = [part for factor in factors for part in (factor.args if factor in sums else (factor,))]
    is_moving = any(leaf.kind == "time_function" for factor in sums for leaf in factor.free_symbols)
    return is_moving or any(node.kind == "sum" for part in within for node in nodes_of(part))


def _best(forms: Iterable[Expr], value: Expr) -> Expr:
    """Return the form of a value that reads best, of equals the first one."""
    angles = multiples_of_angles(value)
    return min((form for form in forms if form == value), key=lambda form: reading(form, angles))


def _by_signs(form: Expr) -> Expr:
    """Return a form with signs in the place of quotients: ``x - a*sign(x)`` for ``x - a*Abs(x)/x``."""
    sizes = [node for node in nodes_of(form) if node.kind == "function" and node.name == "Abs"]
    if not sizes:
        return form
    (found,) = substitute([form], {size: sign(size.args[0]) * size.args[0] for size in sizes})
    found = textbook_form(found)
    return found if found == form and _length(found) < _length(form) else form


def _with_positive_outside(form: Expr) -> Expr:
    """Return a form with positive factors moved out of absolute values: ``a*Abs(x)/b`` for ``Abs(a*b*x)/b**2``."""
    sizes = {node: node.args[0] for node in nodes_of(form) if node.kind == "function" and node.name == "Abs"}
    apart = {
        size: _apart(parts_of(inner, "product")) for size, inner in sizes.items() if inner.kind == "product"
    }
    if not apart:
        return form
    (found,) = substitute([form], apart)
    return found if found == form and _length(found) < _length(form) else form


def _apart(factors: Sequence[Expr]) -> Expr:
    """Return the absolute value of a product, with positive parameters factored out."""
    outside, within = number(1), number(1)
    for factor in factors:
        base = factor.args[0] if factor.kind == "power" else factor
        if base.kind == "symbol" and base.assumption == "positive":
            outside *= factor
        else:
            within *= factor
    return outside * Abs(within)


def _has_fractions(total: Expr) -> bool:
    """Return whether a term of a sum has a fraction."""
    terms = summands(total)
    numbers = [_number_of(term) for term in terms]
    return len(terms) > 1 and any(not each.is_decimal and each.ratio[1] > 1 for each in numbers)


def _has_fractions_inside(form: Expr) -> bool:
    """Return whether a sum that is a factor has fractions in it."""
    factors = (
        part for node in nodes_of(form) if node.kind == "product" for part in parts_of(node, "product")
    )
    return any(map(_has_fractions, factors))


def _is_divided(form: Expr) -> bool:
    return any(map(is_divisor, nodes_of(form)))


def _number_of(term: Expr) -> Expr:
    """Return the size of the number that is a factor of a term."""
    return abs(product_of([part for part in parts_of(term, "product") if part.is_number]))


def _length(form: Expr) -> int:
    return len(str(form))
