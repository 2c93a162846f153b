"""Equations of motion at rest: residuals at zero speeds and accelerations, and their derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Equations
from symbody.simulation.constraint.kinematics import magnitude, quaternions
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.simulation.given.parameter import parameters_among
from symbody.symbolic import Expr, free_symbols, gradient, jacobian, number, substitute, symbol, t

__all__ = ["Statics", "statics_of"]


@dataclass(frozen=True, eq=False)
class Statics:
    """The conditions of equilibrium ``-forcing - phi_q^T lambda - K^T h = 0``, ``phi = 0`` and ``z' = 0``, compiled.

    The positions are the coordinates and the states z beside the mechanics.

    Attributes:
        equations: the equations of motion.
        given: the expressions that replace input functions of time.
    """

    equations: Equations
    given: Given

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, sorted by name."""
        return parameters_among(
            {*self.equations.parameters, *free_symbols([value for _, value in self.given])}
        )

    @cached_property
    def quaternions(self) -> tuple[tuple[Expr, ...], ...]:
        """The Euler parameters of floating frames, with norm one."""
        return quaternions(self.equations.system)

    @property
    def positions(self) -> tuple[Expr, ...]:
        """The coordinates, then the states."""
        return self.equations.coordinates + self.equations.states

    @cached_property
    def holding(self) -> tuple[Expr, ...]:
        """Symbols for the forces h along the positions; none acts along a state."""
        return tuple(symbol(f"holding {k}") for k in range(len(self.positions)))  # names that no user writes

    @cached_property
    def conditions(self) -> tuple[Expr, ...]:
        """Expressions that are zero at rest: residuals, constraints, norms of quaternions less one, rates of states.

        Eliminated constraints on positions follow the others; they have no multipliers.
        """
        at_rest = dict.fromkeys((*self.equations.accelerations, *self.equations.speeds), number(0))
        power = sum((h * rate for h, rate in zip(self.holding, self._rates, strict=False)), start=number(0))
        along = gradient(power, self.equations.speeds)
        residuals = substitute([r - h for r, h in zip(self._residuals, along, strict=True)], at_rest)
        kept = (*self.equations.constraints, *self.equations.system.eliminated_constraints)
        constraints = substitute(self._substitute_inputs(kept), at_rest)
        norms = [sum((e * e for e in four), start=number(-1)) for four in self.quaternions]
        return (*residuals, *constraints, *norms, *substitute(self._state_rates, at_rest))

    @cached_property
    def giving_rates(self) -> list[int]:
        """The places of the constraints on velocities that depend on the position or on states at rest."""
        n, eqs = len(self.equations.speeds), self.equations
        on_velocities = [k for k in range(len(eqs.constraints)) if k not in eqs.system.holonomic]
        return [k for k in on_velocities if free_symbols([self.conditions[n + k]]) & {*self.positions}]

    @cached_property
    def function(self) -> CompiledFunction:
        """The function of t, (q, z), lambda, h and p that returns the conditions, their slopes, and term magnitudes."""
        unknowns = [[*self.positions], [*self.equations.multipliers], [*self.holding]]
        slopes = jacobian(list(self.conditions), [name for names in unknowns for name in names])
        sizes = [magnitude(condition) for condition in self.conditions]
        return lambdify([t, *unknowns, list(self.parameters)], [list(self.conditions), slopes, sizes])

    @cached_property
    def small_motion(self) -> CompiledFunction:
        """The function of t, (q, z), lambda and p that returns M, ``dr/du``, ``dq'/du``, ``dz'/d(u, u')`` at rest."""
        eqs = self.equations
        at_rest = dict.fromkeys((*eqs.accelerations, *eqs.speeds), number(0))
        inertia = jacobian(list(self._residuals), list(eqs.accelerations)).subs(at_rest)
        damping = jacobian(list(self._residuals), list(eqs.speeds)).subs(at_rest)
        rates = jacobian(list(self._rates), list(eqs.speeds))
        variables: list[Expr | list[Expr]] = [
            t,
            list(self.positions),
            list(eqs.multipliers),
            list(self.parameters),
        ]
        driving = jacobian(list(self._state_rates), [*eqs.speeds, *eqs.accelerations]).subs(at_rest)
        return lambdify(variables, [inertia, damping, rates, driving])

    @cached_property
    def _rates(self) -> tuple[Expr, ...]:
        return self._substitute_inputs(tuple(self.equations.kinematics.values()))

    @cached_property
    def _state_rates(self) -> tuple[Expr, ...]:
        return self._substitute_inputs(tuple(self.equations.state_rates.values()))

    @cached_property
    def _residuals(self) -> tuple[Expr, ...]:
        return self._substitute_inputs(self.equations.residuals)

    def _substitute_inputs(self, expressions: tuple[Expr, ...]) -> tuple[Expr, ...]:
        return substitute_inputs(self.equations.system, self.given, expressions)


@lru_cache(maxsize=32)
def statics_of(eqs: Equations, given: Given) -> Statics:
    """Return the statics of equations with given inputs. They are cached, with their compiled code."""
    return Statics(eqs, given)
