"""Integration of differential-algebraic equations by IDA of SUNDIALS, through the package scikit-sundae."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from math import inf
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.errors import CodegenError, ParameterError, SimulationError
from symbody.simulation.given.event import Event
from symbody.simulation.model.model import model_of
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import brief

from .dae import DifferentialAlgebraicEquations, dae_of
from .dae_start import Start, start_of
from .ida_problem import Evaluated, GoesOnAt, IdaProblem, StoppedError

__all__ = ["IdaOccurrence", "IdaRun", "IdaStatistics", "integrate_ida"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class IdaStatistics:
    """The cost of an integration: evaluations of residuals and of their derivatives."""

    evaluations: int
    jacobians: int


@dataclass(frozen=True, eq=False)
class IdaOccurrence:
    """An event that occurred: its index among the given events, the instant in s, and the state there."""

    event: int
    t: float
    state: Array


@dataclass(frozen=True, eq=False)
class IdaRun:
    """A motion at the N instants that were reached; if it ended between two of them, its end is the last row.

    Attributes:
        t: the instants, shape (N,), in s.
        states: coordinates and speeds, shape (N, n).
        multipliers: the multipliers of the constraints, as integrated, shape (N, m).
        accelerations: the rates of the speeds, as integrated.
        trail: one row for each step: the instant and the state at its end, before the last corrections.
        events: the events that occurred, in order.
        statistics: the cost of the integration.
        completed: whether the motion reached the last instant or a terminal event.
        message: why the motion ended.
    """

    t: Array
    states: Array
    multipliers: Array
    accelerations: Array
    trail: Array
    events: tuple[IdaOccurrence, ...]
    statistics: IdaStatistics
    completed: bool
    message: str


def integrate_ida(
    eqs: Equations,
    parameters: Mapping[Expr, float],
    state: Array,
    instants: Array,
    *,
    index: str = "stabilized",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    inputs: Mapping[Expr, ExprLike] | None = None,
    events: Sequence[Event] = (),
    keep_going: GoesOnAt | None = None,
    max_step: float = inf,
) -> IdaRun:
    """Integrate ``F(t, y, y') = 0`` by backward differences of variable order and step [Hindmarsh et al. 2005].

    Algebraic variables, and speeds at index 3, are excluded from the error test. Where the step size changes, their
    error is that of the state over h, or over h^2 for multipliers at index 3, although the state is accurate
    [Petzold & Loetstedt 1986; Hairer & Wanner 1996, sec. VII.3]: the test would make the step size collapse.

    Args:
        eqs: the equations of motion.
        parameters: values of all parameters.
        state: coordinates, then speeds, at the first instant, shape (n,); consistent with the constraints.
        instants: the instants of the results, shape (N,), increasing, in s.
        index: the form of the equations, one of `symbody.simulation.integrate.dae.FORMS`.
        rtol: the tolerance of the error of a step, relative to the state.
        atol: the absolute tolerance of the error of a step.
        inputs: the expressions that replace input functions of time.
        events: the events to watch.
        keep_going: called from time to time with the time reached; False ends the motion.
        max_step: the longest step, in s.

    Raises:
        CodegenError: scikit-sundae is not installed.
        ParameterError: a parameter has no value.
        SimulationError: IDA cannot continue; the run up to there is the error's `motion`.
        ModelError: an input of the equations has no expression.

    >>> import numpy as np
    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, translate
    >>> (x, y), (m, l) = functions_of_time("x y"), symbols("m l")
    >>> circle = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x**2 + y**2 - l**2])
    >>> state, instants = np.array([1.0, 0.0, 0.0, 1.0]), np.linspace(0, np.pi, 3)
    >>> run = integrate_ida(newton_euler(circle), {m: 1.0, l: 1.0}, state, instants)
    >>> run.states[-1].round(5) + 0.0
    array([-1.,  0.,  0., -1.])
    """
    sundae = _sundae()
    dae = dae_of(model_of(eqs, inputs), index)
    values = _values(dae.parameters, parameters)
    watched = _watched(dae, parameters, events) if events else None
    times = np.asarray(instants, float)
    problem = IdaProblem(dae, values, watched, keep_going, float(times[-1] - times[0]))
    start = start_of(dae, values, np.asarray(state, float), float(times[0]))
    return _Integration(problem, tuple(events), times, start).run(sundae, rtol, atol, max_step)


def _sundae() -> ModuleType:
    try:
        from sksundae import ida  # noqa: PLC0415 - an extra, not everybody's
    except Exception as failure:  # what is installed, and can't be loaded, fails in many ways
        is_missing = isinstance(failure, ModuleNotFoundError) and failure.name == "sksundae"
        state = (
            "isn't installed here: pip install symbody[sundials]"
            if is_missing
            else f"can't be loaded here ({brief(failure)}): pip install --force-reinstall scikit-sundae"
        )
        raise CodegenError(
            f"simulate: the methods 'ida', 'ida2' and 'ida3' need the package scikit-sundae, which {state}; or use "
            "another method"
        ) from failure
    return ida  # type: ignore[no-any-return]


def _values(wanted: Sequence[Expr], given: Mapping[Expr, float]) -> Array:
    missing = [str(parameter) for parameter in wanted if parameter not in given]
    if missing:
        raise ParameterError(
            f"simulate: no values of the parameters {', '.join(missing)}; give a number for each"
        )
    return np.array([float(given[parameter]) for parameter in wanted])


def _watched(
    dae: DifferentialAlgebraicEquations, parameters: Mapping[Expr, float], events: Sequence[Event]
) -> Evaluated:
    code = dae.observed(tuple(event.expression for event in events))
    return Evaluated(code, _values(code.parameters, parameters), dae.differential)


@dataclass(eq=False)
class _Integration:
    """An integration in progress."""

    problem: IdaProblem
    events: Sequence[Event]
    instants: Array
    start: Start
    rows: list[tuple[float, Array, Array]] = field(default_factory=list)
    happened: list[IdaOccurrence] = field(default_factory=list)
    statistics: IdaStatistics = field(default_factory=lambda: IdaStatistics(0, 0))

    def run(self, sundae: ModuleType, rtol: float, atol: float, max_step: float) -> IdaRun:
        """Run IDA through all instants."""
        solver = self._solver(sundae, rtol, atol, max_step)
        solver.init_step(self.start.t, self.start.unknowns, self.start.rates)
        self._keep(self.start.t, self.start.unknowns, self.start.rates)
        for instant in self.instants[1:]:
            ending = self._reach(solver, float(instant))
            if ending is not None:
                return self._ended(ending)
        return self._run(is_completed=True, message="the last instant was reached")

    def _solver(self, sundae: ModuleType, rtol: float, atol: float, max_step: float) -> Any:
        problem, n, width = self.problem, self.problem.dae.differential, len(self.start.unknowns)
        with warnings.catch_warnings():  # of a custom Jacobian that replaces IDA's own
            warnings.filterwarnings("ignore", message="Custom sparse Jacobian")
            return sundae.IDA(
                problem.residuals,
                rtol=rtol,
                atol=self._tolerances(atol),
                algebraic_idx=list(range(n, width)),
                first_step=min(self._first_step(rtol, atol), max_step),
                max_step=0.0 if max_step == inf else max_step,
                max_num_steps=_MANY,
                **self._linear_solver(),
                **self._event_options(),
            )

    def _tolerances(self, atol: float) -> Array:
        """Return the absolute tolerances: infinity for what is excluded from the error test."""
        dae, tolerances = self.problem.dae, np.full(len(self.start.unknowns), inf)
        tolerances[: dae.differential] = atol
        if dae.form == "3":
            q, u = len(dae.model.coordinates), len(dae.model.speeds)
            tolerances[q : q + u] = inf
        return tolerances

    def _linear_solver(self) -> dict[str, Any]:
        problem = self.problem
        if len(self.start.unknowns) < _SPARSE:
            return {"jacfn": problem.jacobian}
        return {"jacfn": problem.sparse_jacobian, "linsolver": "sparse", "sparsity": problem.pattern}

    def _event_options(self) -> dict[str, Any]:
        if not self.events:
            return {}
        return {"eventsfn": _as_function(self.problem.events, self.events), "num_events": len(self.events)}

    def _first_step(self, rtol: float, atol: float) -> float:
        """Return the first step: the coordinates deviate from straight lines by their tolerance.

        IDA's own choice, which moves the coordinates by their tolerance, is lost in the rounding of phi at index 3.
        """
        model = self.problem.dae.model
        n = len(model.coordinates)
        bound = atol + rtol * float(np.abs(self.start.unknowns[:n]).max(initial=0.0))
        curving = float(np.abs(self.start.rates[n : n + len(model.speeds)]).max())
        longest = 1e-3 * self.problem.span
        return longest if curving == 0 else min(longest, float(np.sqrt(2 * bound / curving)))

    def _reach(self, solver: Any, instant: float) -> _Ending | None:
        """Integrate to an instant; return how the motion ended if it did before."""
        while True:
            said = io.StringIO()
            try:
                # IDA's wrapper prints its errors; they are captured for the message.
                with redirect_stdout(said):
                    result = solver.step(instant, method="normal", tstop=self.instants[-1])
            except StoppedError:
                return _Ending(self.problem.stop, self.problem.asked_at, "")
            self.statistics = IdaStatistics(int(result.nfev), int(result.njev))
            if result.status < 0 or not np.isfinite(result.y).all():
                return _Ending("failed", float(result.t), said.getvalue() or str(result.message))
            if result.status != _ROOT:
                self._keep(float(result.t), result.y, result.yp)
                return None
            if self._note(result):
                self._keep(float(result.t), result.y, result.yp)
                return _Ending("terminal", float(result.t), str(self.events[self.happened[-1].event]))

    def _keep(self, time: float, unknowns: Array, rates: Array) -> None:
        self.rows.append((time, unknowns, rates))

    def _note(self, result: Any) -> bool:
        """Record the events at which IDA stopped; return whether one of them is terminal."""
        time, state = float(result.t), result.y[: self.problem.dae.differential]
        places = [int(k) for k in np.flatnonzero(result.i_events[-1])]
        terminal = [k for k in places if self.events[k].terminal]
        for k in [*(k for k in places if k not in terminal), *terminal]:
            self.happened.append(IdaOccurrence(k, time, state))
        return bool(terminal)

    def _ended(self, ending: _Ending) -> IdaRun:
        if ending.kind == "terminal":
            return self._run(is_completed=True, message=f"the event {ending.reason} at t = {ending.t:.9g} s")
        if ending.kind == "stopped":
            return self._run(is_completed=False, message=f"stopped at t = {ending.t:.6g} s")
        is_first = ending.t == self.start.t and ending.kind == "failed"
        run = self._run(is_completed=False, message=_failure(ending, self.problem.dae, is_first=is_first))
        raise SimulationError(run.message, run)

    def _run(self, *, is_completed: bool, message: str) -> IdaRun:
        dae = self.problem.dae
        n, m, q = dae.differential, len(dae.model.multipliers), len(dae.model.coordinates)
        unknowns, rates = np.array([y for _, y, _ in self.rows]), np.array([r for _, _, r in self.rows])
        return IdaRun(
            t=np.array([time for time, _, _ in self.rows]),
            states=unknowns[:, :n],
            multipliers=unknowns[:, n : n + m],
            accelerations=rates[:, q : q + len(dae.model.speeds)],
            trail=np.array([[time, *state] for time, state in self.problem.trail]).reshape(-1, 1 + n),
            events=tuple(self.happened),
            statistics=self.statistics,
            completed=is_completed,
            message=message,
        )


@dataclass(frozen=True)
class _Ending:
    """Why a motion ended, when, and the message of IDA."""

    kind: str
    t: float
    reason: str


_ROOT, _MANY, _SPARSE = 2, 2**31 - 1, 150
"""IDA's status at an event; the steps allowed between instants; the unknowns above which a sparse solver is faster."""

