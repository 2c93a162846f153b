"""Equations of motion where nothing moves: residuals at zero speeds and accelerations, and their derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Equations
from symbody.geometry.floating import Floating
from symbody.multibody.frames import all_frames
from symbody.symbolic import Expr, free_symbols, jacobian, number, substitute, t

from .given_input import Given, with_given
from .kinematics import magnitude

__all__ = ["Statics", "statics_of"]


@dataclass(frozen=True, eq=False)
class Statics:
    """The conditions of equilibrium ``-forcing - phi_q^T lambda = 0`` and ``phi = 0``, compiled for numbers.

    Attributes:
        equations: the equations of motion.
        given: what stands in the place of functions of time that are given from outside.
    """

    equations: Equations
    given: Given

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, by name."""
        leaves = {*self.equations.parameters, *free_symbols([value for _, value in self.given])}
        found = {leaf for leaf in leaves if leaf.kind == "symbol" and not leaf.depends_on_time}
        return tuple(sorted(found, key=lambda symbol: symbol.name))

    @cached_property
    def quaternions(self) -> tuple[tuple[Expr, ...], ...]:
        """The Euler parameters of floating frames, whose norms are one."""
        system = self.equations.system
        found = []
        for frame in all_frames(system.bodies, system.loads, system.gravity):
            if isinstance(frame.motion, Floating):
                shifts = free_symbols(frame.motion.displacement)
                found.append(tuple(q for q in frame.motion.kinematics if q not in shifts))
        return tuple(dict.fromkeys(quaternion for quaternion in found if quaternion))

    @cached_property
    def conditions(self) -> tuple[Expr, ...]:
        """What is zero: the residuals at rest, the constraints, and one less the squares of Euler parameters."""
        at_rest = dict.fromkeys((*self.equations.accelerations, *self.equations.speeds), number(0))
        residuals = substitute(self._residuals, at_rest)
        constraints = self._with_given(self.equations.constraints)
        norms = [sum((e * e for e in four), start=number(-1)) for four in self.quaternions]
        return (*residuals, *constraints, *norms)

    @cached_property
    def function(self) -> CompiledFunction:
        """The function of t, q, lambda and p that returns the conditions, their derivatives and sizes of terms."""
        q, multipliers = self.equations.coordinates, self.equations.multipliers
        slopes = jacobian(list(self.conditions), [*q, *multipliers])
        sizes = [magnitude(condition) for condition in self.conditions]
        return lambdify(
            [t, list(q), list(multipliers), list(self.parameters)], [list(self.conditions), slopes, sizes]
        )

    @cached_property
    def small_motion(self) -> CompiledFunction:
        """The function of t, q, lambda and p that returns M, ``dr/du`` and ``dq'/du`` at rest."""
        eqs = self.equations
        at_rest = dict.fromkeys((*eqs.accelerations, *eqs.speeds), number(0))
        inertia = jacobian(list(self._residuals), list(eqs.accelerations)).subs(at_rest)
        damping = jacobian(list(self._residuals), list(eqs.speeds)).subs(at_rest)
        kinematics = self._with_given(tuple(eqs.kinematics.values()))
        rates = jacobian(list(kinematics), list(eqs.speeds))
        variables: list[Expr | list[Expr]] = [
            t,
            list(eqs.coordinates),
            list(eqs.multipliers),
            list(self.parameters),
        ]
        return lambdify(variables, [inertia, damping, rates])

    @cached_property
    def _residuals(self) -> tuple[Expr, ...]:
        return self._with_given(self.equations.residuals)

    def _with_given(self, expressions: tuple[Expr, ...]) -> tuple[Expr, ...]:
        return with_given(self.equations.system, self.given, expressions)


@lru_cache(maxsize=32)
def statics_of(eqs: Equations, given: Given) -> Statics:
    """Return the statics of equations with given inputs; the last ones are kept, with what they compiled."""
    return Statics(eqs, given)
