"""What routines compute from parameters alone: one routine computes it for all, once per set of parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from symbody.codegen.straight_line.code import (
    Code,
    Input,
    Instruction,
    arguments_of,
    operands,
    pruned,
    with_operands,
)
from symbody.symbolic import Argument

__all__ = ["Preparation"]


@dataclass
class Preparation:
    """The work of the parameters' stage of several routines, the same work once.

    A node is a constant, a parameter or an instruction on nodes; equal nodes are one. The constants of the model
    are the nodes that the routines read.
    """

    parameters: tuple[Argument, ...]
    _nodes: dict[Instruction, int] = field(default_factory=dict)
    _constants: dict[int, int] = field(default_factory=dict)

    def without_parameters(self, code: Code) -> Code:
        """Return the code with constants of the model, inputs without names, for what it computes from parameters."""
        known = self._known(code)
        lifted = sorted({p for p in self._read_later(code, known) if p in known})
        first = len(code.constants) + len(code.inputs)
        places = {place: first + i for i, place in enumerate(lifted)}
        shift = len(lifted)

        def moved(place: int) -> int:
            return places.get(place, place + shift if place >= first else place)

        inputs = tuple(Input("", self._constant(known[place]), "") for place in lifted)
        rows = [with_operands(row, [moved(p) for p in operands(row)]) for row in code.instructions]
        results = tuple(moved(place) for place in code.results)
        return pruned(Code(code.constants, code.inputs + inputs, tuple(rows), code.stages, results))

    @property
    def order(self) -> list[int]:
        """The numbers of the constants in the order of their array: parameters themselves come first."""
        rows = list(self._nodes)
        own = [rows[node] for node in self._constants]
        direct = sorted((row[1], k) for k, row in enumerate(own) if row[0] == "parameter")
        return [k for _, k in direct] + [k for k, row in enumerate(own) if row[0] != "parameter"]

    def code(self) -> Code:
        """Return the code that computes the constants from the parameters."""
        rows, wanted = list(self._nodes), list(self._constants)
        constants = [node for node, row in enumerate(rows) if row[0] == "constant"]
        inputs = arguments_of(self.parameters)
        place = {node: i for i, node in enumerate(constants)}
        place |= {n: len(constants) + row[1] for n, row in enumerate(rows) if row[0] == "parameter"}
        work = [node for node, row in enumerate(rows) if row[0] not in {"constant", "parameter"}]
        place |= {node: len(constants) + len(inputs) + i for i, node in enumerate(work)}
        return pruned(
            Code(
                tuple(float.fromhex(rows[node][1]) for node in constants),
                inputs,
                tuple(with_operands(rows[n], [place[m] for m in operands(rows[n])]) for n in work),
                (0,) * len(work),
                tuple(place[wanted[k]] for k in self.order),
            )
        )

    def _known(self, code: Code) -> dict[int, int]:
        """Return the nodes of the places that depend on parameters, and on nothing else that varies."""
        names = [argument.name for argument in self.parameters]
        numbers = {(entry.array, entry.index): i for i, entry in enumerate(arguments_of(self.parameters))}
        nodes = {place: self._node(("constant", value.hex())) for place, value in enumerate(code.constants)}
        fixed = set(nodes)
        for place, entry in enumerate(code.inputs, code.first_input):
            if entry.array in names:
                nodes[place] = self._node(("parameter", numbers[entry.array, entry.index]))
        kept = _factors_of_later_systems(code)
        for place, row in enumerate(code.instructions, code.first_instruction):
            read = operands(row)
            if place not in kept and all(p in nodes for p in read):
                nodes[place] = self._node(with_operands(row, [nodes[p] for p in read]))
                if all(p in fixed for p in read):
                    fixed.add(place)
        return {place: node for place, node in nodes.items() if place not in fixed}

    def _read_later(self, code: Code, known: dict[int, int]) -> Sequence[int]:
        rows = enumerate(code.instructions, code.first_instruction)
        return [*(p for place, row in rows if place not in known for p in operands(row)), *code.results]

    def _node(self, row: Instruction) -> int:
        if row[0] in {"add", "mul"}:
            row = (row[0], *sorted(row[1:]))
        return self._nodes.setdefault(row, len(self._nodes))

    def _constant(self, node: int) -> int:
        return self._constants.setdefault(node, len(self._constants))


def _factors_of_later_systems(code: Code) -> set[int]:
    """Return the places of factorisations that a system of a later stage reads: they stay with it."""
    rows = zip(code.instructions, code.stages, strict=True)
    return {row[1] for row, stage in rows if row[0] == "solve" and stage > 0}
