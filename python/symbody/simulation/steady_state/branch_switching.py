"""Branch switching: the other branch of steady motions at a point where two cross.

At a branch point, the Jacobian of the conditions loses a rank, and its null space has the tangents of both branches
[Seydel 2010, sec. 5.6]. A point of the other branch is searched beside the branch point, at a distance along the null
vector that is normal to the known tangent. From there on, the other branch is followed as any branch is.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError, SimulationError
from symbody.symbolic.given.arguments import counted, described, with_known_names
from symbody.symbolic.numeric.deficiency import reporting

from .branch import Branch
from .continuation import Path, continuation, path_through
from .steady_motion import SteadyMotion
from .steady_variables import Limits, least_and_largest

__all__ = ["crossing_branch"]

Array = NDArray[np.float64]
_WHERE = "crossing_branch"
_DISTANCES = (0.05, 0.01, 0.2, 0.002)
"""The distances from the branch point at which the other branch is searched; the range of the parameter is one."""


@with_known_names
def crossing_branch(
    branch: Branch,
    point: int = 0,
    over: tuple[float, float] | None = None,
    *,
    limits: Limits | None = None,
    most: int = 1000,
) -> Branch:
    """Return the branch of steady motions that crosses another one at one of its branch points.

    A pendulum that hangs from a shaft leaves the vertical where the shaft turns fast enough; a column buckles. The
    branch goes through the branch point, in both directions.

    Args:
        branch: the branch, from `continuation`.
        point: which one of `branch.branch_points`.
        over: the least and the largest value of the parameter; by default, those of the branch.
        limits: the least and the largest values of unknowns, as in `continuation`.
        most: the largest number of steady motions in one direction.

    Raises:
        ArgumentError: this is no branch, or it has no such branch point.
        ParameterError: the branch point is not within the range.
        SimulationError: no other branch is found there.

    >>> from symbody import continuation, crossing_branch, equations_of, functions_of_time, sin, steady, symbols
    >>> theta, (k, l, P) = functions_of_time("theta"), symbols("k l P")
    >>> column = equations_of([[1]], [P * l * sin(theta) - k * theta], [theta])
    >>> straight = continuation(steady(column, {k: 2, l: 1, P: 1}), P, (1, 3))
    >>> buckled = crossing_branch(straight, limits={theta: (-1, 1)})
    >>> abs(buckled[P] * buckled[sin(theta)] - 2 * buckled[theta]).max() < 1e-9
    np.True_
    """
    found = _point(branch, point)
    low, high = _range(branch, found, over)
    with reporting(_WHERE):
        path = path_through(_fixed(found, branch), branch.parameter, (low, high), limits)
        beside = next(_beside(path, branch, found), None)
    if beside is None:
        raise SimulationError(
            f"{_WHERE}: no other branch was found beside the branch point at {branch.parameter} = "
            f"{found[branch.parameter]:.6g}; expected one that crosses: look for its motions with steady_motions at a "
            "value nearby"
        )
    return continuation(beside, branch.parameter, (low, high), limits=limits, most=most)


def _point(branch: object, point: object) -> SteadyMotion:
    if not isinstance(branch, Branch):
        raise ArgumentError(
            f"{_WHERE}: {described(branch)}; expected a branch, such as continuation(...) returns"
        )
    points = branch.branch_points
    if not points:
        raise ArgumentError(
            f"{_WHERE}: this branch has no branch points; expected one that another branch crosses"
        )
    if isinstance(point, bool) or not isinstance(point, int) or not -len(points) <= point < len(points):
        raise ArgumentError(
            f"{_WHERE}, point: {described(point)}; expected the place of one of {counted(len(points), 'branch point')}"
        )
    return points[point]


def _range(branch: Branch, found: SteadyMotion, over: object) -> tuple[float, float]:
    """Return the range of the parameter, which the branch point belongs to."""
    if over is None:
        return branch.range
    least, largest = branch.range
    low, high = least_and_largest(over, f"{_WHERE}, over", f"over=({least:g}, {largest:g})")
    value = found[branch.parameter]
    if not low <= value <= high:
        raise ParameterError(
            f"{_WHERE}, over: {branch.parameter} is {value:.6g} at the branch point, which is not between {low:g} and "
            f"{high:g}; expected a range around it, the least value first"
        )
    return low, high


def _fixed(found: SteadyMotion, branch: Branch) -> SteadyMotion:
    """Return a motion of the branch as one with a given value of the parameter."""
    return SteadyMotion(found.problem.fixing(found.x, branch.parameter), found.x, found.forces)


def _beside(path: Path, branch: Branch, found: SteadyMotion) -> Iterator[SteadyMotion]:
    """Yield steady motions of other branches beside a branch point."""
    place = next(k for k, each in enumerate(branch.motions) if each is found)
    before, here, after = (
        path.scaled(each.x, each.forces)
        for each in (
            branch.motions[max(place - 1, 0)],
            found,
            branch.motions[min(place + 1, len(branch) - 1)],
        )
    )
    curve = path.curve()
    for direction in curve.crossing_directions(here, after - before, after):
        for distance in _DISTANCES:
            z = curve.beside(here, direction, distance)
            if z is not None:
                x, forces = path.plain(z)
                yield _fixed(SteadyMotion(path.problem, x, forces), branch)
