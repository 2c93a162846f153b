"""Simulation: from equations of motion to a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import SimulationError, notify
from symbody.simulation.given.event import Event
from symbody.simulation.given.values import parameter_values
from symbody.simulation.integrate.diagnosis import diagnosis
from symbody.simulation.integrate.initial_state import initial_slopes, initial_state
from symbody.simulation.integrate.integrated import Integrated, run_motions
from symbody.simulation.integrate.notices import findings_of, notices_of_motion
from symbody.simulation.integrate.outcome import FailureKind, with_deficiencies
from symbody.simulation.integrate.stopped_start import stopped_start
from symbody.simulation.integrate.task import Task
from symbody.simulation.integrate.task_of import task_of, warn_of_odd_parameters
from symbody.simulation.integrate.with_sensitivities import beside_sensitivities
from symbody.simulation.integrate.without_redundant import without_redundant
from symbody.simulation.terminal.interruption import Interruption
from symbody.simulation.terminal.progress import preparation_bar, progress_bar
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.numeric.deficiency import noting

from .motion import Motion
from .motion_of import motion_of

__all__ = ["simulate"]

Array = NDArray[np.float64]


@with_known_names
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
    sensitivities: Sequence[Expr] | None = None,
    progress: bool | None = None,
) -> Motion:
    """Return the motion of a system from an initial state: ``M u' = forcing + phi_q^T lambda, phi = 0``.

    Compiled code evaluates and integrates the equations. After Ctrl-C, the motion up to there is returned.

    Args:
        eqs: the equations of motion.
        parameters: values of the parameters, including those that only events and outputs contain. Parameters that
            appear nowhere in the model cause a notice.
        initial: values of coordinates, rates of coordinates, speeds or states at the first instant. Variables that are
            not named are zero, or what the constraints demand: they change as little as possible.
        t: the first and the last instant (1001 evenly spaced instants), or all instants, in s.
        inputs: expressions of time, state and parameters for the input functions of time.
        method: "auto" and "dop853", the explicit Runge-Kutta method of order 8 [Hairer, Norsett & Wanner 1993];
            "tsit5", of order 5; "bdf", "esdirk34" and "tr_bdf2" for stiff equations; "ida" (stabilised index 2),
            "ida2" and "ida3" for constraints without index reduction, by SUNDIALS.
        rtol: the tolerance of the error of a step, relative to the state.
        atol: the absolute tolerance of the error of a step.
        outputs: expressions to evaluate at all instants, by name.
        events: the events to watch; a terminal one ends the motion.
        constraints: how constraints are enforced. "projection" projects onto the constraints and their rates after
            each step [Eich 1993]; "baumgarte" or its (omega, zeta) damps violations; "free" does neither. The methods
            of IDA enforce constraints by themselves.
        guess: where to look for an initial state that satisfies the constraints, for variables that are not given.
        max_step: the longest step, in s.
        sensitivities: parameters, and coordinates, speeds and states for their initial values, by which the motion is
            differentiated; `Motion.sensitivity` has the derivatives.
        progress: whether to show progress bars: of the derivation and compilation after two seconds, and of the
            integration. By default, they are shown if messages go to a terminal.

    Raises:
        ParameterError: a value is missing, has an unknown key, or is not finite.
        ConstraintError: no state with the given values satisfies the constraints.
        ModelError: an input has no expression, or an expression is given for something that is not an input.
        SimulationError: a joint begins at its limit, or beyond it, and moves outwards, though `stops` are among the
            events; or the motion cannot continue: the error's `motion` holds what was computed.

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
    task = task_of(
        eqs,
        parameters,
        t,
        inputs=inputs,
        method=method,
        rtol=rtol,
        atol=atol,
        outputs=outputs,
        events=events,
        constraints=constraints,
        guess=guess,
        max_step=max_step,
        sensitivities=sensitivities,
    )
    parameter_values(task.parameters, parameters, beside=task.model.system.state_names)
    given = {name: float(value) for name, value in (parameters or {}).items()}
    warn_of_odd_parameters(task, given)
    with preparation_bar(is_shown=progress), noting() as met:
        state = initial_state(task, given, initial)
        slopes = initial_slopes(task, given, initial, state) if task.by else None
        task = without_redundant(task, given, state)
        if forbidden := stopped_start(task, given, state):
            raise SimulationError(forbidden)
        if slopes is not None and task.variation is not None:
            state = beside_sensitivities(state, slopes, task.variation, given)
        _ = task.integrate  # compiled now: Ctrl-C interrupts, as there is no motion yet to keep
    motion = _run_one(task, given, state, is_shown=progress)
    return _report(replace(motion, outcome=with_deficiencies(motion.outcome, met)))


def _run_one(
    task: Task, parameters: Mapping[Expr, float], state: Array, *, is_shown: bool | None
) -> Integrated:
    """Integrate one motion. Ctrl-C ends it between two steps."""
    columns = {name: np.array([value]) for name, value in parameters.items()}
    span = float(np.ptp(task.instants))
    with Interruption() as interruption, progress_bar("simulate", span, is_shown=is_shown) as show:

        def keep_going(done: float) -> bool:
            show(done * span)
            return not interruption.is_asked_for

        (motion,) = run_motions(task, columns, state[np.newaxis], 1, keep_going)
        assert motion is not None, "the only motion is begun"
        if not interruption.is_asked_for:
            show(motion.outcome.end[0] - float(task.instants[0]))
    return motion


def _report(motion: Integrated) -> Motion:
    """Return the motion, and warn of what its user should know; if it failed, raise an error that holds it."""
    failure = motion.outcome.failure
    with noting():  # what the motion met is among the findings
        findings = findings_of(motion)
    for notice in notices_of_motion(findings):
        notify(notice)
    if failure is None:
        return motion_of(motion, "the last instant was reached")
    if failure.kind is FailureKind.INTERRUPTED:
        kept = motion_of(motion, f"interrupted at t = {motion.outcome.end[0]:.6g} s")
        notify(f"simulate: {kept.message}; what was computed is kept")
        return kept
    message = f"simulate: {diagnosis(motion)}; what was computed is the error's motion"
    raise SimulationError(message, motion_of(motion, message))
