"""symbody: the native integrators on the compiled equations, and the whole call of `simulate`."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from symbody import simulate
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.ida_method import run_ida
from symbody.simulation.integrate.methods import METHODS
from symbody.simulation.integrate.native import problem_of, run
from symbody.simulation.integrate.outcome import Outcome

from .contender import Contender, decades
from .problem import Array, Problem, instants

TOOL = "symbody"
FINEST = {"dop853": 13, "tsit5": 12, "bdf": 12, "esdirk34": 10}
IDA = "ida"
"""The constraints as they are, by SUNDIALS: stabilised index 2."""


def missing() -> str:
    """Return what to install for IDA, nothing if it is there."""
    return "" if find_spec("sksundae") else "SUNDIALS (pip: scikit-sundae)"


def contenders(problem: Problem) -> list[Contender]:
    """Return the integration of the compiled system by each method; of constrained ones by IDA, too."""
    found = [
        Contender(TOOL, method, decades(finest), _native(problem, method))
        for method, finest in FINEST.items()
    ]
    if problem.model.constraints and not missing():
        found.append(Contender(TOOL, IDA, decades(10), _by_ida(problem)))
    return found


def _native(problem: Problem, method: str) -> Callable[[float, float], Array]:
    """Return the integration; constraints are kept by projection after each step, as `simulate` does."""
    model = problem.model
    needs_jacobian = not METHODS[method].is_explicit
    compiled = problem_of(model, is_projected=True, needs_jacobian=needs_jacobian)
    constants = compiled.constants(problem.values)
    start = np.concatenate([problem.start, np.zeros(model.width - len(model.state))])

    def end(tolerance: float, duration: float) -> Array:
        options = Options(method, tolerance, tolerance)
        return _end(problem, run(compiled, start, constants, instants(duration), options))

    return end


def _by_ida(problem: Problem) -> Callable[[float, float], Array]:
    def end(tolerance: float, duration: float) -> Array:
        options = Options(IDA, tolerance, tolerance)
        outcome = run_ida(problem.model, problem.start, problem.parameters, instants(duration), options)
        return _end(problem, outcome)

    return end


def _end(problem: Problem, outcome: Outcome) -> Array:
    if outcome.failure is not None:
        raise RuntimeError(f"{problem.name}: {outcome.failure.message}")
    return outcome.states[-1, : len(problem.start)]


def whole_call(problem: Problem, count: int) -> Callable[[float, float], Array]:
    """Return `simulate` with all that it does around the integration, for a number of instants."""

    def end(tolerance: float, duration: float) -> Array:
        given = (problem.equations, problem.parameters, problem.initial, np.linspace(0, duration, count))
        motion = simulate(*given, rtol=tolerance, atol=tolerance, progress=False)
        return np.asarray(motion.states[-1])

    return end
