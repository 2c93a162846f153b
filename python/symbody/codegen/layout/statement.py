"""Statements: what generated code consists of, independent of the language."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from symbody.codegen.layout.tree import Tree, names_in

__all__ = ["Clear", "Factor", "Let", "Part", "Read", "Section", "Solve", "Statement", "Store"]


@dataclass(frozen=True)
class Read:
    """A local name for an entry of an array; the note says what it is where the name doesn't."""

    name: str
    array: str
    index: int
    note: str = ""


@dataclass(frozen=True)
class Let:
    """A local name for the value of an expression."""

    name: str
    value: Tree


@dataclass(frozen=True)
class Store:
    """Store a value into an entry of a result, of the workspace, of a matrix or of a right side."""

    array: str
    index: int
    value: Tree


@dataclass(frozen=True)
class Clear:
    """Set all entries of a result or a matrix to zero; entries that aren't zero are stored later."""

    array: str
    size: int


@dataclass(frozen=True)
class Factor:
    """Factorise the matrix that was stored row by row in the array."""

    matrix: str
    size: int


@dataclass(frozen=True)
class Solve:
    """Solve, with a factorised matrix, for the right side that was stored in the array; it becomes the solution."""

    matrix: str
    solution: str
    size: int


@dataclass(frozen=True)
class Section:
    """The title where the work of a stage begins, with its operations, or continues in a later part."""

    title: str


Statement: TypeAlias = Let | Store | Clear | Factor | Solve | Section


@dataclass(frozen=True)
class Part:
    """A part of a routine: what it reads, what it does.

    Attributes:
        reads: local names for entries of arguments and of the workspace.
        statements: what is computed, in order.
    """

    reads: tuple[Read, ...]
    statements: tuple[Statement, ...]

    @cached_property
    def mentions(self) -> frozenset[str]:
        """All names of arrays and values that occur in it."""
        found = {read.array for read in self.reads}
        values: list[Tree] = []
        for statement in self.statements:
            match statement:
                case Let(_, value):
                    values.append(value)
                case Store(array, _, value):
                    found.add(array)
                    values.append(value)
                case Clear(array, _) | Factor(array, _):
                    found.add(array)
                case Solve(matrix, solution, _):
                    found |= {matrix, solution}
        return frozenset(found | names_in(values))

    @property
    def locals(self) -> tuple[str, ...]:
        """The local names, in the order of their definition."""
        lets = (statement.name for statement in self.statements if isinstance(statement, Let))
        return (*(read.name for read in self.reads), *lets)
