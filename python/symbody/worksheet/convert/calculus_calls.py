"""Integrals and limits, which SymPy finds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CALCULUS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _for_sympy(text: Writer, node: syntax.Expression) -> str:
    """Return an expression as one of SymPy."""
    match node:
        case syntax.Name(name="infinity"):
            return "sympy.oo"
        case syntax.Prefix(operator="-", operand=syntax.Name(name="infinity")):
            return "-sympy.oo"
    written = text.text(node)
    found = text.value(written)
    if not isinstance(found, Expr | int):
        raise NoText("int")
    return written if isinstance(found, int) else f"sb.to_sympy({written})"


def _integral(text: Writer, arguments: Arguments) -> str:
    """Return ``int(e, x)`` or ``int(e, x = a..b)``."""
    match arguments:
        case (
            value,
            syntax.Infix(
                operator="=", left=variable, right=syntax.Infix(operator="..", left=first, right=last)
            ),
        ):
            parts = ", ".join(_for_sympy(text, each) for each in (variable, first, last))
            return f"sb.from_sympy(sympy.integrate({_for_sympy(text, value)}, ({parts})))"
        case value, (syntax.Name() | syntax.Call()) as variable:
            parts = ", ".join(_for_sympy(text, each) for each in (value, variable))
            return f"sb.from_sympy(sympy.integrate({parts}))"
    raise NoText("int")


def _limit(text: Writer, arguments: Arguments) -> str:
    """Return ``limit(e, x = a)``."""
    match arguments:
        case value, syntax.Infix(operator="=", left=variable, right=place):
            parts = ", ".join(_for_sympy(text, each) for each in (value, variable, place))
            return f"sb.from_sympy(sympy.limit({parts}))"
    raise NoText("limit")


CALCULUS: Mapping[str, Call] = {"int": _integral, "limit": _limit}
"""Writers by the names of commands."""
