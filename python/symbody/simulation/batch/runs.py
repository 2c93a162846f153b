"""Runs: many motions of one model, as arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError, notify
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.multibody.named_constraint import shortened
from symbody.simulation.batch.case_arrays import Results, Status
from symbody.simulation.integrate.integrated import Integrated
from symbody.simulation.integrate.notices import Finding, deficiency_findings
from symbody.simulation.integrate.outcome import Failure, FailureKind, Outcome, Sensitivities, Statistics
from symbody.simulation.integrate.tally import notices_of_batch
from symbody.simulation.integrate.task import Task
from symbody.simulation.model.unknown import explain_unknown
from symbody.simulation.motion.continuous_angle import values_along
from symbody.simulation.motion.differentiated_motion import DifferentiatedMotion
from symbody.simulation.motion.motion import Motion
from symbody.simulation.motion.motion_of import motion_of
from symbody.simulation.motion.reading import Reading
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import counted, described, with_known_names
from symbody.symbolic.numeric.deficiency import noting

from .case_ends import CaseEnds, FailedCase
from .case_table import case_table
from .case_tasks import case_tasks
from .cases import Cases

Array = NDArray[np.float64]

_READING = Reading(
    "runs",
    "runs.motion(0) is the motion of the first case, runs.states has the states of all of them: "
    "cases x instants x state",
)


@dataclass(frozen=True, eq=False)
class Runs:
    """Many motions of one model at the same instants, as `simulate_many` returns them.

    Where a motion ended before the last instant, its values are NaN from there on. In the shapes below, k is the number
    of cases, N that of instants, n that of state variables. ``runs[expression]`` has the shape (k, N).

    Attributes:
        task: the model, the method and the outputs that the cases share.
        cases: the parameters and initial values of the cases.
        results: the arrays behind the properties: ``t`` (N,), ``states`` (k, N, n), ``outputs`` (k, N) each,
            ``completed`` (k,), ``failures``, ``findings`` and ``not_run``.

    >>> import symbody as sb
    >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
    >>> cart = sb.Body(sb.translate(x, 0, 0), m)
    >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
    >>> runs = sb.simulate_many(oscillator, {m: 1, k: [1, 4]}, {x: 0.1}, t=(0, 1))
    >>> runs[x].shape, runs.states.shape, runs.failures
    ((2, 1001), (2, 1001, 2), [])
    """

    task: Task
    cases: Cases
    results: Results

    def __len__(self) -> int:
        """Return the number of cases."""
        return self.cases.count

    @property
    def t(self) -> Array:
        """The instants, shape (N,), in s."""
        return self.task.instants

    @property
    def system(self) -> Variables:
        """The system that moves."""
        return self.task.model.system

    @property
    def parameters(self) -> Mapping[Expr, Array]:
        """The parameters, shape (k,) each."""
        return self.cases.parameters

    @property
    def initial(self) -> Mapping[Expr, Array]:
        """The given initial values, shape (k,) each."""
        return self.cases.initial

    @property
    def states(self) -> Array:
        """The states, shape (k, N, n), in the order of ``runs.task.model.state``."""
        if not self.task.keeps_states:
            raise ArgumentError(
                "runs: the states of these motions were not kept, only the outputs; give simulate_many "
                "keep_states=True, or name the expression in its outputs"
            )
        return self.results.states[:, :, : len(self.task.model.state)]

    @cached_property
    def outputs(self) -> dict[str, Array]:
        """The outputs by name, shape (k, N) each."""
        return {name: self.results.outputs[:, i] for i, name in enumerate(self.task.outputs)}

    def __iter__(self) -> NoReturn:
        """Refuse to iterate: Python would ask for ``runs[0]``, ``runs[1]`` and so on."""
        _READING.refuse_iteration()

    def __getitem__(self, expression: Expr | Freedom) -> Array:
        """Return the values of an expression, shape (k, N), or of a freedom of a joint, as `Motion` does.

        Raises:
            ArgumentError: the argument is not an expression, or it needs states that were not kept.
            SimulationError: the expression contains a variable that the model does not know.
            ParameterError: a parameter that is not in the equations has no value.
        """
        if isinstance(expression, Freedom):
            return values_along(expression, self.t, self.evaluate, "runs")
        asked = _READING.one_expression(expression, self.task.model.state)
        values: Array = self._values([asked], f"runs[{shortened(asked)}]")[0]
        return values

    @with_known_names
    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, shape (expressions, k, N).

        Raises:
            ArgumentError: the argument is not a list of expressions, or it needs states that were not kept.
            SimulationError: an expression contains a variable that the model does not know.
            ParameterError: a parameter that is not in the equations has no value.
        """
        return self._values(_READING.several_expressions(expressions), "runs.evaluate")

    def _values(self, wanted: Sequence[Expr], place: str) -> Array:
        """Return the values of expressions; those of outputs are already known."""
        values = np.full((len(wanted), len(self), len(self.t)), np.nan)
        outputs = {output: name for name, output in self.task.outputs.items()}
        others = [row for row, expression in enumerate(wanted) if expression not in outputs]
        for row, expression in enumerate(wanted):
            if expression in outputs:
                values[row] = self.outputs[outputs[expression]]
        if others:
            values[others], findings = self._explained([wanted[row] for row in others])
            for notice in notices_of_batch(findings, place):
                notify(notice)
        return values

    def _explained(self, wanted: list[Expr]) -> tuple[Array, list[tuple[Finding, ...]]]:
        """Return the values of `_by_states`, or raise an error that names the unknown variables."""
        try:
            return self._by_states(wanted)
        except ParameterError:
            explain_unknown("runs", wanted, self.task.model, self.cases.parameters)
            raise

    def _by_states(self, wanted: list[Expr]) -> tuple[Array, list[tuple[Finding, ...]]]:
        """Return the values of expressions from the states, and what a user should know of each case."""
        states, values = self.states, np.full((len(wanted), len(self), len(self.t)), np.nan)
        findings: list[tuple[Finding, ...]] = [()] * len(self)
        for case, reached in enumerate(self.results.reached):
            if reached:
                with noting() as found:
                    values[:, case, :reached] = self._tasks[case].values(
                        wanted, states[case, :reached], self.t[:reached], self._parameters_of(case)
                    )
                findings[case] = deficiency_findings(found, self._tasks[case].model)
        return values, findings

    @with_known_names
    def motion(self, index: int) -> Motion:
        """Return the motion of one case, for plots, animations and its energy.

        Args:
            index: the number of the case, from 0; negative ones count from the last.

        Raises:
            ArgumentError: there is no such case, it has no motion, or the states were not kept.
        """
        cases = len(self)
        if not hasattr(index, "__index__") or not -cases <= index < cases:
            raise ArgumentError(f"runs.motion: {described(index)}; expected one of the {cases} cases, from 0")
        case = int(index) % cases
        outcome = self.outcome(case)
        if outcome is None:
            _ = self.states
            why = str(self.results.messages[case]) or "it was not run"
            raise ArgumentError(f"runs.motion: case {case} has no motion: {why}")
        message = str(self.results.messages[case]) or "the last instant was reached"
        return motion_of(Integrated(self._tasks[case], self._parameters_of(case), outcome), message)

    def _parameters_of(self, case: int) -> dict[Expr, float]:
        parameters = self.cases.parameters_of(case)
        if not self.task.model.is_stabilized:
            return parameters
        return {**parameters, **self._tasks[case].damping_of(parameters, self.results.states[case, 0])}

    @cached_property
    def _tasks(self) -> list[Task]:
        """The tasks of the cases: redundant constraints share loads as they do along one motion."""
        return case_tasks(self.task, self.cases, self.results)

    @with_known_names
    def outcome(self, index: int) -> Outcome | None:
        """Return the outcome of the integration of one case; None if it was not started."""
        results, reached = self.results, int(self.results.reached[index])
        if reached == 0 or not self.task.keeps_states:
            return None
        states, t_reached = results.states[index, :reached], float(results.t_reached[index])
        occurrences = [(event, t, state.tolist()) for event, t, state, _ in results.occurrences[index]]
        end = float(self.t[reached - 1]), states[-1].tolist()
        if results.status[index] == Status.ENDED_BY_EVENT:
            end = occurrences[-1][1:]
        failed = results.status[index] == Status.FAILED
        steps, rejected, evaluations, jacobians, is_stiff = map(int, results.counts[index])
        return Outcome(
            states,
            occurrences,
            end,
            Failure(FailureKind.EXPLAINED, t_reached, str(results.messages[index])) if failed else None,
            Statistics(steps, rejected, evaluations, jacobians, bool(is_stiff)),
            sensitivities=self._sensitivities_of(index, reached),
        )

    def _sensitivities_of(self, case: int, reached: int) -> Sensitivities | None:
        """Return the derivatives of one case; None if none were asked for."""
        if not self.task.by:
            return None
        along = self.results.slopes[case, :reached]
        at_events = [slopes for *_, slopes in self.results.occurrences[case]]
        ended = self.results.status[case] == Status.ENDED_BY_EVENT
        occurrences = np.array(at_events).reshape(-1, *along.shape[1:])
        return Sensitivities(along, at_events[-1] if ended else along[-1], occurrences)

    @with_known_names
    def sensitivity(self, expression: Expr, by: Expr) -> Array:
        """Return the derivative of an expression by a parameter, or by an initial value, shape (k, N).

        Each is that of `Motion.sensitivity`; NaN where a motion failed or ended.

        Args:
            expression: an expression of the model, as in ``runs[expression]``.
            by: one of the `sensitivities` of `simulate_many`.

        Raises:
            ParameterError: the motions were not differentiated by it.
            ArgumentError: the argument is not an expression.
            SimulationError: the expression contains a variable that the model does not know.

        >>> import symbody as sb
        >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
        >>> oscillator = sb.newton_euler(sb.System([sb.Body(sb.translate(x, 0, 0), m)], coordinates=[x]))
        >>> u = sb.time_derivative(x)
        >>> runs = sb.simulate_many(oscillator, {m: 1}, {u: [0, 1]}, t=(0, 2), sensitivities=[u])
        >>> runs.sensitivity(x, by=u)[:, -1].round(9)
        array([2., 2.])
        """
        wanted = _READING.one_expression(expression, self.task.model.state)
        found = np.full((len(self), len(self.t)), np.nan)
        for case in np.flatnonzero(self.results.reached).tolist():
            known = slice(0, int(self.results.reached[case]))
            slopes = self.results.slopes[case, known] if self.task.by else None
            motion = DifferentiatedMotion(
                self._tasks[case].model,
                self._parameters_of(case),
                self.task.by,
                self.t[known],
                self.states[case, known],
                slopes,
                "simulate_many",
                "runs",
            )
            found[case, known] = motion.sensitivity(wanted, by)
        return found

    @cached_property
    def ends(self) -> CaseEnds:
        """How the cases ended."""
        found = self.results
        return CaseEnds(self.cases, found.status, found.t_reached, lambda case: str(found.messages[case]))

    @cached_property
    def completed(self) -> NDArray[np.bool_]:
        """Whether each case reached the last instant or a terminal event, shape (k,)."""
        return self.ends.completed

    @cached_property
    def failures(self) -> list[FailedCase]:
        """The cases that failed."""
        return [self.ends.failure(case) for case in self.ends.failed.tolist()]

    @cached_property
    def findings(self) -> list[tuple[Finding, ...]]:
        """The findings of each case, such as that it is stiff; empty for most cases."""
        return list(self.results.findings)

    @property
    def not_run(self) -> list[int]:
        """The cases that were not run because the batch was interrupted."""
        return [int(case) for case in self.ends.not_run]

    def __repr__(self) -> str:
        parts = [counted(len(self), "case"), counted(len(self.t), "instant")]
        parts += [f"{len(self.failures)} failed"] if self.failures else []
        parts += [f"{len(self.not_run)} not run"] if self.not_run else []
        return f"Runs({', '.join(parts)})"

    def _repr_html_(self) -> str:
        kept = self.task.model.state if self.task.keeps_states else ()
        return case_table(repr(self), self.cases, self.results, kept)
