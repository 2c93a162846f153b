"""Lists and whole numbers: what Python's own functions say."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.condition import condition
from symbody.worksheet.convert.names import NoText, identifier
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
        if len(arguments) != 1 or not isinstance(text.value(whole), list | str):
            raise NoText("list")
        return form.format(whole)

    return write


def _paired(text: Writer, arguments: Arguments) -> str:
    """Return ``zip(f, L, M)``: f of the items of two lists."""
    function, *lists = arguments
    if len(lists) != 2:
        raise NoText("zip")
    one, other = (text.text(each) for each in lists)
    firsts = [text.value(f"{grouped(each)}[0]") for each in (one, other)]
    names = [each.name for each in function.parameters] if isinstance(function, syntax.Arrow) else ["a", "b"]
    inner = text.names.inner()
    inner.values |= dict(zip(map(identifier, names), firsts, strict=True))
    nodes = tuple(syntax.Name(each, place=function.place) for each in names)
    body = (
        function.body
        if isinstance(function, syntax.Arrow)
        else syntax.Call(function, nodes, place=function.place)
    )
    if isinstance(body, syntax.If):
        raise NoText("zip")
    return f"[{text.within(inner).text(body)} for {', '.join(map(identifier, names))} in zip({one}, {other})]"


def _mapped_second(text: Writer, arguments: Arguments) -> str:
    """Return ``map2(f, a, L)``: f of a and each item."""
    function, first, whole = arguments
    over = text.text(whole)
    inner = text.names.inner()
    inner.values["each"] = text.value(f"{grouped(over)}[0]")
    each = syntax.Name("each", place=function.place)
    call = syntax.Call(function, (first, each), place=function.place)
    return f"[{text.within(inner).text(call)} for each in {over}]"


_TYPES = {"integer": "int", "list": "list", "string": "str"}


def _selected(form: str) -> Call:
    """Return the writer of the items of a list that obey a condition, or of those that don't."""

    def write(text: Writer, arguments: Arguments) -> str:
        function, whole, *rest = arguments
        over = text.text(whole)
        each = _item_name(function, rest)
        inner = text.names.inner()
        inner.values[each] = text.value(f"{grouped(over)}[0]")
        if not isinstance(text.value(over), list):
            raise NoText("select")
        case = _case(text.within(inner), function, rest)
        return f"[{form.format(each=each, whole=over, case=case)}]"

    return write


def _item_name(function: syntax.Expression, rest: Sequence[syntax.Expression]) -> str:
    """Return the variable of the items: the parameter of an operator ``x -> condition``."""
    match function, rest:
        case syntax.Arrow(parameters=(parameter,)), ():
            return identifier(parameter.name)
    return "each"


def _case(text: Writer, function: syntax.Expression, rest: Sequence[syntax.Expression]) -> str:
    """Return the condition on an item."""
    each = syntax.Name("each", place=function.place)
    match function, rest:
        case syntax.Name(name="type"), (syntax.Name(name=kind),) if kind in _TYPES:
            return f"isinstance(each, {_TYPES[kind]})"
        case syntax.Name(name="has"), (what,):
            return f"each.has({text.text(what)})"
        case syntax.Arrow(parameters=(_,), body=body), () if not isinstance(body, syntax.If):
            return condition(text, body)
    return text.text(syntax.Call(function, (each, *rest), place=function.place))


def _found_place(text: Writer, arguments: Arguments) -> str:
    """Return the place of an item in a list, or zero."""
    item, whole = (text.text(each) for each in arguments)
    if isinstance(text.value(whole), str):
        return f"{grouped(whole)}.find({item}) + 1"
    return f"{grouped(whole)}.index({item}) + 1 if {item} in {whole} else 0"


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
        if len(arguments) == 1 and isinstance(text.value(written), list):
            written = f"*{grouped(written)}"
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
    "igcd": _of_integers("math.gcd"),
    "ilcm": _of_integers("math.lcm"),
    "zip": _paired,
    "map2": _mapped_second,
    "select": _selected("{each} for {each} in {whole} if {case}"),
    "remove": _selected("{each} for {each} in {whole} if not {case}"),
    "Search": _found_place,
    "Flatten": _of_list("np.ravel({0}).tolist()"),
    "binomial": _of_integers("math.comb"),
    "factorial": _of_integers("math.factorial"),
    **dict.fromkeys(("mul", "product"), _product),
    "max": _extreme("max", "sb.Max"),
    "min": _extreme("min", "sb.Min"),
    "D": _operator,
}
"""Writers by the names of commands."""
