"""Expressions as text: trees of operations, brackets only where the order of operations needs them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TypeAlias

from symbody.codegen.layout.language import Language
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["Application", "Entry", "Name", "Number", "Tree", "expression_text", "wrapped"]


@dataclass(frozen=True, slots=True)
class Name:
    """A local name."""

    identifier: str


@dataclass(frozen=True, slots=True)
class Number:
    """A number."""

    value: float


@dataclass(frozen=True, slots=True)
class Entry:
    """An entry of an array, counted from zero."""

    array: str
    index: int


@dataclass(frozen=True, slots=True)
class Application:
    """An operation, applied to its operands."""

    operation: Operation
    operands: tuple[Tree, ...]


Tree: TypeAlias = Name | Number | Entry | Application

_SUM, _PRODUCT, _ATOM = range(3)
_INFIX = {
    Operation.ADD: (" + ", _SUM),
    Operation.SUB: (" - ", _SUM),
    Operation.MUL: ("*", _PRODUCT),
    Operation.DIV: ("/", _PRODUCT),
}


def expression_text(tree: Tree, language: Language) -> str:
    """Return the text of a tree: the same operations in the same order, nothing reassociated."""
    return _text(tree, language)[0]


def _text(tree: Tree, language: Language) -> tuple[str, int]:
    """Return a text and how tightly its outermost operation binds."""
    match tree:
        case Name(identifier):
            return identifier, _ATOM
        case Number(value):
            text = language.literal(value)
            return text, _PRODUCT if text.startswith("-") else _ATOM
        case Entry(array, index):
            return language.entry_text(array, index), _ATOM
        case Application(operation, operands):
            return _application(operation, [_text(operand, language) for operand in operands], language)


def _application(
    operation: Operation, operands: list[tuple[str, int]], language: Language
) -> tuple[str, int]:
    if operation is Operation.NEG:
        text, binding = operands[0]
        return "-" + (_bracketed(text) if binding == _SUM or text.startswith("-") else text), _PRODUCT
    if operation in _INFIX:
        return _infix(operation, *operands)
    return language.functions[operation].format(*(text for text, _ in operands)), _ATOM


def _infix(operation: Operation, left: tuple[str, int], right: tuple[str, int]) -> tuple[str, int]:
    sign, level = _INFIX[operation]
    first = left[0] if left[1] >= level else _bracketed(left[0])
    second = right[0] if right[1] > level and not right[0].startswith("-") else _bracketed(right[0])
    return first + sign + second, level


def _bracketed(text: str) -> str:
    return f"({text})"


_BREAKS = re.compile(r"[-+,?] | : |\*\*|[*/]|[(\[{]|[)\]}]|\"[^\"]*\"")


def wrapped(line: str, language: Language, indent: str) -> list[str]:
    """Return a line as lines of the language's width, the later ones indented twice.

    A line ends after an operator or a comma, within as few brackets as possible: all languages read on there.
    """
    room = language.width - len(language.continuation)
    lines, lead = [], indent
    while len(lead) + len(line) > room and (end := _break(line, room - len(lead))):
        lines.append(lead + line[:end].rstrip() + language.continuation)
        line, lead = line[end:], indent * 2 or language.indent
    return [*lines, lead + line]


def _break(line: str, room: int) -> int:
    """Return where to break a line: outermost in its second half, otherwise as late as possible; 0 for nowhere."""
    depth, places = 0, []
    for found in _BREAKS.finditer(line):
        sign = found.group()
        depth += (sign in "([{") - (sign in ")]}")
        if sign[-1] in " */":
            places.append((found.end(), depth + (sign[-1] in "*/") / 2))
        if found.end() > room + 1 and places:
            break
    near = [(place, depth) for place, depth in places if place <= room + 1] or places[:1]
    late = [(place, depth) for place, depth in near if place > room // 2] or near[-1:]
    return min(late, key=lambda place: (place[1], -place[0]), default=(0, 0))[0]
