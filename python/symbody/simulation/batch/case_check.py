"""Whether the cases have all the values that a task needs; checked before anything is run."""

from __future__ import annotations

from symbody.simulation.given.values import check_parameters, check_state_names
from symbody.simulation.integrate.task import Task

from .cases import PLACE, Cases


def check_cases(task: Task, cases: Cases, place: str = PLACE) -> None:
    """Check that parameters have values, and that the keys of initial values are known.

    Raises:
        ParameterError: a parameter has no value, or a key is neither a coordinate, a rate of one nor a speed.
    """
    check_parameters(task.parameters, cases.parameters, place, task.model.system.state_names)
    check_state_names(task.model.system, cases.initial, f"{place}, initial")
