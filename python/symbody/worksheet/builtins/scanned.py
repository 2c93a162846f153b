"""Numbers and words that a text contains, by a format of C."""

from __future__ import annotations

import re
from collections.abc import Callable

from symbody.errors import WorksheetError
from symbody.symbolic import number
from symbody.worksheet.builtins.texts import unparsed
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import decimal
from symbody.worksheet.values.value import Listed, String, Value

__all__ = ["COMMANDS"]

_CONVERSION = re.compile(r"%(?P<skip>\*)?(?P<width>\d*)[lh]?(?P<kind>[a-zA-Z%])")
_FLOAT = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"

_KINDS: dict[str, tuple[str, Callable[[str], Value]]] = {
    "d": (r"[+-]?\d+", lambda text: number(int(text))),
    **dict.fromkeys("feg", (_FLOAT, lambda text: decimal(float(text), 16))),
    "s": (r"\S+", String),
    "c": (r".", String),
}
"""The pattern of each conversion, and what it makes of a text."""


def scanned(session: Session, text: Value, template: Value) -> Value:
    """sscanf(s, "%d %f"): the list of what the formats read, up to the first that finds nothing."""
    held, formats = unparsed(session, text), unparsed(session, template)
    found: list[Value] = []
    place = end = 0
    for each in _CONVERSION.finditer(formats):
        literal = _literal(held, place, formats[end : each.start()])
        if literal is None:
            return Listed(tuple(found))
        place, end = literal, each.end()
        if each["kind"] not in _KINDS:
            raise WorksheetError(
                f"sscanf: the format {each[0]} is not known; expected one of %d %f %e %g %s %c"
            )
        pattern, convert = _KINDS[each["kind"]]
        blanks = "" if each["kind"] == "c" else r"\s*"
        reach = len(held) if not each["width"] else place + _blanks(held, place) + int(each["width"])
        read = re.compile(f"{blanks}({pattern})").match(held, place, reach)
        if read is None:
            return Listed(tuple(found))
        place = read.end()
        if not each["skip"]:
            found.append(convert(read[1]))
    return Listed(tuple(found))


def _blanks(held: str, place: int) -> int:
    return len(held[place:]) - len(held[place:].lstrip())


def _literal(held: str, place: int, literal: str) -> int | None:
    """Return the place behind a text of the format, in which blanks stand for any; None if it is not there."""
    pattern = r"\s*".join(re.escape(word) for word in re.split(r"\s+", literal))
    found = re.compile(pattern).match(held, place)
    return None if found is None else found.end()


COMMANDS: dict[str, Command] = {"sscanf": scanned}
