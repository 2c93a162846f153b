"""Expressions as text: trees of operations, brackets only where the order of operations needs them."""

from __future__ import annotations

import re
from typing import Any, TypeAlias

from symbody.codegen.layout.language import Language

__all__ = ["Tree", "entry", "expression_text", "name", "number", "wrapped"]

Tree: TypeAlias = tuple[Any, ...]
"""An operation of the tape and its arguments; or a leaf: ``("name", identifier)``, ``("number", value)``,
``("entry", array, index)``."""

_SUM, _PRODUCT, _ATOM = range(3)
_INFIX = {"add": (" + ", _SUM), "sub": (" - ", _SUM), "mul": ("*", _PRODUCT), "div": ("/", _PRODUCT)}


def name(identifier: str) -> Tree:
    """Return the leaf of a name."""
    return ("name", identifier)


def number(value: float) -> Tree:
    """Return the leaf of a number."""
    return ("number", value)


def entry(array: str, index: int) -> Tree:
    """Return the leaf of an entry of an array, counted from zero."""
    return ("entry", array, index)


def expression_text(tree: Tree, language: Language) -> str:
    """Return the text of a tree: the same operations in the same order, nothing reassociated."""
    return _text(tree, language)[0]


def _text(tree: Tree, language: Language) -> tuple[str, int]:
    """Return a text and how tightly its outermost operation binds."""
    kind = tree[0]
    if kind == "name":
        return tree[1], _ATOM
    if kind == "number":
        text = language.literal(tree[1])
        return text, _PRODUCT if text.startswith("-") else _ATOM
    if kind == "entry":
        return language.entry_text(tree[1], tree[2]), _ATOM
    operands = [_text(operand, language) for operand in tree[1:]]
    if kind == "neg":
        text, binding = operands[0]
        return "-" + (_bracketed(text) if binding == _SUM or text.startswith("-") else text), _PRODUCT
    if kind in _INFIX:
        return _infix(kind, *operands)
    return language.functions[kind].format(*(text for text, _ in operands)), _ATOM


def _infix(kind: str, left: tuple[str, int], right: tuple[str, int]) -> tuple[str, int]:
    sign, level = _INFIX[kind]
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
