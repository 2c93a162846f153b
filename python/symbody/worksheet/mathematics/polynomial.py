"""Scalars as polynomials in one of their parts, by value."""

from __future__ import annotations

from symbody.errors import ExpressionError, WorksheetError
from symbody.symbolic import Expr, coeff, expand, number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import tree_of, walk

__all__ = ["coefficients", "degree", "reduced"]

_LEAVES = ("symbol", "time_function", "application", "function")


def coefficients(value: Expr, variable: Expr) -> dict[int, Expr]:
    """Return the coefficients of a polynomial by exponent, those that are zero left out.

    Raises:
        WorksheetError: the value is not a polynomial in the variable.
    """
    if not value.has(variable):
        return {} if value.is_zero else {0: value}
    base = variable
    if variable.kind not in _LEAVES:
        base = symbol("_part")
        value = value.subs({variable: base})
    try:
        found = {n: coeff(value, base, n) for n in range(_highest(value, base) + 1)}
    except ExpressionError as error:
        raise WorksheetError(f"coeff: {error}") from error
    return {n: each for n, each in found.items() if not each.is_zero}


def _highest(value: Expr, variable: Expr) -> int:
    """Return a bound of the degree of a polynomial."""
    bounds: dict[int, int] = {}
    for node in walk(tree_of(value)):
        parts = [bounds[id(part)] for part in node.parts]
        if node.value == variable:
            bound = 1
        elif node.kind == "product":
            bound = sum(parts)
        elif node.kind == "power":
            exponent = node.parts[1].value
            whole = exponent.is_number and exponent.ratio[1] == 1 and exponent.ratio[0] > 0
            bound = parts[0] * exponent.ratio[0] if whole else 0
        else:
            bound = max(parts, default=0) if node.kind == "sum" else 0
        bounds[id(node)] = bound
    highest = bounds[id(tree_of(value))]
    if highest > 200:
        raise WorksheetError(f"coeff: a polynomial of degree {highest}; expected at most 200")
    return max(highest, 1)


def degree(value: Expr, variable: Expr) -> int:
    """Return the degree of a polynomial."""
    return max(coefficients(expand(value), variable), default=0)


def reduced(value: Expr, left: Expr, right: Expr, variables: list[Expr]) -> Expr:
    """Return a value in which the polynomial ``left`` is replaced by ``right``: the remainder of a division.

    The given variables are eliminated first.
    """
    if left.kind in _LEAVES:
        return value.subs({left: right})
    others = sorted(left.free_symbols, key=lambda each: (-degree_or_zero(left, each), str(each)))
    functions = sorted({n.value for n in walk(tree_of(left)) if n.kind == "function"}, key=str)
    for variable in [*variables, *functions, *others]:
        try:
            own = coefficients(expand(left), variable)
            if max(own, default=0) < 1:
                continue
            return _remainder(value, own, right, variable)
        except (ExpressionError, WorksheetError):
            continue
    return value


def degree_or_zero(value: Expr, variable: Expr) -> int:
    """Return the degree, or 0 for what isn't a polynomial."""
    try:
        return degree(value, variable)
    except (ExpressionError, WorksheetError):
        return 0


def _remainder(value: Expr, divisor: dict[int, Expr], right: Expr, variable: Expr) -> Expr:
    n = max(divisor)
    leading = divisor[n]
    rest = sum((c * variable**k for k, c in divisor.items() if k != n), start=number(0))
    replacement = (right - rest) / leading  # variable^n
    found = coefficients(expand(value), variable)
    for _ in range(500):
        highest = max(found, default=0)
        if highest < n:
            break
        coefficient = found.pop(highest)
        raised = expand(coefficient * replacement * variable ** (highest - n))
        for k, c in coefficients(raised, variable).items():
            total = found.get(k, number(0)) + c
            found[k] = total
        found = {k: c for k, c in found.items() if not c.is_zero}
    return sum((c * variable**k for k, c in found.items()), start=number(0))
