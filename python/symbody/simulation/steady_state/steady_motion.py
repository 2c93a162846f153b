"""Steady motions: what `steady` returns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SimulationError
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.simulation.motion.reading import Reading
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic import t as time
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import expression as as_expression
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.given.wording import joined_by_and

from .implicit_slopes import ImplicitSlopes
from .steady_problem import SteadyProblem
from .value_table import HEADER, value_rows, without_noise

__all__ = ["SteadyMotion"]

Array = NDArray[np.float64]
_WHERE = "steady motion"

_READING = Reading("motion", "its attributes, such as motion.coordinates, have the values by name")


@dataclass(frozen=True, eq=False, repr=False)
class SteadyMotion(Mapping[Expr, float]):
    """A steady motion: a mapping of its state, that is, of coordinates, speeds and states beside the mechanics.

    So it can be given where a state is: ``simulate(equations, found.parameters, initial=found, inputs=found.inputs)``.
    ``found[expression]`` is the value of any expression of the model, such as a force or a rate of a coordinate.

    Attributes:
        problem: the conditions that it satisfies.
        x: the variables of these conditions.
        forces: the multipliers and the holding forces.

    >>> from symbody import newton_euler, steady
    >>> from symbody.models import single_track_car
    >>> car = single_track_car()
    >>> found = steady(newton_euler(car.system), car.parameters, given={car["r"]: 0.25}, unknown=[car["delta"]])
    >>> found.ignorable, round(found[car["delta"]], 6), found[car["u"] * car["r"]]
    ((x, y, psi), 0.041111, 6.25)
    """

    problem: SteadyProblem
    x: Array
    forces: Array

    @property
    def system(self) -> Variables:
        """The system that moves."""
        return self.problem.balance.equations.system

    @property
    def t(self) -> float:
        """The time of its first instant, in s."""
        return self.problem.balance.t

    @property
    def coordinates(self) -> dict[Expr, float]:
        """The values of all coordinates; of ignorable ones, those at the first instant."""
        return {q: self.known[q] for q in self.problem.balance.equations.coordinates}

    @property
    def speeds(self) -> dict[Expr, float]:
        """The values of all speeds."""
        return {u: self.known.get(u, 0.0) for u in self.problem.balance.equations.speeds}

    @property
    def states(self) -> dict[Expr, float]:
        """The values of the states beside the mechanics, whose rates are zero."""
        return {z: self.known[z] for z in self.problem.balance.equations.states}

    @cached_property
    def state(self) -> dict[Expr, float]:
        """The coordinates, the speeds, then the states."""
        return {**self.coordinates, **self.speeds, **self.states}

    @property
    def multipliers(self) -> dict[Expr, float]:
        """The values of the multipliers; empty without constraints."""
        return {name: self.known[name] for name in self.problem.balance.equations.multipliers}

    @property
    def holding(self) -> dict[Expr, float]:
        """The generalised forces along held coordinates, by coordinate."""
        m = len(self.problem.balance.equations.multipliers)
        pairs = zip(self.problem.balance.order, self.forces[m:], strict=True)
        return {q: float(force) + 0.0 for q, force in pairs}

    @property
    def solved(self) -> dict[Expr, float]:
        """The parameters and inputs that were solved for."""
        solved = self.problem.balance.conditions.solved
        names = self.problem.names[len(self.problem.names) - len(solved) :]
        return {name: self.known[its] for name, its in zip(names, solved, strict=True)}

    @property
    def parameters(self) -> dict[Expr, float]:
        """The values of all parameters, those that were solved for included."""
        own = {name: self.known[name] for name in self.problem.balance.equations.parameters}
        return {**self.problem.parameters, **own}

    @property
    def inputs(self) -> dict[Expr, Expr | float]:
        """The values of all inputs, or their expressions."""
        return {name: self.known.get(value, value) for name, value in self.problem.inputs.items()}

    @property
    def ignorable(self) -> tuple[Expr, ...]:
        """The coordinates on which nothing depends, so that they may move."""
        return self.problem.balance.conditions.course.ignorable

    @property
    def turning(self) -> tuple[Expr, Expr, Expr] | None:
        """x, y and the heading with which (x', y') turns, if all directions of the plane of x and y are alike."""
        return self.problem.balance.conditions.course.turning

    @property
    def residual(self) -> float:
        """The largest generalised force that is left in the equations of motion."""
        F, _, _ = self.problem.balance.values(self.x, self.forces)
        return float(np.abs(F[: len(self.problem.balance.equations.speeds)]).max())

    @cached_property
    def known(self) -> dict[Expr, float]:
        """The values of all variables, multipliers and symbols of the conditions."""
        balance = self.problem.balance
        conditions, multipliers = balance.conditions, balance.equations.multipliers
        pairs = [
            *self.problem.parameters.items(),
            *zip(conditions.parameters, balance.p, strict=True),
            *zip(conditions.variables, self.x, strict=True),
            *zip(multipliers, self.forces, strict=False),
            (time, balance.t),
        ]
        return {name: float(value) + 0.0 for name, value in pairs}

    @with_known_names
    def written(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions by the names in `known`.

        Raises:
            SimulationError: a variable in them has no value in this motion.
        """
        found = self.problem.balance.conditions.written([as_expression(e, _WHERE) for e in expressions])
        strange = sorted(map(str, free_symbols(found) - self.known.keys()))
        if strange:
            raise SimulationError(
                f"{_WHERE}: no value of {joined_by_and(strange)}; it has values of coordinates, speeds, states, "
                "multipliers, inputs and parameters, and of their expressions"
            )
        return found

    def __getitem__(self, expression: Expr | Freedom) -> float:
        """Return the value of a variable, of a freedom of a joint, or of an expression of the model.

        Raises:
            SimulationError: a variable in it has no value in this motion.
        """
        if isinstance(expression, Freedom):
            expression = expression.value
        if expression in self.state:
            return self.state[expression]
        (found,) = self.written([expression])
        return float(found.evaluate({name: self.known[name] for name in free_symbols([found])}))

    @with_known_names
    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, such as the components of a reaction: shape (expressions,).

        Raises:
            ArgumentError: the argument is not a list of expressions.
            SimulationError: a variable in them has no value in this motion.
        """
        return np.array([self[each] for each in _READING.several_expressions(expressions)], dtype=np.float64)

    @with_known_names
    def sensitivity(self, expression: Expr, by: Expr) -> float:
        """Return the derivative of an expression by a parameter, an input, or a variable that was given.

        ``F_x dx/dp = -F_p`` for the conditions ``F(x, p) = 0`` of steady motion, with exact derivatives.

        Args:
            expression: an expression, as in ``found[expression]``.
            by: the parameter, the input, or what was given.

        Raises:
            ParameterError: it is none of these.
            SimulationError: the motion has no derivative by it, as at a fold, or the expression contains something
                unknown.

        >>> from symbody import newton_euler, steady
        >>> from symbody.models import single_track_car
        >>> car = single_track_car()
        >>> delta, r = car["delta"], car["r"]
        >>> found = steady(newton_euler(car.system), car.parameters, given={r: 0.25}, unknown=[delta])
        >>> more = steady(newton_euler(car.system), car.parameters, given={r: 0.251}, unknown=[delta])
        >>> abs((more[delta] - found[delta]) / 0.001 - found.sensitivity(delta, by=r)) < 1e-3
        True
        """
        (written,) = self.written([expression])
        slopes = ImplicitSlopes(self.problem.balance, self.x, self.forces, "SteadyMotion.sensitivity")
        return slopes.of(written, self.known, by)

    def __iter__(self) -> Iterator[Expr]:
        return iter(self.state)

    def __len__(self) -> int:
        return len(self.state)

    def __contains__(self, name: object) -> bool:
        return name in self.state

    @property
    def varying(self) -> tuple[Expr, ...]:
        """The names of what describes it: unknowns, coordinates that matter, and speeds that may differ from zero."""
        conditions = self.problem.balance.conditions
        kept = {*self.ignorable}
        own = [name for name in (*conditions.positions, *conditions.course.moving) if name not in kept]
        return (*self.solved, *own)

    def __repr__(self) -> str:
        names = self.varying
        values = zip(names, without_noise([self[name] for name in names]), strict=True)
        return f"SteadyMotion({', '.join(f'{name}: {value:.6g}' for name, value in values)})"

    def _repr_html_(self) -> str:
        kinds = {
            "coordinate": {q: value for q, value in self.coordinates.items() if q not in self.ignorable},
            "speed": {u: self[u] for u in self.problem.balance.conditions.course.moving},
            "state": self.states,
            "solved": self.solved,
            "multiplier": self.multipliers,
            "holding force": self.holding,
        }
        free = joined_by_and([str(q) for q in self.ignorable]) if self.ignorable else ""
        note = f"Nothing depends on {free}." if free else ""
        return html_table("Steady motion", HEADER, value_rows(kinds), note)
