"""A task from the arguments of a user; all errors are raised before anything is run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from numpy.typing import ArrayLike

from symbody.dynamics import Equations
from symbody.simulation.given.differentiated import differentiated_by
from symbody.simulation.given.event import Event
from symbody.simulation.given.odd_values import warn_of_odd_values
from symbody.simulation.given.options import Options, check_options, constraint_handling, instants_of
from symbody.simulation.given.values import given_inputs, state_values, zero_parameters
from symbody.simulation.model.model import model_of
from symbody.symbolic import Expr, ExprLike

from .methods import METHODS, check_abilities, method_name
from .outputs_and_events import check_observed, given_events, given_outputs
from .task import Task

__all__ = ["task_of", "warn_of_odd_parameters"]


def task_of(
    eqs: Equations,
    parameters: Mapping[Expr, ArrayLike] | None,
    t: tuple[float, float] | ArrayLike,
    *,
    inputs: Mapping[Expr, ExprLike] | None,
    method: str,
    rtol: float,
    atol: float,
    outputs: Mapping[str, ExprLike] | None,
    events: Sequence[Event] | None,
    constraints: str | tuple[float, float],
    guess: Mapping[Expr, float] | None,
    max_step: float,
    sensitivities: Sequence[Expr] | None = None,
    keeps_states: bool = True,
    where: str = "simulate",
) -> Task:
    """Return a task. The arguments are those of `simulate`.

    Args:
        eqs: the equations of motion.
        parameters: the values of the parameters; zeros influence how the accelerations are solved for.
        t: the instants, or the first and the last of 1001.
        inputs: the expressions that replace input functions of time.
        method: the method by name.
        rtol: the relative tolerance.
        atol: the absolute tolerance.
        outputs: expressions to evaluate, by name.
        events: the events to watch.
        constraints: how constraints are enforced.
        guess: where to look for initial states.
        max_step: the longest step, in s.
        sensitivities: the parameters and initial values by which the state is differentiated.
        keeps_states: whether the states of many motions are results.
        where: the function that the user called, for messages.

    Raises:
        ArgumentError: an argument has the wrong type.
        ModelError: an input has no expression, or an expression is given for something that is not an input.
        ParameterError: a key of the guess is neither a coordinate nor a speed.
        SimulationError: an option is unknown, the method cannot do what is asked for, or an output or event contains a
            variable without values.
    """
    instants, name = instants_of(t, where), method_name(method, where)
    check_options(rtol, atol, max_step, where)
    kept = constraint_handling(constraints, where)
    named_outputs, watched = given_outputs(outputs, where), given_events(events, where)
    formulas = given_inputs(eqs, inputs, where=where, parameters=parameters)
    check_abilities(
        name,
        has_events=bool(watched),
        is_projected=bool(eqs.constraints) and kept == "projection",
        has_sensitivities=bool(sensitivities),
        where=where,
    )
    is_damped = bool(eqs.constraints) and kept not in {"projection", "free"}
    task = Task(
        model=model_of(eqs, formulas, is_stabilized=is_damped, zeros=zero_parameters(parameters)),
        instants=instants,
        options=Options(name, rtol, atol, max_step),
        method=METHODS[name],
        constraints=kept,
        outputs=named_outputs,
        events=watched,
        guess=state_values(eqs.system, guess, where=where, argument="guess"),
        keeps_states=keeps_states,
    )
    check_observed(task.model, named_outputs, watched, where)
    by = differentiated_by(sensitivities, eqs.system, task.parameters, f"{where}, sensitivities")
    return replace(task, by=by) if by else task


def warn_of_odd_parameters(task: Task, parameters: Mapping[Expr, ArrayLike], where: str = "simulate") -> None:
    """Warn of values of parameters that a task does not use, or that make no sense in its model.

    Args:
        task: the task.
        parameters: the values of the parameters.
        where: the function that the user called, for messages.
    """
    wanted = [*task.observed, *dict(task.model.inputs).values()]
    warn_of_odd_values(task.model.equations, parameters, wanted, where)
