"""Solutions of equations in closed form: linear ones, polynomials, and loops of sines and cosines.

Unknowns that follow from one equation are eliminated first. What is left is one equation in one unknown, or the
closure of a loop: two equations in two angles, or in an angle and a length. The sines and cosines of the angles, and
the length, are unknowns of a linear or bilinear system. Its last equation is linear in the sine and the cosine of one
angle.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations

from symbody.errors import ExpressionError
from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.derivative import jacobian, substitute
from symbody.symbolic.calculus.rewrite import expand_trig, simplify
from symbody.symbolic.expression.functions import acos, asin, cos, sin
from symbody.symbolic.expression.leaves import number, symbol
from symbody.symbolic.expression.traverse import post_order
from symbody.symbolic.given.arguments import brief, counted
from symbody.symbolic.linear.elimination import eliminated, is_linear
from symbody.symbolic.linear.symbolic_solve import solve

from .angle import Direction, directions, line
from .fraction import numerator
from .polynomial import coefficients, polynomial_roots

__all__ = ["solutions"]

Solution = dict[Expr, Expr]


def solutions(equations: Sequence[Expr], unknowns: Sequence[Expr]) -> list[Solution]:
    """Return the solutions of equations: expressions that are zero. Unknowns that stay free are in none of them.

    Args:
        equations: the expressions that are to be zero.
        unknowns: symbols, functions of time and their derivatives, each of which is an unknown of its own.

    Raises:
        ExpressionError: there is no closed form; the message names the unknowns that are left.

    >>> from symbody.symbolic import symbols, cos, sin
    >>> x, a, b, l = symbols("x a b l")
    >>> solutions([x**2 - a], [x])
    [{x: sqrt(a)}, {x: -sqrt(a)}]
    >>> phi = symbols("phi")
    >>> [found[phi] for found in solutions([l * cos(phi) - x + a, l * sin(phi) - b], [x, phi])]
    [atan2(b/l, sqrt(1 - b**2/l**2)), atan2(b/l, -sqrt(1 - b**2/l**2))]
    """
    _refuse_cases(equations, unknowns)
    names = _plain_names([*equations, *unknowns])
    back = {plain: leaf for leaf, plain in names.items()}
    plain_unknowns = substitute(tuple(unknowns), names)
    held = frozenset(plain_unknowns)
    plain = [numerator(each, held) for each in substitute(tuple(equations), names)]
    found = _first_form(plain, list(plain_unknowns), back)
    order = list(zip(plain_unknowns, unknowns, strict=True))
    return [
        {leaf: substitute((each[x],), back)[0] for x, leaf in order if x in each and each[x] != x}
        for each in found
    ]


def _refuse_cases(equations: Sequence[Expr], unknowns: Sequence[Expr]) -> None:
    """Refuse functions that are one expression here and another one there: their derivatives don't tell their zeros."""
    held = {*unknowns}
    for node in _nodes(equations):
        if node.kind == "function" and node.name in _BY_CASES and not held.isdisjoint(node.free_symbols):
            raise ExpressionError(
                f"solve: {brief(str(node))} is a different expression in each case; put the expression of one case in "
                "its place, and keep the solutions for which the case holds"
            )


_BY_CASES = frozenset({"Abs", "sign", "Max", "Min", "Piecewise"})


def _first_form(equations: list[Expr], unknowns: list[Expr], names: Solution) -> list[Solution]:
    """Return the solutions of equations as they stand, or of their simplest forms, in which squares cancel."""
    for forms in (equations, [simplify(each) for each in equations]):
        try:
            return _solved(forms, unknowns, alone=len(unknowns) == 1)
        except _NoClosedForm:
            continue
    shown = brief(", ".join(str(names.get(x, x)) for x in unknowns))
    raise ExpressionError(
        f"solve: no solution in closed form of {counted(len(equations), 'equation')} in {shown}; expected linear "
        "equations, polynomials of degree two, or loops in the sines and cosines of an angle; solve them with numbers"
    )


class _NoClosedForm(Exception):
    """The equations that are left are none of those that are known."""


def _nodes(expressions: Iterable[Expr]) -> list[Expr]:
    """Return the nodes of expressions, arguments first."""
    return post_order(expressions, lambda e: e.args, lambda e: e.id)


