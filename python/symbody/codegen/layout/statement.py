"""Statements: what generated code consists of, in the words of no language yet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from symbody.codegen.layout.expression import Application, Entry, Name, Tree

__all__ = ["Block", "Clear", "Factor", "Let", "Read", "Section", "Solve", "Statement", "Store"]


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
    """A value into an entry of a result, of the workspace, of a matrix or of a right side."""

    array: str
    index: int
    value: Tree


@dataclass(frozen=True)
class Clear:
    """Zeros into all entries of a result or a matrix; those that aren't zero are stored later."""

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
    """Where the work of a stage begins, with its operations; or goes on, in a further block."""

    title: str


Statement: TypeAlias = Let | Store | Clear | Factor | Solve | Section


@dataclass(frozen=True)
class Block:
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
        for statement in self.statements:
            match statement:
                case Let(_, value):
                    found.update(_names(value))
                case Store(array, _, value):
                    found.update(_names(value), {array})
                case Clear(array, _) | Factor(array, _):
                    found.add(array)
                case Solve(matrix, solution, _):
                    found |= {matrix, solution}
        return frozenset(found)

    @property
    def locals(self) -> tuple[str, ...]:
        """The local names, in the order of their definition."""
        lets = (statement.name for statement in self.statements if isinstance(statement, Let))
        return (*(read.name for read in self.reads), *lets)


def _names(tree: Tree) -> Iterator[str]:
    """Yield the names of values and arrays in a tree."""
    match tree:
        case Name(name) | Entry(name):
            yield name
        case Application(_, operands):
            for operand in operands:
                yield from _names(operand)
