"""Whether cases give a task what it needs; seen before anything is run."""

from __future__ import annotations

from symbody.simulation.given.values import check_parameters, check_state_names
from symbody.simulation.integrate.task import Task

from .cases import PLACE, Cases


def check_cases(task: Task, cases: Cases) -> None:
    """See that parameters have values, and that initial values belong to something.

    Raises:
        ParameterError: a parameter without a value, or a value without a coordinate or speed.
    """
    check_parameters(task.parameters, cases.parameters, PLACE)
    check_state_names(task.model.system, cases.initial, f"{PLACE}, initial")
