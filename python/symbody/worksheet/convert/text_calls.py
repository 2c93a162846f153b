"""Texts: formats and the commands of StringTools; the methods of ``str`` say the same."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import POWER, SUM, grouped
from symbody.worksheet.convert.sequences import item as opened
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["TEXTS", "formatted"]

Call: TypeAlias = Callable[[Writer, Arguments], str]
_CONVERSION = re.compile(r"%[-+ 0#]*\d*(?:\.\d+)?(.)")


def formatted(text: Writer, form: str, rest: Sequence[syntax.Expression]) -> str:
    """Return a format of ``printf`` with its values as a format of Python; texts are written as they are."""
    kinds = [kind for kind in _CONVERSION.findall(form) if kind != "%"]
    values: list[str] = []
    for each in rest:
        part = opened(text, each)
        part = f"*{part}" if isinstance(text.value(part), tuple) else part
        found = text.value(f"[{part}]")
        if not isinstance(found, list) or len(found) > len(kinds):
            raise NoText("printf")
        values.append(_with_floats(part, found, kinds[: len(found)]))
        kinds = kinds[len(found) :]
    if kinds:
        raise NoText("printf")
    if not values:
        return repr(form.replace("%%", "%"))
    form = _CONVERSION.sub(lambda found: found[0][:-1] + "s" if found[1] == "a" else found[0], form)
    return f"{form!r} % ({', '.join(values)}{',' if len(values) == 1 else ''})"


def _with_floats(part: str, values: Sequence[object], kinds: Sequence[str]) -> str:
    """Return an argument of a format, whose expressions are numbers where the format prints numbers.

    Args:
        part: the argument, which may be several.
        values: what it holds.
        kinds: the letters of the formats that print it.
    """
    pairs = zip(values, kinds, strict=True)
    if not any(isinstance(value, Expr) and kind not in "as" for value, kind in pairs):
        return part
    return f"*map(float, {part[1:]})" if part.startswith("*") else f"float({part})"


def _format(text: Writer, arguments: Arguments) -> str:
    """Return ``sprintf``."""
    form, *rest = arguments
    if not isinstance(form, syntax.Text):
        raise NoText("sprintf")
    return formatted(text, form.text, rest)


def _joined(text: Writer, arguments: Arguments) -> str:
    """Return ``cat(a, b)`` of texts; integers may follow the first one."""
    first, *rest = (text.text(each) for each in arguments)
    if not isinstance(text.value(first), str):
        raise NoText("cat")
    parts = [first, *(f"str({each})" if type(text.value(each)) is int else each for each in rest)]
    if not all(isinstance(text.value(each), str) for each in parts):
        raise NoText("cat")
    return " + ".join(grouped(each, SUM) for each in parts)


def _of_texts(form: str) -> Call:
    """Return the writer of a command of texts by a text with ``{0}``, ``{1}`` for them."""
    count = len(set(re.findall(r"\{\d\}", form)))

    def write(text: Writer, arguments: Arguments) -> str:
        written = [text.text(each) for each in arguments]
        if len(written) != count or not all(isinstance(text.value(each), str) for each in written):
            raise NoText("text")
        return form.format(*(grouped(each, POWER) for each in written))

    return write


def _part(text: Writer, arguments: Arguments) -> str:
    """Return ``substring(s, a..b)``."""
    match arguments:
        case (
            whole,
            syntax.Infix(operator="..", left=syntax.Integer(value=a), right=syntax.Integer(value=b)),
        ) if 0 < a <= b:
            return f"{grouped(text.text(whole), POWER)}[{'' if a == 1 else a - 1}:{b}]"
    raise NoText("substring")


TEXTS: Mapping[str, Call] = {
    "cat": _joined,
    "sprintf": _format,
    "length": _of_texts("len({0})"),
    "substring": _part,
    "UpperCase": _of_texts("{0}.upper()"),
    "LowerCase": _of_texts("{0}.lower()"),
    "Trim": _of_texts("{0}.strip()"),
    "Substitute": _of_texts("{0}.replace({1}, {2}, 1)"),
    "SubstituteAll": _of_texts("{0}.replace({1}, {2})"),
    **dict.fromkeys(("SearchText", "searchtext"), _of_texts("{1}.find({0}) + 1")),
    "IsDigit": _of_texts("{0}.isdigit()"),
    "Explode": _of_texts("list({0})"),
}
"""Writers by the names of commands."""