def _plain_names(expressions: Iterable[Expr]) -> dict[Expr, Expr]:
    """Return symbols for functions of time and their derivatives, so that each is an unknown of its own."""
    leaves = {leaf for each in expressions for leaf in each.free_symbols if leaf.kind == "time_function"}
    functions = sorted(leaves, key=lambda leaf: (-leaf.order, leaf.name))
    return {leaf: symbol(f"{leaf.name}({leaf.order})") for leaf in functions}


def _solved(equations: Sequence[Expr], unknowns: Sequence[Expr], *, alone: bool = False) -> list[Solution]:
    left = [each for each in equations if not each.is_zero]
    occurring = [x for x in unknowns if any(_holds(each, x) for each in left)]
    if any(not any(_holds(each, x) for x in occurring) for each in left):
        return []
    if not left:
        return [{}]
    if is_linear(left, occurring):
        found = _linear(left, occurring)
        return [] if found is None else [found]
    for step in (_one_unknown, _one_linear, _loop):
        result = step(left, occurring, alone=alone)
        if result is not None:
            return result
    raise _NoClosedForm


def _linear(equations: Sequence[Expr], unknowns: Sequence[Expr]) -> Solution | None:
    """Solve linear equations: without pivots, where they are few and have one solution."""
    if len(equations) == len(unknowns):
        try:
            return solve(equations, unknowns)
        except ExpressionError:
            pass
    return eliminated(equations, unknowns)


def _holds(e: Expr, x: Expr) -> bool:
    return x in e.free_symbols


def _continued(equations: Sequence[Expr], unknowns: Sequence[Expr], values: Solution) -> list[Solution]:
    """Return the solutions of further equations with some unknowns known."""
    held = frozenset(unknowns)
    rest = [numerator(each, held) for each in _put_in(equations, values)]
    others = [x for x in unknowns if x not in values]
    result = []
    for found in _solved(rest, others):
        known = {x: _put_in([value], found)[0] for x, value in values.items()}
        result.append({**known, **found})
    return result


def _put_in(expressions: Sequence[Expr], values: Solution) -> list[Expr]:
    """Return expressions with values substituted; if s and c are a sine and a cosine, ``cos(atan2(s, c))`` is c."""
    found = list(substitute(tuple(expressions), values))
    sides = {node: side for node in _nodes(found) if (side := _side(node)) is not None}
    return list(substitute(tuple(found), sides)) if sides else found


def _side(node: Expr) -> Expr | None:
    """Return c for ``cos(atan2(s, c))`` and s for its sine, if s and c are the sine and cosine of an angle."""
    if node.kind != "function" or node.name not in {"sin", "cos"}:
        return None
    (angle,) = node.args
    if angle.kind != "function" or angle.name != "atan2":
        return None
    s, c = angle.args
    return (s if node.name == "sin" else c) if (s**2 + c**2 - 1).is_zero else None


def _one_unknown(
    equations: Sequence[Expr], unknowns: Sequence[Expr], *, alone: bool
) -> list[Solution] | None:
    """Solve an equation that holds one unknown, and the others with its values."""
    for k, each in enumerate(equations):
        held = [x for x in unknowns if _holds(each, x)]
        if len(held) != 1:
            continue
        roots = _roots(each, held[0], alone=alone)
        if roots is not None:
            rest = [*equations[:k], *equations[k + 1 :]]
            return [found for root in roots for found in _continued(rest, unknowns, {held[0]: root})]
    return None


def _roots(e: Expr, x: Expr, *, alone: bool) -> list[Expr] | None:
    polynomial = coefficients(e, x)
    if polynomial is not None:
        return polynomial_roots(polynomial)
    unknown = _Angles.of([e], [x])
    if unknown is None:
        return _through_function(e, x)
    found = line(unknown.equations[0], *unknown.pairs[0])
    if found is None:
        return None
    P, Q, R = found
    if alone and P.is_zero:
        return unknown.back([[asin(-R / Q)]])[0]
    if alone and Q.is_zero:
        return unknown.back([[acos(-R / P)]])[0]
    if R.is_zero and alone:
        return unknown.back([[Direction(Q, -P, number(1)).angle]])[0]
    return unknown.back([[each.angle for each in directions(P, Q, R)]])[0]


