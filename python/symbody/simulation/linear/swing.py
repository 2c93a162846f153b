"""Modes as motions: a mechanism that swings in a mode about its reference position."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import lambdify
from symbody.dynamics import Linear
from symbody.errors import ModelError
from symbody.multibody import Variables
from symbody.simulation.constraint.kinematics import quaternions
from symbody.simulation.given.values import parameter_values
from symbody.symbolic import Expr, free_symbols, jacobian, number, substitute, t

from .participation import bodies_of

__all__ = ["Swing", "visible_amplitude"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_ANGLE = 0.35
"""The largest angle of a body in an animation, in rad: 20 degrees."""
_CLOSED = 1e-10
"""The violation of constraints, relative to the largest coordinate, at which a loop is closed."""
_SINGULAR = 1e-9
"""The singular value, relative to the largest one, that counts as zero: constraints may depend on each other."""
_MOST_STEPS = 30
_WAY = 0.15
"""The largest way of a centre of mass in an animation, in sizes of the mechanism."""


@dataclass(frozen=True, eq=False)
class Swing:
    """A mode as a motion: ``q(t) = q_0 + Re(a phi exp(s t))`` about the steady values at t = 0.

    Independent coordinates are exactly these; the others follow so that loops close.

    Attributes:
        linear: the linear model.
        parameters: the values of the parameters.
        t: the instants, shape (N,).
        about: the values of all coordinates and speeds in the steady motion.
        deviations: those of all coordinates and speeds, shape (variables, N).
    """

    linear: Linear
    parameters: Mapping[Expr, ArrayLike]
    t: Array
    about: Array
    deviations: Array

    @property
    def system(self) -> Variables:
        """The system that swings."""
        return self.linear.system

    def __getitem__(self, expression: Expr) -> Array:
        """Return the values of an expression, shape (N,)."""
        return np.asarray(self.evaluate([expression])[0])

    def evaluate(self, expressions: Sequence[Expr]) -> Array:
        """Return the values of several expressions, one row for each: shape (expressions, N).

        Raises:
            ModelError: an expression contains accelerations, multipliers or rates of inputs.
            ParameterError: a parameter has no value.
        """
        rows = self._function(expressions)(self.about[:, None] + self.deviations)
        return np.array([np.broadcast_to(row, self.t.shape) for row in rows])

    def _function(self, expressions: Sequence[Expr]) -> Callable[[Array], Any]:
        """Return the function of all coordinates and speeds that evaluates expressions."""
        held = {q: value for q, value in self.linear.about.items() if q not in self.linear.variables}
        written = substitute([*self.system.by_speeds([*expressions])], held)
        leaves = free_symbols(written) - {t}
        strange = sorted((leaf for leaf in leaves if leaf.depends_on_time), key=str)
        strange = [leaf for leaf in strange if leaf not in self.linear.variables]
        if strange:
            raise ModelError(
                f"animate: {strange[0]} has no value in a mode; expected expressions of coordinates and speeds"
            )
        names = tuple(sorted((leaf for leaf in leaves if not leaf.depends_on_time), key=str))
        values = parameter_values(names, self.parameters, where="animate", beside=self.linear.variables)
        function = lambdify([t, *names, *self.linear.variables], [*written])
        return lambda variables: function(0.0, *values, *variables)

    def closed(self) -> Swing:
        """Return the same with dependent coordinates such that all loops close at each instant.

        Newton's method with the smallest changes of dependent coordinates; of all coordinates, if that fails, as it
        does beyond a dead centre.

        Raises:
            ModelError: the amplitude is too large: loops can't be closed.
        """
        conditions = _closures(self.system)
        if not conditions:
            return self
        coordinates = [*self.system.coordinates]
        function = self._function([*conditions, *jacobian(conditions, coordinates).entries])
        of_all = [*range(len(coordinates))]
        dependent = [
            k for k, q in enumerate(coordinates) if q not in self.linear.states[: self.linear.counts[0]]
        ]
        for moved in (dependent, of_all):
            found = self._newton(function, len(conditions), moved)
            if found is not None:
                return found
        raise ModelError(
            "Mode.motion: the loops of the mechanism can't be closed at this amplitude; expected a smaller one: "
            "motion(amplitude=...), animate(..., amplitude=...)"
        )

    def _newton(self, function: Callable[[Array], Any], count: int, moved: list[int]) -> Swing | None:
        """Return the swing with some coordinates changed so that conditions vanish; None if they don't.

        Args:
            function: returns the conditions and their derivatives by all coordinates.
            count: the number of conditions.
            moved: the places of the coordinates.
        """
        deviations, N = self.deviations.copy(), len(self.t)
        for _ in range(_MOST_STEPS):
            rows = np.array(
                [np.broadcast_to(row, N) for row in function(self.about[:, None] + deviations)], np.float64
            )
            phi, slopes = rows[:count].T, rows[count:].T.reshape(N, count, -1)
            if not np.isfinite(rows).all():
                return None
            if np.abs(phi).max() <= _CLOSED * max(1.0, np.abs(self.about).max()):
                return replace(self, deviations=deviations)
            change = np.linalg.pinv(slopes[:, :, moved], rcond=_SINGULAR) @ phi[:, :, None]
            deviations[moved] -= change[:, :, 0].T
        return None


def _closures(system: Variables) -> list[Expr]:
    """Return what vanishes at each position: constraints on positions, and norms of Euler parameters less one."""
    norms = [sum((e * e for e in four), start=number(-1)) for four in quaternions(system)]
    return [*system.position_constraints, *system.eliminated_constraints, *norms]


def visible_amplitude(
    linear: Linear, parameters: Mapping[Expr, ArrayLike], about: Array, shape: Complex
) -> float:
    """Return the amplitude at which bodies turn by up to 20 degrees, or move by 0.15 of the size of the mechanism.

    Args:
        linear: the linear model.
        parameters: the values of the parameters.
        about: the values of all coordinates and speeds in the steady motion.
        shape: the deviations of all coordinates and speeds in the mode.
    """
    frames = [body.frame for body in bodies_of(linear, "animate")]
    poses = [frame.pose for frame in frames]
    entries = [x for rows, _ in poses for row in rows for x in row] + [
        x for _, origin in poses for x in origin
    ]
    slopes = jacobian(entries, [*linear.system.coordinates])
    still = Swing(linear, parameters, np.zeros(1), about, np.zeros((len(about), 1)))
    values = still.evaluate([*entries, *slopes.entries])[:, 0]
    count, n = len(entries), len(linear.system.coordinates)
    moved = np.abs(values[count:].reshape(count, n) @ shape[:n])
    k = 9 * len(frames)
    turn = np.sqrt((moved[:k].reshape(-1, 9) ** 2).sum(axis=1) / 2).max()
    way = np.linalg.norm(moved[k:].reshape(-1, 3), axis=1).max()
    places = np.vstack([values[k:count].reshape(-1, 3), np.zeros(3)])
    size = float(np.ptp(places, axis=0).max()) or 1.0
    limits = [limit / moved for limit, moved in ((_ANGLE, turn), (_WAY * size, way)) if moved > 0]
    return float(min(limits, default=1.0))
