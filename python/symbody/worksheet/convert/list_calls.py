"""Lists and whole numbers: what Python's own functions say."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.sequences import comprehension, items
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["LISTS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _replaced(text: Writer, arguments: Arguments) -> str:
    """Return ``subsop(2 = z, L)``."""
    match arguments:
        case (syntax.Infix(operator="=", left=syntax.Integer(value=place), right=new), whole) if place > 0:
            found = grouped(text.text(whole))
            if isinstance(text.value(found), list):
                return f"[*{found}[:{place - 1}], {text.text(new)}, *{found}[{place}:]]"
    raise NoText("subsop")


def _sorted(text: Writer, arguments: Arguments) -> str:
    if len(arguments) != 1:
        raise NoText("sort")
    return f"sorted({text.text(arguments[0])})"


def _of_list(form: str) -> Call:
    """Return the writer of a command of a list by a text with ``{0}`` for it."""

    def write(text: Writer, arguments: Arguments) -> str:
        whole = text.text(arguments[0])
        if len(arguments) != 1 or not isinstance(text.value(whole), list):
            raise NoText("list")
        return form.format(whole)

    return write


def _of_integers(function: str) -> Call:
    """Return the writer of a function of whole numbers."""

    def write(text: Writer, arguments: Arguments) -> str:
        if not all(isinstance(text.value(text.text(each)), int) for each in arguments):
            raise NoText(function)
        return f"{function}({items(text, arguments)})"

    return write


def _extreme(of_numbers: str, of_expressions: str) -> Call:
    """Return the writer of max or min."""

    def write(text: Writer, arguments: Arguments) -> str:
        written = items(text, arguments)
        found = text.value(f"[{written}]")
        are_numbers = isinstance(found, list) and all(isinstance(each, int | float) for each in found)
        return f"{of_numbers if are_numbers else of_expressions}({written})"

    return write


def _product(text: Writer, arguments: Arguments) -> str:
    body, span = arguments
    return f"math.prod({comprehension(text, body, span)[1:-1]})"


def _operator(text: Writer, arguments: Arguments) -> str:
    """Return D of an operator ``x -> e``: a function of the point."""
    match arguments:
        case (syntax.Arrow(parameters=(parameter,), body=body),) if not isinstance(body, syntax.If):
            name = text.text(syntax.Name(parameter.name, place=body.place))
            known = text.value(name)
            if isinstance(known, Expr) and known.kind == "symbol":
                slope = f"sb.diff({text.text(body)}, {name})"
                return f"lambda {name}_: sb.subs({slope}, {{{name}: {name}_}})"
    raise NoText("D")


LISTS: Mapping[str, Call] = {
    "subsop": _replaced,
    "Reverse": _of_list("{0}[::-1]"),
    "MakeUnique": _of_list("list(dict.fromkeys({0}))"),
    "sort": _sorted,
    **dict.fromkeys(("gcd", "igcd"), _of_integers("math.gcd")),
    **dict.fromkeys(("lcm", "ilcm"), _of_integers("math.lcm")),
    "binomial": _of_integers("math.comb"),
    "factorial": _of_integers("math.factorial"),
    **dict.fromkeys(("mul", "product"), _product),
    "max": _extreme("max", "sb.Max"),
    "min": _extreme("min", "sb.Min"),
    "D": _operator,
}
"""Writers by the names of commands."""
