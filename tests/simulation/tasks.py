"""Tasks without outputs and events, for tests of what works on one."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from symbody.simulation.given.options import Options
from symbody.simulation.integrate.methods import METHODS
from symbody.simulation.integrate.task import Task
from symbody.simulation.model.model import Model


def a_task(
    model: Model, method: str = "dop853", constraints: str = "projection", t: ArrayLike = (0.0, 1.0)
) -> Task:
    """Return the task to integrate a model from one instant to another."""
    return Task(model, np.asarray(t, float), Options(method), METHODS[method], constraints, {}, (), {})
