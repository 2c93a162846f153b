"""Driving loads: the solution of the equations of motion for loads, where the motion is known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.errors import ModelError, SimulationError
from symbody.simulation.constraint.least_norm import least_norm_many
from symbody.simulation.constraint.magnitude import MeasuredFunction, measured
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.simulation.given.parameter import parameters_among
from symbody.symbolic import Expr, Matrix, free_symbols, jacobian, number, substitute, t, time_derivative

from .kinematic_analysis import Trajectory
from .limited_drive import limited_drives

__all__ = ["DrivingLoads", "driving_loads"]

Array = NDArray[np.float64]

_UNBALANCED = 1e-7
"""The relative residual up to which an equation of motion counts as balanced."""
_FAINT = 1e-4
"""The ratio to the largest terms that counts, where all terms of an equation are rounding errors."""

_OPEN = 1e-6
"""How much an unknown may move without effect, relative to one that is free, and count as determined."""


@dataclass(frozen=True, eq=False)
class DrivingLoads:
    """The equations of motion as linear equations for loads f and multipliers: ``B (f, lambda) + r = 0``.

    Attributes:
        equations: the equations of motion.
        given: the expressions that replace input functions of time.
        along: the coordinates or quasi-velocities along which generalised forces are solved for.
        loads: symbols or functions of time in the equations, which are solved for.
        where: the function that the user called, for messages.
    """

    equations: Equations
    given: Given
    along: tuple[Expr, ...]
    loads: tuple[Expr, ...]
    where: str

    @property
    def states(self) -> tuple[Expr, ...]:
        """The states beside the mechanics whose values are known: those that are not solved for."""
        return tuple(z for z in self.equations.states if z not in self.loads)

    @property
    def names(self) -> tuple[Expr, ...]:
        """The unknowns, except the multipliers."""
        return self.along + self.loads

    @cached_property
    def residuals(self) -> tuple[Expr, ...]:
        """The residuals of the equations of motion, of time, coordinates, speeds and accelerations.

        Efforts that are solved for are not clipped at the limits of their motors.
        """
        asked = {drive.given: drive.asked for drive in limited_drives(self.equations.system, self.loads)}
        residuals = (
            substitute(self.equations.derived_residuals, asked) if asked else self.equations.derived_residuals
        )
        return substitute_inputs(self.equations.system, self.given, residuals)

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, sorted by name."""
        return parameters_among(free_symbols(self.residuals) - {*self.loads})

    @cached_property
    def function(self) -> MeasuredFunction:
        """The function of t, (q, u, u', z) and p that returns r, B, and the magnitudes of the terms of r.

        Raises:
            ModelError: the equations aren't linear in the loads.
        """
        eqs = self.equations
        unknown = [*self.loads, *eqs.multipliers]
        slopes = jacobian(list(self.residuals), unknown).tolist() if unknown else [[]] * len(self.residuals)
        self._check_linear(slopes)
        rest = substitute(self.residuals, dict.fromkeys(unknown, number(0)))
        columns = self._directions().tolist() if self.along else [[]] * len(rest)
        B = Matrix([[*column, *row] for column, row in zip(columns, slopes, strict=True)])
        variables: list[Expr | list[Expr]] = [
            t,
            [*eqs.coordinates, *eqs.speeds, *eqs.accelerations, *self.states],
            list(self.parameters),
        ]
        return measured(variables, [list(rest), B], rest)

    def _directions(self) -> Matrix:
        """Return ``-K^T``: K has the derivatives, with respect to the speeds, of the rates along which forces act."""
        eqs = self.equations
        rates = [eqs.kinematics.get(time_derivative(name), name) for name in self.along]
        return -jacobian(list(substitute_inputs(eqs.system, self.given, rates)), list(eqs.speeds)).T

    def _check_linear(self, slopes: Sequence[Sequence[Expr]]) -> None:
        leaves = free_symbols(self.residuals)
        rates = sorted((leaf for leaf in leaves if leaf.kind == "time_function" and leaf.order), key=str)
        rates = [rate for rate in rates if rate.name in {name.name for name in self.loads}]
        if rates:
            raise ModelError(
                f"{self.where}, unknowns: the equations of motion contain the rate {rates[0]}; expected loads that "
                "enter without their rates"
            )
        names = {leaf.name for leaf in free_symbols([entry for row in slopes for entry in row])}
        curved = [str(name) for name in self.loads if name.name in names]
        if curved:
            raise ModelError(
                f"{self.where}, unknowns: the equations of motion aren't linear in {', '.join(curved)}; expected "
                "loads in which they are linear, such as a force, its amplitude or the effort of a motor"
            )

    def solution(
        self, instants: Array, trajectory: Trajectory, values: Mapping[Expr, float]
    ) -> tuple[Array, Array, NDArray[np.bool_]]:
        """Return loads, multipliers, and whether these are determined, one row for each instant.

        Those of dependent constraints are of minimum norm.

        Raises:
            SimulationError: loads are not determined, or the equations are not balanced or not finite.
        """
        state = trajectory.rows.T
        p = np.array([values[name] for name in self.parameters]).reshape(-1, 1)
        r, B, sizes = self.function(instants, state, p)
        r, B, sizes = r.T, np.moveaxis(B, -1, 0), sizes.T
        self._check_finite(instants, r, B)
        x, determined = least_norm_many(B, -r)
        left = np.einsum("kij,kj->ki", B, x) + r
        self._check_balanced(instants, left, sizes + np.einsum("kij,kj->ki", np.abs(B), np.abs(x)))
        self._check_determined(instants, determined[:, : len(self.names)])
        n = len(self.names)
        return x[:, :n], x[:, n:], determined[:, n:] > 1 - _OPEN

    def at(self, time: float, motion: Array, values: Mapping[Expr, float]) -> tuple[Array, Array]:
        """Return loads and multipliers at an instant, of (q, u, u', z)."""
        n, k = len(self.equations.coordinates), len(self.equations.speeds)
        parts = np.split(motion[None], [n, n + k, n + 2 * k], axis=1)
        loads, multipliers, _ = self.solution(np.array([time]), Trajectory(*parts), values)
        return loads[0], multipliers[0]

    def _check_finite(self, instants: Array, r: Array, B: Array) -> None:
        is_strange = ~(np.isfinite(r) & np.isfinite(B).all(axis=2))
        if is_strange.any():
            k = int(np.argmax(is_strange.any(axis=1)))
            row = int(np.argmax(is_strange[k]))
            raise SimulationError(
                f"{self.where}: at t = {instants[k]:g} s {self._equation(row)} isn't finite; a function may be out of "
                "its domain there, or a length may be zero"
            )

    def _check_balanced(self, instants: Array, left: Array, sizes: Array) -> None:
        largest = sizes.max(axis=1, keepdims=True)
        is_off = np.abs(left) > _UNBALANCED * np.maximum(sizes, _FAINT * largest)
        if is_off.any():
            k = int(np.argmax(is_off.any(axis=1)))
            row = int(np.argmax(np.where(is_off[k], np.abs(left[k]), 0)))
            what = f"no {', '.join(map(str, self.names))}" if self.names else "no multipliers alone"
            raise SimulationError(
                f"{self.where}: at t = {instants[k]:g} s {what} balance "
                f"{self._equation(row)}: {left[k, row]:.3g} is left; expected loads that act on every degree of "
                "freedom of the motion"
            )

    def _check_determined(self, instants: Array, determined: Array) -> None:
        is_open = determined < 1 - _OPEN
        if is_open.any():
            k = int(np.argmax(is_open.any(axis=1)))
            names = [name for name, left in zip(self.names, is_open[k], strict=True) if left]
            is_one = len(names) == 1
            what = f"the force{'' if is_one else 's'} along " if self.along else ""
            raise SimulationError(
                f"{self.where}: at t = {instants[k]:g} s {what}{', '.join(map(str, names))} "
                f"{'is' if is_one else 'are'} not determined: other values cause the same motion; give as many "
                "unknowns=[...] as the motion has degrees of freedom, and none that is at a dead centre"
            )

    def _equation(self, row: int) -> str:
        return f"the equation of motion of {self.equations.system.driving[row]}"


@lru_cache(maxsize=32)
def driving_loads(
    eqs: Equations, given: Given, along: tuple[Expr, ...], loads: tuple[Expr, ...], where: str
) -> DrivingLoads:
    """Return the equations for loads. They are cached, with their compiled code.

    Args:
        eqs: the equations of motion.
        given: the expressions that replace input functions of time.
        along: the coordinates or quasi-velocities along which generalised forces are solved for.
        loads: the symbols or functions of time that are solved for.
        where: the function that the user called, for messages.
    """
    return DrivingLoads(eqs, given, along, loads, where)
