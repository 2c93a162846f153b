"""Fusion: a product that only one sum reads is rounded together with it, where the processor can do so."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["fused_products", "fused_sums"]


def fused_sums(code: Code, rows: Iterable[int]) -> dict[int, int]:
    """Return the places of the sums of a block that are fused with a product, and which operand it is.

    The product is in the same block, and nothing else reads it. Of two products, the first is fused.

    Args:
        code: the code.
        rows: the numbers of the instructions of the block.
    """
    first, here = code.first_instruction, set(rows)

    def is_own(place: int) -> bool:
        k = place - first
        return k in here and code.instructions[k].operation is Operation.MUL and code.uses[place] == 1

    found = {}
    for k in sorted(here):
        row = code.instructions[k]
        if row.operation in (Operation.ADD, Operation.SUB):
            own = [number for number, place in enumerate(row.reads) if is_own(place)]
            if own:
                found[first + k] = own[0]
    return found


def fused_products(code: Code, rows: Iterable[int]) -> set[int]:
    """Return the places of these products.

    >>> from symbody import symbols
    >>> from symbody.codegen.straight_line.code import code_of
    >>> from symbody.symbolic import Argument
    >>> a, b, c = symbols("a b c")
    >>> code = code_of([Argument("q", "", (a, b, c), "positions")], [a * b + c])
    >>> fused_products(code, range(2)) == {code.first_instruction}
    True
    """
    first = code.first_instruction
    return {
        code.instructions[place - first].reads[number] for place, number in fused_sums(code, rows).items()
    }
