"""Steady motions: constant speeds and states, and the inputs and parameters that keep them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ConstraintError, SimulationError, notify
from symbody.simulation.constraint.consistent_position import listed_values
from symbody.simulation.given.watched_limit import tell_passed_limits
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic import t as time
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.given.wording import joined_by_and
from symbody.symbolic.numeric.deficiency import reporting

from .reached_limit import reached_limits
from .steady_motion import SteadyMotion
from .steady_problem import Search, SteadyProblem, steady_problem
from .steady_variables import Limits
from .undetermined_forces import UndeterminedForces
from .value_table import without_noise
from .whole_turns import without_whole_turns

__all__ = ["check_single", "solved", "steady"]

_WHERE = "steady"
Array = NDArray[np.float64]


@with_known_names
def steady(
    eqs: Equations,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    *,
    given: Mapping[Expr, ArrayLike] | None = None,
    unknown: Iterable[Expr] = (),
    guess: Mapping[Expr, ArrayLike] | None = None,
    limits: Limits | None = None,
    held: Iterable[Expr] = (),
    inputs: Mapping[Expr, ExprLike] | None = None,
    t: float = 0.0,
) -> SteadyMotion:
    """Return a steady motion (trim): one with constant speeds, states and coordinates, but for ignorable ones.

    ``-forcing - phi_q^T lambda = 0`` at zero accelerations, with ``phi = 0``, ``A u + b = 0``, ``z' = 0``, and
    ``q' = 0`` for all coordinates that matter, by damped Gauss-Newton steps with exact derivatives. Coordinates on
    which nothing depends, such as the spin of a wheel, may move at constant rates (relative equilibrium
    [Marsden & Ratiu 1999, sec. 1.10]). If all directions of the plane of two coordinates x and y are alike, the
    velocity (x', y') may turn with the heading, so that a vehicle drives in a circle.

    Args:
        eqs: the equations of motion.
        parameters: the values of all symbols.
        given: values of coordinates, speeds and states, of inputs or parameters, and of expressions of these, such as a
            lateral acceleration.
        unknown: inputs and parameters that are solved for. The state is solved for where it is not given.
        guess: values near the steady motion. By default, they are zero, or those in `parameters` and `inputs`.
        limits: the least and the largest values of unknowns.
        held: coordinates along which forces keep the motion; the result has these forces as `holding`.
        inputs: expressions of time and state for the input functions of time.
        t: the time in loads and constraints, in s.

    Raises:
        SimulationError: no steady motion was found, or it is not isolated, or given values can't be those of one.
        ConstraintError: no position with the given coordinates satisfies the constraints.
        ParameterError: a value is missing, has an unknown key, or is not finite.

    >>> from math import pi
    >>> from symbody import Body, System, Vector, functions_of_time, ground, newton_euler, rotate, symbols, translate
    >>> from symbody import time_derivative
    >>> (psi, theta), (m, l, g) = functions_of_time("psi theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", psi) * rotate("Y", theta) * translate(0, 0, -l), m)
    >>> eqs = newton_euler(System([bob], coordinates=[psi, theta], gravity=Vector(ground, 0, 0, -g)))
    >>> cone = steady(eqs, {m: 1, l: 2, g: 9}, given={theta: pi / 3}, guess={time_derivative(psi): 2})
    >>> round(cone[time_derivative(psi)], 12), cone.ignorable  # omega**2 = g/(l cos(theta))
    (3.0, (psi,))
    """
    with reporting(_WHERE):
        problem = steady_problem(Search(eqs, parameters, given, unknown, guess, limits, held, t, inputs))
        x, forces = solved(problem)
        check_single(problem, x, forces)
        x = without_whole_turns(problem, x, forces)
        undetermined = UndeterminedForces(problem.balance, x, forces)
        found = SteadyMotion(problem, x, undetermined.least_forces)
        found = replace(found, forces=undetermined.shared(found.evaluate))
    text = undetermined.notice()
    if text:
        notify(f"{_WHERE}: {text}")
    values = {**found.parameters, **found.known, time: found.t}
    tell_passed_limits(eqs.system, values, problem.inputs, _WHERE)
    return found


def solved(problem: SteadyProblem) -> tuple[Array, Array]:
    """Return a steady motion within the limits, found from the start or from points around it.

    Raises:
        SimulationError: none was found.
    """
    found = problem.balance.searched(problem.start, problem.limits)
    if found.solution is not None:
        fault = problem.turned_joint(found.solution[0])
        if fault:
            raise ConstraintError(f"{problem.where}: {fault}")
        return found.solution
    if found.beyond is not None:
        raise SimulationError(_limited(problem, found.beyond[0]))
    raise SimulationError(_unsteady(problem, *found.nearest))


def _limited(problem: SteadyProblem, x: Array) -> str:
    names, (low, high) = problem.names, problem.limits.T
    met = [
        f"{name} = {value:.6g}, beyond its limits {least:g} and {most:g}"
        for name, value, least, most in zip(names, without_noise(list(x)), low, high, strict=True)
        if not least <= value <= most
    ]
    return (
        f"{problem.where}: none was found within the limits; the nearest one needs {joined_by_and(met)}; expected "
        "wider limits, other given values, or a guess nearer to another one"
    )


def check_single(problem: SteadyProblem, x: Array, forces: Array) -> None:
    """Check that a steady motion is isolated.

    Raises:
        SimulationError: there is another one nearby: too many unknowns; or derivatives are not finite.
    """
    _, slopes, _ = problem.balance.values(x, forces)
    if not np.isfinite(slopes).all():
        row = int(np.argmin(np.isfinite(slopes).all(axis=1)))
        name = problem.balance.conditions.names[row].rstrip(",")
        raise SimulationError(
            f"{problem.where}: {name} has no derivative at {_place(problem, x)}; expected laws of loads that have one "
            "there: give another speed, or slips a least speed, such as sqrt(u**2 + v0**2) for u"
        )
    if problem.balance.other_nearby(x, forces) is None:
        return
    directions = problem.balance.neutral(x, forces)
    size = np.abs(directions).max(axis=1)
    moved = [str(name) for name, share in zip(problem.names, size, strict=True) if share > 1e-3 * size.max()]
    freest = int(np.argmax(size))
    count = directions.shape[1]
    subject = f"{moved[0]} can" if len(moved) == 1 else f"{joined_by_and(moved)} can together"
    more = f"{count} more" if count > 1 or len(moved) > 1 else "it"
    which = f" of these {len(moved)}" if len(moved) > 1 else ""
    raise SimulationError(
        f"{problem.where}: the unknowns are too many: {subject} be changed, and the motion stays steady; give "
        f"{more}{which}, such as given={{{problem.names[freest]}: {x[freest]:.6g}}}"
    )


def _unsteady(problem: SteadyProblem, x: Array, forces: Array) -> str:
    balance = problem.balance
    F, _, _ = balance.values(x, forces)
    error = np.abs(F / balance.scale(x, forces))
    worst = int(np.argmax(np.where(np.isfinite(error), error, np.inf)))
    return (
        f"{problem.where}: none was found; nearest, at {_place(problem, x)}: "
        f"{balance.conditions.names[worst].rstrip(',')} is off by {F[worst]:.3g}{_limits(problem, x)}; "
        f"{_way_out(problem, x, forces)}"
    )


def _limits(problem: SteadyProblem, x: Array) -> str:
    """Return which motors are at their limits."""
    values = problem.parameters | dict(zip(problem.names, map(float, x), strict=True))
    unknown = {symbol: values[name] for name, symbol in problem.inputs.items() if name in values}
    return reached_limits(problem.balance.equations.system, problem.inputs, values | unknown)


def _place(problem: SteadyProblem, x: Array) -> str:
    """Return the values of the unknowns, the first ones at least; of what is given if nothing is unknown."""
    is_free = problem.balance.is_free
    is_shown = is_free if is_free.any() else ~is_free
    shown = [problem.names[k] for k in np.flatnonzero(is_shown)]
    return listed_values(shown, dict(zip(problem.names, without_noise(list(x)), strict=True)))


def _way_out(problem: SteadyProblem, x: Array, forces: Array) -> str:
    """Return which unknowns are missing, if some are, or else that another guess may help."""
    balance = problem.balance
    _, slopes, _ = balance.values(x, forces)
    if not np.isfinite(slopes).all():
        return "the equations are not finite there: give a guess nearer to the steady motion"
    scaled = slopes / balance.scale(x, forces)[:, None]
    is_free = np.concatenate([balance.is_free, np.ones(balance.count, dtype=bool)])
    F = (balance.values(x, forces)[0] / balance.scale(x, forces))[:, None]
    free = scaled[:, is_free]
    rank = _rank(free)
    if _rank(np.hstack([free, F])) == rank:
        return "give a guess nearer to the steady motion"
    helping = [
        str(problem.names[k])
        for k in np.flatnonzero(~balance.is_free)
        if problem.names[k] not in balance.conditions.course.ignorable
        and _rank(np.hstack([free, scaled[:, [k]]])) > rank
    ]
    names = [str(problem.names[k]) for k in np.flatnonzero(balance.is_free)]
    verb = "doesn't" if len(names) == 1 else "don't"
    unknowns = f"{joined_by_and(names)} alone {verb} suffice" if names else "nothing is unknown"
    given = f"leave {joined_by_and(helping, last='or')} out of what is given, " if helping else ""
    inputs = [str(name) for name in problem.inputs if name not in problem.names]
    example = f" such as {inputs[0]}" if inputs else ""
    return (
        f"{unknowns}: {given}{'or ' if given else ''}name a parameter or an input{example} in unknown=[...], or a "
        "coordinate along which a force may act in held=[...]"
    )


def _rank(A: Array) -> int:
    """Return the rank of a matrix with columns of different units."""
    size = np.abs(A).max(axis=0, initial=0.0)
    s = np.linalg.svd(A / np.where(size > 0, size, 1.0), compute_uv=False)
    return int(np.sum(s > 1e-8 * s.max(initial=0.0)))
