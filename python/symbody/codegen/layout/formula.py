"""The results of straight-line code as short formulas, with the user's names."""

from __future__ import annotations

from symbody.codegen.layout.code_text import expression_text
from symbody.codegen.layout.language import Language
from symbody.codegen.layout.tree import Application, Name, Number, Tree
from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.instruction import LINEAR_SYSTEMS

__all__ = ["formulas"]

LONGEST = 6
"""The largest number of operations in a formula that fits into a comment."""


def formulas(code: Code, language: Language) -> list[str]:
    """Return a formula for each result; an empty text where it would be long."""
    trees: dict[int, tuple[Tree, int] | None] = {p: (Number(v), 0) for p, v in enumerate(code.constants)}
    trees |= {place: (Name(read.name), 0) for place, read in enumerate(code.inputs, code.first_input)}
    for place, row in enumerate(code.instructions, code.first_instruction):
        parts = [None] if row.operation in LINEAR_SYSTEMS else [trees[operand] for operand in row.reads]
        known = [part for part in parts if part]
        size = 1 + sum(size for _, size in known)
        is_short = len(known) == len(parts) and size <= LONGEST
        tree = Application(row.operation, tuple(tree for tree, _ in known))
        trees[place] = (tree, size) if is_short else None
    return [expression_text(found[0], language) if (found := trees[place]) else "" for place in code.results]
