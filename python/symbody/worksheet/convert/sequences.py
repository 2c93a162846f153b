"""Items: lists, arguments, comprehensions; sequences are opened in them."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from symbody.worksheet.convert.condition import condition
from symbody.worksheet.convert.frames import components
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.operations import SUM, grouped
from symbody.worksheet.convert.selections import word_of
from symbody.worksheet.convert.unrolled import at_values
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import mentions

__all__ = ["comprehension", "distinct", "item", "items", "listed"]


def items(to: Writer, nodes: tuple[syntax.Expression, ...]) -> str:
    """Return items behind each other; sequences are opened."""
    return ", ".join(text for node in nodes for text in [item(to, node)] if text)


_SEVERAL = frozenset({"solve", "fsolve", "eigenvals", "eigenvalues", "Dimension", "Dimensions"})
"""Commands whose values are a sequence in the worksheet."""


def item(to: Writer, node: syntax.Expression) -> str:
    """Return an item of a list, or an argument; a sequence is opened."""
    match node:
        case syntax.Call(function=syntax.Name(name="op"), arguments=(whole,)):
            return f"*{grouped(to.text(whole))}"
        case syntax.Call(function=syntax.Name(name="comp_XYZ" | "Comps"), arguments=arguments):
            return f"*{components(to, arguments)}"
        case syntax.Call(function=syntax.Name(name="seq"), arguments=(each, span)):
            return f"*{comprehension(to, each, span)}"
        case syntax.Call(function=syntax.Name(name="allvalues")):
            return f"*{to.text(node)}"
        case syntax.Infix(operator="$", left=each, right=syntax.Infix(operator="=") as span):
            return f"*{comprehension(to, each, span)}"
        case syntax.Call(
            function=syntax.Name(name=name) | syntax.Selection(indices=(syntax.Name(name=name),))
        ) if name in _SEVERAL:
            roots = to.text(node)
            return f"*{roots}" if _are_roots(to.value(roots)) else roots
        case syntax.SequenceDisplay(items=nodes):
            return items(to, nodes)
    text = to.text(node)
    return f"*{text}" if isinstance(node, syntax.Name) and isinstance(to.value(text), tuple) else text


def _are_roots(value: object) -> bool:
    """Whether a value is several roots of one unknown, which are a sequence in the worksheet."""
    return isinstance(value, np.ndarray) or (
        isinstance(value, list | tuple) and not any(isinstance(each, dict) for each in value)
    )


def distinct(text: Writer, written: str) -> str:
    """Return a list that stands for a set: without items that are equal."""
    found = text.value(written)
    is_distinct = not isinstance(found, list) or all(each not in found[:k] for k, each in enumerate(found))
    return written if is_distinct else f"list(dict.fromkeys({written}))"


def listed(to: Writer, nodes: tuple[syntax.Expression, ...]) -> str:
    """Return a list; one that holds an opened sequence alone is that list."""
    if len(nodes) == 1:
        only = item(to, nodes[0])
        if only.startswith("*"):
            found = only[1:]
            return found if isinstance(to.value(found), list) else f"[{only}]"
    written = [text for node in nodes for text in [item(to, node)] if text]
    return f"[{_first_components(written) or ', '.join(written)}]"


_COMPONENT = re.compile(r"(.*\.(?:components|coordinates))\[(\d)\]", re.DOTALL)


def _first_components(written: Sequence[str]) -> str:
    """Return ``*v.components[:2]`` for the first two components of a vector; nothing for another list."""
    found = [_COMPONENT.fullmatch(each) for each in written]
    wholes = {each[1] for each in found if each is not None}
    places = [each[2] for each in found if each is not None]
    if len(wholes) != 1 or len(places) < len(written) or places != ["0", "1"]:
        return ""
    return f"*{wholes.pop()}[:2]"


def comprehension(to: Writer, each: syntax.Expression, span: syntax.Expression) -> str:
    """Return ``[each for i in range(a, b + 1)]``, or over the items of a list."""
    match span:
        case syntax.Infix(
            operator="=", left=variable, right=syntax.Infix(operator="..", left=a, right=b)
        ) if mentions(each, syntax.Concatenation):
            with contextlib.suppress(NoText):
                return _comprehension(to, each, span)
            return f"[{items(to, tuple(at_values(to, each, word_of(variable), a, b)))}]"
    return _comprehension(to, each, span)


def _comprehension(to: Writer, each: syntax.Expression, span: syntax.Expression) -> str:
    name, over, first = _span(to, span)
    inner = to.names.inner()
    inner.values[name] = first
    writer = to.within(inner)
    match each:
        case syntax.Call(function=syntax.Name(name="if" | "ifelse"), arguments=(case, kept, nothing)) if (
            _is_null(nothing)
        ):
            return f"[{item(writer, kept)} for {name} in {over} if {condition(writer, case)}]"
    body = item(writer, each)
    if body.startswith("*"):
        return f"[item for {name} in {over} for item in {body[1:]}]"
    return f"[{body} for {name} in {over}]"


def _is_null(node: syntax.Expression) -> bool:
    return isinstance(node, syntax.Name) and node.name == "NULL"


def _span(to: Writer, span: syntax.Expression) -> tuple[str, str, Any]:
    """Return the variable of ``i = a..b`` or ``i in L``, what it goes over, and its first value."""
    match span:
        case syntax.Infix(
            operator="=", left=variable, right=syntax.Infix(operator="..", left=first, right=last)
        ):
            a, b = to.text(first), to.text(last)
            name = _bare(variable)
            if not isinstance(to.value(a), int):
                raise NoText("range")
            return name, f"range({a}, {_next(b)})", to.value(a)
        case syntax.Infix(operator="in" | "=", left=variable, right=whole):
            over = to.text(whole)
            found = to.value(over)
            if not isinstance(found, list | tuple) or not found:
                raise NoText("in")
            return _bare(variable), over, found[0]
    raise NoText("range")


def _bare(node: syntax.Expression) -> str:
    return identifier(word_of(node))


def _next(text: str) -> str:
    return str(int(text) + 1) if text.isdigit() else f"{grouped(text, SUM)} + 1"
