"""All steady motions within ranges: searches from many starts, spread evenly and the same each time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from numbers import Integral

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ArgumentError, ParameterError
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import described, with_known_names
from symbody.symbolic.numeric.deficiency import reporting

from .force_balance import BALANCED
from .steady import check_single, solved
from .steady_motion import SteadyMotion
from .steady_problem import Search, SteadyProblem, steady_problem
from .steady_variables import Limits

__all__ = ["steady_motions"]

Array = NDArray[np.float64]
_WHERE = "steady_motions"
_SAME = 1e-6
"""The relative distance below which two solutions count as one."""


@with_known_names
def steady_motions(
    eqs: Equations,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    *,
    within: Limits,
    starts: int = 64,
    given: Mapping[Expr, ArrayLike] | None = None,
    unknown: Iterable[Expr] = (),
    guess: Mapping[Expr, ArrayLike] | None = None,
    held: Iterable[Expr] = (),
    inputs: Mapping[Expr, ExprLike] | None = None,
    t: float = 0.0,
) -> tuple[SteadyMotion, ...]:
    """Return the steady motions within ranges that are found from many starts, the least values first.

    The starts are points of a Sobol sequence [Sobol 1967], the same each time. More starts may find more motions; no
    number of them proves that there are no others.

    Args:
        eqs: the equations of motion.
        parameters: the values of all symbols.
        within: the least and the largest values of some unknowns. Starts are spread over these ranges, and motions
            beyond them are left out.
        starts: the number of starts, rounded up to a power of two.
        given: values of variables, as in `steady`.
        unknown: inputs and parameters that are solved for.
        guess: the values of other unknowns at all starts.
        held: coordinates along which forces keep the motion.
        inputs: expressions of time and state for the input functions of time.
        t: the time in loads and constraints, in s.

    Raises:
        ArgumentError: `starts` is not a positive whole number, or a range is not two numbers.
        SimulationError: none was found, or one is not isolated.
        ParameterError: a value is missing, has an unknown key, or is not finite; or a range is not finite.

    >>> from symbody import newton_euler, time_derivative
    >>> from symbody.models import heavy_top
    >>> top = heavy_top()
    >>> turn, spin = time_derivative(top["psi"]), time_derivative(top["phi"])
    >>> given = {top["theta"]: 0.3, spin: 150}
    >>> found = steady_motions(newton_euler(top.system), top.parameters, given=given, within={turn: (-50, 50)})
    >>> [round(each[turn], 6) for each in found]  # the slow and the fast precession
    [2.472044, 13.641591]
    """
    with reporting(_WHERE):
        if not isinstance(starts, Integral) or starts < 1:
            raise ArgumentError(f"{_WHERE}, starts: {described(starts)}; expected a whole number, 1 or more")
        within = within or {}
        problem = steady_problem(
            Search(eqs, parameters, given, unknown, guess, within, held, t, inputs, _WHERE, "within")
        )
        found: list[SteadyMotion] = []
        for start in _starts(problem, within, starts):
            x, forces = problem.balance.solution(start)
            if problem.balance.error(x, forces) <= BALANCED and _is_within(x, problem.limits):
                if problem.turned_joint(x):
                    continue
                known = (motion for motion in found if np.allclose(motion.x, x, rtol=_SAME, atol=_SAME))
                if next(known, None) is None:
                    check_single(problem, x, forces)
                    found.append(SteadyMotion(problem, x, forces))
        if not found:
            x, forces = solved(problem)
            check_single(problem, x, forces)
            found.append(SteadyMotion(problem, x, forces))
    names = [name for name in problem.names if name in within]
    return tuple(sorted(found, key=lambda motion: [motion[name] for name in names]))


def _starts(problem: SteadyProblem, within: Limits, count: int) -> list[Array]:
    """Return starts within ranges.

    Raises:
        ParameterError: a range is not finite, or there is none.
    """
    from scipy.stats.qmc import Sobol  # noqa: PLC0415 - slow to load, and needed here alone

    places = [problem.names.index(name) for name in within]
    if not places or not np.isfinite(problem.limits[places]).all():
        name = next(iter(within), problem.names[int(np.argmax(problem.balance.is_free))])
        raise ParameterError(
            f"{_WHERE}, within: {'no ranges' if not places else f'the range of {name} is not finite'}; expected the "
            f"ranges over which starts are spread, such as within={{{name}: (-1, 1)}}"
        )
    low, high = problem.limits[places].T
    points = Sobol(len(places), scramble=True, seed=1).random_base2(max(0, int(np.ceil(np.log2(count)))))
    starts = np.tile(problem.start, (len(points), 1))
    starts[:, places] = low + points * (high - low)
    return [problem.start, *starts]


def _is_within(x: Array, limits: Array) -> bool:
    return bool((x >= limits[:, 0]).all() and (x <= limits[:, 1]).all())
