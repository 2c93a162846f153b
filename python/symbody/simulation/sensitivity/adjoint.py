"""The adjoint equations of a motion, integrated backwards from checkpoint to checkpoint.

For ``x' = f(x, p, t)`` and ``J = g(x, p) at the end + integral of L(x, p, t)``, the adjoint variables satisfy

    lambda' = -f_x^T lambda - L_x,   lambda = g_x at the end
    dJ/dp = g_p + integral of (L_p + f_p^T lambda) + S(0)^T lambda(0)        S(0) = dx(0)/dp

[Cao, Li, Petzold & Serban 2003]. All derivatives come from one reverse sweep over ``lambda^T f + L``, so that their
cost does not depend on the number of parameters. The state is integrated backwards together with lambda, and is set to
the motion's own at checkpoints: where the way back leaves the motion, as that of a damped motion does, this is done
more often, and more checkpoints are made where that does not suffice.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode
from symbody.errors import SimulationError
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.native import problem_of, run
from symbody.simulation.integrate.problem import Problem
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, derivation, gradient, substitute, symbol
from symbody.symbolic import t as time

__all__ = ["Adjoint", "BackwardMotion", "adjoint_of"]

Array = NDArray[np.float64]

_CLOSE = 30.0
"""The distance, in tolerances, by which the state on the way back may differ from the motion."""
_PARTS, _DEEPEST = 16, 5
"""Into how many parts the time between two checkpoints is divided, and how often."""


@dataclass(frozen=True, eq=False)
class Adjoint:
    """The adjoint equations of a model for one functional.

    Attributes:
        model: the model.
        by: the parameters.
        integrand: L, without accelerations and multipliers.
        is_projected: whether states are projected onto the constraints.
    """

    model: Model
    by: tuple[Expr, ...]
    integrand: Expr
    is_projected: bool

    @cached_property
    def multipliers(self) -> tuple[Expr, ...]:
        """The adjoint variables lambda, one for each entry of the state."""
        return tuple(symbol(f"adjoint of {x}") for x in self.model.state)

    @cached_property
    def scale(self) -> Expr:
        """The variable of the scale of the functional: lambda and the integrals are divided by it."""
        return symbol("scale of the functional")

    @cached_property
    def sizes(self) -> tuple[Expr, ...]:
        """The variables of the sizes of the parameters, by which the integrals are multiplied."""
        return tuple(symbol(f"size of {p}") for p in self.by)

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values."""
        own = (*self.model.parameters, *self.model.damping)
        held = sorted((p for p in self.integrand.free_symbols if _is_parameter(p) and p not in own), key=str)
        return (*own, *held, self.scale, *self.sizes)

    @cached_property
    def _inputs(self) -> tuple[Expr, ...]:
        integrals = (symbol(f"integral by {p}") for p in self.by)
        return (time, *self.model.state, *self.multipliers, *integrals, symbol("integral of the functional"))

    @property
    def width(self) -> int:
        """The length of the vector: the state, lambda, an integral for each parameter, and that of L."""
        return len(self._inputs) - 1

    def _code(self, expressions: Sequence[Expr]) -> PreparedCode:
        """Return the machine code of expressions in which the time runs backwards."""
        stands = {x: symbol(f"{x} on the way back") for x in self.model.state}
        backwards = substitute(substitute(expressions, stands), {time: -time})
        inputs = tuple(stands.get(name, name) for name in self._inputs)
        return PreparedCode(self.parameters, inputs, backwards)

    @cached_property
    def problem(self) -> Problem:
        """The compiled equations, as functions of minus the time."""
        model, n = self.model, len(self.model.state)
        rates = model.rates[:n]
        with derivation():
            pairs = zip(self.multipliers, rates, strict=True)
            L = self.integrand / self.scale
            whole = sum((y * rate for y, rate in pairs), start=L)
            slopes = gradient(whole, [*model.state, *self.by])
            by_parameter = [slope * size for slope, size in zip(slopes[n:], self.sizes, strict=True)]
            back = [-rate for rate in rates]
        corrections = None
        if self.is_projected and model.constraints:
            positions, velocities = model.correction_codes
            corrections = self._code(positions.expressions), self._code(velocities.expressions)
        return Problem(
            width=self.width,
            controlled=2 * n,
            rates=self._code([*back, *slopes[:n], *by_parameter, L]),
            corrections=corrections,
        )


