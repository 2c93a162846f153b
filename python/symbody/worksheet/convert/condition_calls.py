"""Conditions as values, and what depends on them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.operators import condition
from symbody.worksheet.convert.parameter_types import type_test
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CONDITIONS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _chosen(text: Writer, arguments: Arguments) -> str:
    """Return ```if`(c, a, b)``."""
    case, *values = arguments
    if len(values) != 2:
        raise NoText("if")
    yes, no = (text.text(each) for each in values)
    return f"{yes} if {condition(text, case)} else {no}"


def _truth(text: Writer, arguments: Arguments) -> str:
    """Return ``evalb(a = b)``: whether both sides are equal."""
    return f"bool({condition(text, arguments[0])})"


def _pieces(text: Writer, arguments: Arguments) -> str:
    """Return ``piecewise(c, a, ..., otherwise)``."""
    pairs = [f"({text.text(value)}, {condition(text, case)})" for case, value in _cases(arguments)]
    rest = [text.text(arguments[-1])] if len(arguments) % 2 else []
    return f"sb.Piecewise({', '.join([*pairs, *(f'otherwise={each}' for each in rest)])})"


def _cases(arguments: Arguments) -> Iterator[tuple[syntax.Expression, syntax.Expression]]:
    """Return conditions with their values."""
    return zip(arguments[::2], arguments[1::2], strict=False)


def _has(text: Writer, arguments: Arguments) -> str:
    whole, what = (text.text(each) for each in arguments)
    found, wanted = text.value(whole), text.value(what)
    if isinstance(found, Matrix):
        whole, found = f"{grouped(whole)}.entries", list(found.entries)
    if not isinstance(found, Expr | list | tuple) or not isinstance(wanted, Expr | list):
        raise NoText("has")
    one = "each" if not isinstance(found, Expr) else grouped(whole)
    loops = f" for each in {whole}" if not isinstance(found, Expr) else ""
    if isinstance(wanted, list):
        return f"any({one}.has(x){loops} for x in {what})"
    return f"any({one}.has({what}){loops})" if loops else f"{one}.has({what})"


def _member(text: Writer, arguments: Arguments) -> str:
    if len(arguments) != 2:
        raise NoText("member")
    return f"{text.text(arguments[0])} in {text.text(arguments[1])}"


def _typed(text: Writer, arguments: Arguments) -> str:
    """Return ``type(x, BODY)``: whether a value is of a class."""
    whole, kind = arguments
    test = type_test(kind, grouped(text.text(whole)))
    if not test:
        raise NoText("type")
    return test


def _names_of(text: Writer, arguments: Arguments) -> str:
    """Return ``indets(e)`` of an expression, a list or a matrix: its variables."""
    (whole,) = arguments
    written = text.text(whole)
    found = text.value(written)
    if isinstance(found, Matrix):
        return f"[*sb.symbolic.free_symbols({grouped(written)}.entries)]"
    if isinstance(found, dict):
        raise NoText("indets")
    return f"[*sb.symbolic.free_symbols({written if isinstance(found, list) else f'[{written}]'})]"


CONDITIONS: Mapping[str, Call] = {
    **dict.fromkeys(("if", "ifelse"), _chosen),
    **dict.fromkeys(("evalb", "is"), _truth),
    "piecewise": _pieces,
    "has": _has,
    "member": _member,
    "type": _typed,
    "indets": _names_of,
}
"""Writers by the names of commands."""
