"""The interface to the native integrator: compiled functions, by their addresses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode
from symbody.simulation.given.event import Event
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr
from symbody.symbolic._core import Dynamics

from .observed import parameters_in

__all__ = ["Problem"]


@dataclass(frozen=True, eq=False)
class Problem:
    """The compiled functions of an integration.

    Attributes:
        width: the length of the integrated vector.
        controlled: the number of its entries that enter the error estimate.
        rates: the rates of the vector.
        jacobian: their nonzero derivatives, with rows and columns; for implicit methods.
        corrections: the corrections of coordinates and of speeds onto the constraints; None without projection.
        energies: the kinetic and the potential energy; None where their sum is not constant.
        events: the functions whose zeros are events, and the events.
        trail: the most states at the ends of steps that are kept for each motion; of longer motions, every second or
            fourth state is kept, and so on.
    """

    width: int
    controlled: int
    rates: PreparedCode
    jacobian: tuple[PreparedCode, list[tuple[int, int]]] | None = None
    corrections: tuple[PreparedCode, PreparedCode] | None = None
    energies: PreparedCode | None = None
    events: tuple[PreparedCode, tuple[Event, ...]] | None = None
    trail: int = 0

    @classmethod
    def of(
        cls,
        model: Model,
        *,
        is_projected: bool,
        needs_jacobian: bool = False,
        events: Sequence[Event] = (),
        trail: int = 0,
    ) -> Problem:
        """Return the problem of a model. Its functions are derived here, and compiled when `native` is read.

        Args:
            model: the model.
            is_projected: whether states are projected onto the constraints after each step.
            needs_jacobian: whether the method is implicit.
            events: the events to watch.
            trail: the most states at the ends of steps that are kept.
        """
        watched = model.along_motion([event.expression for event in events])
        others = [name for name in parameters_in(watched) if name not in (*model.parameters, *model.damping)]
        code = model.code(watched, others) if events else None
        return cls(
            width=model.width,
            controlled=len(model.state),
            rates=model.rates_code,
            jacobian=model.jacobian_code if needs_jacobian else None,
            corrections=model.correction_codes if is_projected and model.constraints else None,
            energies=model.energies_code,
            events=None if code is None else (code, tuple(events)),
            trail=trail,
        )

    @property
    def codes(self) -> list[PreparedCode]:
        """All functions, in the order of their constants."""
        jacobian = [] if self.jacobian is None else [self.jacobian[0]]
        events = [] if self.events is None else [self.events[0]]
        energies = [] if self.energies is None else [self.energies]
        return [self.rates, *jacobian, *(self.corrections or ()), *energies, *events]

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values: the parameters of the rates, then those that only events contain."""
        return self.codes[-1].parameters

    def constants(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the constants of all functions for given parameters, one after another."""
        return np.concatenate([code.prepare(parameters[: len(code.parameters)]) for code in self.codes])

    @cached_property
    def native(self) -> Dynamics:
        """The functions, by their addresses."""
        positions, velocities = self.corrections or (None, None)
        return Dynamics(
            _code(self.rates),
            None if self.jacobian is None else (_code(self.jacobian[0]), self.jacobian[1]),
            None if positions is None else _code(positions),
            None if velocities is None else _code(velocities),
            None if self.energies is None else _code(self.energies),
            None
            if self.events is None
            else (_code(self.events[0]), [(event.direction, event.terminal) for event in self.events[1]]),
        )


def _code(code: PreparedCode) -> tuple[int, int, int]:
    return code.address, code.constants, len(code.expressions)
