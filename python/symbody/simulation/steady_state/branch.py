"""Branches of steady motions over a parameter: what `continuation` returns."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.errors import ArgumentError, SimulationError
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.simulation.motion.drawing import drawing_function
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import described, with_known_names
from symbody.symbolic.given.wording import joined_by_and

from .steady_motion import SteadyMotion

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Branch"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class Branch:
    """A branch of steady motions over a parameter, in their order along it.

    ``branch[expression]`` are the values of an expression of the model along the branch.

    Attributes:
        parameter: the variable, parameter or input along which it was followed.
        motions: the steady motions; folds and branch points are among them.
        folds: those at which the branch turns back in its parameter, located to rounding errors.
        branch_points: those at which another branch crosses it.
        ends: why it ends, at its first and at its last motion.

    >>> from symbody import continuation, newton_euler, steady
    >>> from symbody.models import single_track_car
    >>> car = single_track_car()
    >>> found = steady(newton_euler(car.system), car.parameters, inputs=car.inputs)
    >>> branch = continuation(found, car["u"], (5, 40))
    >>> [round(value, 9) for value in branch.range]
    [5.0, 40.0]
    >>> float(branch[car["u"] * car["r"]].max().round(2))  # the lateral acceleration, in m/s^2
    5.48
    """

    parameter: Expr
    motions: tuple[SteadyMotion, ...]
    folds: tuple[SteadyMotion, ...]
    branch_points: tuple[SteadyMotion, ...]
    ends: tuple[str, str]

    @property
    def system(self) -> Variables:
        """The system that moves."""
        return self.motions[0].problem.balance.equations.system

    @property
    def varying(self) -> tuple[Expr, ...]:
        """The unknowns, coordinates that matter and speeds that are not the same everywhere, but for the parameter."""
        names = [name for name in self.motions[0].varying if name != self.parameter]
        rows = self.evaluate(names)
        return tuple(
            name
            for name, row in zip(names, rows, strict=True)
            if np.ptp(row) > 1e-9 * max(1.0, np.abs(row).max())
        )

    @property
    def marks(self) -> dict[str, list[int]]:
        """The places of folds and branch points among the motions, by name."""
        kinds = {"fold": self.folds, "branch point": self.branch_points}
        places = {id(motion): k for k, motion in enumerate(self.motions)}
        return {name: [places[id(motion)] for motion in found] for name, found in kinds.items()}

    def __len__(self) -> int:
        return len(self.motions)

    def __getitem__(self, expression: Expr | Freedom) -> Array:
        """Return the values of an expression, or of a freedom of a joint, shape (number of motions,)."""
        wanted = expression.value if isinstance(expression, Freedom) else expression
        return np.asarray(self.evaluate([wanted])[0])

    @with_known_names
    def evaluate(self, expressions: Sequence[Expr]) -> Array:
        """Return the values of several expressions, one row for each.

        Raises:
            SimulationError: a variable in them has no value in these motions.
        """
        written = self.motions[0].written(expressions)
        names = [*self.motions[0].known]
        columns = np.array([[motion.known[name] for name in names] for motion in self.motions])
        return np.array(
            [np.broadcast_to(row, len(self.motions)) for row in lambdify(names, list(written))(*columns.T)]
        )

    @with_known_names
    def at(self, value: float) -> tuple[SteadyMotion, ...]:
        """Return the motions of the branch at a value of its parameter, in their order; none outside of its range.

        Each is found by Newton steps from its neighbour.

        Raises:
            ArgumentError: the value is not a finite number.
        """
        if not isinstance(value, Real | Expr) or not np.isfinite(float(value)):
            raise ArgumentError(
                f"Branch.at: {described(value)}; expected a value of {self.parameter}, a number"
            )
        value = float(value)
        places = self[self.parameter] - value
        found = [self.motions[k] for k in np.flatnonzero(places == 0)]
        for k in np.flatnonzero(places[:-1] * places[1:] < 0):
            share = places[k] / (places[k] - places[k + 1])
            found.append(self._between(int(k), float(share), value))
        return tuple(found)

    def _between(self, k: int, share: float, value: float) -> SteadyMotion:
        """Return the motion at a value of the parameter between two neighbours."""
        here, there = self.motions[k], self.motions[k + 1]
        x = (1 - share) * here.x + share * there.x
        x[here.problem.names.index(self.parameter)] = value
        problem = here.problem.fixing(x, self.parameter)
        return SteadyMotion(problem, *problem.balance.solution(x))

    @cached_property
    def range(self) -> tuple[float, float]:
        """The least and the largest value of the parameter."""
        values = self[self.parameter]
        return float(values.min()), float(values.max())

    def __repr__(self) -> str:
        low, high = self.range
        folds = [f"{motion[self.parameter]:.6g}" for motion in self.folds]
        turns = f", folds at {', '.join(folds)}" if folds else ""
        return f"Branch({len(self)} steady motions, {self.parameter} from {low:.6g} to {high:.6g}{turns})"

    def _repr_html_(self) -> str:
        marks = {id(each): "fold" for each in self.folds} | {
            id(each): "branch point" for each in self.branch_points
        }
        shown = [self.motions[0], *(each for each in self.motions if id(each) in marks), self.motions[-1]]
        names = self.varying[:8]
        rows = [
            [marks.get(id(motion), "end"), *(f"{motion[name]:.6g}" for name in (self.parameter, *names))]
            for motion in shown
        ]
        header = ["", str(self.parameter), *map(str, names)]
        return html_table(f"Branch of {len(self)} steady motions", header, rows)

    @with_known_names
    def plot(
        self,
        *panels: Any,
        units: Mapping[Expr | str, str] | None = None,
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return a figure over the parameter, with one panel for each argument; by default, of what changes.

        Folds are marked by dots, and branch points by crosses.

        Args:
            panels: what to plot, as in `Motion.plot`.
            units: the units of expressions or of panels, and of the parameter, for the labels.
            title: the title of the figure.
            path: a file to save the figure in.

        Raises:
            SimulationError: a variable in a panel has no value in these motions.
        """
        for expression in _expressions(panels):
            try:
                self.motions[0].written([expression])
            except SimulationError as error:
                its = joined_by_and([*dict.fromkeys(map(str, (self.parameter, *self.motions[0].varying)))])
                told = str(error).removeprefix("steady motion: ").partition(";")[0]
                raise SimulationError(
                    f"Branch.plot: {told}; expected expressions of {its}, or of other variables of these motions"
                ) from None
        figure: Figure = drawing_function("plot_branch")(self, *panels, units=units, title=title, path=path)
        return figure


def _expressions(panels: Any) -> Iterator[Expr]:
    """Yield the expressions in panels, which may be lists and dictionaries of them."""
    if isinstance(panels, Expr):
        yield panels
    elif isinstance(panels, Mapping):
        yield from _expressions([*panels.values()])
    elif isinstance(panels, list | tuple):
        for panel in panels:
            yield from _expressions(panel)
