"""Strings and formatted printing."""

from __future__ import annotations

import re

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.printing.print import Style, text_of
from symbody.worksheet.values.integers import MOST_BITS, number_text
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, as_integer
from symbody.worksheet.values.value import NULL, Array, Listed, Range, String, Value

__all__ = ["COMMANDS", "formatted", "unparsed"]


def unparsed(session: Session, value: Value) -> str:
    """Return a value as text, without primes and aliases; a name without backquotes, a string without its own."""
    if isinstance(value, String):
        return value.text
    if isinstance(value, Expr) and value.kind == "symbol":
        return str(value.name)
    return _in_syntax(session, value)


def _in_syntax(session: Session, value: Value) -> str:
    """Return a value as a sheet would write it."""
    return text_of(value, Style(digits=session.options.digits, raw=frozenset(session.opaque)))


_FORMAT = re.compile(
    r"%(?P<before>[-+ 0#]*)(?:\{(?P<table>[^}]*)\})?(?P<flags>[-+ 0#]*)"
    r"(?P<width>\d+|\*)?(?:\.(?P<precision>\d+|\*))?(?P<long>[lhZ]*)(?P<kind>[a-zA-Z%])"
)
_SEPARATOR = re.compile(r"(?:c(?P<character>.))?", re.DOTALL)
"""The options of a table that are known: ``c`` and the character between the entries of a row."""


def formatted(session: Session, template: Value, values: tuple[Value, ...]) -> str:
    """Return a text as C's printf makes it; ``%a`` writes any value."""
    text = unparsed(session, template)
    pending = list(values)

    def piece(found: re.Match[str]) -> str:
        kind = found["kind"]
        if kind == "%":
            return "%"
        width, precision = (_size(each, pending) for each in (found["width"], found["precision"]))
        if not pending:
            raise WorksheetError(f"printf: the format {found[0]} has no value")
        if int(width or 0) > 10_000 or int(precision or 0) > 1000:
            raise WorksheetError(f"printf: the format {found[0]} is too wide")
        flags = found["before"] + found["flags"]
        value = pending.pop(0)
        if kind in "qQ":
            listed = ", ".join(_piece(session, "", "", None, kind, each) for each in (value, *pending))
            pending.clear()
            return f"%{flags}{width or ''}s" % listed
        rows = _rows(session, value) if kind in "dfeg" else None
        if rows is None:
            return _piece(session, flags, width or "", precision, kind, value)
        between = _separator(found["table"] or "", found[0])
        return "\n".join(
            between.join(_piece(session, flags, width or "", precision, kind, each) for each in row)
            for row in rows
        )

    return _FORMAT.sub(piece, text)


def _rows(session: Session, value: Value) -> list[list[Value]] | None:
    """Return the rows of a matrix, or the entries of a vector or a list as one row; None of other values."""
    match session.resolve(value):
        case Array(rows=rows, columns=columns, entries=entries):
            wide = columns if rows > 1 and columns > 1 else max(len(entries), 1)
            items = [session.current(each) for each in entries]
            return [items[i : i + wide] for i in range(0, len(items), wide)]
        case Listed(items=listed):
            return [[session.current(each) for each in listed]]
    return None


def _separator(options: str, where: str) -> str:
    """Return what stands between the entries of a row: a blank, or the character of ``%{c,}f``."""
    found = _SEPARATOR.fullmatch(options)
    if found is None:
        raise WorksheetError(
            f"printf: the option {{{options}}} of {where} is not known; expected {{c,}}, "
            "where c is followed by the character between entries"
        )
    return found["character"] or " "


def _size(text: str | None, pending: list[Value]) -> str | None:
    """Return a width or a precision; that of ``*`` is the next argument."""
    return str(as_integer(pending.pop(0)) or 0) if text == "*" and pending else text


def _piece(session: Session, flags: str, width: str, precision: str | None, kind: str, value: Value) -> str:
    """Return a value in a format of C.

    Args:
        session: the session.
        flags: ``+0`` of the format ``%+06.3f``.
        width: its ``6``.
        precision: its ``3``.
        kind: its letter.
        value: the value.
    """
    point = f".{precision}" if precision is not None else ""
    if kind in "aAsc" or kind in "qQp":
        text = _in_syntax(session, value) if kind in "aq" else unparsed(session, value)
        return f"%{flags.replace('0', '').replace('+', '')}{width}{point}s" % text
    if kind in "di":
        return _integer_piece(session, flags, width, point, value)
    amount = as_float(scalar(session, value)) if isinstance(value, Expr) else None
    if amount is None:
        raise WorksheetError(f"printf: a number expected for %{kind}, found {session.text(value)[:60]}")
    if kind in "xXo":
        return f"%{flags}{width}{kind}" % (as_integer(value) or 0)
    if kind in "feEgG":
        return f"%{flags}{width}{point}{kind}" % amount
    raise WorksheetError(f"printf: the format %{kind} is not known; expected one of %d %f %e %g %s %a")


def _integer_piece(session: Session, flags: str, width: str, point: str, value: Value) -> str:
    """Return an integer in a format such as ``%+6d``; one of very many digits is longer than any width.

    Args:
        session: the session.
        flags: signs and zeros of the format, such as ``+``.
        width: the least number of characters.
        point: the number of digits, with its point.
        value: the integer.
    """
    whole = as_integer(value)
    if whole is None or not isinstance(value, Expr):
        raise WorksheetError(f"printf: integer expected for %d, found {session.text(value)[:60]}")
    if whole.bit_length() > MOST_BITS:
        return number_text(value).rjust(int(width or 0))
    return f"%{flags}{width}{point}d" % whole


