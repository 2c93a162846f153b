"""Machine code in two parts: what follows from parameters alone, computed once; and the rest, for every state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.codegen.llvm import jit
from symbody.codegen.llvm.assembly import Assembly
from symbody.codegen.llvm.llvm_module import lane_modules, scalar_modules, shortcut_modules
from symbody.codegen.machine.machine_code import POINTER
from symbody.codegen.straight_line.code import Code, Input, code_of
from symbody.codegen.straight_line.instruction import Operation, renumber
from symbody.codegen.straight_line.preparation import Preparation
from symbody.errors import ParameterError
from symbody.symbolic import Argument, Expr

__all__ = ["PreparedCode", "Shortcut"]


WORTH_LANES = 256
"""The number of states from which code of several states pays, which takes a moment to compile."""


@dataclass(frozen=True)
class Shortcut:
    """Faster expressions of the same outputs, which are accurate in most states.

    Attributes:
        expressions: the outputs.
        conditions: all are positive where the expressions are accurate.

    >>> from symbody import symbols
    >>> x, a = symbols("x a")
    >>> shortcut = Shortcut((a * x**2,), (x,))  # of a x |x|
    >>> code = PreparedCode((a,), (x,), (a * x * abs(x),), shortcut)
    >>> code.evaluate(np.array([2.0]), np.array([-3.0]))
    array([-18.])
    """

    expressions: tuple[Expr, ...]
    conditions: tuple[Expr, ...]


@dataclass(frozen=True, eq=False)
class PreparedCode:
    """A function of machine code, ``void f(const double *in, double *out)`` with ``in = (inputs, constants)``.

    The constants are what its expressions need of the parameters: `prepare` computes them for a set of parameters.
    It compiles at the first use, in each process to which it is sent.

    Attributes:
        parameters: what changes from one motion to another.
        inputs: what changes from one state to another.
        expressions: the outputs.
        shortcut: faster expressions of them, which are used where they are accurate.

    >>> from symbody import cos, sin, symbols
    >>> x, a, b = symbols("x a b")
    >>> code = PreparedCode((a, b), (x,), (sin(a) * x, cos(b) / x))
    >>> code.constants
    2
    >>> code.evaluate(np.array([0.5, 0.25]), np.array([2.0]))
    array([0.95885108, 0.48445621])
    """

    parameters: tuple[Expr, ...]
    inputs: tuple[Expr, ...]
    expressions: tuple[Expr, ...]
    shortcut: Shortcut | None = None

    @property
    def address(self) -> int:
        """The address of the function."""
        return self._function.address

    @property
    def in_lanes(self) -> tuple[int, int] | None:
        """The address of the function of several states, and the number of its conditions.

        ``void f(const double *in, double *out)``: number k of lane i is at ``k*lanes + i``. The conditions follow the
        outputs, which hold in the lanes where all of them are positive. None if the code solves linear systems, whose
        deficiencies belong to one state.
        """
        quick = self._parts.shortcut or self._parts.outputs
        if any(row.operation is Operation.FACTOR for row in quick.instructions):
            return None
        return self._lanes.address, len(quick.results) - len(self.expressions)

    @property
    def constants(self) -> int:
        """The number of constants that it reads."""
        return len(self._parts.constants.results)

    def prepare(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the constants for values of the parameters."""
        values, out = np.ascontiguousarray(parameters, float), np.empty(self.constants)
        if values.shape != (len(self.parameters),):
            raise ParameterError(
                f"expected values of {len(self.parameters)} parameters, found an array of the shape {values.shape}"
            )
        if self.constants:
            self._preparation.function(POINTER, POINTER)(values.ctypes.data, out.ctypes.data)
        return out

    def evaluate(self, parameters: NDArray[np.float64], inputs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the outputs for one state."""
        values: NDArray[np.float64] = self.evaluate_rows(parameters, inputs[np.newaxis])[0]
        return values

    def evaluate_rows(
        self, parameters: NDArray[np.float64], rows: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the outputs for states, each a row of inputs, in rows."""
        constants = np.broadcast_to(self.prepare(parameters), (len(rows), self.constants))
        states, out = np.hstack([rows, constants]), np.empty((len(rows), len(self.expressions)))
        function = self._function.function(POINTER, POINTER)
        for state, row in zip(states, out, strict=True):
            function(state.ctypes.data, row.ctypes.data)
        return out

    def prepare_many(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the constants for k sets of parameters, shape (k, constants)."""
        values = np.ascontiguousarray(parameters, float)
        out = np.empty((len(values), self.constants))
        if values.shape[1:] != (len(self.parameters),):
            raise ParameterError(
                f"expected rows of {len(self.parameters)} parameters, found an array of the shape {values.shape}"
            )
        if len(values) > 1 and (values == values[:1]).all():
            out[:] = self.prepare_many(values[:1])
        elif self.constants:
            _call_for_each(self._preparation, values, out)
        return out

    def evaluate_many(
        self, parameters: NDArray[np.float64], rows: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the outputs for k sets of parameters, each at its own state, in rows."""
        states = np.hstack([rows, self.prepare_many(parameters)])
        out = np.empty((len(rows), len(self.expressions)))
        several = self.in_lanes if len(rows) >= WORTH_LANES else None
        others = np.arange(len(rows)) if several is None else self._evaluate_in_lanes(several[1], states, out)
        if len(others):
            single = np.empty((len(others), out.shape[1]))
            _call_for_each(self._function, states[others], single)
            out[others] = single
        return out

    def _evaluate_in_lanes(
        self, conditions: int, states: NDArray[np.float64], out: NDArray[np.float64]
    ) -> NDArray[np.intp]:
        """Write the outputs for rows of states and constants; return the places of those that need code for one."""
        width, count = jit.lanes(), len(states)
        crews = -(-count // width)
        whole = np.resize(
            states, (crews * width, states.shape[1])
        )  # the last crew is filled up with the first states
        columns = np.ascontiguousarray(whole.reshape(crews, width, -1).transpose(0, 2, 1))
        found = np.empty((crews, out.shape[1] + conditions, width))
        _call_for_each(self._lanes, columns, found)
        results = found.transpose(0, 2, 1).reshape(crews * width, -1)[:count]
        out[:] = results[:, : out.shape[1]]
        return np.flatnonzero(~(results[:, out.shape[1] :] > 0).all(axis=1))

    @cached_property
    def _parts(self) -> _Parts:
        p = Argument("p", "", self.parameters, "parameters")
        x = Argument("x", "", self.inputs, "velocities")
        preparation = Preparation((p,))
        ways = [self.expressions]
        if self.shortcut is not None:
            ways.append((*self.shortcut.expressions, *self.shortcut.conditions))
        rests = [preparation.without_parameters(code_of((p, x), way)) for way in ways]
        first, order = len(self.inputs), {number: k for k, number in enumerate(preparation.order)}

        def position(entry: Input) -> int:
            return entry.index if entry.array == "x" else first + order[entry.index]

        constants = _laid_out(preparation.code(), lambda entry: entry.index, len(self.parameters))
        return _Parts(constants, *(_laid_out(rest, position, first + len(order)) for rest in rests))

    @cached_property
    def _preparation(self) -> jit.Compiled:
        return _compiled(lambda lanes: scalar_modules(self._parts.constants, "prepare", lanes), "prepare")

    @cached_property
    def _function(self) -> jit.Compiled:
        outputs, shortcut = self._parts.outputs, self._parts.shortcut

        def assembly(lanes: int) -> Assembly:
            if shortcut is None:
                return scalar_modules(outputs, "evaluate", lanes)
            return shortcut_modules(shortcut, len(self.expressions), outputs, "evaluate", lanes)

        return _compiled(assembly, "evaluate")

    @cached_property
    def _lanes(self) -> jit.Compiled:
        quick = self._parts.shortcut or self._parts.outputs
        return _compiled(lambda lanes: lane_modules(quick, "lanes", lanes), "lanes")

    def __reduce__(self) -> tuple[Any, ...]:
        return PreparedCode, (self.parameters, self.inputs, self.expressions, self.shortcut)


@dataclass(frozen=True)
class _Parts:
    """The code of the constants, that of the outputs, and that of a shortcut and its conditions."""

    constants: Code
    outputs: Code
    shortcut: Code | None = None


def _call_for_each(code: jit.Compiled, rows: NDArray[np.float64], out: NDArray[np.float64]) -> None:
    """Call a function for each row of numbers; write its outputs to rows."""
    function = code.function(POINTER, POINTER)
    start, end = rows.ctypes.data, out.ctypes.data
    for place in range(len(rows)):
        function(start + place * rows.strides[0], end + place * out.strides[0])


def _compiled(assembly: Callable[[int], Assembly], name: str) -> jit.Compiled:
    return jit.compile_assembly(assembly(jit.lanes()), name)


def _laid_out(code: Code, position: Callable[[Input], int], size: int) -> Code:
    """Return the code with inputs for all entries of an array, each at its position."""
    first, shift = code.first_input, size - len(code.inputs)
    after = range(code.first_instruction, code.first_instruction + len(code.instructions))
    places = [*range(first), *(first + position(entry) for entry in code.inputs), *(k + shift for k in after)]
    return replace(
        code,
        inputs=tuple(Input("in", k, "") for k in range(size)),
        instructions=renumber(code.instructions, places),
        results=tuple(places[place] for place in code.results),
    )
