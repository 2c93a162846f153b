"""The functions that IDA calls: residuals, their derivatives and events, all in machine code."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from math import inf
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode

from .dae import DifferentialAlgebraicEquations

__all__ = ["Evaluated", "GoesOnAt", "IdaProblem", "StoppedError"]

Array = NDArray[np.float64]
GoesOnAt = Callable[[float], bool]
"""Called from time to time with the time reached, in s; False ends the motion."""


def _c_function(code: PreparedCode) -> Callable[[int, int], None]:
    return ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(code.address)


class Evaluated:
    """Machine code with its parameters, as a function of t, y, y' and cj."""

    def __init__(self, code: PreparedCode, parameters: Array, differential: int) -> None:
        constants, n = code.prepare(parameters), len(code.inputs)
        self._code = code
        self._inputs = np.concatenate([np.zeros(n), constants])
        self.values = np.empty(len(code.expressions))
        self._function = _c_function(code)
        self._places = self._inputs.ctypes.data, self.values.ctypes.data
        self._differential = differential
        self._unknowns, self._rates = (
            self._inputs[1 : n - 1 - differential],
            self._inputs[n - 1 - differential : n - 1],
        )
        self._n = n

    def __call__(self, time: float, y: Array, rates: Array, cj: float = 0.0) -> Array:
        inputs = self._inputs
        inputs[0], inputs[self._n - 1] = time, cj
        self._unknowns[:], self._rates[:] = y, rates[: self._differential]
        self._function(*self._places)
        return self.values


class StoppedError(Exception):
    """Ends IDA from a callback: the user interrupted it, or it no longer advances."""


_POLL = 200
"""The number of residuals between two calls of `keep_going`: some milliseconds."""
_TRAIL = 2**16
"""The most states of a trail; of a longer motion, every second one is kept."""
_PATIENCE, _STALL = 100, 1e-6
"""The part of the duration by which the integration must advance between as many calls."""


@dataclass(eq=False)
class IdaProblem:
    """The functions that IDA calls, with their parameters."""

    dae: DifferentialAlgebraicEquations
    parameters: Array
    watched: Evaluated | None
    keep_going: GoesOnAt | None
    span: float
    calls: int = 0
    since: float = -inf
    asked_at: float = -inf
    stop: str = ""
    trail: list[tuple[float, Array]] = field(default_factory=list)
    stdout: TextIO = field(default_factory=lambda: sys.stdout)
    residual: Evaluated = field(init=False)
    slopes: Evaluated = field(init=False)

    def __post_init__(self) -> None:
        n = self.dae.differential
        self.residual = Evaluated(self.dae.residual_code, self.parameters, n)
        self.slopes = Evaluated(self.dae.slopes_code, self.parameters, n)
        places = self.dae.slopes[1]
        self.rows, self.columns = places[:, 0], places[:, 1]

    def residuals(self, time: float, y: Array, rates: Array, out: Array) -> None:
        self.calls += 1
        if self.calls % _POLL == 0:
            self._poll(time)
        self._note(time, y)
        out[:] = self.residual(time, y, rates)

    def _note(self, time: float, y: Array) -> None:
        """Keep the last state that was tried at an instant; repeated steps begin earlier."""
        while self.trail and self.trail[-1][0] >= time:
            self.trail.pop()
        self.trail.append((time, y[: self.dae.differential].copy()))
        if len(self.trail) > _TRAIL:
            del self.trail[1::2]

    def _poll(self, time: float) -> None:
        if self.keep_going is not None and not self._may_go_on(time):
            self.stop = "stopped"
        elif self.calls % (_POLL * _PATIENCE) == 0:
            if time - self.since < _STALL * self.span:
                self.stop = "stalled"
            self.since = time
        self.asked_at = time
        if self.stop:
            raise StoppedError

    def _may_go_on(self, time: float) -> bool:
        with redirect_stdout(self.stdout):  # while IDA runs, stdout is a buffer for its messages
            return self.keep_going is None or self.keep_going(time)

    def jacobian(self, time: float, y: Array, rates: Array, _: Array, cj: float, out: Array) -> None:
        """Evaluate ``dF/dy + cj dF/dy'`` as a full matrix.

        Args:
            time: the time, in s.
            y: the unknowns.
            rates: their rates.
            _: the residuals, which are not used.
            cj: the derivative of a rate with respect to its unknown.
            out: the matrix to fill.
        """
        out[self.rows, self.columns] = self.slopes(time, y, rates, cj)

    def sparse_jacobian(self, time: float, y: Array, rates: Array, _: Array, cj: float, out: Array) -> None:
        """Evaluate the nonzero entries of ``dF/dy + cj dF/dy'``.

        Args:
            time: the time, in s.
            y: the unknowns.
            rates: their rates.
            _: the residuals, which are not used.
            cj: the derivative of a rate with respect to its unknown.
            out: the sparse matrix to fill.
        """
        out[:] = self.slopes(time, y, rates, cj)

    @property
    def pattern(self) -> Any:
        """The sparsity pattern of the Jacobian, column by column like its values."""
        from scipy.sparse import csc_matrix  # noqa: PLC0415 - slow to load, and other methods need none

        n = len(self.dae.unknowns)
        return csc_matrix((np.ones(len(self.rows)), (self.rows, self.columns)), shape=(n, n))

    def events(self, time: float, y: Array, rates: Array, out: Array) -> None:
        if self.watched is not None:
            out[:] = self.watched(time, y, rates)
