"""Sums, products and powers as Python writes them: with the brackets that they need, and without float quotients."""

from __future__ import annotations

import ast
import math
import re
from decimal import Decimal

__all__ = [
    "ATOM",
    "POWER",
    "PRODUCT",
    "SUM",
    "grouped",
    "integer_quotient",
    "plain_decimal",
    "product",
    "quotient",
]

#: How strongly the parts of a text hold together.
LAMBDA, COMPARISON, SUM, PRODUCT, SIGN, POWER, ATOM = range(7)

_OPERATIONS: dict[type, int] = {
    ast.Add: SUM,
    ast.Sub: SUM,
    ast.Mult: PRODUCT,
    ast.Div: PRODUCT,
    ast.MatMult: PRODUCT,
    ast.Mod: PRODUCT,
    ast.Pow: POWER,
}


def strength(text: str) -> int:
    """Return how strongly the parts of a text hold together."""
    if re.fullmatch(r"[\w.]+", text):
        return ATOM
    try:
        node = ast.parse(text, mode="eval").body
    except SyntaxError:
        return LAMBDA
    match node:
        case ast.BinOp(op=operation):
            return _OPERATIONS.get(type(operation), LAMBDA)
        case ast.UnaryOp(op=ast.USub() | ast.UAdd()):
            return SIGN
        case ast.Compare():
            return COMPARISON
        case ast.BoolOp() | ast.UnaryOp() | ast.IfExp() | ast.Lambda() | ast.GeneratorExp():
            return LAMBDA
    return ATOM


def grouped(text: str, least: int = ATOM) -> str:
    """Return an operand, in brackets unless it holds together strongly enough."""
    return text if strength(text) >= least else f"({text})"


def integer_quotient(text: str) -> tuple[str, str] | None:
    """Return numerator and denominator of a quotient of integers, such as ``1/2``."""
    found = re.fullmatch(r'sb\.number\("(-?\d+)/(\d+)"\)', text)
    return (found[1], found[2]) if found else None


def plain_decimal(text: str) -> str:
    """Return a decimal as Python writes it, beside an expression, which takes it exactly; another text as it is."""
    found = re.fullmatch(r'sb\.number\("(-?[\d.]+(?:e[+-]?\d+)?)"\)', text)
    if not found or not math.isfinite(float(found[1])) or Decimal(repr(float(found[1]))) != Decimal(found[1]):
        return text
    return (
        f"0{found[1]}" if found[1].startswith(".") else f"{found[1]}0" if found[1].endswith(".") else found[1]
    )


def product(left: str, right: str, sign: str = "*") -> str:
    """Return a product; a quotient of integers in front becomes a factor and a divisor: ``m*v**2/2``."""
    fraction = integer_quotient(left)
    if fraction is not None and not re.fullmatch(r"\d+", right):
        a, b = fraction
        if a != "1":
            return f"{a}{sign}{grouped(right, POWER)}/{b}"
        return f"{right}/{b}" if strength(right) >= PRODUCT else f"({right})/{b}"
    carried = re.fullmatch(r"(.+)/(\d+)", left)
    if carried and strength(left) == PRODUCT and _is_last_divisor(left) and sign == "*":
        return f"{product(carried[1], right)}/{carried[2]}"
    return f"{grouped(left, PRODUCT)}{sign}{grouped(right, POWER)}"


def _is_last_divisor(text: str) -> bool:
    """Whether the outermost operation of a text is the division by its last factor."""
    node = ast.parse(text, mode="eval").body
    return (
        isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and isinstance(node.right, ast.Constant)
    )


def quotient(left: str, right: str) -> str:
    """Return a quotient, exact for integers."""
    if re.fullmatch(r"-?\d+", left) and re.fullmatch(r"\d+", right):
        return f'sb.number("{left}/{right}")'
    return f"{grouped(left, PRODUCT)}/{grouped(right, POWER)}"
