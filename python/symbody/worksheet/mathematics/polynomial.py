"""Scalars as polynomials in one of their parts, by value."""

from __future__ import annotations

from symbody.errors import ExpressionError, WorksheetError
from symbody.symbolic import Expr, coeff, expand, number
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.structure import tree_of, walk

__all__ = ["coefficients", "degree", "reduced"]

_LEAVES = ("symbol", "time_function", "application", "function")


def coefficients(value: Expr, variable: Expr) -> dict[int, Expr]:
    """Return the coefficients of a polynomial by exponent, those that are zero left out; ``a/x`` has exponent -1.

    Raises:
        WorksheetError: the value is not a polynomial in the variable.
    """
    is_root = variable.kind == "power"  # sqrt(x), which has and subs don't see in a*sqrt(x)
    held = any(node.value == variable for node in walk(tree_of(value))) if is_root else value.has(variable)
    if not held:
        return {} if value.is_zero else {0: value}
    base = variable
    if not is_root and variable.kind not in _LEAVES:
        base = symbol("_part")
        value = value.subs({variable: base})
    lowest, highest = _bounds(value, base)
    if lowest < 0:
        value = expand(expand(value) * base**-lowest)
    try:
        found = {n: coeff(value, base, n - lowest) for n in range(lowest, highest + 1)}
    except ExpressionError as error:
        raise WorksheetError(f"coeff: {error}") from error
    return {n: each for n, each in found.items() if not each.is_zero}


def _bounds(value: Expr, variable: Expr) -> tuple[int, int]:
    """Return bounds of the exponents of a variable: the lowest, at most 0, and the highest, at least 1."""
    bounds: dict[int, tuple[int, int]] = {}
    for node in walk(tree_of(value)):
        parts = [bounds[id(part)] for part in node.parts]
        low, high = 0, 0
        if node.value == variable:
            low, high = 1, 1
        elif node.kind == "product":
            low, high = sum(part[0] for part in parts), sum(part[1] for part in parts)
        elif node.kind == "power":
            exponent = node.parts[1].value
            whole = exponent.ratio[0] if exponent.is_number and exponent.ratio[1] == 1 else 0
            is_sum = node.parts[0].kind == "sum"
            ends = (parts[0][0] * whole, parts[0][1] * whole) if whole > 0 or not is_sum else (0, 0)
            low, high = min(ends), max(ends)
        elif node.kind == "sum":
            low, high = min(part[0] for part in parts), max(part[1] for part in parts)
        bounds[id(node)] = low, high
    low, high = bounds[id(tree_of(value))]
    if high > 200 or low < -200:
        raise WorksheetError(f"coeff: a polynomial of degree {max(high, -low)}; expected at most 200")
    return min(low, 0), max(high, 1)


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
