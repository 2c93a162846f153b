"""How a form reads: the length of its text, and what a reader stumbles over."""

from __future__ import annotations

from collections.abc import Iterator

from symbody.symbolic._core import Expr
from symbody.symbolic.expression.traverse import post_order

AWKWARD, _MULTIPLE = 5, 8
"""Characters by which an awkward term, and new multiples of angles, make a form longer to a reader."""


def reading(form: Expr, angles: set[Expr]) -> int:
    """Return the length of a form to a reader.

    Args:
        form: the form.
        angles: the multiples of angles that don't count, since the given expression has them.
    """
    awkward = AWKWARD * awkward_terms(form) + _MULTIPLE * len(multiples_of_angles(form) - angles)
    return len(str(form)) + awkward


def nodes_of(expression: Expr) -> list[Expr]:
    """Return the nodes of an expression, parts first, each once."""
    return post_order([expression], lambda node: node.args, lambda node: node.id)


def waves_in(expression: Expr) -> list[Expr]:
    """Return the sines, cosines and tangents of an expression, inner ones first."""
    return [node for node in nodes_of(expression) if node.kind == "function" and node.name in WAVES]


def angles_in(expression: Expr) -> set[Expr]:
    """Return the angles of sines, cosines and tangents."""
    return {wave.args[0] for wave in waves_in(expression)}


def multiples_of_angles(expression: Expr) -> set[Expr]:
    """Return the angles such as 2*x of sines, cosines and tangents."""
    return {angle for angle in angles_in(expression) if any(abs(factor) != 1 for factor in _numbers(angle))}


WAVES = frozenset({"sin", "cos", "tan"})


def _numbers(angle: Expr) -> list[Expr]:
    return [
        part for node in nodes_of(angle) if node.kind == "product" for part in node.args if part.is_number
    ]


def levels(form: Expr) -> int:
    """Return the levels of brackets of a form: of sums within sums, but those of parameters alone and of angles.

    >>> from symbody import functions_of_time, symbols
    >>> (x, y), a, b = functions_of_time("x y"), *symbols("a b")
    >>> levels(x * (b + y * (a + x))), levels(x * b + y * (a + b))
    (2, 1)
    """
    found = dict[int, int]()
    for node in nodes_of(form):
        if node.kind == "function":
            found[node.id] = 0
            continue
        inner = [found[arg.id] - (arg.kind == node.kind == "sum" and found[arg.id] > 0) for arg in node.args]
        is_level = node.kind == "sum" and any(leaf.kind == "time_function" for leaf in node.free_symbols)
        found[node.id] = max(inner, default=0) + is_level
    return found[form.id]


def functions_within_functions(expression: Expr) -> int:
    """Return how deep functions stand in the arguments of functions.

    >>> from symbody import cos, sin, sqrt, symbols
    >>> a, b = symbols("a b")
    >>> functions_within_functions(a * sin(b)), functions_within_functions(sin(a + cos(sqrt(b))))
    (1, 2)
    """
    found = dict[int, int]()
    for node in nodes_of(expression):
        found[node.id] = max((found[part.id] for part in node.args), default=0) + (node.kind == "function")
    return found[expression.id]


def awkward_terms(expression: Expr) -> int:
    """Return how many terms of sums have a factor that occurs again in its brackets, or quotients in a quotient."""
    terms = {
        term.id: term for node in nodes_of(expression) if node.kind == "sum" for term in parts_of(node, "sum")
    }
    nested = sum(map(_is_nested, terms.values()))
    return nested + sum(map(_is_compound, nodes_of(expression)))


def awkward_parts(expression: Expr) -> int:
    """Return the number of awkward terms, of which a product may be one itself.

    >>> from symbody import symbols
    >>> a, b = symbols("a b")
    >>> awkward_parts(a * (a + b)), awkward_parts(a * (1 + b)), awkward_terms(a * (a + b))
    (1, 0, 0)
    """
    return awkward_terms(expression) + (expression.kind == "product" and _is_nested(expression))


def _is_nested(term: Expr) -> bool:
    bases = {_base(factor) for factor in parts_of(term, "product") if not factor.is_number}
    return any(bases & {_base(factor) for factor in factors} for factors in _products_in(term))


def _is_compound(node: Expr) -> bool:
    is_quotient = any(map(is_divisor, parts_of(node, "product")))
    return is_quotient and any(any(map(is_divisor, factors)) for factors in _products_in(node))


def _products_in(product: Expr) -> Iterator[list[Expr]]:
    """Yield the factors of each term of the sums that are factors of a product."""
    for factor in parts_of(product, "product"):
        if factor.kind == "sum":
            yield from (parts_of(term, "product") for term in parts_of(factor, "sum"))


def is_divisor(factor: Expr) -> bool:
    """Return whether a node is a power with a negative exponent."""
    return factor.kind == "power" and str(factor.args[1]).startswith("-")


def _base(factor: Expr) -> Expr:
    is_root = factor.kind == "power" and factor.args[1].is_number and not factor.args[1].is_decimal
    return factor.args[0] if is_root else factor


def parts_of(node: Expr, kind: str) -> list[Expr]:
    """Return the terms of a sum, or the factors of a product, that is nested in the graph."""
    if node.kind != kind:
        return [node]
    return [part for arg in node.args for part in parts_of(arg, kind)]
