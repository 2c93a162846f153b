"""Constraints that contradict each other along a motion: whatever was integrated, no motion satisfies them.

Let y be a combination of constraints whose gradients cancel, ``y^T phi_q = 0``. Then ``y^T phi``, ``y^T phi_t`` and
``y^T c``, with ``phi'' = phi_q u' + c``, depend on time alone and must vanish. This holds only if the gradients also
cancel at neighbouring positions, that is, if ``y^T (phi_q w)_q w`` vanishes for all w with ``phi_q w = 0``. At a
singular position it does not: there ``y^T c = 0`` is a condition for the speeds. The linear solver also reports
contradictory right-hand sides at states that were tried and rejected; this file checks the states of the motion
itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.simulation.constraint.consistent_position import Positions, term_sizes
from symbody.simulation.constraint.contradiction import (
    INCONSISTENT,
    cancelling_combinations,
    contradiction_between,
)
from symbody.simulation.constraint.kinematics import Kinematics
from symbody.simulation.constraint.least_norm import least_norm
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr
from symbody.symbolic.numeric.deficiency import Deficiency

from .kinematics_at import kinematics_at
from .massless_speeds import unbalanced_speeds
from .outcome import Failure, FailureKind, Outcome

__all__ = ["contradictory_constraints", "with_contradictions"]

Array = NDArray[np.float64]

LOOKS = 64
"""The number of states of a motion that are checked first."""
_SUSPECT = {
    FailureKind.PROJECTION,
    FailureKind.STALLED,
    FailureKind.STEP_COLLAPSE,
    FailureKind.LIBRARY,
    FailureKind.EXPLAINED,
}
"""The kinds of failure that contradictory equations cause."""


def with_contradictions(
    outcome: Outcome, model: Model, parameters: Mapping[Expr, float], instants: Array
) -> Outcome:
    """Return an outcome that fails if equations contradict each other along the motion.

    These may be constraints, or the equations of speeds that move no mass. If no state of the motion has a
    contradiction, those that the linear solver reported belong to rejected states, where the equations are dependent.
    """
    of_model = {d for d in outcome.deficiencies if d.equations == len(model.equation_names)}
    noted = {d for d in of_model if d.contradictions}
    is_suspect = outcome.failure is not None and outcome.failure.kind in _SUSPECT
    if not model.constraints or not (noted or is_suspect):
        return outcome
    times, states = _instants_and_states(outcome, model, instants)
    span = float(instants[-1] - instants[0]) or 1.0
    contradiction_at = partial(
        _contradiction, model, parameters, span, are_speeds_noted=_holds_speeds(noted, model)
    )
    place = _first(lambda k: bool(contradiction_at(float(times[k]), states[k])), len(times))
    if place is None:
        return replace(outcome, deficiencies=outcome.deficiencies - noted | {_as_dependent(d) for d in noted})
    t = float(times[place])
    reached = max(1, min(place + 1, len(outcome.states)))
    return replace(
        outcome,
        states=outcome.states[:reached],
        occurrences=[event for event in outcome.occurrences if event[1] <= t],
        end=(t, outcome.states[place].tolist() if place < len(outcome.states) else outcome.end[1]),
        failure=Failure(
            FailureKind.CONTRADICTION, t, f"at t = {t:.9g} s: {contradiction_at(t, states[place])}"
        ),
        deficiencies=outcome.deficiencies - of_model,
    )


def _contradiction(
    model: Model,
    parameters: Mapping[Expr, float],
    span: float,
    t: float,
    state: Array,
    *,
    are_speeds_noted: bool,
) -> str:
    """Return which equations contradict each other at a state, and why; the empty text if none do.

    Args:
        model: the model.
        parameters: the values of its parameters.
        span: the duration of the motion, in s.
        t: the time, in s.
        state: coordinates, speeds and states, shape (model.state,).
        are_speeds_noted: whether the linear solver reported equations of speeds.
    """
    kinematics, p = kinematics_at(model, parameters, state)
    mechanical = len(model.coordinates) + len(model.speeds)
    rows = contradictory_constraints(kinematics, p, t, state[:mechanical], span)
    if rows:
        return contradiction_between(model.system.conditions, rows)
    return unbalanced_speeds(model, parameters, t, state) if are_speeds_noted else ""


def _holds_speeds(noted: Iterable[Deficiency], model: Model) -> bool:
    """Return whether equations of speeds, which precede the constraints, are among the contradictory ones."""
    n = len(model.speeds) if len(model.equation_names) > len(model.constraints) else 0
    return any(min((row, *others)) < n for d in noted for row, others in d.contradictions)


def contradictory_constraints(
    kinematics: Kinematics, p: Array, t: float, state: ArrayLike, span: float
) -> tuple[int, ...]:
    """Return the rows of constraints that contradict each other at a state; none if they are compatible.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        state: coordinates and speeds.
        span: the duration of the motion, in s; it weighs violations of rates by the violation of positions they cause.
    """
    m = len(kinematics.constraints)
    q, u = _polished(kinematics, p, t, np.asarray(state, float))
    with np.errstate(all="ignore"):
        phi, phi_q, sizes = kinematics.position(t, q, p)
        A, b = (part[:m] for part in kinematics.velocity(t, q, p))
        c = kinematics.acceleration(t, np.concatenate([q, u]), p)[:m]
    if not all(np.isfinite(part).all() for part in (phi, A, b, c)):
        return ()
    terms, phi = kinematics.among_all(term_sizes(q, phi_q, sizes)), kinematics.among_all(phi)
    for y in _lasting_combinations(kinematics, p, t, q, A):
        allowed = INCONSISTENT * float(np.abs(y) @ terms)
        rates = ((b, span), (c, span**2 / 2))
        if abs(y @ phi) > allowed or any(_is_off(y, rate, factor, allowed) for rate, factor in rates):
            return tuple(int(row) for row in np.flatnonzero(y))
    return ()


def _lasting_combinations(kinematics: Kinematics, p: Array, t: float, q: Array, A: Array) -> list[Array]:
    """Return the combinations of constraints whose gradients cancel at a position and at its neighbours.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        q: the coordinates, shape (n_q,).
        A: the Jacobian of the constraints with respect to the speeds, shape (m, n).
    """
    cancelling = len(cancelling_combinations(A))
    if not cancelling:
        return []
    free = least_norm(A, np.zeros(len(A)))[1]
    draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (cancelling, free.shape[1]))
    bends = [_second_derivative(kinematics, p, t, q, free @ share) for share in draw]
    return cancelling_combinations(np.column_stack([A, *bends]))


def _second_derivative(kinematics: Kinematics, p: Array, t: float, q: Array, w: Array) -> Array:
    """Return ``(phi_q w)_q w``: the part of c that is quadratic in the speeds.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        q: the coordinates, shape (n_q,).
        w: speeds that the constraints allow, shape (n,).
    """
    with np.errstate(all="ignore"):
        forth, back, none = (
            kinematics.acceleration(t, np.concatenate([q, u]), p)[: len(kinematics.constraints)]
            for u in (w, -w, np.zeros_like(w))
        )
    bend: Array = np.nan_to_num((forth + back) / 2 - none, posinf=0.0, neginf=0.0)
    return bend


def _polished(kinematics: Kinematics, p: Array, t: float, state: Array) -> tuple[Array, Array]:
    """Return coordinates and speeds that satisfy the constraints as well as possible; only there is c correct."""
    n, m = len(kinematics.system.coordinates), len(kinematics.constraints)
    problem = Positions.at(kinematics, p, t, state[:n])
    q = problem.solution(state[:n], np.ones(n, dtype=bool))
    if not problem.error(q) <= problem.error(state[:n]):
        q = state[:n]
    with np.errstate(all="ignore"):
        A, b = (part[:m] for part in kinematics.velocity(t, q, p))
    u = state[n:]
    if np.isfinite(A).all() and np.isfinite(b).all():
        u = u - least_norm(A, A @ u + b)[0]
    return q, u


def _is_off(y: Array, rate: Array, factor: float, allowed: float) -> bool:
    """Return whether a combination of rates exceeds rounding, and causes a violation of positions in the end."""
    left = abs(y @ rate)
    return bool(left > INCONSISTENT * np.abs(y) @ np.abs(rate) and left * factor > allowed)


def _instants_and_states(outcome: Outcome, model: Model, instants: Array) -> tuple[Array, Array]:
    """Return the instants and states of a motion, including its end."""
    size, reached = len(model.state), len(outcome.states)
    times, states = instants[:reached], outcome.states[:, :size]
    if outcome.end[0] <= times[-1]:
        return times, states
    return np.append(times, outcome.end[0]), np.vstack([states, outcome.end[1][:size]])


def _first(is_contradictory: Callable[[int], bool], count: int) -> int | None:
    """Return the index of the first contradictory state: some states are checked, then the gap before the first hit."""
    looks = np.unique(np.linspace(0, count - 1, min(LOOKS, count)).astype(int)).tolist()
    found = next((k for k, place in enumerate(looks) if is_contradictory(place)), None)
    if found is None:
        return None
    gap = range(looks[found - 1] + 1 if found else 0, looks[found] + 1)
    return next(place for place in gap if is_contradictory(place))


def _as_dependent(deficiency: Deficiency) -> Deficiency:
    rows = {*deficiency.dependent, *(row for row, _ in deficiency.contradictions)}
    return replace(deficiency, dependent=tuple(sorted(rows)), contradictions=())
