"""Functions of numbers: roots, whole parts, and functions that few sheets use."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import POWER, grouped
from symbody.worksheet.convert.writer import Arguments, Writer

__all__ = ["ELEMENTARY"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _whole(function: str) -> Call:
    """Return the writer of a whole number beside a constant."""

    def write(text: Writer, arguments: Arguments) -> str:
        (node,) = arguments
        whole = text.text(node)
        found = text.value(whole)
        if isinstance(found, int | float):
            return f"{function}({whole})"
        if not isinstance(found, Expr) or not found.is_constant:
            raise NoText(function)
        return f"{function}(float({whole}))"

    return write


def _form(form: str, count: int) -> Call:
    """Return the writer of a function by a text with ``{0}``, ``{1}`` for the arguments."""

    def write(text: Writer, arguments: Arguments) -> str:
        if len(arguments) != count:
            raise NoText(form)
        return form.format(*(grouped(text.text(each), POWER) for each in arguments))

    return write


ELEMENTARY: Mapping[str, Call] = {
    **{name: _whole(f"math.{name}") for name in ("floor", "ceil", "trunc")},
    "round": _whole("round"),
    "root": _form('{0}**sb.number("1/{1}")', 2),
    "iquo": _form("{0} // {1}", 2),
    "irem": _form("{0} % {1}", 2),
    "modp": _form("{0} % {1}", 2),
    "log10": _form("sb.log({0})/sb.log(10)", 1),
    "csgn": _form("sb.sign({0})", 1),
    "arccot": _form("sb.pi/2 - sb.atan({0})", 1),
    "frac": _form("{0} - math.trunc(float({0}))", 1),
    "evalhf": _form("float({0})", 1),
    "isprime": _form("sympy.isprime({0})", 1),
}
"""Writers by the names of commands."""