def _is_parameter(leaf: Expr) -> bool:
    return leaf.kind == "symbol" and not leaf.depends_on_time


@lru_cache(maxsize=16)
def adjoint_of(model: Model, by: tuple[Expr, ...], integrand: Expr, *, is_projected: bool) -> Adjoint:
    """Return adjoint equations. They are cached, with their compiled code."""
    return Adjoint(model, by, integrand, is_projected)


@dataclass(frozen=True, eq=False)
class BackwardMotion:
    """The way back along a motion.

    Attributes:
        adjoint: the equations.
        values: the values of their parameters.
        options: the method and its tolerances.
    """

    adjoint: Adjoint
    values: Mapping[Expr, float]
    options: Options

    @cached_property
    def _constants(self) -> Array:
        return self.adjoint.problem.constants(
            np.array([self.values[name] for name in self.adjoint.parameters])
        )

    def to_start(self, instants: Array, states: Array, vector: Array, depth: int = 0) -> Array:
        """Return the vector at the first checkpoint, given that at the last.

        Args:
            instants: the instants of the checkpoints, shape (N,), in s.
            states: the states there, shape (N, n).
            vector: the state, lambda and the integrals at the last of them.
            depth: how often the time between checkpoints was divided.

        Raises:
            SimulationError: the motion can't be followed back.
        """
        n, last, most = states.shape[1], len(instants) - 1, max(1, len(instants) // 8)
        vector = np.concatenate([states[-1], vector[n:]])
        while last > 0:
            first = max(0, last - most)
            found = self._followed(instants[first : last + 1], vector)
            good = self._good(found, states[first : last + 1][::-1])
            if good == 0:
                more, between = self._divided(instants[last - 1 : last + 1], states[last - 1], depth)
                vector, good = self.to_start(more, between, vector, depth + 1), 1
            else:
                vector = found[good]
            most = 2 * most if good == last - first else max(1, good)
            last -= good
            vector = np.concatenate([states[last], vector[n:]])
        return vector

    def _followed(self, instants: Array, vector: Array) -> Array:
        """Return the vectors at the instants, from the last to the first, as far as the integration came."""
        outcome = run(self.adjoint.problem, vector, self._constants, -instants[::-1], self.options)
        return outcome.states

    def _good(self, found: Array, states: Array) -> int:
        """Return how many steps back the state is that of the motion."""
        n, (rtol, atol) = states.shape[1], (self.options.rtol, self.options.atol)
        bound = _CLOSE * (atol + rtol * np.abs(states).max(axis=0))
        is_near = (np.abs(found[:, :n] - states[: len(found)]) <= bound).all(axis=1)
        is_near &= np.isfinite(found).all(axis=1)
        return len(is_near) - 1 if is_near.all() else int(np.argmin(is_near)) - 1

    def _divided(self, instants: Array, state: Array, depth: int) -> tuple[Array, Array]:
        """Return more checkpoints between two of them."""
        if depth == _DEEPEST:
            raise SimulationError(
                f"gradient_of_motion: the motion can't be followed back from t = {instants[1]:.6g} s, as its way back "
                "leaves it at once: the equations are stiff; use simulate(..., sensitivities=[...]) instead"
            )
        model = self.adjoint.model
        plain = problem_of(model, is_projected=self.adjoint.is_projected)
        constants = plain.constants(np.array([self.values[name] for name in plain.parameters]))
        more = np.linspace(instants[0], instants[1], _PARTS + 1)
        vector = np.concatenate([state, np.zeros(model.width - len(state))])
        outcome = run(plain, vector, constants, more, replace(self.options, max_step=np.inf))
        return more[: len(outcome.states)], outcome.states[:, : len(state)]
