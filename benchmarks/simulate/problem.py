"""Problems: equations of motion with numbers, from an initial state to an instant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody import Equations, Expr
from symbody.models import ClassicSystem
from symbody.simulation.given.values import parameter_values
from symbody.simulation.model.model import Model, model_of

Array = NDArray[np.float64]


def first_state(classic: ClassicSystem) -> dict[Expr, float]:
    """Return all coordinates and speeds at the first instant, for integrators that don't close loops themselves."""
    at_rest = dict.fromkeys(classic.system.speeds, 0.0)
    return {**at_rest, **classic.guess, **classic.initial}


@dataclass(frozen=True, eq=False)
class Problem:
    """A motion to compute.

    Attributes:
        name: what the report calls it.
        equations: its equations of motion; nothing in them depends on time.
        parameters: the numbers of its parameters.
        initial: where it begins.
        duration: how long it lasts, in s.
        published: coordinates at the end, where they were published.
    """

    name: str
    equations: Equations
    parameters: Mapping[Expr, float]
    initial: Mapping[Expr, float]
    duration: float
    published: tuple[float, ...] | None = None

    @property
    def model(self) -> Model:
        """The functions that are integrated: what `simulate` itself takes."""
        return model_of(self.equations)

    @cached_property
    def values(self) -> Array:
        """The numbers, in the order of the model's parameters."""
        return parameter_values(self.model.parameters, self.parameters)

    @cached_property
    def start(self) -> Array:
        """The state at the first instant."""
        return np.array([self.initial[name] for name in self.model.state], dtype=float)

    @property
    def size(self) -> int:
        """The number of coordinates."""
        return len(self.equations.coordinates)

    @property
    def durations(self) -> tuple[float, ...]:
        """Where errors are looked at: at one instant alone an error may cross zero. The last one is the whole."""
        return tuple(part * self.duration for part in (0.9, 0.95, 1.0))


def instants(duration: float) -> Array:
    """Return the first instant and the last one."""
    return np.array([0.0, duration])
