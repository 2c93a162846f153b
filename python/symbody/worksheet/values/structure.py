"""The structure of a scalar as Maple shows it: flat sums and products, in a fixed order.

The core knows equal mathematics as one node, so its own form is not what Maple's ``op``, ``has`` and ``nops`` count.
They read this tree, and so does the printer. Trees are shared as the nodes of the core are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import reduce
from operator import add, mul

from symbody.symbolic import Expr, UndefinedFunction, number, t
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.integers import number_text
from symbody.worksheet.values.numeric import as_float, decimal

__all__ = ["Tree", "is_negative", "leaves", "product_of", "sum_of", "tree_of", "walk"]

_KEY_LENGTH = 120

FUNCTION_NAMES = {
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "atan2": "arctan",
    "log": "ln",
    "Abs": "abs",
    "sign": "signum",
    "Min": "min",
    "Max": "max",
    "Piecewise": "piecewise",
}
"""The functions of the core that Maple calls otherwise."""


@dataclass(frozen=True, slots=True)
class Tree:
    """A node of the structure.

    Attributes:
        kind: "number", "name", "sum", "product", "power", "function", "derivative".
        value: the expression that it stands for.
        parts: terms, factors, base and exponent, arguments, or a function and the variable of its derivative.
        name: that of a name or a function.
        key: what it is sorted by: the beginning of its text.
    """

    kind: str
    value: Expr
    parts: tuple[Tree, ...] = ()
    name: str = ""
    key: str = field(default="", compare=False)


_trees: dict[int, Tree] = {}


def tree_of(expression: Expr) -> Tree:
    """Return the structure of an expression."""
    known = _trees.get(expression.id)
    if known is not None:
        return known
    if len(_trees) > 2_000_000:
        _trees.clear()
    for node in post_order([expression], _unknown_parts, lambda node: node.id):
        if node.id not in _trees:
            _trees[node.id] = _made(node, [_trees[part.id] for part in _flat_parts(node)])
    return _trees[expression.id]


def _unknown_parts(node: Expr) -> Iterable[Expr]:
    return () if node.id in _trees else _flat_parts(node)


_LONGEST = 3000
"""The length up to which sums inside sums are opened at once."""


def _flat_parts(node: Expr) -> Iterable[Expr]:
    """Return the parts of a node, those of a sum inside a sum in its place: long running sums need no trees."""
    if node.kind != "sum" or all(part.kind != "sum" for part in node.args):
        return node.args
    flat: list[Expr] = []
    pending = list(reversed(node.args))
    while pending:
        part = pending.pop()
        if part.kind == "sum" and len(flat) + len(pending) < _LONGEST and part.id not in _trees:
            pending.extend(reversed(part.args))
        else:
            flat.append(part)
    return flat


def _made(node: Expr, parts: list[Tree]) -> Tree:
    return _MAKERS[node.kind](node, parts)


def _number(node: Expr, parts: list[Tree]) -> Tree:
    return Tree("number", node, key=number_text(node)[:_KEY_LENGTH])


def _constant(node: Expr, parts: list[Tree]) -> Tree:
    return Tree("name", node, name="Pi", key="Pi")


def _symbol(node: Expr, parts: list[Tree]) -> Tree:
    return Tree("name", node, name=node.name, key=node.name[:_KEY_LENGTH])


def _time_function(node: Expr, parts: list[Tree]) -> Tree:
    if not node.order:
        return _call(node, node.name, [tree_of(t)])
    value = UndefinedFunction(node.name)(t)
    tree = tree_of(value)
    for order in range(1, node.order + 1):
        value = node if order == node.order else value.diff(t)
        tree = _derivative(value, tree, tree_of(t))
    return tree


def _derivative(value: Expr, function: Tree, variable: Tree) -> Tree:
    return Tree(
        "derivative", value, (function, variable), key=f"diff({function.key},{variable.key})"[:_KEY_LENGTH]
    )


def _application(node: Expr, parts: list[Tree]) -> Tree:
    plain = UndefinedFunction(node.name)(*node.args)
    varied = [(part, order) for part, order in zip(parts, node.orders, strict=True) if order]
    if all(part.kind == "name" and _is_in_one(part.value, node.args) for part, _ in varied):
        tree, value = _call(plain, node.name, parts), plain
        for part, order in varied:
            for _ in range(order):
                value = value.diff(part.value)
                tree = _derivative(value, tree, part)
        return tree
    places = ",".join(str(i) for i, order in enumerate(node.orders, 1) for _ in range(order))
    operator = f"D[{places}]({node.name})"
    if len(parts) == 1:
        order = node.orders[0]
        operator = f"D({node.name})" if order == 1 else f"(D@@{order})({node.name})"
    return _call(node, operator, parts)


def _is_in_one(variable: Expr, arguments: tuple[Expr, ...]) -> bool:
    """Whether one argument alone holds a variable, so that ``diff`` by it is the derivative by a place."""
    return (
        sum(variable in each.free_symbols or (variable == t and each.depends_on_time) for each in arguments)
        == 1
    )


def _call(value: Expr, name: str, arguments: list[Tree]) -> Tree:
    inner = ",".join(each.key for each in arguments)
    return Tree("function", value, tuple(arguments), name, f"{name}({inner})"[:_KEY_LENGTH])


def _function(node: Expr, parts: list[Tree]) -> Tree:
    if any(part.kind == "number" and part.value.is_decimal for part in parts) and (made := _decimal(node)):
        return made
    return _call(node, FUNCTION_NAMES.get(node.name, node.name), parts)


def _decimal(value: Expr) -> Tree | None:
    """Return a constant that is made of decimals as the decimal that Maple shows; None if it isn't constant."""
    found = as_float(value) if value.is_constant else None
    return None if found is None else tree_of(decimal(found))