_HINTS = {
    "3": "index 3 is the most delicate form: use method='ida', or larger tolerances",
    "2": "if the constraints have drifted, use method='ida'",
    "stabilized": "larger tolerances may help, or another method",
}


def _failure(ending: _Ending, dae: DifferentialAlgebraicEquations, *, is_first: bool) -> str:
    said = " ".join(ending.reason.split()).rstrip(".")
    what = "the steps became too short" if ending.kind == "stalled" else f"IDA gave up ({said})"
    expected = (
        "an initial state that satisfies the constraints and their rates, and independent constraints"
        if is_first and dae.model.constraints
        else "a motion that is smooth and finite there: look for a singular position, constraints that depend on each "
        "other, a force that jumps, or a function that leaves its domain"
    )
    return f"simulate: at t = {ending.t:.9g} s {what}; expected {expected}; {_HINTS[dae.form]}"


def _as_function(method: Callable[..., None], events: Sequence[Event]) -> Callable[..., None]:
    """Return a function with the attributes that IDA's wrapper reads; a method cannot have attributes."""

    def function(time: float, y: Array, rates: Array, out: Array) -> None:
        method(time, y, rates, out)

    function.terminal = [event.terminal for event in events]  # type: ignore[attr-defined]
    function.direction = [event.direction for event in events]  # type: ignore[attr-defined]
    return function