def _through_function(e: Expr, x: Expr) -> list[Expr] | None:
    """Solve a polynomial in one power ``u**n`` with a fraction n: by ``u**n = y``."""
    inner = {
        node for node in _nodes([e]) if node.kind == "power" and _holds(node, x) and node.args[1].is_number
    }
    roots = [node for node in inner if node.args[1].ratio[1] != 1]
    if len(roots) != 1:
        return None
    y = symbol(f"{x}^")
    polynomial = coefficients(substitute((e,), {roots[0]: y})[0], y)
    if polynomial is None or any(_holds(each, x) for each in polynomial):
        return None
    base, n = roots[0].args
    values = polynomial_roots(polynomial) or []
    if n.ratio[0] in (1, -1):  # a root of a real number is not negative
        values = [value for value in values if not _is_negative(value)]
        if not values:
            return []
    found = [polynomial_roots(coefficients(base - value ** (1 / n), x) or []) for value in values]
    return [root for each in found if each for root in each] or None


def _is_negative(e: Expr) -> bool:
    return e.is_constant and e.evaluate() < 0


def _one_linear(equations: Sequence[Expr], unknowns: Sequence[Expr], *, alone: bool) -> list[Solution] | None:
    """Eliminate an unknown that occurs in an equation with a known coefficient; lengths before angles."""
    del alone
    if len(equations) < 2:
        return None
    for k, each in enumerate(equations):
        for x in unknowns:
            if not _holds(each, x):
                continue
            slope = jacobian(each, x)[0, 0]
            if any(_holds(slope, y) for y in unknowns):
                continue
            value = -substitute((each,), {x: number(0)})[0] / slope
            rest = [*equations[:k], *equations[k + 1 :]]
            try:
                return _continued(rest, unknowns, {x: value})
            except _NoClosedForm:
                continue
    return None


# --- loops ---


