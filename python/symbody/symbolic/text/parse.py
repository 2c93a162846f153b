"""Expressions from plain text; ``parse`` reads what ``str`` prints."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from symbody.errors import ArgumentError, user_frame
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import Meaning, pi, t
from symbody.symbolic.given.arguments import described
from symbody.symbolic.given.new_namesake import notice_namesakes

__all__ = ["parse"]

_NAME = r"[^\W\d]\w*"
_DEFINITION = re.compile(rf"\s*({_NAME})\s*:?=(?!=)")
_OF_TIME = re.compile(rf"({_NAME})'+(?!\s*\(|')|\bdiff\(\s*({_NAME})\s*,\s*t\b")


def parse(text: str, names: Mapping[str, Meaning] | None = None) -> Expr:
    """Return the expression that a text denotes.

    ``names`` gives the meanings of names. Any other name is a real symbol, or a function of time where the text
    differentiates it, as in ``x'`` or ``diff(x, t)``. Lines ``z1 = ...`` before the expression define names, as do
    lines ``c1 := ...``, which `show` prints; these may go on in lines that begin with a sign.

    Raises:
        ParseError: the text is not an expression; the message shows where, and what was expected.

    >>> from symbody import parse, symbols
    >>> parse("m*x'' + k*x - F")
    m*x'' + k*x - F
    >>> length = symbols("length", positive=True)
    >>> parse("sqrt(length**2)", names={"length": length})
    length
    """
    if not isinstance(text, str):
        raise ArgumentError(f"parse: {described(text)}; expected a text, such as 'm*x + k*x'")
    from symbody.symbolic.text.syntax import Source  # noqa: PLC0415 - the first text loads the parser

    before = _core.node_count()
    known: dict[str, Meaning] = {"pi": pi, "t": t}
    known |= {name: _core.time_function(name) for name in _functions_of_time(text)}
    known |= names or {}
    lines, row = text.split("\n"), 0
    while row < len(lines):
        definition = _DEFINITION.match(lines[row])
        if definition is None:
            result = Source(lines, row, 0, len(lines)).parse(known)
            # What existed before has been noticed, or was printed in another place.
            made = [leaf for leaf in result.free_symbols if leaf.id >= before]
            notice_namesakes(sorted(made, key=str), "parse", user_frame())
            return result
        end = _end_of_definition(lines, row, definition)
        known[definition[1]] = Source(lines, row, definition.end(), end).parse(known)
        row = end
    raise Source(lines, len(lines), 0, len(lines)).error(
        len(lines), len(lines[-1]) + 1, "found definitions only, expected an expression after them"
    )


def _end_of_definition(lines: Sequence[str], row: int, definition: re.Match[str]) -> int:
    """Return the row after a definition: one with ``:=`` goes on in lines that begin with a sign."""
    end = row + 1
    while definition[0].endswith(":=") and end < len(lines) and lines[end].lstrip().startswith(("+ ", "- ")):
        end += 1
    return end


def _functions_of_time(text: str) -> Iterable[str]:
    """Return the names that the text differentiates with respect to time."""
    return (match[1] or match[2] for match in _OF_TIME.finditer(text))
