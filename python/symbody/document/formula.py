"""Formulas of sections: equations below each other, if they are short enough to be read."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice

from symbody.document.document import Block, Formula, Math, Prose, Words, prose
from symbody.dynamics.display.row import printed, written
from symbody.dynamics.display.short_names import in_order_of_use
from symbody.multibody import Variables
from symbody.symbolic import Expr, cost, free_symbols, latex, listing, substitute, symbol
from symbody.symbolic.expression.latex_layout import LINE, aligned, broken, width
from symbody.symbolic.given.arguments import counted

READABLE = 6000
"""The letters of LaTeX up to which the formulas of a section are printed: about a page."""

WIDEST = 3 * LINE
"""The width of the longest row: two lines of a page, as both parts of a fraction count."""


def listed(expressions: Sequence[Expr]) -> Words:
    """Return expressions with commas between them."""
    words: list[str | Math] = []
    for expression in expressions:
        words += [", ", Math(latex(expression))]
    return tuple(words[1:])


def equalities(
    lead: Prose,
    names: Sequence[str],
    values: Sequence[Expr | Sequence[Expr]],
    system: Variables | None = None,
) -> list[Block]:
    r"""Return equations below each other, after their common parts; or the number of operations if they are too long.

    Args:
        lead: the beginning of the sentence that the formulas end.
        names: the left sides, in LaTeX.
        values: the right sides; terms of a sum keep their order.
        system: gives the order of coordinates and speeds in products, as in the equations of motion.

    >>> from symbody import symbols
    >>> _, formula = equalities(prose("The height is"), ["y"], [symbols("x") ** 2])
    >>> print(formula.latex)
    \begin{aligned} y &= x^{2} \end{aligned}
    """
    sums = [[value] if isinstance(value, Expr) else value for value in values]
    radicands, terms = named_radicands([term for each in sums for term in each])
    shown = [*radicands.values(), *terms]
    definitions, texts = listing(shown, "latex") if system is None else printed(shown, "latex", system)
    remaining = iter(texts)
    sides = [written(islice(remaining, count)) for count in (*(1 for _ in radicands), *map(len, sums))]
    named = list(zip(map(latex, radicands), sides, strict=False))
    pairs = [*in_order_of_use([*definitions, *named]), *zip(names, sides[len(radicands) :], strict=True)]
    rows = [row for left, right in pairs for row in broken(f"{left} &= ", right)]
    if sum(map(len, rows)) > READABLE or max(map(width, rows), default=0) > WIDEST:
        kind = "an expression" if len(values) == 1 else "expressions"
        size = counted(cost(shown).total, "operation")
        return [prose(*lead.words, f" {kind} of {size}, too long to be read here.")]
    return [lead, Formula(aligned(rows))]


def named_radicands(values: Sequence[Expr]) -> tuple[dict[Expr, Expr], Sequence[Expr]]:
    """Return names for the long sums under roots, since a root is not broken, and the values with these names.

    >>> from symbody import sqrt, symbols
    >>> a, b = symbols("alpha beta")
    >>> named_radicands([sqrt(a + b)])
    ({}, [sqrt(alpha + beta)])
    """
    wide = [base for base in _radicands(values) if width(latex(base)) > LINE // 2]
    if not wide:
        return {}, values
    used = {leaf.name for leaf in free_symbols(values)}
    letter = next(each for each in "sdpeo" if not any(name.rstrip("0123456789") == each for name in used))
    names = [symbol(f"{letter}{number}") for number in range(1, len(wide) + 1)]
    return dict(zip(names, wide, strict=True)), substitute(values, dict(zip(wide, names, strict=True)))


def _radicands(values: Iterable[Expr]) -> list[Expr]:
    """Return the sums under the outermost roots, in the order of the values."""
    found, seen, stack = list[Expr](), set[int](), [*values][::-1]
    while stack:
        node = stack.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        is_root = node.kind == "power" and node.args[0].kind == "sum" and node.args[1].kind == "number"
        if is_root and float(node.args[1]) % 1:
            found.append(node.args[0])
        else:
            stack.extend(reversed(node.args))
    return list(dict.fromkeys(found))
