"""What the results of straight-line code are, as short formulas in the user's names."""

from __future__ import annotations

from symbody.codegen.layout.expression import Tree, expression_text, name, number
from symbody.codegen.layout.language import Language
from symbody.codegen.straight_line.code import Code

__all__ = ["described"]

LONGEST = 6
"""Operations of a formula that a comment can hold."""


def described(code: Code, language: Language) -> list[str]:
    """Return a formula for each result, empty where it would be long."""
    trees: dict[int, tuple[Tree, int] | None] = {p: (number(v), 0) for p, v in enumerate(code.constants)}
    trees |= {place: (name(read.name), 0) for place, read in enumerate(code.inputs, code.first_input)}
    for place, row in enumerate(code.instructions, code.first_instruction):
        parts = [trees[operand] for operand in row[1:]] if row[0] not in _SYSTEMS else [None]
        known = [part for part in parts if part]
        size = 1 + sum(size for _, size in known)
        is_short = len(known) == len(parts) and size <= LONGEST
        trees[place] = ((row[0], *(tree for tree, _ in known)), size) if is_short else None
    return [expression_text(tree[0], language) if (tree := trees[place]) else "" for place in code.results]


_SYSTEMS = frozenset({"factor", "solve", "component"})
