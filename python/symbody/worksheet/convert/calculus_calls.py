"""Integrals, limits, sums and transforms, which SymPy finds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CALCULUS", "for_sympy", "infinity"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def for_sympy(text: Writer, node: syntax.Expression) -> str:
    """Return an expression as one of SymPy."""
    if infinity(node):
        return infinity(node)
    written = text.text(node)
    found = text.value(written)
    if not isinstance(found, Expr | int):
        raise NoText("int")
    return written if isinstance(found, int) else f"sb.to_sympy({written})"


def infinity(node: syntax.Expression) -> str:
    """Return infinity as SymPy has it; nothing for another expression."""
    match node:
        case syntax.Name(name="infinity"):
            return "sympy.oo"
        case syntax.Prefix(operator="-", operand=syntax.Name(name="infinity")):
            return "-sympy.oo"
    return ""


def _span(text: Writer, node: syntax.Expression) -> str:
    """Return ``x``, or ``x = a..b`` as the tuple that SymPy takes."""
    match node:
        case syntax.Infix(
            operator="=", left=variable, right=syntax.Infix(operator="..", left=first, right=last)
        ):
            return f"({', '.join(for_sympy(text, each) for each in (variable, first, last))})"
        case syntax.Name() | syntax.Call():
            return for_sympy(text, node)
    raise NoText("int")


def _place(text: Writer, node: syntax.Expression) -> str:
    """Return ``x = a`` as the two arguments that SymPy takes."""
    match node:
        case syntax.Infix(operator="=", left=variable, right=place):
            return f"{for_sympy(text, variable)}, {for_sympy(text, place)}"
    raise NoText("limit")


def _over(function: str, span: Callable[[Writer, syntax.Expression], str] = _span) -> Call:
    """Return the writer of what is taken over a span, or at a place; it is worked out."""

    def write(text: Writer, arguments: Arguments) -> str:
        if len(arguments) != 2:
            raise NoText(function)
        return f"sb.from_sympy({function}({for_sympy(text, arguments[0])}, {span(text, arguments[1])}))"

    return write


def _inert(function: str, span: Callable[[Writer, syntax.Expression], str] = _span) -> Call:
    """Return the writer of what is not worked out until ``value`` asks for it."""
    worked_out = _over(function, span)
    return lambda text, arguments: worked_out(text, arguments).removeprefix("sb.from_sympy(")[:-1]


def _worked_out(text: Writer, arguments: Arguments) -> str:
    """Return ``value(e)``."""
    written = text.text(arguments[0])
    found = text.value(written)
    return f"sb.from_sympy({grouped(written)}.doit())" if hasattr(found, "doit") else written


def _transform(form: str) -> Call:
    """Return the writer of a transform of Laplace."""

    def write(text: Writer, arguments: Arguments) -> str:
        if len(arguments) != 3:
            raise NoText("laplace")
        return f"sb.from_sympy({form.format(*(for_sympy(text, each) for each in arguments))})"

    return write


CALCULUS: Mapping[str, Call] = {
    "int": _over("sympy.integrate"),
    "limit": _over("sympy.limit", _place),
    "Int": _inert("sympy.Integral"),
    "Limit": _inert("sympy.Limit", _place),
    "Sum": _inert("sympy.Sum"),
    "value": _worked_out,
    "laplace": _transform("sympy.laplace_transform({0}, {1}, {2}, noconds=True)"),
}
"""Writers by the names of commands."""
