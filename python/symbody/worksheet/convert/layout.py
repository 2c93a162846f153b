"""Lines of a program that are too long to be read, on several lines."""

from __future__ import annotations

import ast
from collections.abc import Iterator

__all__ = ["laid_out"]

_WIDTH = 100
_INDENT = "    "
_OPENING, _CLOSING = "([{", ")]}"


def laid_out(line: str) -> list[str]:
    """Return a line of code, or the lines that say the same, broken at commas and before signs within brackets.

    >>> laid_out("x = f(" + ", ".join(["argument"] * 12) + ")")[:2]
    ['x = f(', '    argument,']
    """
    if len(line) <= _WIDTH or line.lstrip().startswith("#"):
        return [line]
    indent = line[: len(line) - len(line.lstrip())]
    lines = [indent + each for each in _broken(line.strip())]
    return lines if _is_same(line.strip(), [each.removeprefix(indent) for each in lines]) else [line]


def _is_same(line: str, lines: list[str]) -> bool:
    """Whether both have the same syntax; a head of a loop or a function is completed for that."""
    end = " pass" if line.endswith(":") else ""
    try:
        return ast.dump(ast.parse(line + end)) == ast.dump(ast.parse("\n".join(lines) + end))
    except SyntaxError:
        return False


def _broken(text: str) -> list[str]:
    """Return a text broken inside its longest brackets."""
    span = _longest_brackets(text)
    if len(text) <= _WIDTH or span is None:
        return [text]
    begin, end = span
    clauses = list(_clauses(text[begin + 1 : end]))
    if len(clauses) > 1:
        inner = [_INDENT + line for clause in clauses for line in _part(clause)]
        return [text[: begin + 1], *inner, *_tail(text[end:])]
    items = list(_split(text[begin + 1 : end]))
    lines = [text[: begin + 1]]
    for place, item in enumerate(items):
        comma = "," if len(items) > 1 or place < len(items) - 1 else ""
        *first, last = _part(item)
        lines += [_INDENT + each for each in (*first, last + comma)]
    return [*lines, *_tail(text[end:])]


def _tail(text: str) -> list[str]:
    """Return what follows brackets; it may have long brackets of its own."""
    span = _longest_brackets(text[1:])
    if len(text) <= _WIDTH or span is None:
        return [text]
    first, *rest = _broken(text[1:])
    return [text[0] + first, *rest]


def _part(item: str) -> list[str]:
    """Return an item inside brackets: a long sum has a line for each term."""
    if len(item) <= _WIDTH - len(_INDENT):
        return [item]
    terms = list(_terms(item))
    return [line for term in terms for line in _broken(term)]


def _longest_brackets(text: str) -> tuple[int, int] | None:
    """Return the places of the outer brackets that hold most."""
    depth, begin, found = 0, 0, None
    for place, _ in _characters(text):
        if text[place] in _OPENING:
            begin = place if depth == 0 else begin
            depth += 1
        elif text[place] in _CLOSING:
            depth -= 1
            is_longer = found is None or place - begin > found[1] - found[0]
            if depth == 0 and is_longer and place - begin > 1:
                found = begin, place
    return found


def _characters(text: str) -> Iterator[tuple[int, int]]:
    """Return the places of characters outside of strings, with the depth of brackets there."""
    quote, depth = "", 0
    for place, character in enumerate(text):
        if quote:
            quote = "" if character == quote and text[place - 1] != "\\" else quote
            continue
        if character in "'\"":
            quote = character
            continue
        depth += (character in _OPENING) - (character in _CLOSING)
        yield place, depth


def _split(text: str) -> Iterator[str]:
    """Return the items between commas; those of a comprehension are one."""
    begin = 0
    for place, depth in _characters(text):
        if text[place] == "," and depth == 0:
            yield text[begin:place].strip()
            begin = place + 1
    if text[begin:].strip():
        yield text[begin:].strip()


def _clauses(text: str) -> Iterator[str]:
    """Return the clauses of a comprehension, ``each``, ``for each in ...``, ``if ...``; another text is one."""
    begin = 0
    for place, depth in _characters(text):
        is_clause = text.startswith(" for ", place) or (begin > 0 and text.startswith(" if ", place))
        if depth == 0 and is_clause:
            yield text[begin:place].strip()
            begin = place + 1
    yield text[begin:].strip()


def _terms(text: str) -> Iterator[str]:
    """Return the terms of a sum, each with its sign."""
    begin = 0
    for place, depth in _characters(text):
        if depth == 0 and text[place : place + 3] in {" + ", " - "}:
            yield text[begin:place].strip()
            begin = place + 1
    yield text[begin:].strip()
