"""What is told where no equilibrium is found, or where it is not isolated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.kinematics import kinematics_of
from symbody.symbolic.given.wording import joined_by_and

from .force_balance import Balance

Array = NDArray[np.float64]

_NEARLY = 1e-2
"""The ratio of singular values up to which constraints nearly depend on each other."""


def unbalanced(problem: Balance, q: Array, forces: Array, where: str) -> str:
    """Return what to tell where no equilibrium was found.

    Args:
        problem: the balance of forces.
        q: the positions at which the forces balance best.
        forces: the forces of constraints and those that hold coordinates there.
        where: the function that the user called.
    """
    eqs = problem.equations
    F, _, _ = problem.values(q, forces)
    error = np.abs(F / problem.scale(q, forces))
    worst = int(np.argmax(np.where(np.isfinite(error), error, np.inf)))
    name = problem.conditions.names[worst]
    place = ", ".join(
        f"{q_k} = {value:.6g}" for q_k, value in zip(problem.conditions.positions[:12], q, strict=False)
    )
    return (
        f"{where}: none was found; nearest, at {place}: {name} is off by {F[worst]:.3g}; expected loads that "
        "can balance: give a guess nearer to the equilibrium, or hold coordinates that no load holds, "
        f"such as fixed={{{eqs.coordinates[0]}: ...}}{_across(problem, q)}"
    )


def _across(problem: Balance, q: Array) -> str:
    """Return that no finite forces balance a load, if constraints nearly depend on each other at a position."""
    kinematics = kinematics_of(problem.equations, dict(problem.conditions.given))
    m, n = len(kinematics.constraints), len(problem.equations.coordinates)
    if not m or kinematics.has_states:
        return ""
    values = dict(zip(problem.conditions.parameters, problem.p, strict=True))
    p = np.array([values[name] for name in kinematics.parameters])
    with np.errstate(all="ignore"):
        velocity, *_ = kinematics.velocity(problem.t, q[:n], p)
    A = velocity[:m]  # as it is: a gradient that nearly vanishes is told too
    if not np.isfinite(A).all():
        return ""
    s = np.linalg.svd(A, compute_uv=False)
    if kinematics.rank > len(s) or s[kinematics.rank - 1] > _NEARLY * s[0]:
        return ""
    return (
        ". The constraints nearly depend on each other there, so that no finite forces of theirs balance a load in "
        "that direction, as one across a straight chain of bars"
    )


def not_isolated(problem: Balance, q: Array, direction: Array, where: str) -> str:
    """Return what to tell of an equilibrium beside which there are others.

    Args:
        problem: the balance of forces.
        q: the positions of the equilibrium.
        direction: towards another one, by position.
        where: the function that the user called.
    """
    names = problem.conditions.positions
    size = np.abs(direction)
    moved = [name for name, share in zip(names, size, strict=True) if share > 1e-3 * size.max()]
    freest = int(np.argmax(size))
    if names[freest] in problem.equations.states:
        open_states = [names[k] for k in _open_states(problem, q)] or [names[freest]]
        is_one = len(open_states) == 1
        fixed = ", ".join(f"{state}: {round(q[names.index(state)], 9) + 0.0:.6g}" for state in open_states)
        return (
            f"{where}: the equilibrium is not isolated: the state{'' if is_one else 's'} "
            f"{joined_by_and([*map(str, open_states)])} can have other values, as neither the loads nor the rates of "
            f"states determine {'it' if is_one else 'them'}, as of a tyre at rest; fix {'it' if is_one else 'them'}, "
            f"such as fixed={{{fixed}}}, leave {'it' if is_one else 'them'} out of the states, or let "
            f"{'its rate' if is_one else 'their rates'} depend on {'it' if is_one else 'them'}"
        )
    together = f"{moved[0]} can" if len(moved) == 1 else f"{', '.join(map(str, moved))} can together"
    return (
        f"{where}: the equilibrium is not isolated: {together} be changed without a force; fix a coordinate, "
        f"such as fixed={{{names[freest]}: {q[freest]:.6g}}}"
    )


def _open_states(problem: Balance, q: Array) -> list[int]:
    """Return the places of the states that have no effect on their rates at rest, and none of others has either."""
    n = len(problem.equations.coordinates)
    _, slopes, _ = problem.values(q, np.zeros(problem.count))
    of_rates = slopes[len(slopes) - len(problem.equations.states) :, n : len(q)]
    is_open = ~of_rates.any(axis=1) & ~of_rates.any(axis=0)
    fixed = {*problem.fixed}
    return [n + int(k) for k in np.flatnonzero(is_open) if problem.conditions.positions[n + k] not in fixed]
