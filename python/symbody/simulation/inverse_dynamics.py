"""Inverse dynamics: the loads that make a system follow a prescribed motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import lambdify
from symbody.dynamics import Equations
from symbody.errors import ModelError, ProgramError, SimulationError
from symbody.multibody import System
from symbody.symbolic import Expr, ExprLike, free_symbols, jacobian, number, substitute, t
from symbody.symbolic.arguments import described

from .kinematic_analysis import Course, course, least_norm_many
from .kinematics import Kinematics, kinematics_of, magnitude
from .prescription import prescription_of
from .values import given_inputs, parameter_values, state_values

__all__ = ["InverseDynamics", "inverse_dynamics"]

Array = NDArray[np.float64]

_WHERE = "inverse_dynamics"
_UNBALANCED = 1e-7
"""The part of its terms that an equation of motion may be off where it counts as balanced."""


@runtime_checkable
class _Followed(Protocol):
    """A motion that was computed before."""

    @property
    def t(self) -> Array:
        """The instants."""
        ...

    @property
    def parameters(self) -> Mapping[Expr, float]:
        """The values of parameters."""
        ...

    def evaluate(self, expressions: Sequence[Expr]) -> Array:
        """Return values of expressions, a row for each."""
        ...


@dataclass(frozen=True, eq=False)
class InverseDynamics:
    """A prescribed motion and the loads that it takes; ``result[expression]`` has the values of any expression.

    Attributes:
        system: what moves.
        t: the instants, N of them, in s.
        coordinates: where it is, a row for each instant.
        speeds: the speeds u, likewise.
        accelerations: their rates.
        forces: the loads that were solved for, an array of N for each; along a prescribed coordinate by its name.
        multipliers: the multipliers of the constraints, a row for each instant.
        parameters: the values of the parameters.
    """

    system: System
    t: Array
    coordinates: Array
    speeds: Array
    accelerations: Array
    forces: Mapping[Expr, Array]
    multipliers: Array
    parameters: Mapping[Expr, float]
    _inputs: Mapping[Expr, Expr] = field(default_factory=dict, repr=False)

    def __repr__(self) -> str:
        names = ", ".join(map(str, self.forces))
        return f"InverseDynamics of {names}: {len(self.t)} instants from {self.t[0]:g} to {self.t[-1]:g} s"

    def __getitem__(self, expression: ExprLike) -> Array:
        """Return the values of an expression, one for each instant."""
        values: Array = self.evaluate([expression])[0]
        return values

    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, a row for each.

        Raises:
            SimulationError: an expression of something that isn't known here.
        """
        system = self.system
        wanted = substitute([number(each) for each in expressions], dict(self._inputs))
        wanted = substitute(wanted, system.known_rates)
        loads = [name for name in self.forces if name not in system.coordinates]
        known: list[Expr | list[Expr]] = [
            t,
            [*system.coordinates, *system.speeds, *system.accelerations, *system.multipliers],
            loads,
            list(self.parameters),
        ]
        state = np.hstack([self.coordinates, self.speeds, self.accelerations, self.multipliers]).T
        forces = np.array([self.forces[name] for name in loads]).reshape(len(loads), len(self.t))
        values = np.array(list(self.parameters.values()))[:, None]
        try:
            function = lambdify(known, list(wanted))
        except (ProgramError, ValueError) as failure:
            raise SimulationError(f"{_WHERE}: {failure}") from failure
        return np.asarray(function(self.t, state, forces, values))


def inverse_dynamics(
    eqs: Equations,
    motion: Mapping[Expr, ExprLike | ArrayLike] | _Followed,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    t: ArrayLike | None = None,
    *,
    unknowns: Sequence[Expr] | None = None,
    inputs: Mapping[Expr, ExprLike] | None = None,
    guess: Mapping[Expr, ArrayLike] | None = None,
) -> InverseDynamics:
    """Return the loads that make a system follow a prescribed motion.

    The coordinates that aren't prescribed follow from the constraints, at the level of positions, velocities and
    accelerations; then ``M u' - forcing - phi_q^T lambda - K^T f = 0`` is linear in the forces f along the prescribed
    coordinates, or in loads that are named, and in lambda [Nikravesh 1988, sec. 5.5].

    Args:
        eqs: equations of motion.
        motion: for each prescribed coordinate an expression of time and parameters, a number, or a row of samples,
            one for each instant; or a motion that was simulated, all of which is followed.
        parameters: the values of all symbols but the unknown ones.
        t: the first and the last instant (1001 instants, evenly spaced), or the instants themselves, in s.
        unknowns: the symbols or functions of time in the loads that are solved for; by default a generalised force
            along each prescribed coordinate, which comes to the loads that there are.
        inputs: functions of time that are given from outside, by time and state.
        guess: coordinates near the first position, where they aren't prescribed.

    Raises:
        SimulationError: the motion or the loads aren't determined, or no values of them balance the equations.
        ConstraintError: the constraints don't allow the motion.
        ModelError: something is prescribed or unknown that can't be.
        ParameterError: a value is missing, isn't finite, or belongs to nothing.

    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, translate
    >>> from symbody import t as time
    >>> x, m = functions_of_time("x"), symbols("m")
    >>> eqs = newton_euler(System([Body(translate(x, 0, 0), m)], coordinates=[x]))
    >>> inverse_dynamics(eqs, {x: time**2}, {m: 3}, [0, 1, 2]).forces
    {x: array([6., 6., 6.])}
    """
    wanted = _unknowns(eqs, unknowns)
    given = given_inputs(
        eqs, inputs, where=_WHERE, besides=[name for name in wanted or () if name.kind != "symbol"]
    )
    kinematics = kinematics_of(eqs, given)
    _check_outside(kinematics, wanted or ())
    if isinstance(motion, Mapping):
        values, instants, along = _followed_path(eqs, kinematics, motion, parameters, t, wanted, guess)
        prescribed = tuple(motion)
    elif isinstance(motion, _Followed):
        if t is not None:
            raise SimulationError(f"{_WHERE}: t is given by the motion; leave it out")
        values = dict(motion.parameters) | dict(parameters or {})  # type: ignore[arg-type]
        values = _numbers(eqs, given, (), values, wanted)
        instants, along, prescribed = motion.t, _computed(eqs, motion), eqs.coordinates
    else:
        raise ModelError(
            f"{_WHERE}, motion: {described(motion)}; expected a dictionary of coordinates and expressions of time, or a "
            "motion that was simulated"
        )
    loads = _Loads(eqs, kinematics, wanted, prescribed, given)
    forces, multipliers = loads.solved(instants, along, values)
    return InverseDynamics(
        eqs.system,
        instants,
        along.coordinates,
        along.speeds,
        along.accelerations,
        dict(zip(loads.names, forces.T, strict=True)),
        multipliers,
        values,
        given,
    )
