"""Positions, velocities and accelerations of constrained systems: functions of numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Equations
from symbody.errors import ModelError
from symbody.multibody import System, Variables
from symbody.multibody.frames import all_frames
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.simulation.given.parameter import parameters_among
from symbody.symbolic import (
    Expr,
    ExprLike,
    Matrix,
    derivation,
    free_symbols,
    jacobian,
    number,
    substitute,
    t,
)

from .magnitude import MeasuredFunction, measured

__all__ = ["Kinematics", "kinematics_in", "kinematics_of", "neutral_position", "quaternions"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Kinematics:
    """The constraints of a system and the rates of its coordinates, compiled for numbers.

    Attributes:
        system: the system.
        given: the expressions that replace input functions of time.
        states: the values of the states beside the mechanics, shape (k,) or (k, N), if constraints hold states.
    """

    system: Variables
    given: Given = ()
    states: Array | None = None

    @cached_property
    def has_states(self) -> bool:
        """Whether constraints on velocities, rates or eliminated speeds hold states, whose values are needed then."""
        return not self._written.isdisjoint(self.system.states)

    @cached_property
    def _written(self) -> frozenset[Expr]:
        """The variables in constraints and kinematics as they were written, without what inputs bring in."""
        system = self.system
        eliminated = [system.eliminated[u] for u in self.eliminated]
        levels = system.velocity_level(system.constraints)
        return free_symbols((*levels, *system.rate(system.coordinates), *eliminated))

    def beside(self, states: ArrayLike) -> Kinematics:
        """Return the same, with the same compiled code, for values of the states."""
        if not self.has_states:
            return self
        _ = self._velocity, self._acceleration
        made = copy(self)
        vars(made).pop("in_speeds", None)
        object.__setattr__(made, "states", np.asarray(states, dtype=np.float64))
        return made

    def _with_states(self, place: Array) -> Array:
        return place if self.states is None else np.concatenate([place, self.states])

    def position_of_many(self, t: ArrayLike, q: Array, p: Array) -> Any:
        """Return `position` at k positions (n, k) with parameters (p, k), to the same digits; at one instant, or k."""
        return self.position.at_few_points(t, q, p)

    def velocity_of_many(self, t: float, q: Array, p: Array) -> Any:
        """Return `velocity` at k positions (n, k) with parameters (p, k), to the same digits."""
        return self._velocity.at_few_points(t, q, p)

    def velocity(self, t: ArrayLike, q: Array, p: Array) -> Any:
        """Return A and b of ``(phi', q') = A u + b``, with all constraints."""
        return self._velocity(t, self._with_states(q), p)

    def acceleration(self, t: ArrayLike, state: Array, p: Array) -> Any:
        """Return c of ``(phi'', q'') = A u' + c``, at coordinates and speeds."""
        return self._acceleration(t, self._with_states(state), p)

    @cached_property
    def constraints(self) -> tuple[Expr, ...]:
        """All constraints, on positions and on velocities."""
        return self._with_inputs(self.system.constraints)

    @cached_property
    def position_constraints(self) -> tuple[Expr, ...]:
        """The constraints phi on positions, also those that were eliminated with speeds."""
        eliminated = self._with_inputs(self.system.eliminated_constraints)
        return (*(self.constraints[k] for k in self.system.holonomic), *eliminated)

    @property
    def velocity_constraints(self) -> tuple[Expr, ...]:
        """The constraints on the level of velocities, ``A u + b``."""
        return self._velocities[: len(self.constraints)]

    @property
    def coordinate_rates(self) -> tuple[Expr, ...]:
        """The rates of the coordinates, ``K u + k``."""
        return self._velocities[len(self.constraints) :]

    @property
    def eliminated_values(self) -> tuple[Expr, ...]:
        """The expressions of the eliminated speeds, ``D u + d``."""
        return self._with_inputs(self.system.eliminated[u] for u in self.eliminated)

    @cached_property
    def _drifts(self) -> tuple[Expr, ...]:
        """B of ``A u + b``, symbolically."""
        return substitute(self.velocity_constraints, dict.fromkeys(self.system.speeds, number(0)))

    @cached_property
    def is_rheonomic(self) -> bool:
        """Whether constraints, or rates of coordinates, are led by the time, or at given velocities."""
        at_rest = substitute(self._velocities, dict.fromkeys(self.system.speeds, number(0)))
        return not all(each.is_zero for each in at_rest)

    @cached_property
    def rank(self) -> int:
        """The number of constraints that are independent at almost every position, of ``(A b)`` of ``A u + b``."""
        if not self.constraints:
            return 0
        A = jacobian(list(self.velocity_constraints), list(self.system.speeds))
        if all(drift.is_zero for drift in self._drifts):
            return A.rank()
        return Matrix([[*A.row(k), drift] for k, drift in enumerate(self._drifts)]).rank()

    @cached_property
    def _velocities(self) -> tuple[Expr, ...]:
        """The constraints on the level of velocities, then the rates of the coordinates."""
        if self.system.is_holonomic:
            return self._with_inputs(self.system.rate([*self.constraints, *self.system.coordinates]))
        levels = self.system.velocity_level(self.constraints)
        return self._with_inputs((*levels, *self.system.rate(self.system.coordinates)))

    def among_all(self, values: Array) -> Array:
        """Return values of the constraints on positions with zeros for those on velocities, shape (m,)."""
        whole = np.zeros(len(self.constraints))
        if self.constraints:  # eliminated ones demand no velocities
            whole[list(self.system.holonomic)] = values
        return whole

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, sorted by name."""
        return parameters_among(self.leaves)

    @cached_property
    def leaves(self) -> frozenset[Expr]:
        """The variables in constraints and kinematics, and in the rates of the states that constraints hold."""
        eliminated = self._with_inputs(self.eliminated)
        levels = free_symbols((*self.constraints, *self.position_constraints, *self._velocities, *eliminated))
        rates = zip(self.system.states, self.system.state_rates.values(), strict=True)
        own = levels | free_symbols(self._with_inputs(rate for z, rate in rates if z in levels))
        if not self.system.momenta:
            return own
        return own | self.in_speeds.leaves | free_symbols(self._momenta)

    @cached_property
    def in_speeds(self) -> Kinematics:
        """The kinematics in the speeds that momenta replaced."""
        made = Kinematics(self.system.whole, self.given)
        return made if self.states is None else made.beside(self.states)

    def parameters_of(self, other: Kinematics, p: Array) -> Array:
        """Return the values of the parameters of other kinematics, which are among the own ones."""
        values = dict(zip(self.parameters, p, strict=True))
        return np.array([values[name] for name in other.parameters])

    @property
    def _momenta(self) -> tuple[Expr, ...]:
        return substitute_inputs(self.system.whole, self.given, [*self.system.momenta.values()])

    @cached_property
    def momenta(self) -> CompiledFunction:
        """The function of t, (q, u) and p that returns the momenta, of the speeds u that these replaced."""
        state = [*self.system.coordinates, *self.system.whole.speeds]
        return lambdify(self._arguments(state), list(self._momenta))

    @cached_property
    def position(self) -> MeasuredFunction:
        """The function of t, q and p that returns phi, ``dphi/dq``, and the magnitudes of the terms of phi."""
        phi, q = list(self.position_constraints), list(self.system.coordinates)
        return measured(self._arguments(q), [phi, jacobian(phi, q)], phi)

    @cached_property
    def _velocity(self) -> CompiledFunction:
        """The function of t, q (and z) and p that returns A and b."""
        u = list(self.system.speeds)
        rest = substitute(self._velocities, dict.fromkeys(u, number(0)))
        outputs = [jacobian(list(self._velocities), u), list(rest)]
        return lambdify(self._arguments([*self.system.coordinates, *self._held]), outputs)

    @property
    def eliminated(self) -> list[Expr]:
        """The speeds that were eliminated, or replaced by momenta, and that are no rates of coordinates."""
        return [u for u in self.system.eliminated if u.order == 0]

    def eliminated_speeds(self, t: ArrayLike, q: Array, p: Array) -> Any:
        """Return D and d: the eliminated speeds are ``D u + d``."""
        return self._eliminated_speeds(t, self._with_states(q), p)

    @cached_property
    def _eliminated_speeds(self) -> CompiledFunction:
        """The function of t, q (and z) and p that returns D and d."""
        u, values = list(self.system.speeds), self._with_inputs(self.eliminated)
        rest = substitute(values, dict.fromkeys(u, number(0)))
        place = self._arguments([*self.system.coordinates, *self._held])
        return lambdify(place, [jacobian(list(values), u), list(rest)])

    @cached_property
    def _acceleration(self) -> CompiledFunction:
        """The function of t, (q, u) (and z) and p that returns c."""
        with derivation():
            rates = self.system.rate(self._velocities)
            rest = substitute(rates, dict.fromkeys(self.system.accelerations, number(0)))
            rest = self._with_inputs(rest) if self.has_states else rest
        return lambdify(
            self._arguments([*self.system.coordinates, *self.system.speeds, *self._held]), list(rest)
        )

    @property
    def _held(self) -> tuple[Expr, ...]:
        """The states, if constraints hold any of them; their rates may hold the others."""
        return self.system.states if self.has_states else ()

    def _arguments(self, state: list[Expr]) -> list[Expr | list[Expr]]:
        return [t, state, list(self.parameters)]

    def _with_inputs(self, expressions: Iterable[Expr]) -> tuple[Expr, ...]:
        return substitute_inputs(self.system, self.given, tuple(expressions))

    def check_inputs(self, where: str) -> None:
        """Check that all functions of time in the constraints have values.

        Raises:
            ModelError: some of them do not.
        """
        system = self.system
        if self.has_states and self.states is None:
            first = next(z for z in system.states if z in self._written)
            raise ModelError(
                f"{where}: the constraints hold the state {first}, whose value isn't known here; expected constraints "
                "without states: make the system with a number, or an input, in its place"
            )
        known = {leaf.name for leaf in (*system.coordinates, *system.speeds, *system.eliminated, *self._held)}
        unknown = sorted(
            {leaf.name for leaf in self.leaves if leaf.kind == "time_function" and leaf.name not in known}
        )
        brought = next((z for z in system.states if z.name in unknown), None)
        if brought is not None:
            raise ModelError(
                f"{where}: the constraints contain an input that is given by the state {brought}; expected expressions "
                "of time, coordinates and speeds in constraints"
            )
        if unknown:
            raise ModelError(
                f"{where}: the constraints contain the functions of time {', '.join(unknown)}, which are neither "
                f"coordinates nor speeds; give them as inputs={{{unknown[0]}: sin(t)}}"
            )


def quaternions(system: Variables) -> tuple[tuple[Expr, ...], ...]:
    """Return the Euler parameters of floating frames, four each, that are coordinates."""
    if not isinstance(system, System):
        return ()
    frames = all_frames(system.bodies, system.loads, system.gravity)
    found = [
        frame.motion.quaternion for frame in frames if frame.motion is not None and frame.motion.quaternion
    ]
    return tuple(four for four in dict.fromkeys(found) if not {*four}.isdisjoint(system.coordinates))


def neutral_position(system: Variables) -> Array:
    """Return the default coordinates: zero, and e0 = 1 for floating frames, which means no rotation."""
    ones = {four[0] for four in quaternions(system)}
    return np.array([1.0 if q in ones else 0.0 for q in system.coordinates])


def kinematics_of(eqs: Equations, inputs: Mapping[Expr, ExprLike] | None = None) -> Kinematics:
    """Return the kinematics of a system with given inputs. They are cached, with their compiled code."""
    return kinematics_in(eqs.system, inputs)


def kinematics_in(system: Variables, inputs: Mapping[Expr, ExprLike] | None = None) -> Kinematics:
    """Return the kinematics in the variables of a system, as `kinematics_of` does."""
    return _kinematics(
        system, tuple(sorted(((f, number(e)) for f, e in (inputs or {}).items()), key=_by_name))
    )


@lru_cache(maxsize=64)
def _kinematics(system: Variables, given: Given) -> Kinematics:
    return Kinematics(system, given)


def _by_name(pair: tuple[Expr, Expr]) -> str:
    return str(pair[0])
