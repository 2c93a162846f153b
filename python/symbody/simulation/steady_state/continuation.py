"""Continuation: branches of steady motions over a parameter, through folds, by pseudo-arclength."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError, SimulationError, notify
from symbody.simulation.constraint.gauss_newton import Linearization
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described, with_known_names
from symbody.symbolic.numeric.deficiency import reporting

from .branch import Branch
from .force_balance import BALANCED, Balance
from .solution_curve import CurveEnd, CurvePoint, Landmark, SolutionCurve
from .steady_motion import SteadyMotion
from .steady_problem import SteadyProblem
from .steady_variables import Limits, bounds, least_and_largest

__all__ = ["Path", "continuation", "path_through"]

Array = NDArray[np.float64]
_WHERE = "continuation"
_PART = 0.2
"""The part of the range of the parameter after which changes of other variables are looked at."""
_LEAST_SHARE = 1e-4
"""The least share of the parameter in the first tangent by which changes are compared."""
_ROUNDED = 1e-14
"""The distance from a bound that rounding explains."""
_STEP = 0.02
"""The longest step of the parameter, whose range has the length one."""


@with_known_names
def continuation(
    found: SteadyMotion,
    parameter: Expr,
    over: tuple[float, float],
    *,
    limits: Limits | None = None,
    most: int = 1000,
) -> Branch:
    """Return the branch of steady motions through a given one, over a parameter, in both directions.

    Pseudo-arclength continuation [Keller 1977; Seydel 2010, ch. 4]: the branch is followed through folds, where it
    turns back in the parameter. Folds and points where branches cross are located. It ends where the parameter leaves
    its range or an unknown meets its limit, or when it is closed.

    Args:
        found: a steady motion within the range.
        parameter: what is varied: a coordinate, speed or state that was given, a parameter, an input, or a given
            expression.
        over: the least and the largest value of the parameter.
        limits: the least and the largest values of unknowns; by default those of the steady motion.
        most: the largest number of steady motions in one direction.

    Raises:
        ParameterError: the parameter was not given in the steady motion, or the range is not one around it.
        SimulationError: the steady motion does not change with the parameter alone.

    >>> from symbody import newton_euler, steady
    >>> from symbody.models import single_track_car
    >>> car = single_track_car()
    >>> found = steady(newton_euler(car.system), car.parameters, inputs=car.inputs)
    >>> branch = continuation(found, car["u"], (5, 40))
    >>> branch.at(10)[0][car["r"]].__round__(12), branch.ends  # u delta/(L + K u**2)
    (0.062937062937, ('u reached 5', 'u reached 40'))
    """
    with reporting(_WHERE):
        path = path_through(found, parameter, over, limits)
        forward = path.followed(1, most)
        closed = forward.reason == "it is closed"
        backward = CurveEnd(forward.points[:1], [], forward.reason) if closed else path.followed(-1, most)
    branch = _branch(path, backward, forward)
    for reason in dict.fromkeys(branch.ends):
        if not reason.startswith(("it is", *map(str, path.problem.names))):
            notify(f"{_WHERE}: the branch ends early: {reason}")
    return branch


@dataclass(frozen=True, eq=False)
class Path:
    """A curve of steady motions, in the scaled unknowns z: free variables over their sizes, then forces.

    Attributes:
        problem: the conditions, with the parameter among the unknowns.
        start: the variables and the forces of the first steady motion.
        parameter: the place of the parameter among the variables.
        over: the range of the parameter.
        sizes: those of the free variables.
        unit: that of forces.
    """

    problem: SteadyProblem
    start: tuple[Array, Array]
    parameter: int
    over: tuple[float, float]
    sizes: Array
    unit: float

    @property
    def balance(self) -> Balance:
        return self.problem.balance

    def scaled(self, x: Array, forces: Array) -> Array:
        """Return z of variables and forces."""
        return np.concatenate([x[self.balance.is_free] / self.sizes, forces / self.unit])

    def plain(self, z: Array) -> tuple[Array, Array]:
        """Return the variables and the forces of z."""
        is_free, x = self.balance.is_free, self.start[0].copy()
        count = int(is_free.sum())
        x[is_free] = z[:count] * self.sizes
        return x, z[count:] * self.unit

    @property
    def place(self) -> int:
        """The place of the parameter among the free variables."""
        return int(np.cumsum(self.balance.is_free)[self.parameter]) - 1

    def rescaled(self) -> Path:
        """Return the same with sizes such that no variable changes much more than the parameter.

        The tangent shows this at first, and steady motions at a part of the range, if they are found, farther away.
        """
        z, along = self.scaled(*self.start), np.zeros(len(self.sizes) + self.balance.count)
        along[self.place] = 1
        tangent = self.curve().tangent(z, along)
        if tangent is None:
            return self
        changes = np.abs(tangent[: len(self.sizes)]) / max(abs(tangent[self.place]), _LEAST_SHARE)
        sizes = self.sizes * np.maximum(1.0, changes)
        for sign in (1, -1):
            aside = self._beside(z, tangent * sign / max(abs(tangent[self.place]), _LEAST_SHARE))
            sizes = np.maximum(sizes, np.abs(aside - self.start[0])[self.balance.is_free] / _PART)
        return replace(self, sizes=sizes)

    def _beside(self, z: Array, direction: Array) -> Array:
        """Return the variables of a steady motion a part of the range away; those at the start if none is found."""
        x, _ = self.plain(z + _PART * direction)
        x[self.parameter] = np.clip(x[self.parameter], *self.over)
        balance = self.problem.fixing(x, self.problem.names[self.parameter]).balance
        found = balance.solution(x)
        return found[0] if balance.error(*found) <= BALANCED else self.start[0]

    def curve(self) -> SolutionCurve:
        """Return the curve of solutions."""
        balance, is_free = self.balance, self.balance.is_free
        counts = np.concatenate([np.ones(int(is_free.sum()), bool), np.zeros(balance.count, bool)])
        columns = np.concatenate([is_free, np.ones(balance.count, bool)])
        weights = np.concatenate([self.sizes, np.full(balance.count, self.unit)])

        def linearized_at(place: Array) -> Linearization:
            scale = balance.scale(*self.plain(place))

            def linearization(z: Array) -> tuple[Array, Array]:
                F, slopes, _ = balance.values(*self.plain(z))
                return F / scale, slopes[:, columns] * weights / scale[:, None]

            return linearization

        return SolutionCurve(
            linearized_at, lambda z: balance.error(*self.plain(z)), counts, BALANCED, self.place
        )

    def landmarks(self, curve: SolutionCurve) -> list[Landmark]:
        """Return folds, branch points, and the ends of the range and of limits."""
        place = self.place
        found = [
            Landmark("fold", lambda point, _: float(point.tangent[place])),
            Landmark("branch point", curve.orientation),
        ]
        bounds = [(self.parameter, value) for value in self.over]
        bounds += [
            (k, value) for k, pair in enumerate(self.problem.limits) for value in pair if np.isfinite(value)
        ]
        return found + [self._bound(k, float(value)) for k, value in bounds]

    def _bound(self, k: int, value: float) -> Landmark:
        def excess(point: CurvePoint, begin: CurvePoint) -> float:
            del begin
            found = float(self.plain(point.z)[0][k] - value) / max(1.0, abs(value))
            return found if abs(found) > _ROUNDED else 0.0  # where it begins there, this is no crossing

        return Landmark(f"{self.problem.names[k]} reached {value:g}", excess, ends=True)

    def followed(self, sign: int, most: int) -> CurveEnd:
        """Return the curve in the direction in which the parameter grows, or falls."""
        curve, z = self.curve(), self.scaled(*self.start)
        along = np.zeros(len(z))
        along[self.place] = sign
        tangent = curve.tangent(z, along)
        if tangent is None:
            tangent = curve.tangent(z, sign * np.ones(len(z)))
        if tangent is None:
            raise SimulationError(
                f"{_WHERE}: no other steady motion is nearby when {self.problem.names[self.parameter]} varies alone; "
                "expected an unknown that can follow: leave a variable out of what is given, or name an input"
            )
        value = float(self.start[0][self.parameter])
        if value == self.over[(sign + 1) // 2] and tangent[self.place] * sign > 0:
            reason = f"{self.problem.names[self.parameter]} reached {value:g}"
            return CurveEnd([CurvePoint(z, tangent)], [], reason)
        return curve.followed(CurvePoint(z, tangent), _STEP, self.landmarks(curve), most)


def path_through(
    found: SteadyMotion, parameter: Expr, over: tuple[float, float], limits: Limits | None
) -> Path:
    """Return the curve of steady motions through a given one, over a parameter."""
    if not isinstance(found, SteadyMotion):
        raise ArgumentError(
            f"{_WHERE}: {described(found)}; expected a steady motion, such as steady(...) returns"
        )
    problem, x = found.problem.freeing(found.x, parameter)
    k = problem.names.index(parameter)
    low, high = least_and_largest(over, f"{_WHERE}, over", f"({x[k] - 1:g}, {x[k] + 1:g})")
    if not np.isfinite([low, high]).all():
        raise ParameterError(
            f"{_WHERE}, over: ({low:g}, {high:g}): the range of {parameter} is not finite; expected two finite numbers"
        )
    if not low <= x[k] <= high or low == high:
        raise ParameterError(
            f"{_WHERE}: {parameter} is {x[k]:g} in the steady motion, which is not between {low:g} and {high:g}; "
            "expected a range around it, the least value first"
        )
    if limits is not None:
        problem = replace(
            problem, limits=bounds(limits, problem.names, problem.balance.fixed, f"{_WHERE}, limits")
        )
    sizes = np.maximum(np.abs(x), 1.0)
    sizes[k] = high - low
    balance = problem.balance
    unit = balance.scale(x, found.forces)[: len(balance.equations.speeds)].max()
    path = Path(problem, (x, found.forces), k, (low, high), sizes[balance.is_free], float(unit))
    return path.rescaled()


def _branch(path: Path, backward: CurveEnd, forward: CurveEnd) -> Branch:
    """Return the branch of two directions, from the least value of the parameter on at first."""
    points = [*reversed(backward.points), *forward.points[1:]]
    middle = len(backward.points) - 1
    motions = tuple(SteadyMotion(path.problem, *path.plain(point.z)) for point in points)
    marks = [(name, middle - k) for name, k in backward.landmarks]
    marks += [(name, middle + k) for name, k in forward.landmarks]

    def marked(name: str) -> Sequence[SteadyMotion]:
        return [motions[k] for mark, k in sorted(marks, key=lambda each: each[1]) if mark == name]

    return Branch(
        path.problem.names[path.parameter],
        motions,
        tuple(marked("fold")),
        tuple(marked("branch point")),
        (backward.reason, forward.reason),
    )
