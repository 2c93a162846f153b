"""Expressions and statements as lines of a language, with brackets only where the order of operations needs them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from symbody.codegen.layout.language import Language
from symbody.codegen.layout.statement import Clear, Factor, Let, Part, Read, Section, Solve, Statement, Store
from symbody.codegen.layout.tree import Application, Entry, Name, Number, Tree
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["expression_text", "part_lines", "wrap_line", "wrap_lines"]

Shapes: TypeAlias = Mapping[str, tuple[int, ...]]

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
            return _entry_text(language, array, index), _ATOM
        case Application(Operation.ADD | Operation.SUB, (Application(Operation.MUL), _)) if language.fused:
            return _fused(tree, 0, language), _ATOM
        case Application(Operation.ADD | Operation.SUB, (_, Application(Operation.MUL))) if language.fused:
            return _fused(tree, 1, language), _ATOM
        case Application(operation, operands):
            return _application(operation, [_text(operand, language) for operand in operands], language)


def _fused(tree: Application, number: int, language: Language) -> str:
    """Return the text of a sum or a difference, one operand of which is a product, as one operation."""
    product, other = tree.operands[number], tree.operands[1 - number]
    assert isinstance(product, Application), "a product is fused"
    factors = list(product.operands)
    if tree.operation is Operation.SUB:
        minus = Application(Operation.NEG, (factors[0] if number else other,))
        factors, other = ([minus, factors[1]], other) if number else (factors, minus)
    return language.fused.format(*(_text(part, language)[0] for part in (*factors, other)))


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


def part_lines(part: Part, language: Language, shapes: Shapes, indent: str | None = None) -> list[str]:
    """Return the lines of a part: what it reads, then its statements, with a blank line before each section.

    ``shapes`` are the shapes of the results, whose entries are assigned with one index, two, or none.
    """
    indent = language.indent if indent is None else indent
    lines = [indent + line for line in _aligned(part.reads, language)]
    before: Statement | None = None
    for statement in part.statements:
        text = statement_text(statement, language, shapes)
        if isinstance(statement, Section) or (isinstance(statement, Clear) and before is None and text):
            lines += ["", indent + text] if lines else [indent + text]
        elif text:
            lines += wrap_line(text, language, indent)
        before = statement
    return lines


def statement_text(statement: Statement, language: Language, shapes: Shapes) -> str:
    """Return a statement as one line of any length."""
    match statement:
        case Section(title):
            return _comment_text(language, title)
        case Let(name, value):
            return language.declare.format(name=name, value=expression_text(value, language))
        case Store(array, index, value):
            place = _place_text(language, array, index, shapes.get(array, (index,)))
            return language.assign.format(place=place, value=expression_text(value, language))
        case Clear(array, size):
            return _clear_text(language, array, size, shapes.get(array, (size,)))
        case Factor(matrix, size):
            return language.factor.format(n=size, work=matrix)
        case Solve(matrix, solution, size):
            return language.solve.format(n=size, work=matrix, x=solution)


def _aligned(reads: Sequence[Read], language: Language) -> list[str]:
    """Return the lines that name entries of arrays, with equal signs and notes aligned."""
    width = max((len(read.name) for read in reads), default=0)
    texts = [
        language.declare.format(
            name=read.name.ljust(width), value=_entry_text(language, read.array, read.index)
        )
        for read in reads
    ]
    longest = max(map(len, texts), default=0)
    noted = [
        f"{text.ljust(longest)}  {_comment_text(language, read.note)}" if read.note else text
        for text, read in zip(texts, reads, strict=True)
    ]
    return [line if len(line) <= language.width else text for line, text in zip(noted, texts, strict=True)]


def _entry_text(language: Language, array: str, index: int) -> str:
    """Return an entry of an array; indices count from zero here, from the first index in the language."""
    return language.entry.format(array, index + language.first_index)


def _place_text(language: Language, array: str, index: int, shape: tuple[int, ...]) -> str:
    """Return an entry of a result as the left side of an assignment; matrices are counted row by row."""
    if not shape:
        return language.scalar.format(array)
    if len(shape) == 1 or not language.matrix:
        return _entry_text(language, array, index)
    row, column = divmod(index, shape[1])
    return language.matrix.format(array, row + language.first_index, column + language.first_index)


def _clear_text(language: Language, array: str, size: int, shape: tuple[int, ...]) -> str:
    """Return the statement that makes all entries of an array zero."""
    template = (language.clear_matrix if len(shape) == 2 else "") or language.clear
    return template.format(array=array, size=size, sizes=", ".join(map(str, shape)))


def _comment_text(language: Language, text: str) -> str:
    """Return a comment of one line."""
    return f"{language.comment[0]} {text} {language.comment[1]}".rstrip()


_BREAKS = re.compile(r"[-+,?] | : |\*\*|[*/]|[(\[{]|[)\]}]|\"[^\"]*\"")


def wrap_line(line: str, language: Language, indent: str) -> list[str]:
    """Break a line into lines of the language's width; later lines are indented twice.

    Lines end after an operator or a comma, within as few brackets as possible: all languages continue there.
    """
    room = language.width - len(language.continuation)
    lines, lead = [], indent
    while len(lead) + len(line) > room and (end := _break(line, room - len(lead))):
        lines.append(lead + line[:end].rstrip() + language.continuation)
        line, lead = line[end:], indent * 2 or language.indent
    return [*lines, lead + line]


def wrap_lines(lines: Iterable[str], language: Language, indent: str) -> list[str]:
    """Break each of some lines into lines of the language's width."""
    return [part for line in lines for part in wrap_line(line, language, indent)]


def _break(line: str, room: int) -> int:
    """Return where to break a line, or 0: outermost in its second half, otherwise as late as possible."""
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
