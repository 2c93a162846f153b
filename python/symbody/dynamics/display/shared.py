"""Quantities that expressions share: each is written once and replaced by its name elsewhere."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from symbody.symbolic import Expr, substitute
from symbody.symbolic.expression.traverse import post_order

_AGAIN, _LONG = 4, 30
"""The least number of printed leaves of a quantity with a name: if it occurs several times, and if it occurs once."""
_SAVED = 3
"""The least number of printed leaves that the name of a shorter sum must save."""


def shared(roots: Sequence[Expr]) -> list[Expr]:
    """Return the sums and products that get names, each after those in it.

    >>> from symbody import cos, sin, symbols
    >>> a, b, q = symbols("a b q")
    >>> shared([a * (a * sin(q) + b * cos(q)), b * (a * sin(q) + b * cos(q))])
    [a*sin(q) + b*cos(q)]
    """
    order = post_order(roots, lambda node: node.args, lambda node: node.id)
    first = dict[Expr, Expr]()
    for node in order:
        first.setdefault(node, node)
    uses = Counter(first[arg].id for node in first for arg in node.args) + Counter(
        first[each].id for each in roots
    )
    leaves, named = dict[int, int](), list[Expr]()
    ends = {first[root].id for root in roots}
    for node in first:
        count = sum(leaves[first[arg].id] for arg in node.args) if node.args else int(not node.is_number)
        is_long = count >= _LONG and node.id not in ends
        if node.kind in {"sum", "product"} and (is_long or _is_worth_a_name(node, uses[node.id], count)):
            named.append(node)
            count = 1
        leaves[node.id] = count
    return named


def _is_worth_a_name(node: Expr, uses: int, leaves: int) -> bool:
    """Return whether a quantity that occurs several times gets a name; short sums of parameters don't."""
    if uses == 1 or leaves >= _AGAIN:
        return uses > 1
    return (
        node.kind == "sum" and (leaves - 1) * (uses - 1) >= _SAVED and any(map(_is_moving, node.free_symbols))
    )


def _is_moving(leaf: Expr) -> bool:
    return leaf.kind == "time_function"


def with_names(
    roots: Sequence[Expr], quantities: Sequence[Expr], names: Sequence[Expr]
) -> tuple[list[Expr], list[Expr]]:
    """Return the quantities and the roots, written with the names of the quantities.

    >>> from symbody import symbols
    >>> a, b, c, w1, w2 = symbols("a b c w1 w2")
    >>> with_names([c * (c + a * b)], [a * b, c + a * b], [w1, w2])
    ([a*b, c + w1], [c*w2])
    """
    mapping, made = dict[Expr, Expr](), list[Expr]()
    for quantity, name in zip(quantities, names, strict=True):
        made += substitute([quantity], mapping)
        mapping[quantity] = name
    return made, [*substitute(roots, mapping)]


def merged(expressions: Sequence[Expr]) -> list[Expr]:
    """Return expressions in which equal parts have the same form, so that they can be shared.

    >>> from symbody import cos, sin, symbols
    >>> a, b, q = symbols("a b q")
    >>> merged([b * (a + 1) ** 2, b * (a**2 + 2 * a + 1) * q])
    [b*(a**2 + 2*a + 1), b*q*(a**2 + 2*a + 1)]
    >>> merged([0.5 * sin(q), sin(q) * cos(q) / 2])
    [0.5*sin(q), sin(q)*cos(q)/2]
    """
    found = [*expressions]
    for _ in range(_PASSES):
        order = post_order(found, lambda node: node.args, lambda node: node.id)
        first = {node: node for node in reversed(order) if not node.args}  # numbers and symbols stay
        for node in order:
            first.setdefault(node, node)
        twins = {node: first[node] for node in order if node.args and first[node].id != node.id}
        if not twins:
            break
        found = [*substitute(found, twins)]
    return found


_PASSES = 3
"""The largest number of passes: replacing a part may give a known value a new form."""
