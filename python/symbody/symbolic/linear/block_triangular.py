"""Block triangular order of underdetermined linear equations: which unknowns follow from the others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from symbody.errors import ExpressionError
from symbody.symbolic.expression.matrix import Matrix

__all__ = ["LARGEST", "Block", "BlockTriangular", "block_triangular"]

LARGEST = 3
"""The most equations in one block, whose inverse is written out."""


@dataclass(frozen=True)
class Block:
    """Equations, and as many unknowns, which follow from them and from earlier unknowns."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


@dataclass(frozen=True)
class BlockTriangular:
    """An order in which ``B x = c`` is solved.

    Attributes:
        blocks: none contains an unknown of a later one.
        independent: the columns of the unknowns that can be chosen freely.
    """

    blocks: tuple[Block, ...]
    independent: tuple[int, ...]


def block_triangular(B: Matrix) -> BlockTriangular:
    """Return the blocks of a wide matrix of full rank; among possible independent unknowns, the first ones are taken.

    The equations with the fewest new unknowns come first. The closure of one loop of a mechanism often has one more
    unknown than equations; the loops behind it then have as many unknowns as equations.

    Raises:
        ExpressionError: an equation follows from others, or a block is larger than :data:`LARGEST`.

    >>> from symbody.symbolic import Matrix, symbols
    >>> a, b, c, d = symbols("a b c d")
    >>> order = block_triangular(Matrix([[a, b, c, 0, 0], [b, d, a, 0, 0], [0, 0, d, a, b]]))
    >>> [block.columns for block in order.blocks], order.independent
    ([(1, 2), (4,)], (0, 3))
    """
    supports = [{j for j, entry in enumerate(row) if not entry.is_zero} for row in B.tolist()]
    blocks: list[Block] = []
    independent: list[int] = []
    known: set[int] = set()
    left = set(range(B.rows))
    while left:
        rows, new = _next({row: supports[row] - known for row in left})
        block = _regular_block(B, rows, sorted(new))
        blocks.append(block)
        independent += sorted(new - set(block.columns))
        known |= new
        left -= set(rows)
    return BlockTriangular(tuple(blocks), tuple(sorted({*independent, *range(B.columns)} - _columns(blocks))))


def _columns(blocks: Sequence[Block]) -> set[int]:
    return {column for block in blocks for column in block.columns}


def _next(unknown: dict[int, set[int]]) -> tuple[tuple[int, ...], set[int]]:
    """Return the equations, contained in the unknowns of one of them, that leave the fewest unknowns undetermined."""
    groups = ((tuple(q for q in sorted(unknown) if unknown[q] <= new), new) for new in unknown.values())
    return min(groups, key=lambda group: (len(group[1]) - len(group[0]), len(group[0]), group[0]))


def _regular_block(B: Matrix, rows: tuple[int, ...], new: Sequence[int]) -> Block:
    for columns in _choices(rows, new):
        if Matrix([[B[row, column] for column in columns] for row in rows]).rank() == len(rows):
            return Block(rows, columns)
    equations = ", ".join(str(row + 1) for row in rows)
    raise ExpressionError(
        f"block_triangular: the equations {equations} do not form a block of at most {LARGEST} independent equations"
    )


def _choices(rows: Sequence[int], new: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Yield the choices of dependent unknowns; the first unknowns stay independent as long as possible."""
    if len(rows) > min(LARGEST, len(new)):
        return
    for free in combinations(new, len(new) - len(rows)):
        yield tuple(column for column in new if column not in free)
