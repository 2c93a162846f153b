"""Sums of parameters times one quantity: ``(l - r)*m*a1`` for ``l*m*a1 - m*r*a1``."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, factor_terms, number
from symbody.symbolic.calculus.reading import nodes_of, parts_of
from symbody.symbolic.calculus.summands import summands


def by_quantities(form: Expr) -> Expr:
    """Return a form whose sums have one term for each product of quantities that move, where that is shorter.

    >>> from symbody import functions_of_time, symbols
    >>> (a1, a2), (l, m, r) = functions_of_time("a1 a2"), symbols("l m r")
    >>> by_quantities(l * m * a1 - m * r * a1 + m * a2)
    m*(l - r)*a1 + m*a2
    """
    made = dict[int, Expr]()
    for node in nodes_of(form):
        made[node.id] = _rebuilt(node, [made[arg.id] for arg in node.args])
    return made[form.id]


def _rebuilt(node: Expr, args: Sequence[Expr]) -> Expr:
    is_same = all(new.id == old.id for new, old in zip(args, node.args, strict=True))
    if node.kind == "sum":
        return _collected(node if is_same else sum(args, start=number(0)))
    if is_same or node.kind not in {"product", "power"}:
        return node
    if node.kind == "power":
        return args[0] ** args[1]
    made = number(1)
    for arg in args:
        made *= arg
    return made


def _collected(total: Expr) -> Expr:
    factors = dict[Expr, list[Expr]]()
    for term in summands(total):
        moving, parameters = number(1), number(1)
        for part in parts_of(term, "product"):
            if any(leaf.kind == "time_function" for leaf in part.free_symbols):
                moving *= part
            else:
                parameters *= part
        factors.setdefault(moving, []).append(parameters)
    terms = [_shorter(moving, parameters) for moving, parameters in factors.items()]
    return total if len(terms) == len(summands(total)) else sum(terms, start=number(0))


def _shorter(moving: Expr, parameters: Sequence[Expr]) -> Expr:
    total = sum(parameters, start=number(0))
    flat = sum((each * moving for each in parameters), start=number(0))
    if len(parameters) == 1 or moving.is_number:
        return flat
    return min(factor_terms(total) * moving, flat, key=lambda form: len(str(form)))
