"""Machine code of expressions, for one state and for many, compiled at its first use."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from symbody.codegen.llvm import jit
from symbody.codegen.llvm.llvm_module import batch_modules, scalar_modules
from symbody.codegen.straight_line.code import Code, Input, code_of_tape
from symbody.symbolic import Expr
from symbody.symbolic.numeric.deficiency import Deficiency, noting, report
from symbody.symbolic.numeric.tape import Tape

__all__ = ["POINTER", "MachineCode"]

_WORTH = 10_000_000
"""Operations that are worth waking a thread for: about half a millisecond."""
POINTER, _INTEGER = ctypes.c_void_p, ctypes.c_int64


@dataclass(frozen=True, eq=False)
class MachineCode:
    """Functions of machine code that evaluate expressions.

    One state: ``void f(const double *inputs, double *outputs)``, at :attr:`address`. Many states, several in a vector:
    ``void f(const double *const *inputs, double *outputs, int64 first, int64 last, int64 stride)``, at
    :meth:`batch_address`; input k of state i is ``inputs[k][i]``, or ``inputs[k][0]`` where it is uniform, output j is
    ``outputs[j*stride + i]``, and there are at least :func:`symbody.codegen.llvm.jit.lanes` states.

    Attributes:
        inputs: the variables.
        expressions: the outputs.

    >>> from symbody import sin, symbols
    >>> x, a = symbols("x a")
    >>> out = np.empty((1, 2))
    >>> MachineCode((x, a), (a * x, sin(x))).evaluate(np.array([[0.5, 4.0]]), out)
    >>> out
    array([[2.        , 0.47942554]])
    """

    inputs: tuple[Expr, ...]
    expressions: tuple[Expr, ...]
    _batches: dict[tuple[bool, ...], jit.Compiled] = field(default_factory=dict)
    _scalars: list[jit.Compiled] = field(default_factory=list)

    @cached_property
    def operations(self) -> int:
        """The number of operations for one state."""
        return sum(Tape(self.inputs, self.expressions).operations)

    @property
    def address(self) -> int:
        """The address of the function of one state."""
        return self._scalar().address

    def batch_address(self, uniform: Sequence[bool]) -> int:
        """Return the address of the function of many states; uniform inputs have one value for all states."""
        return self._batch(tuple(uniform)).address

    def evaluate(self, states: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Evaluate states, each a row of inputs, into rows of outputs."""
        function = self._scalar().function(POINTER, POINTER)
        for state, row in zip(states, out, strict=True):
            function(state.ctypes.data, row.ctypes.data)

    def evaluate_columns(
        self, columns: Sequence[NDArray[np.float64]], points: int, out: NDArray[np.float64], threads: int = 1
    ) -> None:
        """Evaluate many states; several threads share them if there is enough work for each.

        Args:
            columns: the values of each input, of the shape (points,), or (1,) where all states share one value.
            points: the number of states.
            out: the outputs, of the shape (outputs, points).
            threads: how many threads share the states at most.
        """
        compiled = self._batch(tuple(column.size == 1 for column in columns))
        function = compiled.function(POINTER, POINTER, _INTEGER, _INTEGER, _INTEGER)
        pointers = (POINTER * len(columns))(*(column.ctypes.data for column in columns))

        def run(start: int, end: int) -> set[Deficiency]:
            with noting() as found:
                function(pointers, out.ctypes.data, start, end, points)
            return found

        parts = _parts(points, min(threads, max(points * self.operations // _WORTH, 1)))
        if len(parts) == 1:
            report(run(*parts[0]))
            return
        with ThreadPoolExecutor(len(parts)) as pool:
            report(set().union(*pool.map(lambda part: run(*part), parts)))

    def _scalar(self) -> jit.Compiled:
        if not self._scalars:
            code = self._code([0] * len(self.inputs))
            self._scalars.append(jit.compile_assembly(scalar_modules(code, "scalar", jit.lanes()), "scalar"))
        return self._scalars[0]

    def _batch(self, uniform: tuple[bool, ...]) -> jit.Compiled:
        if uniform not in self._batches:
            code = self._code([0 if is_uniform else 1 for is_uniform in uniform])
            assembly = batch_modules(code, "batch", jit.lanes(), uniform)
            self._batches[uniform] = jit.compile_assembly(assembly, "batch")
        return self._batches[uniform]

    def _code(self, stages: Sequence[int]) -> Code:
        inputs = [Input("in", k, str(variable)) for k, variable in enumerate(self.inputs)]
        return code_of_tape(Tape(self.inputs, self.expressions, stages), inputs)


def _parts(points: int, threads: int) -> list[tuple[int, int]]:
    """Return the states of each thread: whole vectors but for the last one, and at least one vector."""
    width = jit.lanes()
    vectors = max(points // width, 1)
    bounds = [vectors * k // threads * width for k in range(threads)] + [points]
    return [(start, end) for start, end in pairwise(bounds) if end > start]