def _is_radical(part: Tree) -> bool:
    """Whether a factor is a root of a number."""
    return part.kind == "power" and all(inner.kind == "number" for inner in part.parts)


def _solution(node: Expr, parts: list[Tree]) -> Tree:
    return _call(node, "linear_solution", parts)


# --- powers, products, sums -------------------------------------------------------------------------------------------


def _power(node: Expr, parts: list[Tree]) -> Tree:
    base, exponent = parts
    if base.kind == "product" and exponent.kind == "number" and exponent.value.ratio[1] == 1:
        return product_of([_power_of(factor, exponent) for factor in base.parts])
    return _raised(node, base, exponent)


def _power_of(base: Tree, exponent: Tree) -> Tree:
    value = base.value**exponent.value
    return tree_of(value) if value.kind != "product" else _raised(value, base, exponent)


def _raised(value: Expr, base: Tree, exponent: Tree) -> Tree:
    return Tree("power", value, (base, exponent), key=f"{base.key}^{exponent.key}"[:_KEY_LENGTH])


def _product(node: Expr, parts: list[Tree]) -> Tree:
    return product_of(parts, node)


def product_of(parts: Iterable[Tree], value: Expr | None = None) -> Tree:
    """Return a flat product; a number before a single sum is multiplied out."""
    coefficient = number(1)
    factors: list[Tree] = []
    for part in parts:
        for factor in part.parts if part.kind == "product" else (part,):
            if factor.kind == "number":
                coefficient = coefficient * factor.value
            else:
                factors.append(factor)
    factors, content = _powers_joined(factors)
    coefficient = coefficient * content
    if coefficient.ratio[0] < 0:
        coefficient, factors = _sign_taken_in(coefficient, factors)
    if coefficient.is_decimal and any(map(_is_radical, factors)):
        coefficient = reduce(mul, (part.value for part in factors if _is_radical(part)), coefficient)
        coefficient = decimal(as_float(coefficient) or 0.0)
        factors = [part for part in factors if not _is_radical(part)]
    if coefficient.is_zero or not factors:
        return tree_of(coefficient)
    unit = coefficient == 1 and not coefficient.is_decimal
    if len(factors) == 1:
        if unit:
            return factors[0]
        if factors[0].kind == "sum":
            return sum_of((product_of([tree_of(coefficient), term]) for term in factors[0].parts), value)
    factors.sort(key=_factor_order)
    if not unit:
        factors.insert(0, tree_of(coefficient))
    if value is None:
        value = reduce(mul, (factor.value for factor in factors))
    key = "*".join(factor.key for factor in (factors if unit else factors[1:]))
    return Tree("product", value, tuple(factors), key=key[:_KEY_LENGTH])