class _Angles:
    """Equations in sines and cosines of unknown angles, each by two symbols.

    Attributes:
        equations: the equations in these symbols and in other unknowns.
        pairs: the cosine and the sine of each angle.
    """

    def __init__(
        self, equations: list[Expr], pairs: list[tuple[Expr, Expr]], angles: list[Expr], x: list[Expr]
    ) -> None:
        self.equations, self.pairs, self._angles, self._unknowns = equations, pairs, angles, x

    @classmethod
    def of(cls, equations: Sequence[Expr], unknowns: Sequence[Expr]) -> _Angles | None:
        """Return equations in sines and cosines of their arguments; None where unknowns also occur outside of them."""
        nodes = [
            node
            for node in _nodes(equations)
            if node.kind == "function" and node.name in {"sin", "cos"} and node.free_symbols & {*unknowns}
        ]
        arguments = [node.args[0] for node in nodes]
        x = [each for each in unknowns if any(_holds(argument, each) for argument in arguments)]
        if not x or not is_linear(arguments, x):
            return None
        angles: list[Expr] = []
        for argument in arguments:
            if not any(_known_part(argument, angle, x) for angle in angles):
                angles.append(argument)
        if len(angles) > len(x):
            return None
        pairs = [(symbol(f"cos({k})"), symbol(f"sin({k})")) for k in range(len(angles))]
        mapping = {}
        for node in nodes:
            mapping[node] = _by_pairs(node, angles, pairs, x)
        plain = list(substitute(tuple(equations), mapping))
        if any(_holds(each, y) for each in plain for y in x):
            return None
        return cls(plain, pairs, angles, x)

    def back(self, values: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
        """Return the unknowns for values of the angles, case by case, of one unknown."""
        cases = zip(*values, strict=True)
        found = []
        for case in cases:
            equations = [angle - value for angle, value in zip(self._angles, case, strict=True)]
            solved = eliminated(equations, self._unknowns) or {}
            found.append([solved[x] for x in self._unknowns])
        return [list(each) for each in zip(*found, strict=True)]


def _known_part(argument: Expr, angle: Expr, unknowns: Sequence[Expr]) -> tuple[int, Expr] | None:
    """Return a sign and what is known of an argument ``sign*angle + known``; None if the rest isn't known."""
    for sign in (1, -1):
        rest = argument - sign * angle
        slopes = jacobian(rest, list(unknowns)).entries
        if all(each.is_zero for each in slopes):
            return sign, substitute((rest,), dict.fromkeys(unknowns, number(0)))[0]
    return None


def _by_pairs(
    node: Expr, angles: list[Expr], pairs: list[tuple[Expr, Expr]], unknowns: Sequence[Expr]
) -> Expr:
    """Return the sine or cosine of ``sign*angle + known`` by the addition theorem."""
    for angle, (c, s) in zip(angles, pairs, strict=True):
        found = _known_part(node.args[0], angle, unknowns)
        if found is not None:
            sign, known = found
            if node.name == "cos":
                return c * cos(known) - sign * s * sin(known)
            return sign * s * cos(known) + c * sin(known)
    raise AssertionError(f"{node} has none of the angles")


def _loop(equations: Sequence[Expr], unknowns: Sequence[Expr], *, alone: bool) -> list[Solution] | None:
    """Solve two equations in two angles, or in an angle and a length, and the others with their values."""
    del alone
    for first, second in combinations(range(len(equations)), 2):
        pair = [expand_trig(equations[first]), expand_trig(equations[second])]
        for given in ([equations[first], equations[second]], pair):
            held = [x for x in unknowns if any(_holds(each, x) for each in given)]
            if len(held) != 2:
                continue
            found = _closed(given, held)
            if found is not None:
                rest = [each for k, each in enumerate(equations) if k not in {first, second}]
                return [more for each in found for more in _continued(rest, unknowns, each)]
    return None


def _closed(pair: Sequence[Expr], held: Sequence[Expr]) -> list[Solution] | None:
    angles = _Angles.of(pair, held)
    if angles is None:
        return None
    if len(angles.pairs) == 2:
        return _two_angles(angles, held)
    return _angle_and_length(angles, held)


def _two_angles(angles: _Angles, held: Sequence[Expr]) -> list[Solution] | None:
    """Eliminate the second angle: its cosine and sine are linear in those of the first; their squares add up to 1."""
    for one, other in ((0, 1), (1, 0)):
        pair = list(angles.pairs[other])
        if not is_linear(angles.equations, pair):
            return None
        solved = eliminated(angles.equations, pair)
        if solved is None or len(solved) < 2:
            continue
        c, s = (solved[each] for each in pair)
        condition = c**2 + s**2 - 1
        condition = numerator(condition, condition.free_symbols)
        found = line(condition, *angles.pairs[one])
        if found is None or (found[0].is_zero and found[1].is_zero):
            continue
        result = []
        for each in directions(*found):
            values = dict(zip(angles.pairs[one], (each.cosine, each.sine), strict=True))
            following = Direction(substitute((c,), values)[0], substitute((s,), values)[0], number(1))
            both = [each.angle, following.angle] if one == 0 else [following.angle, each.angle]
            known = angles.back([[value] for value in both])
            result.append({x: value[0] for x, value in zip(held, known, strict=True)})
        return result
    return None


def _angle_and_length(angles: _Angles, held: Sequence[Expr]) -> list[Solution] | None:
    """Eliminate the length from two equations that are linear in it."""
    ((c, s),) = angles.pairs
    lengths = [x for x in held if any(_holds(each, x) for each in angles.equations)]
    if len(lengths) != 1:
        return None
    length = lengths[0]
    (turning,) = (x for x in held if x != length)
    if not is_linear(angles.equations, [length]):
        return None
    slopes = [jacobian(each, length)[0, 0] for each in angles.equations]
    others = substitute(tuple(angles.equations), {length: number(0)})
    found = line(others[0] * slopes[1] - others[1] * slopes[0], c, s)
    if found is None:
        return None
    result = []
    for each in directions(*found):
        values = {c: each.cosine, s: each.sine}
        slope, rest = substitute(slopes, values), substitute(others, values)
        square = sum((a * a for a in slope), start=number(0))
        value = -sum((a * b for a, b in zip(slope, rest, strict=True)), start=number(0)) / square
        ((angle,),) = angles.back([[each.angle]])
        result.append({turning: angle, length: simplify(value)})
    return result