def printf(session: Session, template: Value, *values: Value) -> Value:
    """printf(format, ..)."""
    text = formatted(session, template, values)
    session.shown.append(text)
    session.write(text)
    return NULL


def sprintf(session: Session, template: Value, *values: Value) -> Value:
    """sprintf(format, ..): a string."""
    return String(formatted(session, template, values))


def nprintf(session: Session, template: Value, *values: Value) -> Value:
    """nprintf(format, ..): a name."""
    return symbol(formatted(session, template, values))


def cat(session: Session, *values: Value) -> Value:
    """cat(a, b, ..): a name, or a string if the first argument is one; of a range 1..n, as many."""
    place = next((i for i, each in enumerate(values) if isinstance(each, Range)), None)
    if place is not None and (numbers := _whole_numbers(session, values[place])):
        return sequence([cat(session, *values[:place], each, *values[place + 1 :]) for each in numbers])
    parts = [unparsed(session, each) for each in values]
    session.limits.check_items(sum(map(len, parts)))
    text = "".join(parts)
    return String(text) if values and isinstance(values[0], String) else session.value(text)


def _whole_numbers(session: Session, value: Value) -> list[Expr]:
    """Return the numbers of a range of integers; none of another range."""
    if not isinstance(value, Range):
        return []
    first, last = (as_integer(session.current(each)) for each in (value.start, value.stop))
    if first is None or last is None:
        return []
    session.limits.check_items(last - first + 1)
    return [number(i) for i in range(first, last + 1)]


def length(session: Session, value: Value) -> Value:
    """length(e): of a string, its letters; of an integer, its digits; of other values, the length of their text."""
    if isinstance(value, String):
        return number(len(value.text))
    if isinstance(value, Expr) and as_integer(value) is not None:
        return number(0 if value.is_zero else len(number_text(value).lstrip("-")))
    return number(len(unparsed(session, value)))


def substring(session: Session, text: Value, places: Value) -> Value:
    """substring(s, i..j)."""
    held = unparsed(session, text)
    if isinstance(places, Range):
        start, stop = as_integer(places.start) or 1, as_integer(places.stop)
        stop = len(held) if stop is None else stop
        start, stop = (each if each >= 0 else len(held) + 1 + each for each in (start, stop))
        made = held[max(start, 1) - 1 : stop]
    else:
        place = as_integer(places) or 1
        made = held[place - 1 : place] if place > 0 else held[place:][:1]
    return String(made) if isinstance(text, String) else symbol(made)


def search_text(session: Session, pattern: Value, text: Value) -> Value:
    """searchtext(pattern, s): where a text occurs, without regard to case; 0 if it doesn't."""
    return number(unparsed(session, text).lower().find(unparsed(session, pattern).lower()) + 1)


def parse(session: Session, text: Value, *options: Value) -> Value:
    """parse(s): the expression that a string holds."""
    return session.parsed(unparsed(session, text))


def upper(session: Session, text: Value) -> Value:
    """StringTools[UpperCase](s)."""
    return String(unparsed(session, text).upper())


def lower(session: Session, text: Value) -> Value:
    """StringTools[LowerCase](s)."""
    return String(unparsed(session, text).lower())


def replaced(session: Session, text: Value, old: Value, new: Value) -> Value:
    """StringTools[SubstituteAll](s, old, new)."""
    return String(unparsed(session, text).replace(unparsed(session, old), unparsed(session, new)))


def split(session: Session, text: Value, separator: Value | None = None) -> Value:
    """StringTools[Split](s, separator)."""
    pieces = unparsed(session, text).split(unparsed(session, separator) if separator is not None else " ")
    return Listed(tuple(String(piece) for piece in pieces))


def joined(session: Session, pieces: Value, separator: Value | None = None) -> Value:
    """StringTools[Join]([s, ..], separator)."""
    if not isinstance(pieces, Listed):
        raise WorksheetError(f"Join: a list of strings expected, found {session.text(pieces)[:60]}")
    between = " " if separator is None else unparsed(session, separator)
    return String(between.join(unparsed(session, each) for each in pieces.items))


def trimmed(session: Session, text: Value) -> Value:
    """StringTools[Trim](s): without blanks at its ends."""
    return String(unparsed(session, text).strip())


def search(session: Session, pattern: Value, text: Value) -> Value:
    """StringTools[Search](pattern, s): where a text occurs; 0 if it doesn't."""
    return number(unparsed(session, text).find(unparsed(session, pattern)) + 1)


def reverse(session: Session, text: Value) -> Value:
    """StringTools[Reverse](s)."""
    return String(unparsed(session, text)[::-1])


def explode(session: Session, text: Value) -> Value:
    """StringTools[Explode](s): the list of its characters."""
    return Listed(tuple(String(each) for each in unparsed(session, text)))


def is_digit(session: Session, text: Value) -> Value:
    """StringTools[IsDigit](s): whether all its characters are digits."""
    return symbol("true" if set(unparsed(session, text)) <= set("0123456789") else "false")


COMMANDS: dict[str, Command] = {
    "printf": printf,
    "sprintf": sprintf,
    "nprintf": nprintf,
    "cat": cat,
    "length": length,
    "substring": substring,
    "searchtext": search_text,
    "SearchText": search_text,
    "parse": parse,
}

PACKAGES: dict[str, dict[str, Command]] = {
    "StringTools": {
        "UpperCase": upper,
        "LowerCase": lower,
        "SubstituteAll": replaced,
        "Substitute": lambda session, text, old, new: String(
            unparsed(session, text).replace(unparsed(session, old), unparsed(session, new), 1)
        ),
        "Split": split,
        "Join": joined,
        "Trim": trimmed,
        "Search": search,
        "Length": length,
        "Reverse": reverse,
        "Explode": explode,
        "IsDigit": is_digit,
    }
}
