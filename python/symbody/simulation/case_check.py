"""Whether cases give a model what it needs; seen before anything is run."""

from __future__ import annotations

from .asked import check_known_along, parameters_in
from .batch import Batch
from .cases import PLACE, Cases
from .values import check_parameters, check_state_names


def check_cases(batch: Batch, cases: Cases) -> None:
    """See that parameters have values, that initial values belong to something, and that outputs and events are known.

    Raises:
        ParameterError: a parameter without a value, or a value without a coordinate or speed.
        SimulationError: an output or an event of what no motion knows.
    """
    check_known_along(batch.model, batch.outputs, batch.events, PLACE)
    asked = [*batch.outputs.values(), *(event.expression for event in batch.events)]
    check_parameters((*batch.model.parameters, *parameters_in(asked)), cases.parameters, PLACE)
    check_state_names(batch.model.system, cases.initial, f"{PLACE}, initial")
