"""What a series leaves out, ``O(x^n)``: a term that is printed, and that ``convert(.., polynom)`` takes away."""

from __future__ import annotations

from symbody.symbolic import Expr, UndefinedFunction, number
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.mathematics.closed_roots import polynomial_in
from symbody.worksheet.values.naming import symbol

__all__ = ["absorbed", "order_of_derivative", "order_term", "order_terms", "without_order"]

_NAME = "O"


def order_term(power: Expr) -> Expr:
    """Return O of a power."""
    return UndefinedFunction(_NAME)(power)


def order_of_derivative(term: Expr) -> Expr:
    """Return what the derivative of O(x^n) is: O(x^(n - 1))."""
    (power,) = term.args
    if power.kind == "power":
        return order_term(power.args[0] ** (power.args[1] - 1))
    return order_term(number(1))


def order_terms(value: Expr) -> list[Expr]:
    """Return the terms O(..) in a scalar."""
    nodes = post_order([value], lambda node: node.args, lambda node: node.id)
    return [
        node for node in nodes if node.kind == "application" and node.name == _NAME and len(node.args) == 1
    ]


def absorbed(value: Expr) -> Expr:
    """Return a sum of series with one O(x^n), the lowest, and without the terms that it covers."""
    terms = order_terms(value)
    bases = {_power(term)[0] for term in terms}
    if len(bases) != 1 or not _is_linear(value, terms):
        return value
    (base,), lowest = bases, min(_power(term)[1] for term in terms)
    rest = without_order(value)
    known = polynomial_in(rest, base) if base.kind == "symbol" else None
    if known is not None:
        rest = sum((c * base**k for k, c in enumerate(known[:lowest])), start=number(0))
    return rest + order_term(base**lowest)


def _power(term: Expr) -> tuple[Expr, int]:
    """Return x and n of a term O(x^n)."""
    (power,) = term.args
    base, exponent = power.args if power.kind == "power" else (power, number(1))
    return base, exponent.ratio[0] if exponent.is_number else 1


def _is_linear(value: Expr, terms: list[Expr]) -> bool:
    """Whether an expression is a sum of terms with numbers as factors, and of what has none."""
    names = {term: symbol(f"_order{k}") for k, term in enumerate(terms)}
    held = value.subs(names)
    return all(held.diff(name).is_number for name in names.values())


def without_order(value: Expr) -> Expr:
    """Return a series as a polynomial."""
    return value.subs(dict.fromkeys(order_terms(value), number(0)))
