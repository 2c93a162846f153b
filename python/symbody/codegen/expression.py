"""Expressions as text: trees of operations, brackets only where the order of operations needs them."""

from __future__ import annotations

import re
from typing import Any, TypeAlias

from symbody.codegen.language import Language

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


_AFTER_SIGNS = re.compile(r"(?<=[-+,?] )|(?<= : )")
_AFTER_FACTORS = re.compile(r"(?<=[*/])")


def wrapped(line: str, language: Language, indent: str) -> list[str]:
    """Return a line as lines of the language's width, broken after operators; the later ones are indented twice."""
    room = language.width - len(language.continuation)
    parts = [
        part
        for piece in _AFTER_SIGNS.split(line)
        for part in ([piece] if len(piece) < room // 2 else _AFTER_FACTORS.split(piece))
    ]
    lines = [indent]
    for part in parts:
        if len(lines[-1]) + len(part.rstrip()) > room and lines[-1].strip():
            lines.append(indent * 2 or language.indent)
        lines[-1] += part
    return [row.rstrip() + language.continuation for row in lines[:-1]] + [lines[-1]]
