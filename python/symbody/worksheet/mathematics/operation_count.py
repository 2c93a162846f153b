"""Operation counts as Maple's codegen[cost] gives them: of expressions as they are written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from symbody.symbolic import Expr
from symbody.worksheet.values.structure import Tree, tree_of

__all__ = ["operation_count"]


def operation_count(expressions: Iterable[Expr]) -> Counter[str]:
    """Return how many additions, multiplications, divisions, functions and subscripts an evaluation takes."""
    total: Counter[str] = Counter()
    known: dict[int, Counter[str]] = {}
    for expression in expressions:
        total.update(_count(tree_of(expression), known))
    return total


def _count(tree: Tree, known: dict[int, Counter[str]]) -> Counter[str]:
    if id(tree) in known:
        return known[id(tree)]
    found: Counter[str] = Counter()
    for part in tree.parts:
        if tree.kind != "derivative":
            found.update(_count(part, known))
    found.update(_own(tree))
    known[id(tree)] = found
    return found


def _own(tree: Tree) -> Counter[str]:
    if tree.kind == "sum":
        return Counter(additions=len(tree.parts) - 1)
    if tree.kind == "product":
        below = sum(_is_reciprocal(part) for part in tree.parts)
        sign = tree.parts[0].value == -1
        above = len(tree.parts) - below - sign
        return Counter(multiplications=max(above - 1, 0) + (below - 1 if below > 1 else 0))
    if tree.kind == "power":
        return _power(tree)
    if tree.kind in ("function", "derivative"):
        return Counter(functions=1)
    if tree.kind == "name" and "[" in tree.name:
        return Counter(subscripts=1)
    return Counter()


def _is_reciprocal(tree: Tree) -> bool:
    return tree.kind == "power" and tree.parts[1].kind == "number" and tree.parts[1].value.ratio[0] < 0


def _power(tree: Tree) -> Counter[str]:
    exponent = tree.parts[1].value
    if not exponent.is_number:
        return Counter(functions=1)
    numerator, denominator = exponent.ratio
    found: Counter[str] = Counter()
    if numerator < 0:
        found["divisions"] += 1
    if denominator == 1:
        found["multiplications"] += _multiplications(abs(numerator))
    elif denominator == 2:
        found["functions"] += 1
        found["multiplications"] += _multiplications(abs(numerator))
    else:
        found["functions"] += 1
    return found


def _multiplications(exponent: int) -> int:
    """Return how many multiplications a power takes by squaring."""
    return exponent.bit_length() - 1 + exponent.bit_count() - 1
