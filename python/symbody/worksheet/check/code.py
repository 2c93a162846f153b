"""Printed programs: a sequence of assignments is compared by the values of its results."""

from __future__ import annotations

import re
from collections.abc import Iterable

from symbody.symbolic import Expr, symbol
from symbody.worksheet.check.compare import same_value
from symbody.worksheet.check.printed import NotComparable, functions_in, printed, value_of

__all__ = ["code_difference"]

_ASSIGNMENT = re.compile(r"\s*(\w+(?:\s*[(\[][\d, \]\[]*[)\]])?)\s*=(?!=)(.*)", re.DOTALL)
_CONTINUED = re.compile(r"\n     [&#$+]")
_PART = re.compile(r"t\d+")


def code_difference(theirs: Iterable[str], ours: Iterable[str]) -> str:
    """Return where a program of the run computes something else than the file's, or "" if it doesn't.

    Raises:
        NotComparable: a program is no sequence of assignments that can be read.
    """
    file, run = _results("\n".join(theirs)), _results("\n".join(ours))
    if file.keys() != run.keys():
        return f"the file computes {', '.join(file)}, the run {', '.join(run)}"
    return next((f"{name} has another value" for name in file if not same_value(file[name], run[name])), "")


def _results(text: str) -> dict[str, Expr]:
    """Return what a program computes: its names but for those of parts, or the last one."""
    values: dict[str, Expr] = {}
    for statement in _statements(text):
        match = _ASSIGNMENT.fullmatch(statement)
        if match is None:
            raise NotComparable("the program is more than a sequence of assignments")
        expression = printed(_as_maple(match[2])).expression
        value = value_of(expression, functions_in(expression))
        if not isinstance(value, Expr):
            raise NotComparable(f"the value of {match[1]} in the program is no expression")
        known = {symbol(name): each for name, each in values.items()}
        values[re.sub(r"\s", "", match[1])] = value.subs(known) if known else value
    named = {name: value for name, value in values.items() if not _PART.fullmatch(name)}
    return named or dict(list(values.items())[-1:])


def _statements(text: str) -> list[str]:
    joined = _CONTINUED.sub(" ", text)
    pieces = joined.split(";") if ";" in joined else joined.split("\n")
    return [piece for piece in pieces if piece.strip()]


def _as_maple(text: str) -> str:
    """Return an expression of a program with Maple's operators and numbers."""
    text = re.sub(r"(?<=\d)[dD](?=[+-]?\d)", "e", text)
    text = re.sub(r"\b[mM]ath\.", "", text)
    return re.sub(r"\.(?=[*/^])", "", text)
