"""The accelerations along a motion, by the machine code that integrated it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model
from symbody.symbolic import Expr
from symbody.symbolic.numeric.deficiency import noting, report

__all__ = ["accelerations_along"]

Array = NDArray[np.float64]


def accelerations_along(model: Model, parameters: Mapping[Expr, float], t: Array, states: Array) -> Array:
    """Return the rates of the speeds, one row for each instant.

    Args:
        model: the model.
        parameters: the values of its parameters, by name.
        t: the instants, shape (N,).
        states: coordinates, then speeds, shape (N, n).
    """
    code, first = model.rates_code, len(model.coordinates)
    rows = np.zeros((len(t), len(model.code_variables)))
    rows[:, 0], rows[:, 1 : 1 + states.shape[1]] = t, states
    with noting() as found:
        rates = code.evaluate_rows(np.array([parameters[name] for name in code.parameters]), rows)
    report(found, model.equation_names, "motion", together=model.equations_together)
    return rates[:, first : first + len(model.speeds)]
