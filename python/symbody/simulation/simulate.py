"""Simulation: from equations of motion to a motion."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import inf

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ModelNotice, SimulationError
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.deficiency import noting

from .asked import asked_outputs, check_known_along, parameters_in, watched_events
from .baumgarte_choice import chosen_damping
from .begin import begin
from .contradictory_constraints import without_contradictions
from .diagnosis import diagnosis
from .event import Event
from .given_bodies import notice_impossible_bodies
from .ida import IDA_FORMS
from .ida_outcome import ida_outcome
from .integrator import Options, Outcome, Problem, run
from .interruption import Interruption
from .model import DAMPING, Model, model_of
from .motion import Motion
from .motion_of import motion_of
from .notices import Integrated, findings_of, notices_of_motion
from .options import instants_of, kept_by, options_of
from .progress import preparation_bar, progress_bar
from .unused import notice_unused
from .values import given_inputs, parameter_values, vanishing

__all__ = ["simulate"]

Array = NDArray[np.float64]


def simulate(
    eqs: Equations,
    parameters: Mapping[Expr, float] | None = None,
    initial: Mapping[Expr, float] | None = None,
    t: tuple[float, float] | ArrayLike = (0.0, 10.0),
    *,
    inputs: Mapping[Expr, ExprLike] | None = None,
    method: str = "auto",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    outputs: Mapping[str, ExprLike] | None = None,
    events: Sequence[Event] | None = None,
    constraints: str | tuple[float, float] = "projection",
    guess: Mapping[Expr, float] | None = None,
    max_step: float = inf,
    progress: bool | None = None,
) -> Motion:
    """Return the motion of a system from an initial state: ``M u' = forcing + phi_q^T lambda, phi = 0``.

    The equations are compiled, and integrated by compiled code. Ctrl-C returns what was computed.

    Args:
        eqs: the equations of motion.
        parameters: values of the parameters, also of those that stand in events and outputs alone. Others of the model
            may be there; one that stands nowhere in it is named in a notice.
        initial: values of coordinates, their rates or speeds at the first instant. What isn't named is free: zero
            without constraints, and changed as little as the constraints demand with them.
        t: the first and the last instant (1001 instants, evenly spaced), or the instants themselves, in s.
        inputs: expressions of time, state and parameters for the functions of time that are given from outside.
        method: "auto" and "dop853", the explicit Runge-Kutta method of order 8 [Hairer, Norsett & Wanner 1993];
            "tsit5", order 5; for stiff equations "bdf", "esdirk34", "tr_bdf2"; for constraints without reduction of
            the index "ida" (stabilised index 2), "ida2", "ida3", by SUNDIALS.
        rtol: the error of a step relative to the state.
        atol: the error of a step where the state is small.
        outputs: expressions to evaluate at all instants, by name.
        events: what to look for; a terminal one ends the motion.
        constraints: "projection", back onto the constraints and their rates after each step [Eich 1993]; "baumgarte" or
            its (omega, zeta), damping of what is off; "free", neither. IDA's methods keep them by themselves.
        guess: where to look for an initial state that satisfies the constraints, for what isn't given.
        max_step: the longest step, in s.
        progress: whether to show bars, of derivation and compilation after two seconds, and of the integration; by
            default where messages go to a terminal.

    Raises:
        ParameterError: a value is missing, belongs to nothing, or isn't finite.
        ConstraintError: no state with what is given satisfies the constraints.
        ModelError: functions of time that nobody gives, or that aren't needed.
        SimulationError: the motion can't go on; what was computed is the error's `motion`.

    >>> from symbody import Body, Point, System, Vector, functions_of_time, ground, lagrange_equations, rotate, symbols
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(Point(rotate("Z", theta), 0, -l, 0), m)
    >>> pendulum = lagrange_equations(System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0)))
    >>> motion = simulate(pendulum, {m: 1, l: 1, g: 9.81}, {theta: 0.1}, t=(0, 2))
    >>> motion
    Motion of theta: 1001 instants from 0 to 2 s, the last instant was reached
    >>> motion.energy_drift < 1e-7
    True
    """
    instants, options, kept = instants_of(t), options_of(method, rtol, atol, max_step), kept_by(constraints)
    asked, watched = asked_outputs(outputs), watched_events(events)
    modelled = partial(model_of, eqs, given_inputs(eqs, inputs), zeros=vanishing(parameters))
    plain = modelled()
    check_known_along(plain, asked, watched)
    others = parameters_in([*asked.values(), *(event.expression for event in watched)])
    values = parameter_values((*plain.parameters, *others), parameters)[: len(plain.parameters)]
    given = {name: float(value) for name, value in _given(parameters).items()}
    notice_unused(eqs, given, [*dict(plain.inputs).values(), *others], "simulate")
    notice_impossible_bodies(eqs.system, given, "simulate")
    with preparation_bar(is_shown=progress), noting() as met:
        state = begin(plain, given, _given(initial), _given(guess), float(instants[0]))
    is_damped = bool(eqs.constraints) and kept not in {"projection", "free"}
    model = modelled(is_stabilized=True) if is_damped else plain
    if is_damped:
        damping = chosen_damping(plain, values, state, instants) if isinstance(kept, str) else kept
        given |= dict(zip(DAMPING, damping, strict=True))
        values = np.concatenate([values, damping])
    course = _Course(model, given, values, instants, options, watched, is_projected=kept == "projection")
    outcome = course.followed(state, is_shown=progress)
    return course.told(replace(outcome, deficiencies=outcome.deficiencies | met), asked)


def _given(values: Mapping[Expr, float] | None) -> Mapping[Expr, float]:
    """Return what a user gives, or nothing."""
    return {} if values is None else values


@dataclass(frozen=True, eq=False)
class _Course:
    """A simulation that can begin."""

    model: Model
    parameters: Mapping[Expr, float]
    values: Array
    instants: Array
    options: Options
    events: tuple[Event, ...]
    is_projected: bool

    def followed(self, state: Array, *, is_shown: bool | None) -> Outcome:
        """Integrate; Ctrl-C ends it between two steps."""
        first, last = float(self.instants[0]), float(self.instants[-1])
        is_ida = self.options.method in IDA_FORMS
        with noting() as found:
            with preparation_bar(is_shown=is_shown):
                problem, constants = (None, np.empty(0)) if is_ida else self._compiled()
            with (
                Interruption() as interruption,
                progress_bar("simulate", last - first, is_shown=is_shown) as show,
            ):

                def keep_going(time: float) -> bool:
                    show(time - first)
                    return not interruption.is_asked_for

                if problem is None:
                    size = len(self.model.state)
                    given = (self.parameters, self.instants, self.options, self.events, keep_going)
                    outcome = ida_outcome(self.model, state[:size], *given)
                else:
                    outcome = run(problem, state, constants, self.instants, self.options, keep_going)
                if not interruption.is_asked_for:
                    show(outcome.end[0] - first)
        outcome = replace(outcome, deficiencies=frozenset(found))
        return without_contradictions(outcome, self.model, self.parameters, self.instants)

    def _compiled(self) -> tuple[Problem, Array]:
        """Return the compiled functions and their constants; Ctrl-C interrupts, as there is no motion yet to keep."""
        method, events = self.options.method, self.events
        problem = Problem.of(self.model, method, is_projected=self.is_projected, events=events)
        values = np.array([self.parameters[name] for name in problem.parameters])
        constants = problem.constants(values)
        problem.native  # noqa: B018 - compiled now
        return problem, constants

    def told(self, outcome: Outcome, asked: Mapping[str, Expr]) -> Motion:
        """Return the motion; raise an error that holds it if it failed."""
        failure = outcome.failure
        begin = float(self.instants[0])
        with noting():  # what the motion met is among the findings
            findings = findings_of(Integrated(self.model, self.parameters, self.options, outcome, begin))
        for notice in notices_of_motion(findings):
            warnings.warn(notice, ModelNotice, stacklevel=3)
        if failure is None:
            return self._motion(outcome, asked, "the last instant was reached")
        if failure.kind == "interrupted":
            motion = self._motion(outcome, asked, f"interrupted at t = {outcome.end[0]:.6g} s")
            warnings.warn(f"simulate: {motion.message}; what was computed is kept", ModelNotice, stacklevel=3)
            return motion
        reason = diagnosis(failure, outcome, self.model, self.values, self.options.method)
        message = f"simulate: {reason}; what was computed is the error's motion"
        raise SimulationError(message, self._motion(outcome, asked, message))

    def _motion(self, outcome: Outcome, asked: Mapping[str, Expr], message: str) -> Motion:
        return motion_of(self.model, self.parameters, self.instants, self.events, outcome, message, asked)
