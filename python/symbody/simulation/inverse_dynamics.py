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
from symbody.symbolic import (
    Expr,
    ExprLike,
    Matrix,
    free_symbols,
    jacobian,
    number,
    substitute,
    time_derivative,
)
from symbody.symbolic import t as symbolic_time
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
            symbolic_time,
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
    functions = [name for name in wanted or () if name.kind == "time_function"]
    given = given_inputs(eqs, inputs, where=_WHERE, besides=functions)
    kinematics = kinematics_of(eqs, given)
    _check_outside(kinematics, wanted or ())
    prescribed, instants, along, values = _followed(eqs, kinematics, motion, parameters, t, wanted, guess)
    loads = _Loads(eqs, given, prescribed, wanted)
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


def _followed(
    eqs: Equations,
    kinematics: Kinematics,
    motion: Mapping[Expr, ExprLike | ArrayLike] | _Followed,
    parameters: Mapping[Expr, ArrayLike] | None,
    t: ArrayLike | None,
    wanted: Sequence[Expr] | None,
    guess: Mapping[Expr, ArrayLike] | None,
) -> tuple[tuple[Expr, ...], Array, Course, dict[Expr, float]]:
    """Return the prescribed coordinates, the instants, the motion, and the values of parameters."""
    if isinstance(motion, Mapping):
        instants = _instants(t)
        prescription = prescription_of(eqs.system, motion, instants, _WHERE)
        values = _values(eqs, kinematics.given, prescription.parameters, parameters, wanted)
        near = state_values(eqs.system, guess, where=_WHERE, argument="guess", has_speeds=False)
        p = np.array([values[name] for name in kinematics.parameters])
        along = course(kinematics, p, prescription.compiled(values), instants, near, _WHERE)
        return prescription.coordinates, instants, along, values
    if not isinstance(motion, _Followed):
        raise ModelError(
            f"{_WHERE}, motion: {described(motion)}; expected a dictionary of coordinates and expressions of time, "
            "or a motion that was simulated"
        )
    if t is not None:
        raise SimulationError(f"{_WHERE}: t, and a motion that has instants of its own; leave t out")
    values = _values(eqs, kinematics.given, (), {**motion.parameters, **(parameters or {})}, wanted)
    q, n = len(eqs.coordinates), len(eqs.speeds)
    rows = motion.evaluate([*eqs.coordinates, *eqs.speeds, *eqs.accelerations]).T
    along = Course(rows[:, :q], rows[:, q : q + n], rows[:, q + n :])
    return eqs.coordinates, motion.t, along, values


def _unknowns(eqs: Equations, unknowns: Sequence[Expr] | None) -> tuple[Expr, ...] | None:
    """Return the loads that are solved for, or None for forces along the prescribed coordinates."""
    if unknowns is None:
        return None
    if not isinstance(unknowns, list | tuple) or not unknowns:
        raise ModelError(
            f"{_WHERE}, unknowns: {described(unknowns)}; expected a list of symbols or functions of time"
        )
    known = (*eqs.parameters, *eqs.inputs)
    for name in unknowns:
        if name not in known or (name.kind == "time_function" and name.order):
            raise ModelError(
                f"{_WHERE}, unknowns: {name} isn't in the equations of motion; expected symbols or functions of time "
                f"in the loads: {', '.join(map(str, known)) or 'there are none'}"
            )
    return tuple(unknowns)


def _check_outside(kinematics: Kinematics, wanted: Sequence[Expr]) -> None:
    names = {leaf.name for leaf in kinematics.leaves}
    inside = [str(name) for name in wanted if name.name in names]
    if inside:
        raise ModelError(
            f"{_WHERE}, unknowns: {', '.join(inside)} stands in constraints or kinematics; expected what stands in "
            "loads alone"
        )


def _instants(given: ArrayLike | None) -> Array:
    instants = np.atleast_1d(np.array(given if given is not None else np.nan, dtype=np.float64))
    if (
        instants.ndim != 1
        or not np.isfinite(instants).all()
        or (np.diff(instants) <= 0).any()
        or not instants.size
    ):
        raise SimulationError(
            f"{_WHERE}: t={described(given)}; expected the first and the last instant, or all instants, increasing"
        )
    return np.linspace(instants[0], instants[1], 1001) if len(instants) == 2 else instants


def _values(
    eqs: Equations,
    given: Sequence[tuple[Expr, Expr]],
    more: Sequence[Expr],
    parameters: Mapping[Expr, ArrayLike] | None,
    wanted: Sequence[Expr] | None,
) -> dict[Expr, float]:
    """Return the values of all symbols but the unknown ones."""
    leaves = {*eqs.parameters, *more, *free_symbols([value for _, value in given])}
    needed = {leaf for leaf in leaves if leaf.kind == "symbol" and not leaf.depends_on_time} - {
        *(wanted or ())
    }
    names = sorted(needed, key=lambda symbol: symbol.name)
    numbers = parameter_values(names, parameters, where=_WHERE, are_all=False)
    return dict(zip(names, map(float, numbers), strict=True))


