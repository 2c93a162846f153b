"""Why a motion ended early: what the integrator found, and the likely cause in the model."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.consistent_position import listed_values
from symbody.simulation.constraint.dependent_constraints import (
    NEAR,
    dependent_constraints,
    described_dependence,
)
from symbody.simulation.model.model import Model
from symbody.simulation.model.undefined_force import undefined_force
from symbody.symbolic import t as time

from .integrated import Integrated
from .methods import DEFAULT, methods_that
from .outcome import Failure, FailureKind, Outcome
from .task import Task

__all__ = ["diagnosis"]

Array = NDArray[np.float64]


def diagnosis(motion: Integrated) -> str:
    """Return what happened to a motion that failed, when, and the way out, in the names of the model."""
    model, outcome = motion.task.model, motion.outcome
    failure = outcome.failure
    assert failure is not None, "only motions that failed have a diagnosis"
    parameters = np.array([motion.parameters[name] for name in (*model.parameters, *model.damping)])
    if failure.kind is FailureKind.CONTRADICTION:
        return failure.message.removeprefix("simulate: ")
    if failure.kind is FailureKind.EXPLAINED:
        return _explained(failure, outcome, model, parameters)
    t, state = outcome.end[0], np.array(outcome.end[1][: len(model.state)])
    when = f"at t = {t:.9g} s"
    singular = _singular(model, parameters, t, state)
    if singular:
        return f"{when}: {singular}"
    if failure.kind is FailureKind.NOT_FINITE:
        return f"{when}: {_out_of_domain(model, parameters, t, state)}"
    near = _BY_CONSTRAINTS.get(failure.kind, 0.0)
    dependent = _dependent(model, parameters, t, state, near) if near else ""
    return f"{when}: {_failure_and_cause(failure, dependent or _possible_cause(failure.kind, motion.task))}"


def _failure_and_cause(failure: Failure, cause: str) -> str:
    if failure.kind in _BY_CONSTRAINTS:
        return f"{failure.message}; {cause}"
    return f"the method gave up ({failure.message}); {cause}"


def _possible_cause(kind: FailureKind, task: Task) -> str:
    """Return the likely cause of a failure that the constraints did not cause, and the way out."""
    stiff = "; for stiff equations use method='bdf'" if task.method.is_explicit else ""
    if kind is FailureKind.PROJECTION:
        return (
            "the constraints can't be satisfied beyond this position, or it is singular; look at the motion up to "
            "there; smaller tolerances or constraints='baumgarte' may pass it"
        )
    if kind is FailureKind.STALLED:
        return (
            "a force may jump back and forth, such as dry friction by sign(v): smooth it, for example by "
            f"tanh(v/v0), or end the motion by an event{stiff}"
        )
    if kind is FailureKind.STEP_COLLAPSE:
        held = "the constraints may allow no further motion, " if task.model.constraints else ""
        return (
            f"{held}the motion may go to infinity there, or a force jumps: smooth it, or end the motion by an "
            f"event{stiff}"
        )
    return (
        "use other tolerances"
        if task.options.method == DEFAULT
        else f"use method={DEFAULT!r}, or other tolerances"
    )


def _explained(failure: Failure, outcome: Outcome, model: Model, parameters: Array) -> str:
    """Return the message of the method, and which constraints are dependent at the end of its last step."""
    message = failure.message.removeprefix("simulate: ")
    t, state = outcome.end
    known = outcome.trail[np.isfinite(outcome.trail).all(axis=1)]
    if len(known):
        t, *state = known[-1]
    dependent = _dependent(
        model, parameters, t, np.array(state)[: len(model.state)], _BY_CONSTRAINTS[failure.kind]
    )
    return f"{message.partition('; expected')[0]}; {dependent}" if dependent else message


_BY_CONSTRAINTS = {
    FailureKind.PROJECTION: NEAR,
    FailureKind.STALLED: NEAR,
    FailureKind.STEP_COLLAPSE: NEAR,
    FailureKind.SINGULAR: 0.3,
    FailureKind.EXPLAINED: 0.1,
}
"""The kinds of failure that dependent constraints cause, and how close to singular the state may be.

A method that finds no step past a singular position stops one step before it."""


def _dependent(model: Model, parameters: Array, t: float, state: Array, near: float) -> str:
    """Return which constraints are dependent at a state, and what to do about it.

    Args:
        model: the model.
        parameters: the values of its parameters, then those of Baumgarte's stabilisation if it is used.
        t: the time, in s.
        state: coordinates and speeds, shape (n_q + n,).
        near: the ratio of singular values below which constraints are nearly dependent.
    """
    found = described_dependence(dependent_constraints(model, parameters, t, state, near))
    keep_branch = " or ".join(methods_that(lambda method: method.keeps_branch))
    return found and (
        f"{found}: the motion is at or near a singular position, from which several motions may continue; "
        f"method={keep_branch} with constraints='projection' passes most such positions; or start from another "
        "state, change the dimensions, or end the motion by an event before it; leave out constraints that depend on "
        "each other wherever the mechanism moves"
    )


def _out_of_domain(model: Model, parameters: Array, t: float, state: Array) -> str:
    names = _not_finite(model, parameters, t, state)
    if names:
        variables = (*model.parameters, *model.damping, time, *model.state)
        known = dict(zip(variables, [*parameters, t, *state], strict=True))
        cause = undefined_force(model.system, model.inputs, known) or (
            "look for a division by zero, a root or logarithm of a negative value, or parameters that make no sense"
        )
        return f"{names} not finite there, at {listed_values(model.coordinates, known)}; {cause}"
    return (
        "a rate of the state is not finite after the next step, however short that is; look for a function that "
        "leaves its domain"
    )


def _not_finite(model: Model, parameters: Array, t: float, state: Array) -> str:
    """Return which rates are not finite at a state."""
    values = model.rates_code.evaluate(
        parameters, np.concatenate([[t], state, np.zeros(model.width - len(model.state))])
    )
    names = [
        *(f"the rate of {q}" for q in model.coordinates),
        *map(str, model.accelerations),
        *map(str, model.equations.state_rates),
        "the power",
    ]
    bad = [name for name, value in zip(names, values, strict=False) if not np.isfinite(value)]
    return "" if not bad else f"{', '.join(bad[:4])}{' and others' if len(bad) > 4 else ''} {_are(bad)}"


def _are(names: list[str]) -> str:
    return "is" if len(names) == 1 else "are"


def _singular(model: Model, parameters: Array, t: float, state: Array) -> str:
    """Return which speeds move no mass at a state, if the mass matrix is singular there."""
    if model.constraints:
        return ""
    n = len(model.speeds)
    code = model.code(model.with_inputs(model.equations.mass_matrix.entries))
    M = code.evaluate(
        parameters, np.concatenate([[t], state, np.zeros(model.width - len(model.state))])
    ).reshape(n, n)
    if not np.isfinite(M).all():
        return ""
    scale = np.sqrt(np.maximum(np.abs(np.diag(M)), np.finfo(float).tiny))
    _, sizes, directions = np.linalg.svd(M / np.outer(scale, scale))
    if sizes[-1] > 1e-13 * sizes[0]:
        return ""
    weights = np.abs(directions[-1])
    names = [str(u) for u, weight in zip(model.speeds, weights, strict=True) if weight > 0.1 * weights.max()]
    together = names[0] if len(names) == 1 else f"a combination of {', '.join(names)}"
    return (
        f"the mass matrix is singular: {together} moves no mass; give it some, or leave that coordinate out; or the "
        "position is singular, which happens with Euler angles but not with floating_frame()"
    )