def _sign_taken_in(coefficient: Expr, factors: list[Tree]) -> tuple[Expr, list[Tree]]:
    """Return a positive number and factors, one of which takes the sign: ``(x-1)*y`` stands for ``-(1-x)*y``."""
    for i, factor in enumerate(factors):
        power = (
            factor.parts[1].value.ratio
            if factor.kind == "power" and factor.parts[1].kind == "number"
            else (1, 1)
        )
        base = factor.parts[0] if factor.kind == "power" else factor
        if base.kind != "sum" or power[1] != 1 or power[0] % 2 == 0:
            continue
        first, *others = base.parts
        if first.kind == "number" and all(map(is_negative, others)):
            turned = sum_of(product_of([tree_of(number(-1)), term]) for term in base.parts)
            value = turned.value ** number(power[0])
            made = turned if power[0] == 1 else _raised(value, turned, factor.parts[1])
            return -coefficient, [*factors[:i], made, *factors[i + 1 :]]
    return coefficient, factors


def _powers_joined(factors: list[Tree]) -> tuple[list[Tree], Expr]:
    """Return factors with numeric powers of one base joined, and the number that this leaves."""
    groups: dict[Expr, list[Tree]] = {}
    for factor in factors:
        numeric = factor.kind == "power" and factor.parts[1].value.is_number
        groups.setdefault((factor.parts[0] if numeric else factor).value, []).append(factor)
    content = number(1)
    if len(groups) == len(factors):
        return factors, content
    joined: list[Tree] = []
    for group in groups.values():
        made = group[0] if len(group) == 1 else tree_of(reduce(mul, (factor.value for factor in group)))
        for part in made.parts if made.kind == "product" else (made,):
            if part.kind == "number":
                content = content * part.value
            else:
                joined.append(part)
    return joined, content


_RANK = {"name": 1, "function": 2, "derivative": 3, "sum": 4}


def _factor_order(factor: Tree) -> tuple[int, str]:
    inner = factor.parts[0] if factor.kind == "power" else factor
    return (0 if inner.kind == "number" else _RANK.get(inner.kind, 5), factor.key)


def _sum(node: Expr, parts: list[Tree]) -> Tree:
    return sum_of(parts, node)


def sum_of(parts: Iterable[Tree], value: Expr | None = None) -> Tree:
    """Return a flat sum, terms of a high degree first and numbers last."""
    terms: list[Tree] = []
    for part in parts:
        terms.extend(part.parts if part.kind == "sum" else (part,))
    terms = _merged(terms)
    if len(terms) == 1:
        return terms[0]
    if not terms:
        return tree_of(number(0))
    terms.sort(key=_series_order if any(map(_is_order, terms)) else _term_order)
    first = next((i for i, term in enumerate(terms) if _may_lead(term)), 0)
    terms.insert(0, terms.pop(first))
    if value is None:
        value = reduce(add, (term.value for term in terms))
    key = "+".join(term.key for term in terms)
    return Tree("sum", value, tuple(terms), key=key[:_KEY_LENGTH])


def is_negative(term: Tree) -> bool:
    """Whether the number of a term is negative."""
    return _coefficient(term).ratio[0] < 0


