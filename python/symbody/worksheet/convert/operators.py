"""Operators: sums and products of numbers, frames and matrices, equations, conditions."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from symbody.geometry import Frame
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import (
    COMPARISON,
    POWER,
    SUM,
    grouped,
    plain_decimal,
    product,
    quotient,
)
from symbody.worksheet.convert.sequences import distinct
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["infix", "postfix", "prefix"]


def _compared(word: str) -> Callable[[str, str], str]:
    return lambda left, right: f"{grouped(left, COMPARISON + 1)} {word} {grouped(right, COMPARISON + 1)}"


def _difference(left: str, right: str) -> str:
    """Return a difference; that of a negative term is a sum."""
    if right.startswith("-") and grouped(right, SUM + 1) == right:
        return f"{grouped(left, SUM)} + {right[1:]}"
    return f"{grouped(left, SUM)} - {grouped(right, SUM + 1)}"


_OPERATIONS: Mapping[str, Callable[[str, str], str]] = {
    "+": lambda left, right: f"{grouped(left, SUM)} + {grouped(right, SUM + 1)}",
    "-": _difference,
    "/": quotient,
    "^": lambda left, right: f"{grouped(left)}**{grouped(right)}",
    "mod": lambda left, right: f"{grouped(left)} % {grouped(right)}",
    "union": lambda left, right: f"{grouped(left, SUM)} + {grouped(right, SUM + 1)}",
    "minus": lambda left, right: f"[item for item in {left} if item not in {grouped(right)}]",
    "intersect": lambda left, right: f"[item for item in {left} if item in {grouped(right)}]",
    "in": lambda left, right: f"{grouped(left, COMPARISON + 1)} in {grouped(right, COMPARISON + 1)}",
    "<>": lambda left, right: f"{grouped(left, COMPARISON + 1)} != {grouped(right, COMPARISON + 1)}",
    **{word: _compared(word) for word in ("<", "<=", ">", ">=")},
}


_ORDER = frozenset({"<", "<=", ">", ">="})


def prefix(to: Writer, node: syntax.Prefix) -> str:
    """Return a sign, or ``not``."""
    operand = to.text(node.operand)
    if node.operator == "not":
        return f"not {grouped(operand)}"
    if node.operator not in {"-", "+"}:
        raise NoText(node.operator)
    if node.operator == "-" and isinstance(to.value(operand), list):
        return f"[-each for each in {operand}]"
    return f"-{grouped(operand, POWER)}" if node.operator == "-" else operand


def infix(to: Writer, node: syntax.Infix) -> str:
    """Return an operation on two operands."""
    if node.operator == "=":
        return _equation(to, node)
    left, right = to.text(node.left), to.text(node.right)
    operator = node.operator
    left, right = _beside(to, left, right), _beside(to, right, left)
    by_entries = _by_entries(to, operator, left, right)
    if by_entries:
        return by_entries
    if operator in {"*", ".", "&*"}:
        return _product(to, left, right)
    if operator == "/" and isinstance(to.value(right), Matrix):
        inverse = f"{grouped(right)}.inverse()"
        return inverse if left == "1" else _product(to, left, inverse)
    power = _matrix_power(to, left, right) if operator == "^" else ""
    if power:
        return power
    if operator in {"+", "-"}:
        left, right = _with_identity(to, left, right), _with_identity(to, right, left)
    if operator == "/" and isinstance(to.value(left), int) and isinstance(to.value(right), int):
        left = left if left.isdigit() else f"sb.number({left})"
    writer = _OPERATIONS.get(operator)
    if writer is None:
        raise NoText(operator)
    if operator == "union" and isinstance(to.value(left), dict) and isinstance(to.value(right), dict):
        return f"{{**{left}, **{right}}}"
    if operator in _ORDER:
        left, right = _as_numbers(to, left, right)
    written = writer(left, right)
    return distinct(to, written) if operator == "union" else written


def _as_numbers(to: Writer, *sides: str) -> list[str]:
    """Return the sides of an inequality; constants, which have no order as expressions, as floats."""
    found = [to.value(side) for side in sides]
    are_constant = all(isinstance(each, int | float) or getattr(each, "is_constant", False) for each in found)
    return [
        f"float({side})" if are_constant and isinstance(each, Expr) else side
        for side, each in zip(sides, found, strict=True)
    ]


def _by_entries(to: Writer, operator: str, left: str, right: str) -> str:
    """Return a sum of lists, or a multiple of one, entry by entry; nothing for other operands."""
    a, b = to.value(left), to.value(right)
    if operator in {"+", "-"} and isinstance(a, list) and isinstance(b, list):
        return f"[a {operator} b for a, b in zip({left}, {right}, strict=True)]"
    if operator == "*" and isinstance(a, int | Expr) and isinstance(b, list):
        return f"[{product(left, 'each')} for each in {right}]"
    if operator in {"*", "/"} and isinstance(a, list) and isinstance(b, int | Expr):
        write = product if operator == "*" else quotient
        return f"[{write('each', right)} for each in {left}]"
    return ""


def _beside(to: Writer, text: str, other: str) -> str:
    """Return an operand; a decimal beside an expression needs no words."""
    return (
        plain_decimal(text) if isinstance(to.value(other), Expr) and plain_decimal(other) == other else text
    )


def _with_identity(to: Writer, text: str, other: str) -> str:
    """Return a number beside a matrix as a multiple of the identity, as Maple takes it."""
    matrix = to.value(other)
    if isinstance(matrix, Frame):
        matrix = matrix.matrix
    found = to.value(text)
    if isinstance(matrix, Matrix) and isinstance(found, int | Expr) and matrix.shape[0] == matrix.shape[1]:
        unit = f"sb.identity({matrix.shape[0]})"
        return unit if text == "1" else f"{grouped(text, POWER)}*{unit}"
    if isinstance(found, Frame) and isinstance(matrix, int | Expr | Matrix):
        return f"{grouped(text)}.matrix"
    return text


def _product(to: Writer, left: str, right: str) -> str:
    """Return a product of numbers, frames, or matrices."""
    a, b = to.value(left), to.value(right)
    if isinstance(a, Frame) and isinstance(b, Matrix):
        return f"{grouped(left)}.matrix @ {grouped(right)}"
    if isinstance(a, Matrix) and isinstance(b, list) and not isinstance(b[0], list):
        return f"{grouped(left)} @ sb.Matrix.column({right})"
    if isinstance(a, Matrix) and isinstance(b, Frame):
        return f"{grouped(left)} @ {grouped(right)}.matrix"
    if isinstance(a, Matrix) and isinstance(b, Matrix):
        return _matrix_product(left, right, a.shape, b.shape)
    return product(left, right)


def _matrix_product(left: str, right: str, one: tuple[int, int], other: tuple[int, int]) -> str:
    """Return the product of two matrices of some shapes; that of two vectors is a scalar."""
    if one == other and one[1] == 1 < one[0]:
        left, one = f"{grouped(left)}.T", one[::-1]
    written = product(left, right, " @ ")
    return f"({written})[0, 0]" if one[0] == other[1] == 1 < one[1] else written


def _matrix_power(to: Writer, base: str, exponent: str) -> str:
    """Return a power of a matrix to a small integer; nothing for other operands."""
    n = to.value(exponent)
    if not isinstance(to.value(base), Matrix) or not isinstance(n, int) or not 0 < abs(n) < 5:
        return ""
    factor = f"{grouped(base)}.inverse()" if n < 0 else grouped(base, POWER)
    return " @ ".join([factor] * abs(n))


def _equation(to: Writer, node: syntax.Infix) -> str:
    """Return ``{x: value}`` for what gives a variable a value, and ``left - right`` for another equation."""
    left, right = to.text(node.left), to.text(node.right)
    found = to.value(left)
    is_known = isinstance(found, Expr) and (found.is_variable or found.kind == "application")
    if is_known and not to.as_differences:
        return f"{{{left}: {plain_decimal(right)}}}"
    if to.names.as_pairs:
        return f"({left}, {right})"
    if right == "0":
        return left
    return _difference(left, right)


def postfix(to: Writer, node: syntax.Postfix) -> str:
    """Return a transposed matrix."""
    if node.operator in {"%T", "^%T"}:
        return f"{grouped(to.text(node.operand))}.T"
    raise NoText(node.operator)
