"""Products multiplied out: the form of a small set of expressions in which like terms meet, where it is cheaper.

What is carried from frame to frame is turned there and back, and shares of several bodies are sums of their own:
``sin(a)*(sin(a)*x + y) + cos(a)*(cos(a)*x + z)`` is ``x + y*sin(a) + z*cos(a)``, ``m*l**2/12 + l*m*(l/2)/2`` is
``m*l**2/3``. Multiplied out, such terms meet; each common factor then comes outside again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import prod

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.cost import operations
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.traverse import post_order

__all__ = ["multiplied_out_if_cheaper"]

_MOST_OPERATIONS = 128
"""The most operations for which forms are compared."""

_LEAST_SAVED = 2
"""The fewest operations for which a form is left: one less is not worth other brackets."""

_MOST_TERMS = 80
"""The most terms of all expressions that are multiplied out: with more, no shorter form has been found in time."""


def multiplied_out_if_cheaper(
    expressions: Sequence[Expr], variables: Sequence[Expr] = ()
) -> tuple[Expr, ...]:
    """Return expressions with like terms collected in those where all together then take clearly fewer operations.

    Args:
        expressions: the expressions; many of them, and long ones, stay as they are.
        variables: what may be collected further, such as accelerations.

    >>> from symbody import cos, sin, symbols
    >>> a, x, y = symbols("a x y")
    >>> multiplied_out_if_cheaper([sin(a) * (x * sin(a) + y) + x * cos(a) ** 2])
    (x + y*sin(a),)
    """
    given = tuple(dict.fromkeys(expressions))
    count = operations(given)
    if not _LEAST_SAVED < count <= _MOST_OPERATIONS or _terms(given) > _MOST_TERMS:
        return tuple(expressions)
    best = given
    with derivation(fresh=True):  # so that forms are not those that another derivation holds for the values
        for forms in _candidates(given, variables):
            best = _cheapest(best, forms)
        best = tuple(_without_leading_minus(*pair) for pair in zip(best, given, strict=True))
    if operations(best) > count - _LEAST_SAVED:
        return tuple(expressions)
    found = dict(zip(given, best, strict=True))
    return tuple(found[expression] for expression in expressions)


def _candidates(given: Sequence[Expr], variables: Sequence[Expr]) -> Iterator[tuple[Expr, ...]]:
    """Return the other forms: multiplied out, also by angles combined, with common factors outside, by variables."""
    flat = [_core.rewrite("expand", expression) for expression in given]
    combined = [_core.rewrite("combine_trig", expression) for expression in flat]
    has_single_angles = not {angle / 2 for angle in _angles(combined)} & _angles(given)
    for forms in (flat, combined) if has_single_angles else (flat,):
        yield tuple(_core.rewrite("factor_terms", each) for each in forms)
        if variables:
            yield tuple(_core.rewrite("factor_terms", _core.collect(each, variables)) for each in forms)


def _angles(expressions: Sequence[Expr]) -> set[Expr]:
    nodes = post_order(expressions, lambda node: node.args, lambda node: node.id)
    return {node.args[0] for node in nodes if node.kind == "function" and node.name in ("sin", "cos")}


def _cheapest(best: tuple[Expr, ...], forms: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return expressions in other forms: all of them, or one after another, where all then take fewer operations."""
    fewest = operations(best)
    shorter = [k for k, form in enumerate(forms) if operations([form]) < operations([best[k]])]
    for k in (None, *shorter):
        trial = forms if k is None else (*best[:k], forms[k], *best[k + 1 :])
        count = operations(trial)
        if count < fewest:
            best, fewest = trial, count
    return best


def _without_leading_minus(form: Expr, given: Expr) -> Expr:
    """Return a form that doesn't begin with minus, as ``-m*(b + c - a)`` does, if need be the given one."""
    if form.same_form(given) or not str(form).startswith("-"):
        return form
    simplified = _core.rewrite("simplify", form)
    return given if str(simplified).startswith("-") else simplified


def _terms(expressions: Sequence[Expr]) -> int:
    """Return a bound of the number of terms that expressions have when they are multiplied out."""
    found = dict[int, int]()
    for node in post_order(expressions, lambda node: node.args, lambda node: node.id):
        found[node.id] = _terms_of(node, [found[part.id] for part in node.args])
    return sum(found[expression.id] for expression in expressions)


def _terms_of(node: Expr, parts: Sequence[int]) -> int:
    if node.kind == "sum":
        return sum(parts)
    if node.kind == "product":
        return prod(parts)
    if node.kind == "power" and parts[0] > 1 and node.args[1].is_number:
        return int(parts[0] ** min(abs(node.args[1].ratio[0]), _MOST_TERMS))
    return 1
