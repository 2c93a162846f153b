"""What keeps a position from being one of rest: kinematics that move at zero speeds, and forces without values."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ModelError, SimulationError
from symbody.multibody import System
from symbody.simulation.constraint.consistent_position import listed_values
from symbody.simulation.model.undefined_force import undefined_force
from symbody.symbolic import number, substitute, time_derivative
from symbody.symbolic import t as time
from symbody.symbolic.given.arguments import brief

from .force_balance import Balance
from .steady_conditions import SteadyConditions

__all__ = ["check_finite", "check_kinematics"]

Array = NDArray[np.float64]

_WHERE = "equilibrium"


def check_kinematics(conditions: SteadyConditions) -> None:
    """Check that no coordinate moves at zero speeds, as ``x' = y - x`` in kinematics: that would be no rest.

    Raises:
        ModelError: a rate of a coordinate that the user wrote depends on positions or states at zero speeds.
    """
    system = conditions.equations.system
    if not isinstance(system, System):
        return
    written = {*system.chosen, *(q for q in system.coordinates if time_derivative(q) in system.eliminated)}
    at_rest = dict.fromkeys(system.speeds, number(0))
    for q in (q for q in system.coordinates if q in written):
        (drift,) = substitute([system.kinematics[time_derivative(q)]], at_rest)
        if not drift.free_symbols.isdisjoint(conditions.positions):
            raise ModelError(
                f"{_WHERE}: the kinematics move {q} at zero speeds, {time_derivative(q)} = {brief(drift)}, and don't "
                "tell which force holds it; expected a constraint instead: "
                f"constraints=[time_derivative({q}) - ({brief(drift)})]"
            )


def check_finite(problem: Balance, solution: tuple[Array, Array]) -> None:
    """Check that the equations have derivatives at an equilibrium.

    Raises:
        SimulationError: they have none, as at the end of a damper whose direction is not determined.
    """
    q, forces = solution
    is_rounded = np.abs(q) <= _ROUNDED * max(1.0, np.abs(q).max())
    near = np.where(is_rounded, 0.0, q)  # where a search ends beside the place
    if problem.is_finite(q, forces) and problem.is_finite(near, forces):
        return
    q = near
    eqs, conditions = problem.equations, problem.conditions
    place = dict(zip(conditions.positions, q, strict=True))
    known = dict(zip(conditions.parameters, problem.p, strict=True)) | {time: problem.t} | place
    cause = undefined_force(eqs.system, conditions.given, known | dict.fromkeys(eqs.speeds, 0.0))
    raise SimulationError(
        f"{_WHERE}: the equations of motion are not finite at rest at "
        f"{listed_values(conditions.positions, place)}, nor are those of small motions; {cause or _STRANGE}"
    )


_ROUNDED = 1e-12
_STRANGE = "look for a division by zero, or for a root that vanishes there"
