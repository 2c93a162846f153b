"""From straight-line code to statements: values that are used once stand where they are used, others get names."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import isqrt

from symbody.codegen.layout.names import Scope
from symbody.codegen.layout.statement import Clear, Factor, Let, Part, Read, Section, Solve, Statement, Store
from symbody.codegen.layout.tree import Application, Entry, Name, Number, Tree
from symbody.codegen.straight_line.code import Code, Input
from symbody.codegen.straight_line.count import section_titles
from symbody.codegen.straight_line.cut import Cut, cut
from symbody.codegen.straight_line.fusion import fused_products
from symbody.codegen.straight_line.instruction import LINEAR_SYSTEMS, Instruction, Operation

__all__ = ["Composition", "compose"]

LONGEST_EXPRESSION = 12
"""The largest number of operations in one statement, so that a reader can follow it."""

MOST_ZEROS = 3
"""The largest number of zeros that are stored one by one; arrays with more zeros are cleared first."""

LONGEST_NAME = 24
"""The longest descriptive name, in letters; values with longer ones are numbered instead."""


@dataclass(frozen=True)
class Composition:
    """The parts of a routine and the working arrays that they share, with their sizes."""

    parts: tuple[Part, ...]
    workspace: tuple[str, int]
    matrices: tuple[tuple[str, int], ...]
    solutions: tuple[tuple[str, int], ...]


def compose(
    code: Code,
    scope: Scope,
    notes: Sequence[str],
    targets: Sequence[tuple[str, int]],
    *,
    scalars: frozenset[str] = frozenset(),
    limit: int | None = None,
    fuses: bool = False,
) -> Composition:
    """Return the statements of a routine.

    Args:
        code: what it computes.
        scope: the names that its locals must not take.
        notes: a note on each input whose name doesn't say what it is; otherwise an empty text.
        targets: the array and the index of each result.
        scalars: the arguments that are single numbers, not arrays.
        limit: the largest number of operations of a part, if there is any.
        fuses: whether a product stands inside the sum that it is fused with.
    """
    made = _cut(code, limit)
    parts = pairwise(made.starts) if fuses else ()
    fused = frozenset().union(*(fused_products(code, range(*part)) for part in parts))
    return _Composer(code, scope, notes, targets, scalars, made, fused).composition()


@dataclass
class _Composer:
    code: Code
    scope: Scope
    notes: Sequence[str]
    targets: Sequence[tuple[str, int]]
    scalars: frozenset[str]
    cut: Cut
    fused: frozenset[int]
    _trees: dict[int, Tree] = field(default_factory=dict)
    _sizes: dict[int, int] = field(default_factory=dict)
    _matrices: dict[int, tuple[str, int]] = field(default_factory=dict)
    _solutions: dict[int, tuple[str, int]] = field(default_factory=dict)
    _numbered: int = 0

    def __post_init__(self) -> None:
        self.workspace = self.scope.claim("w")
        self.titles = section_titles(self.code)
        self.readers, self.results = _uses(self.code)
        self._trees = {place: Number(value) for place, value in enumerate(self.code.constants)}
        for place, read in enumerate(self.code.inputs, self.code.first_input):
            self._trees[place] = self._leaf(read)
        zeros = Counter(array for (array, _), place in self._results_in_order() if self._is_zero(place))
        sizes = Counter(array for array, _ in self.targets)
        self.cleared = {array: sizes[array] for array, count in zeros.items() if count > MOST_ZEROS}

    def _leaf(self, read: Input) -> Tree:
        """Return a local name for an input; an input without a name is written as an entry where it is used."""
        if read.array in self.scalars:
            return Name(read.array)
        return Name(self.scope.claim(read.name)) if read.name else Entry(read.array, read.index)

    def _results_in_order(self) -> Iterator[tuple[tuple[str, int], int]]:
        return zip(self.targets, self.code.results, strict=True)

    def _is_zero(self, place: int) -> bool:
        return place < self.code.first_input and repr(self.code.constants[place]) == "0.0"

    def composition(self) -> Composition:
        parts = [list(self._statements(part)) for part in range(len(self.cut.starts) - 1)]
        parts[0] = [*(Clear(array, size) for array, size in self.cleared.items()), *parts[0]]
        parts[-1] += self._results_without_work()
        return Composition(
            tuple(Part(self._reads(k), tuple(part)) for k, part in enumerate(parts)),
            (self.workspace, self.cut.size),
            tuple(self._matrices.values()),
            tuple(self._solutions.values()),
        )

    def _statements(self, part: int) -> Iterator[Statement]:
        start, end = self.cut.starts[part : part + 2]
        stage = None
        for number_ in range(start, end):
            if self.code.stages[number_] != stage:
                stage = self.code.stages[number_]
                yield Section(self._title(number_, stage))
            place = self.code.first_instruction + number_
            yield from self._instruction(place, self.code.instructions[number_])
        first = self.code.first_instruction
        kept = [place for place in range(first + start, first + end) if place in self.cut.slots]
        if kept:
            yield Section("what later parts read")
        for place in kept:
            yield Store(self.workspace, self.cut.slots[place], self._trees[place])

    def _title(self, first: int, stage: int) -> str:
        goes_on = first > 0 and self.code.stages[first - 1] == stage
        return self.titles[stage].split(":")[0] + ", continued" if goes_on else self.titles[stage]

    def _instruction(self, place: int, row: Instruction) -> Iterator[Statement]:
        if row.operation not in LINEAR_SYSTEMS:
            yield from self._value(place, row)
        elif row.operation is Operation.FACTOR:
            yield from self._factor(place, row)
        elif row.operation is Operation.SOLVE:
            yield from self._solve(place, row)
        else:
            self._trees[place] = Entry(self._solutions[row.reads[0]][0], row.component)
            yield from self._stores(place)

    def _factor(self, place: int, row: Instruction) -> Iterator[Statement]:
        matrix = self._matrices[place] = (self.scope.claim("matrix"), isqrt(len(row.reads)))
        yield from self._filled(matrix[0], row.reads)
        yield Factor(*matrix)

    def _solve(self, place: int, row: Instruction) -> Iterator[Statement]:
        matrix, right = self._matrices[row.reads[0]], row.reads[1:]
        solution = self._solutions[place] = (self.scope.claim("solution"), len(right))
        yield from self._filled(solution[0], right)
        yield Solve(matrix[0], *solution)

    def _filled(self, array: str, places: Sequence[int]) -> Iterator[Statement]:
        """Yield the stores of a matrix or of a right side."""
        cleared = sum(map(self._is_zero, places)) > MOST_ZEROS
        if cleared:
            yield Clear(array, len(places))
        for index, place in enumerate(places):
            if not (cleared and self._is_zero(place)):
                yield Store(array, index, self._trees[place])

    def _value(self, place: int, row: Instruction) -> Iterator[Statement]:
        tree = Application(row.operation, tuple(self._trees[operand] for operand in row.reads))
        size = 1 + sum(self._sizes.get(operand, 0) for operand in row.reads)
        results, readers = self.results.get(place, []), self.readers.get(place, [])
        if len(results) == 1 and not readers:
            yield Store(*self.targets[results[0]], tree)
            return
        is_short = self._stands_inside(place, readers) and size < LONGEST_EXPRESSION
        if not results and (is_short or place in self.fused):
            self._trees[place], self._sizes[place] = tree, size
            return
        local = self._trees[place] = Name(self.scope.claim(self._name(tree)))
        yield Let(local.identifier, tree)
        yield from self._stores(place)

    def _stands_inside(self, place: int, readers: Sequence[int]) -> bool:
        """Whether the value can be written inside the one expression that uses it, in the same part and stage."""
        if len(readers) != 1:
            return False
        own, reader = place - self.code.first_instruction, readers[0]
        return self.code.stages[own] == self.code.stages[reader] and place not in self.cut.slots

    def _name(self, tree: Application) -> str:
        """Return a descriptive name such as ``sin_theta``, or a numbered one."""
        words: list[str] = []
        match tree:
            case Application(operation, (Name(only),)) if operation is not Operation.NEG:
                words = [operation.lower(), only]
            case Application(Operation.MUL, (Name(left), Name(right))) if left == right:
                words = [left, "squared"]
        text = "_".join(words)
        if text and len(text) <= LONGEST_NAME:
            return text
        self._numbered += 1
        return f"v{self._numbered}"

    def _stores(self, place: int) -> Iterator[Statement]:
        for result in self.results.get(place, []):
            yield Store(*self.targets[result], self._trees[place])

    def _results_without_work(self) -> list[Statement]:
        stores = [
            Store(array, index, self._trees[place])
            for (array, index), place in self._results_in_order()
            if place < self.code.first_instruction and not (array in self.cleared and self._is_zero(place))
        ]
        return [Section("entries that need no computation"), *stores] if stores else []

    def _reads(self, part: int) -> tuple[Read, ...]:
        """Return the local names of the inputs that a part uses, and of the values from earlier parts."""
        start, end = (self.code.first_instruction + n for n in self.cut.starts[part : part + 2])
        rows = range(start, end)
        used = {p for row in rows for p in self.code.instructions[row - self.code.first_instruction].reads}
        if part == len(self.cut.starts) - 2:
            used |= {place for place in self.results if place < self.code.first_instruction}
        first = self.code.first_input
        inputs = sorted(place for place in used if first <= place < self.code.first_instruction)
        saved = sorted(place for place in used if place in self.cut.slots and place < start)
        return (
            *(read for place in inputs if (read := self._input(place)).name != read.array),
            *(Read(self._local(p), self.workspace, self.cut.slots[p]) for p in saved),
        )

    def _local(self, place: int) -> str:
        """Return the local name of a value; an entry that is written where it is used has the name of its array."""
        match self._trees[place]:
            case Name(name) | Entry(name):
                return name
        raise AssertionError("a value that crosses parts has a name")

    def _input(self, place: int) -> Read:
        number_ = place - self.code.first_input
        read = self.code.inputs[number_]
        return Read(self._local(place), read.array, read.index, self.notes[number_])


def _cut(code: Code, limit: int | None) -> Cut:
    """Cut code into blocks; linear systems are kept in arrays of their own."""
    rows = enumerate(code.instructions, code.first_instruction)
    held = {place for place, row in rows if row.operation in LINEAR_SYSTEMS}
    return cut([row.reads for row in code.instructions], code.first_instruction, limit, held)


def _uses(code: Code) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """Return which instructions read each place, once per operand, and which results are that place."""
    readers: dict[int, list[int]] = {}
    results: dict[int, list[int]] = {}
    for reader, row in enumerate(code.instructions):
        for place in row.reads:
            readers.setdefault(place, []).append(reader)
    for result, place in enumerate(code.results):
        results.setdefault(place, []).append(result)
    return readers, results
