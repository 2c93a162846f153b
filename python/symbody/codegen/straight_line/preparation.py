"""The part of routines that depends on parameters alone: one routine computes it, once for each set of parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from symbody.codegen.straight_line.code import Code, Input, arguments_of, prune
from symbody.codegen.straight_line.instruction import Instruction, Operation, renumber
from symbody.symbolic import Argument

__all__ = ["Preparation"]


@dataclass(frozen=True)
class _Constant:
    """A number, by its exact text, which distinguishes -0.0 from 0.0."""

    text: str


@dataclass(frozen=True)
class _Parameter:
    """A parameter, by its number among the inputs."""

    number: int


_Node: TypeAlias = _Constant | _Parameter | Instruction

_COMMUTATIVE = frozenset({Operation.ADD, Operation.MUL})


@dataclass
class Preparation:
    """The work of several routines that depends on parameters alone, without repetition.

    A node is a constant, a parameter or an instruction that reads nodes; equal nodes are one. The constants of the
    model are the nodes that the routines read.
    """

    parameters: tuple[Argument, ...]
    _nodes: dict[_Node, int] = field(default_factory=dict)
    _constants: dict[int, int] = field(default_factory=dict)

    @cached_property
    def inputs(self) -> tuple[Input, ...]:
        """The entries of the parameters."""
        return arguments_of(self.parameters)

    def without_parameters(self, code: Code) -> Code:
        """Return the code with constants of the model, as inputs without names, instead of work on parameters."""
        known = self._known(code)
        lifted = sorted({p for p in self._read_later(code, known) if p in known})
        first, end = code.first_instruction, code.first_instruction + len(code.instructions)
        places = [*range(first), *range(first + len(lifted), end + len(lifted))]
        for number, place in enumerate(lifted, first):
            places[place] = number
        inputs = tuple(Input("", self._constant(known[place]), "") for place in lifted)
        rows = renumber(code.instructions, places)
        results = tuple(places[place] for place in code.results)
        return prune(Code(code.constants, code.inputs + inputs, rows, code.stages, results))

    @property
    def order(self) -> list[int]:
        """The numbers of the constants in the order of their array: parameters themselves come first."""
        nodes = list(self._nodes)
        own = [nodes[node] for node in self._constants]
        direct = sorted((node.number, k) for k, node in enumerate(own) if isinstance(node, _Parameter))
        return [k for _, k in direct] + [k for k, node in enumerate(own) if not isinstance(node, _Parameter)]

    def code(self) -> Code:
        """Return the code that computes the constants from the parameters."""
        constants: list[float] = []
        work: list[Instruction] = []
        for node in self._nodes:
            match node:
                case _Constant(text):
                    constants.append(float.fromhex(text))
                case Instruction():
                    work.append(node)
        places = self._places(len(constants), len(constants) + len(self.inputs))
        wanted = list(self._constants)
        results = tuple(places[wanted[k]] for k in self.order)
        instructions = renumber(work, places)
        return prune(Code(tuple(constants), self.inputs, instructions, (0,) * len(work), results))

    def _places(self, first_input: int, first_instruction: int) -> list[int]:
        """Return the place of each node in the code that computes the constants."""
        places, constants, instructions = [], 0, first_instruction
        for node in self._nodes:
            match node:
                case _Constant():
                    places.append(constants)
                    constants += 1
                case _Parameter(number):
                    places.append(first_input + number)
                case Instruction():
                    places.append(instructions)
                    instructions += 1
        return places

    def _known(self, code: Code) -> dict[int, int]:
        """Return the node of each place that depends on parameters and on nothing else that varies."""
        numbers = {(entry.array, entry.index): i for i, entry in enumerate(self.inputs)}
        nodes = {place: self._node(_Constant(value.hex())) for place, value in enumerate(code.constants)}
        fixed = set(nodes)
        for place, entry in enumerate(code.inputs, code.first_input):
            number = numbers.get((entry.array, entry.index))
            if number is not None:
                nodes[place] = self._node(_Parameter(number))
        kept = _factors_of_later_systems(code)
        for place, row in enumerate(code.instructions, code.first_instruction):
            if place not in kept and all(p in nodes for p in row.reads):
                nodes[place] = self._node(_on_nodes(row, [nodes[p] for p in row.reads]))
                if all(p in fixed for p in row.reads):
                    fixed.add(place)
        return {place: node for place, node in nodes.items() if place not in fixed}

    def _read_later(self, code: Code, known: dict[int, int]) -> Sequence[int]:
        rows = enumerate(code.instructions, code.first_instruction)
        return [*(p for place, row in rows if place not in known for p in row.reads), *code.results]

    def _node(self, node: _Node) -> int:
        return self._nodes.setdefault(node, len(self._nodes))

    def _constant(self, node: int) -> int:
        return self._constants.setdefault(node, len(self._constants))


def _on_nodes(row: Instruction, nodes: Sequence[int]) -> Instruction:
    """Return an instruction on nodes, which are sorted if their order does not matter."""
    ordered = sorted(nodes) if row.operation in _COMMUTATIVE else nodes
    return Instruction(row.operation, tuple(ordered), row.component)


def _factors_of_later_systems(code: Code) -> set[int]:
    """Return the places of factorisations that a system of a later stage reads, with which they stay."""
    rows = zip(code.instructions, code.stages, strict=True)
    return {row.reads[0] for row, stage in rows if row.operation is Operation.SOLVE and stage > 0}
