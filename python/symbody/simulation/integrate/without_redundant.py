"""A task without the constraints that are redundant where its mechanism moves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics.equations.leaving_out import leaving_out
from symbody.dynamics.formalism.self_stress import borne
from symbody.simulation.constraint.overconstraint import overconstraint
from symbody.simulation.model.model import with_equations
from symbody.symbolic import Expr

from .kinematics_at import kinematics_at
from .task import Task

__all__ = ["without_redundant"]


def without_redundant(
    task: Task, parameters: Mapping[Expr, float], state: NDArray[np.float64], known: Iterable[Task] = ()
) -> Task:
    """Return the task in which overconstrained mechanisms move: the best choice of redundant constraints is left out.

    Args:
        task: the task.
        parameters: the values of the parameters.
        state: an initial state, shape (model.width,).
        known: the same tasks of other cases.

    Raises:
        ConstraintError: the constraints leave no motion, or only at this position.
    """
    model = task.unstabilized
    if not model.constraints:
        return task
    kinematics, p = kinematics_at(model, parameters, state)
    q, t = state[: len(model.coordinates)], float(task.instants[0])
    others = {each.redundancy: each for each in known if each.redundancy is not None}
    found = overconstraint(kinematics, p, t, q, others)
    if found is None or found in others:
        return task if found is None else others[found]
    reduced = leaving_out(model.equations, found.choice, borne)
    return replace(task, model=with_equations(task.model, reduced), redundancy=found)
