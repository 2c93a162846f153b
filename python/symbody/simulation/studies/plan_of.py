"""The plan of a study, from what is asked of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from numpy.typing import ArrayLike

from symbody.dynamics import Equations
from symbody.simulation.batch.case_check import check_cases
from symbody.simulation.batch.cases import Cases
from symbody.simulation.device.devices import on_device
from symbody.simulation.integrate.outputs_and_events import check_observed
from symbody.simulation.integrate.task_of import task_of, warn_of_odd_parameters

from .asked import Asked
from .integrals import with_integrals
from .plan import PLACE, Plan, all_events, study_instants

__all__ = ["plan_of"]


def plan_of(
    eqs: Equations,
    cases: Cases,
    t: ArrayLike,
    asked: Asked,
    device: str | None,
    options: Mapping[str, Any],
) -> Plan:
    """Return the plan of a study, which is checked against its cases.

    Args:
        eqs: the equations of motion.
        cases: the cases.
        t: the instants.
        asked: what is computed.
        device: the device that integrates, if it is one.
        options: further arguments of `task_of`.

    Raises:
        SymbodyError: what is asked for does not fit the model, or a value is missing.
    """
    named, outputs = asked.measures, asked.outputs
    integrands = {name: each.integrand for name, each in named.items() if each.integrand is not None}
    extended, states = with_integrals(eqs, [*integrands.values()])
    events = all_events(asked.events, named)
    task = task_of(extended, cases.parameters, t, outputs=None, events=events, where=PLACE, **options)
    task = replace(task, instants=study_instants(t, named, has_outputs=bool(outputs)))
    task = on_device(task, device, PLACE)
    integrals = dict(zip(integrands, states, strict=True))
    plan = Plan(task, named, integrals, outputs, asked.statistics, asked.histories, len(asked.events))
    measured = {name: measure.expression for name, measure in named.items()}
    check_observed(task.model, outputs, task.events, PLACE, measured)
    check_cases(plan.with_names, cases, PLACE)
    warn_of_odd_parameters(plan.with_names, cases.parameters, PLACE)
    return plan
