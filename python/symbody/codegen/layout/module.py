"""Modules: a program's routines as statements, with the names of one language."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import prod

from symbody.codegen.layout.compose import Composition
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["Array", "Function", "Module"]


@dataclass(frozen=True)
class Array:
    """An argument or a result of a function.

    Attributes:
        name: its identifier.
        meaning: what it is.
        entries: what each entry is, in the user's names; results have none.
        shape: () for a single number, (n,) or (rows, columns), row by row.
    """

    name: str
    meaning: str
    entries: tuple[str, ...]
    shape: tuple[int, ...]

    @cached_property
    def size(self) -> int:
        """The number of entries."""
        return prod(self.shape)

    @cached_property
    def is_scalar(self) -> bool:
        """Whether it is a single number, not an array."""
        return not self.shape


@dataclass(frozen=True)
class Function:
    """A routine as statements.

    Attributes:
        name: its identifier.
        meaning: what it computes.
        arguments: what it takes, in order.
        results: what it returns, in order.
        composition: its statements, in parts.
        counts: its operations in words, by stage.
        operations: the operations that occur in it.
        working: the names and sizes of the working arrays: matrices, solutions, values that later parts read.
        calls: the routines that it calls first; their results have the names that they have in this routine.
    """

    name: str
    meaning: str
    arguments: tuple[Array, ...]
    results: tuple[Array, ...]
    composition: Composition
    counts: Mapping[str, str]
    operations: frozenset[Operation]
    working: tuple[tuple[str, int], ...]
    calls: tuple[Function, ...] = ()

    @cached_property
    def received(self) -> tuple[tuple[str, int], ...]:
        """The names and sizes of the arrays that the results of calls are kept in."""
        return tuple((result.name, result.size) for call in self.calls for result in call.results)

    @cached_property
    def arrays(self) -> tuple[tuple[str, int], ...]:
        """The names and sizes of all local arrays: results of calls, and the working arrays."""
        return (*self.received, *self.working)

    @cached_property
    def shapes(self) -> dict[str, tuple[int, ...]]:
        """The shapes of the results, by name."""
        return {result.name: result.shape for result in self.results}

    @cached_property
    def mentions(self) -> frozenset[str]:
        """The names of all arrays that occur in it."""
        passed = {array.name for call in self.calls for array in call.arguments}
        return frozenset(passed).union(*(part.mentions for part in self.composition.parts))


@dataclass(frozen=True)
class Module:
    """The module that a target prints.

    Attributes:
        name: the identifier of the program.
        meaning: what it models.
        arguments: all arrays that functions take, including the constants of the model.
        prepare: the function that computes the constants of the model from parameters, if there are any.
        routines: the functions of the state.
        values: the values of the program's arguments in the self-check, by array.
        references: the results for these values, in the order of the routines and of their results.
        target: the name of the target that prints it; the mark of the files contains it.
    """

    name: str
    meaning: str
    arguments: tuple[Array, ...]
    prepare: Function | None
    routines: tuple[Function, ...]
    values: Mapping[str, tuple[float, ...]]
    references: tuple[tuple[tuple[float, ...], ...], ...]
    target: str = ""

    @cached_property
    def functions(self) -> tuple[Function, ...]:
        """All functions, the preparation first."""
        return (self.prepare, *self.routines) if self.prepare else self.routines

    @cached_property
    def operations(self) -> frozenset[Operation]:
        """The operations that occur in it."""
        return frozenset().union(*(function.operations for function in self.functions))