def _merged(terms: list[Tree]) -> list[Tree]:
    """Return terms with those joined that differ by a number only, as Maple joins them at once."""
    if len(terms) < 2:
        return terms
    if any(term.kind == "number" and term.value.is_decimal for term in terms):
        terms = _radicals_joined(terms)
    groups: dict[tuple[Expr, ...], list[Tree]] = {}
    for term in terms:
        groups.setdefault(_monomial(term), []).append(term)
    if len(groups) == len(terms):
        return terms
    joined: list[Tree] = []
    for monomial, group in groups.items():
        if len(group) == 1:
            joined.append(group[0])
            continue
        coefficient = reduce(add, (_coefficient(term) for term in group))
        if not coefficient.is_zero:
            joined.append(product_of([tree_of(coefficient), *map(tree_of, monomial)]))
    return joined


def _radicals_joined(terms: list[Tree]) -> list[Tree]:
    """Return terms with the roots of numbers joined to the decimal among them."""
    constant = [
        term for term in terms if term.kind == "number" or all(map(_is_radical_or_number, _factors(term)))
    ]
    if len(constant) < 2:
        return terms
    total = _decimal(reduce(add, (term.value for term in constant)))
    rest = [term for term in terms if term not in constant]
    return terms if total is None else [*rest, total]


def _factors(term: Tree) -> tuple[Tree, ...]:
    return term.parts if term.kind == "product" else (term,)


def _is_radical_or_number(part: Tree) -> bool:
    return part.kind == "number" or _is_radical(part)


def _monomial(term: Tree) -> tuple[Expr, ...]:
    """Return the factors of a term but for its number."""
    if term.kind == "number":
        return ()
    factors = term.parts if term.kind == "product" else (term,)
    return tuple(factor.value for factor in factors if factor.kind != "number")


def _coefficient(term: Tree) -> Expr:
    first = term.parts[0] if term.kind == "product" else term
    return first.value if first.kind == "number" else number(1)


def _term_order(term: Tree) -> tuple[bool, int, str]:
    imaginary = _is_imaginary(term)
    return (term.kind == "number" or imaginary, 1 if imaginary else -_degree(term), term.key)


def _may_lead(term: Tree) -> bool:
    """Whether a sum may begin with a term."""
    return not (is_negative(term) or _is_imaginary(term) or _is_order(term))


def _is_order(term: Tree) -> bool:
    """Whether a term is O(x^n), as series have it."""
    return term.kind == "function" and term.name == "O" and len(term.parts) == 1


def _series_order(term: Tree) -> tuple[bool, int, str]:
    """Terms of a series rise in degree, and O(..) is the last one."""
    return (_is_order(term), _degree(term) if term.kind != "number" else 0, term.key)


def _is_imaginary(term: Tree) -> bool:
    """Whether a term is I, or a number times I: these follow the real number."""
    last = term.parts[-1] if term.kind == "product" and len(term.parts) == 2 else term
    return last.name == "I" and last.kind == "name" and (last is term or term.parts[0].kind == "number")


def _degree(term: Tree) -> int:
    """Return twice the degree of a term in names and functions; a sum counts as half a factor."""
    if term.kind == "product":
        return sum(_degree(factor) for factor in term.parts)
    if term.kind == "power" and term.parts[1].kind == "number":
        numerator, denominator = term.parts[1].value.ratio
        return 2 * numerator if denominator == 1 and numerator > 0 else 0
    return {"number": 0, "sum": 1}.get(term.kind, 2)


_MAKERS: dict[str, Callable[[Expr, list[Tree]], Tree]] = {
    "number": _number,
    "constant": _constant,
    "symbol": _symbol,
    "time_function": _time_function,
    "application": _application,
    "function": _function,
    "power": _power,
    "product": _product,
    "sum": _sum,
    "solution": _solution,
}


# --- walks ------------------------------------------------------------------------------------------------------------


def walk(tree: Tree) -> Iterator[Tree]:
    """Return all nodes of a structure, parts first, each once."""
    return iter(post_order([tree], lambda node: node.parts, id))


def leaves(expression: Expr) -> frozenset[Expr]:
    """Return the names, functions and derivatives that occur."""
    return frozenset(
        node.value for node in walk(tree_of(expression)) if node.kind in ("name", "function", "derivative")
    )
