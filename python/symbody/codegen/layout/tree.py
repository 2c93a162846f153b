"""Trees: expressions as operations on operands, whose leaves are names, numbers and entries of arrays."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

from symbody.codegen.straight_line.instruction import Operation

__all__ = ["Application", "Entry", "Name", "Number", "Tree", "names_in"]


class Name(NamedTuple):
    """A local name."""

    identifier: str


class Number(NamedTuple):
    """A number."""

    value: float


class Entry(NamedTuple):
    """An entry of an array, counted from zero."""

    array: str
    number: int


class Application(NamedTuple):
    """An operation, applied to its operands."""

    operation: Operation
    operands: tuple[Tree, ...]


Tree: TypeAlias = Name | Number | Entry | Application


def names_in(trees: Iterable[Tree]) -> set[str]:
    """Return the names of all values and arrays in trees.

    >>> sorted(names_in([Application(Operation.ADD, (Name("x"), Entry("q", 0)))]))
    ['q', 'x']
    """
    found, waiting = set(), list(trees)
    while waiting:
        match waiting.pop():
            case Name(name) | Entry(name):
                found.add(name)
            case Application(_, operands):
                waiting += operands
    return found
