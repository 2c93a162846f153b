"""SciPy's solve_ivp on symbody's machine code: the same function that symbody's integrators call."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.integrate import solve_ivp

from symbody.codegen import PreparedCode
from symbody.symbolic import jacobian as jacobian_of

from .contender import Contender, decades
from .problem import Array, Problem

TOOL = "solve_ivp"
FINEST = {"RK45": 12, "DOP853": 13, "LSODA": 12, "Radau": 10, "BDF": 10}
IMPLICIT = ("LSODA", "Radau", "BDF")
"""Methods that take a Jacobian; theirs is machine code, too."""

Function = Callable[[float, Array], Array]


def contenders(problem: Problem) -> list[Contender]:
    """Return its methods; a constrained system is given as the ordinary differential equations of index 1."""
    given = rates(problem), jacobian(problem)
    return [
        Contender(TOOL, method, decades(finest), partial(_end, problem, method, *given))
        for method, finest in FINEST.items()
    ]


def _end(
    problem: Problem, method: str, rates: Function, jacobian: Function, tolerance: float, duration: float
) -> Array:
    return integrated(problem.start, duration, method, rates, jacobian, tolerance)


def integrated(
    start: Array,
    duration: float,
    method: str,
    rates: Function,
    jacobian: Function | None,
    tolerance: float,
    max_step: float = np.inf,
) -> Array:
    """Return the state at the last instant."""
    options = {"jac": jacobian} if method in IMPLICIT else {}
    solution = solve_ivp(
        rates, (0.0, duration), start, method, rtol=tolerance, atol=tolerance, max_step=max_step, **options
    )
    if not solution.success:
        raise RuntimeError(f"{method}: {solution.message}")
    return np.asarray(solution.y[:, -1])


def rates(problem: Problem) -> Function:
    """Return the rates of the state: the very machine code that symbody integrates."""
    return _function(problem, problem.model.rates_code, (len(problem.start),))


def jacobian(problem: Problem) -> Function:
    """Return the derivatives of the rates by the state, a full matrix."""
    state = problem.model.state
    slopes = jacobian_of(list(problem.model.rates[: len(state)]), list(state))
    n = len(state)
    code = problem.model.code([slopes[i, j] for i in range(n) for j in range(n)])
    return _function(problem, code, (n, n))


def _function(problem: Problem, code: PreparedCode, shape: tuple[int, ...]) -> Function:
    """Return the cheapest call from Python: fixed buffers, one foreign call that keeps the interpreter, one copy.

    Time stands at the first place and is left out: nothing depends on it here.
    """
    size = len(problem.start)
    row = np.concatenate([np.zeros(len(code.inputs)), code.prepare(problem.values)])
    out = np.empty(len(code.expressions))
    state, result = row[1 : 1 + size], out[: int(np.prod(shape))].reshape(shape)
    pointers = ctypes.c_void_p(row.ctypes.data), ctypes.c_void_p(out.ctypes.data)
    native = ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(code.address)

    def function(_t: float, y: Array, _alive: tuple[object, ...] = (code, row, out)) -> Array:
        state[:] = y
        native(*pointers)
        return result.copy()

    return function