@dataclass(frozen=True, eq=False)
class _Loads:
    """The equations of motion as linear equations for loads and multipliers: ``B (f, lambda) + r = 0``."""

    equations: Equations
    given: Mapping[Expr, Expr]
    prescribed: tuple[Expr, ...]
    wanted: tuple[Expr, ...] | None

    @property
    def names(self) -> tuple[Expr, ...]:
        """What is solved for: loads, or coordinates for the forces along them."""
        return self.prescribed if self.wanted is None else self.wanted

    def solved(self, instants: Array, along: Course, values: Mapping[Expr, float]) -> tuple[Array, Array]:
        """Return loads and multipliers, a row for each instant; the least multipliers of dependent constraints.

        Raises:
            SimulationError: some loads aren't determined, or the equations don't balance.
        """
        state = np.hstack([along.coordinates, along.speeds, along.accelerations]).T
        variables, expressions = self._expressions()
        function = lambdify([*variables, list(values)], expressions)
        r, B, sizes = function(instants, state, np.array(list(values.values())).reshape(-1, 1))
        B, r, sizes = np.moveaxis(B, -1, 0), np.asarray(r).T, np.asarray(sizes).T
        B, r, sizes = (np.broadcast_to(each, (len(instants), *each.shape[1:])) for each in (B, r, sizes))
        if not (np.isfinite(B).all() and np.isfinite(r).all()):
            raise SimulationError(f"{_WHERE}: {self._strange(instants, r)}")
        x, determined = least_norm_many(B, -r)
        self._check_balanced(instants, np.einsum("kij,kj->ki", B, x) + r, sizes + _terms(B, x))
        self._check_determined(instants, determined)
        return x[:, : len(self.names)], x[:, len(self.names) :]

    def _expressions(self) -> tuple[list[Expr | list[Expr]], list[object]]:
        eqs, system = self.equations, self.equations.system
        residuals = substitute(substitute(eqs.residuals, dict(self.given)), system.known_rates)
        unknown = [*(self.wanted or ()), *eqs.multipliers]
        rest = substitute(residuals, dict.fromkeys(unknown, number(0)))
        slopes = jacobian(list(residuals), unknown).tolist() if unknown else [[] for _ in residuals]
        self._check_linear(slopes)
        if self.wanted is None:
            rates = [eqs.kinematics[rate] for rate in map(time_derivative, self.prescribed)]
            K = jacobian(substitute(rates, dict(self.given)), list(eqs.speeds))
            slopes = [[*(-K[j, i] for j in range(len(rates))), *row] for i, row in enumerate(slopes)]
        variables: list[Expr | list[Expr]] = [
            symbolic_time,
            [*eqs.coordinates, *eqs.speeds, *eqs.accelerations],
        ]
        return variables, [list(rest), Matrix(slopes), [magnitude(each) for each in rest]]

    def _check_linear(self, slopes: Sequence[Sequence[Expr]]) -> None:
        leaves = free_symbols([entry for row in slopes for entry in row])
        names = {leaf.name for leaf in leaves}
        curved = [str(name) for name in self.wanted or () if name.name in names]
        if curved:
            raise ModelError(
                f"{_WHERE}, unknowns: the equations of motion aren't linear in {', '.join(curved)}; expected loads "
                "that are, such as a force or its amplitude"
            )

    def _check_determined(self, instants: Array, determined: Array) -> None:
        is_open = determined[:, : len(self.names)] < 1 - 1e-6
        if not is_open.any():
            return
        k = int(np.argmax(is_open.any(axis=1)))
        names = [str(name) for name, left in zip(self.names, is_open[k], strict=True) if left]
        is_one = len(names) == 1
        what = ("force" if self.wanted is None else "load") + ("" if is_one else "s")
        along = " along" if self.wanted is None else ""
        verb = "isn't" if is_one else "aren't"
        raise SimulationError(
            f"{_WHERE}: at t = {instants[k]:g} s the {what}{along} {', '.join(names)} {verb} determined: other values move "
            "the system alike; give fewer unknowns=[...], as many as the motion has degrees of freedom"
        )

    def _check_balanced(self, instants: Array, left: Array, sizes: Array) -> None:
        off = np.abs(left) > _UNBALANCED * np.maximum(sizes, 1e-9 * sizes.max(initial=0.0))
        if not off.any():
            return
        k = int(np.argmax(off.any(axis=1)))
        row = int(np.argmax(np.where(off[k], np.abs(left[k]), 0)))
        raise SimulationError(
            f"{_WHERE}: at t = {instants[k]:g} s no {', '.join(map(str, self.names))} balance the equation of motion "
            f"of {self.equations.system.driving[row]}: {left[k, row]:.3g} are left; expected loads that work on "
            "every degree of freedom of the motion"
        )

    def _strange(self, instants: Array, r: Array) -> str:
        k = int(np.argmax(~np.isfinite(r).all(axis=1)))
        row = int(np.argmax(~np.isfinite(r[k])))
        return (
            f"at t = {instants[k]:g} s the equation of motion of {self.equations.system.driving[row]} isn't finite; "
            "a function may be out of its domain there, or a length zero"
        )


def _terms(B: Array, x: Array) -> Array:
    terms: Array = np.einsum("kij,kj->ki", np.abs(B), np.abs(x))
    return terms
