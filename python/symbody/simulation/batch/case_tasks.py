"""The tasks of cases: where its mechanism is overconstrained, a case moves without the redundant constraints."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.integrate.notices import OVERCONSTRAINED
from symbody.simulation.integrate.task import Task
from symbody.simulation.integrate.without_redundant import without_redundant
from symbody.symbolic import Expr

from .case_arrays import Results
from .cases import Cases

__all__ = ["Reduced", "case_tasks", "own_task"]

Reduced = dict[tuple[int, ...], Task]
"""The tasks without some constraints, by the places of these."""


def own_task(
    task: Task, parameters: Mapping[Expr, float], state: NDArray[np.float64], reduced: Reduced
) -> Task:
    """Return the task of one case; cases without the same constraints have the same one.

    Args:
        task: what the cases share.
        parameters: the values of the parameters of the case.
        state: its initial state.
        reduced: the tasks of other cases, to which a new one is added.

    Raises:
        ConstraintError: the constraints leave no motion, or only at this position.
    """
    own = without_redundant(task, parameters, state, reduced.values())
    return task if own.redundancy is None else reduced.setdefault(own.redundancy.choice, own)


def case_tasks(task: Task, cases: Cases, results: Results) -> list[Task]:
    """Return the task of each case that was run: its findings tell whether constraints were left out.

    Args:
        task: what the cases share.
        cases: the cases.
        results: their results, with the states.
    """
    tasks, reduced = [task] * cases.count, Reduced()
    for case, findings in enumerate(results.findings):
        if results.reached[case] and any(each.kind == OVERCONSTRAINED for each in findings):
            tasks[case] = own_task(task, cases.parameters_of(case), results.states[case, 0], reduced)
    return tasks
