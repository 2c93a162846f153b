"""Consistent states: positions and velocities that satisfy the constraints, as close as possible to given values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ConstraintError
from symbody.simulation.given.unused import warn_of_unused
from symbody.simulation.given.values import check_equations, parameter_values, state_values
from symbody.simulation.model.named_constraint import shortened
from symbody.symbolic import Expr, ExprLike, number, time_derivative
from symbody.symbolic.numeric.deficiency import reporting

from .contradiction import contradiction_between, contradictory_equations
from .gauss_newton import gauss_newton
from .kinematics import Kinematics, kinematics_of, neutral_position
from .least_norm import least_norm

__all__ = ["consistent_state", "solved_state", "term_sizes"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_WHERE = "consistent_state"
EXACT = 1e-10
"""The relative violation up to which a constraint counts as satisfied."""
ROUNDED = 1e-6
"""The relative violation, as of numbers with seven digits, up to which given values are corrected as well."""
POLISHED = 1e-3
"""The largest correction of given speeds, relative to the largest speed."""


def consistent_state(
    eqs: Equations,
    parameters: Mapping[Expr, ArrayLike] | None,
    initial: Mapping[Expr, ArrayLike] | None,
    *,
    guess: Mapping[Expr, ArrayLike] | None = None,
    t: float = 0.0,
    inputs: Mapping[Expr, ExprLike] | None = None,
) -> dict[Expr, float]:
    """Return a state that has the given values and satisfies the constraints; the other values change least.

    ``min |q - q0|^2`` with ``phi(q, t) = 0``, then ``min |u - u0|^2`` with ``phi_q u + phi_t = 0``, over the values
    that are not given [Nikravesh 1988, sec. 5.2; Eich-Soellner & Fuehrer 1998, sec. 5.4]. Constraints may be
    dependent. Given values that violate the constraints by rounding, a millionth of the terms, are corrected.

    Args:
        eqs: the equations of motion.
        parameters: the values of the symbols in the constraints; others are allowed.
        initial: the values of coordinates, rates of coordinates and speeds that are fixed.
        guess: the values near which the others should be, q0 and u0. By default, they are zero, and floating frames are
            not rotated.
        t: the time, in s.
        inputs: expressions of time for the input functions of time.

    Returns:
        All coordinates, then all speeds.

    Raises:
        ConstraintError: no state with these values satisfies the constraints, or none was found.
        ParameterError: a value is missing, has an unknown key, or is not finite.

    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, time_derivative, translate
    >>> x, y = functions_of_time("x y")
    >>> m, l = symbols("m l")
    >>> pendulum = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x**2 + y**2 - l**2])
    >>> state = consistent_state(newton_euler(pendulum), {l: 5}, {x: 3, time_derivative(x): 4}, guess={y: -1})
    >>> [round(value, 12) for value in state.values()]
    [3.0, -4.0, 4.0, 3.0]
    """
    with reporting(_WHERE):
        check_equations(eqs, _WHERE)
        state = solved_state(kinematics_of(eqs, inputs), parameters, initial, guess, t)
    warn_of_unused(eqs, parameters or {}, [number(value) for value in (inputs or {}).values()], _WHERE)
    return state


def solved_state(
    kinematics: Kinematics,
    parameters: Mapping[Expr, ArrayLike] | None,
    initial: Mapping[Expr, ArrayLike] | None,
    guess: Mapping[Expr, ArrayLike] | None,
    t: float,
) -> dict[Expr, float]:
    """Return the state of `consistent_state`, without notices of unused parameters, which `simulate` gives itself.

    Args:
        kinematics: the constraints and the kinematics.
        parameters: the values of the parameters.
        initial: the values that are fixed.
        guess: the values near which the others should be.
        t: the time, in s.
    """
    kinematics.check_inputs(_WHERE)
    p = parameter_values(kinematics.parameters, parameters, where=_WHERE)
    fixed = state_values(kinematics.system, initial, where=_WHERE)
    near = state_values(kinematics.system, guess, where=_WHERE, argument="guess")
    q = positions(kinematics, p, t, fixed, near)
    u = velocities(kinematics, p, t, q, fixed, near)
    names = (*kinematics.system.coordinates, *kinematics.system.speeds)
    return dict(zip(names, map(float, [*q, *u]), strict=True))


@dataclass(frozen=True, eq=False)
class Positions:
    """The equations ``phi(q, t) = 0`` for some of the coordinates, relative to the magnitudes of their terms."""

    kinematics: Kinematics
    p: Array
    t: float
    scale: Array

    @classmethod
    def at(cls, kinematics: Kinematics, p: Array, t: float, q: Array) -> Positions:
        """Return the equations, scaled at the position where the search starts."""
        with np.errstate(all="ignore"):
            _, phi_q, sizes = kinematics.position(t, q, p)
        return cls(kinematics, p, t, term_sizes(q, phi_q, sizes))

    def linearization(self, q: Array, is_free: Flags) -> tuple[Array, Array]:
        """Return the scaled constraints and their derivatives with respect to the free coordinates."""
        with np.errstate(all="ignore"):
            phi, phi_q, _ = self.kinematics.position(self.t, q, self.p)
            return phi / self.scale, phi_q[:, is_free] / self.scale[:, None]

    def error(self, q: Array) -> float:
        """Return the largest relative violation; infinity if a constraint is not finite."""
        with np.errstate(all="ignore"):
            phi, phi_q, sizes = self.kinematics.position(self.t, q, self.p)
        error = float(np.max(np.abs(phi) / term_sizes(q, phi_q, sizes)))
        return error if np.isfinite(error) else np.inf

    def solution(self, q: Array, is_free: Flags, most: int = 200) -> Array:
        """Return the position after Gauss-Newton steps of the free coordinates, at most as many as given."""
        found = q.copy()

        def of_free(free: Array) -> tuple[Array, Array]:
            found[is_free] = free
            return self.linearization(found, is_free)

        found[is_free] = gauss_newton(of_free, q[is_free], most)
        return found


def positions(
    kinematics: Kinematics,
    p: Array,
    t: float,
    fixed: Mapping[Expr, float],
    guess: Mapping[Expr, float],
    where: str = _WHERE,
) -> Array:
    """Return the coordinates, shape (n_q,): the fixed values, and the least change of the others from their guess.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        fixed: the values of fixed coordinates.
        guess: the values near which the others should be.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: no position was found that satisfies the constraints.
    """
    coordinates = kinematics.system.coordinates
    neutral = neutral_position(kinematics.system)
    start = np.array([fixed.get(q, guess.get(q, zero)) for q, zero in zip(coordinates, neutral, strict=True)])
    is_free = np.array([q not in fixed for q in coordinates])
    if not kinematics.constraints:
        return start
    best, least = start, np.inf
    for beginning in starting_points(start, is_free):
        problem = Positions.at(kinematics, p, t, beginning)
        found = problem.solution(beginning, is_free)
        if problem.error(found) <= EXACT:
            return _nearest(problem, start, found, is_free)
        if problem.error(found) <= ROUNDED:
            polished = problem.solution(found, np.ones_like(is_free))
            if problem.error(polished) <= EXACT and np.allclose(polished, found, rtol=1e-4, atol=1e-4):
                return polished
        if problem.error(found) < least:
            best, least = found, problem.error(found)
    raise ConstraintError(f"{where}: {_unsatisfied(kinematics, p, t, best, fixed)}")


def starting_points(start: Array, is_free: Flags) -> Iterator[Array]:
    """Yield the start, then points around it at growing distances: if the start is singular, they are not."""
    yield start
    if not is_free.any():
        return
    directions = np.random.Generator(np.random.PCG64(1))
    for size in (1e-2, 1e-1, 0.3, 1.0, 1.0, 3.0, 3.0, 3.0, 10.0, 10.0):
        shift = directions.uniform(-1, 1, len(start)) * is_free
        yield start + size * np.maximum(np.abs(start), 0.3) * shift


def term_sizes(q: Array, phi_q: Array, sizes: Array) -> Array:
    """Return the magnitudes of the terms of the constraints, at least those by a thousandth of the coordinates."""
    scale = np.maximum(sizes, 1e-3 * np.abs(phi_q) @ np.maximum(np.abs(q), 1))
    return np.where(np.isfinite(scale) & (scale > 0), scale, 1.0)


def _nearest(problem: Positions, start: Array, found: Array, is_free: Flags) -> Array:
    """Return the solution nearest to the start, by descent from a solution that was found.

    Each step projects the difference to the start onto the tangent space, and then returns to the constraints.
    """
    share = 1.0
    for _ in range(_APPROACHES):
        _, J = problem.linearization(found, is_free)
        _, tangents = least_norm(J, np.zeros(len(J)))
        back = np.zeros_like(found)
        back[is_free] = tangents @ (tangents.T @ (start - found)[is_free])
        if np.abs(back).max() <= 1e-10 * (1 + np.abs(found).max()):
            break
        nearer = problem.solution(found + share * back, is_free)
        if problem.error(nearer) <= EXACT and _distance(nearer, start) < _distance(found, start):
            found, share = nearer, min(1.0, 2 * share)
        elif share > 1e-3:
            share /= 4
        else:
            break
    return found


_APPROACHES = 60


def _distance(a: Array, b: Array) -> float:
    return float(np.linalg.norm(a - b))


def velocities(
    kinematics: Kinematics,
    p: Array,
    t: float,
    q: Array,
    fixed: Mapping[Expr, float],
    guess: Mapping[Expr, float],
) -> Array:
    """Return the speeds, shape (n,): the fixed values, and the least change of the others from their guess.

    Fixed rates of coordinates that are not speeds, ``q' = K u + k``, are conditions like those of the constraints.

    Args:
        kinematics: the constraints and the kinematics.
        p: the values of their parameters.
        t: the time, in s.
        q: the coordinates.
        fixed: the values of fixed speeds and rates.
        guess: the values near which the others should be.

    Raises:
        ConstraintError: no speeds with these values satisfy the constraints.
    """
    speeds, m = kinematics.system.speeds, len(kinematics.constraints)
    A, b = kinematics.velocity(t, q, p)
    u = _guessed(kinematics, A[m:], b[m:], guess)
    is_free = np.array([speed not in fixed for speed in speeds])
    u[~is_free] = [fixed[speed] for speed in speeds if speed in fixed]
    places, values = _given_rates(kinematics, fixed)
    rows = [*range(m), *(m + place for place in places)]
    A, b = A[rows], -b[rows] + np.array([0.0] * m + values)
    least = np.append(_usual_sizes(kinematics, p, t, q), np.zeros(len(places)))
    u[is_free] += least_norm(A[:, is_free], b - A @ u)[0]
    error = _relative(A, b, u, least)
    if (error > EXACT).any() and (error <= ROUNDED).all():
        change = least_norm(A, b - A @ u)[0]
        # Where a gradient vanishes, its direction is a rounding error: speeds that are nearly right are not changed.
        if np.abs(change).max() <= POLISHED * np.abs(u).max():
            u = u + change
        error = _relative(A, b, u, least)
    if not (error <= ROUNDED).all():
        against = contradictory_equations(A[:m], b[:m], np.abs(b[:m])) if np.isfinite(A).all() else ()
        if against:
            contradiction = contradiction_between(kinematics.system.constraints, against)
            raise ConstraintError(f"{_WHERE}: at t = {t:g} s {contradiction}")
        raise ConstraintError(_impossible(kinematics, t, error, places, fixed))
    return u


def _usual_sizes(kinematics: Kinematics, p: Array, t: float, q: Array) -> Array:
    """Return the usual magnitudes of the constraints' gradients, even where these vanish: terms over coordinates."""
    with np.errstate(all="ignore"):
        _, _, sizes = kinematics.position(t, q, p)
    usual: Array = np.where(np.isfinite(sizes), sizes, 0.0) / max(1.0, float(np.abs(q).max()))
    return usual


def _relative(A: Array, b: Array, u: Array, least: Array) -> Array:
    """Return the residuals of equations relative to the magnitudes of their terms.

    Args:
        A: the left sides.
        b: the right sides.
        u: the speeds.
        least: a lower bound for the sum of each row.
    """
    size = np.maximum(np.abs(A).sum(axis=1), least) * np.abs(u).max(initial=0.0) + np.abs(b)
    error: Array = np.abs(A @ u - b) / np.where(size > 0, size, 1)
    return error


def _guessed(kinematics: Kinematics, K: Array, k: Array, guess: Mapping[Expr, float]) -> Array:
    """Return the speeds of least norm with the guessed values of speeds and of rates of coordinates."""
    u = np.array([guess.get(speed, 0.0) for speed in kinematics.system.speeds])
    places, values = _given_rates(kinematics, guess)
    shift: Array = least_norm(K[places], np.array(values) - k[places] - K[places] @ u)[0]
    return u + shift


def _given_rates(kinematics: Kinematics, given: Mapping[Expr, float]) -> tuple[list[int], list[float]]:
    """Return the indices of the coordinates whose rates are given but are not speeds, and these rates."""
    speeds = kinematics.system.speeds
    rates = [time_derivative(q) for q in kinematics.system.coordinates]
    places = [place for place, rate in enumerate(rates) if rate in given and rate not in speeds]
    return places, [given[rates[place]] for place in places]


def _unsatisfied(kinematics: Kinematics, p: Array, t: float, q: Array, fixed: Mapping[Expr, float]) -> str:
    """Return which constraints are violated where the search ended, and the way out.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        q: the nearest coordinates that were found, shape (n_q,).
        fixed: the values of fixed coordinates.
    """
    phi, phi_q, sizes = kinematics.position(t, q, p)
    system = kinematics.system
    against = (
        contradictory_equations(phi_q, phi, term_sizes(q, phi_q, sizes)) if np.isfinite(phi_q).all() else ()
    )
    if against:
        return f"at t = {t:g} s {contradiction_between(system.constraints, against)}"
    named = [name for name in system.coordinates if name in fixed]
    left = [
        f"constraint {k + 1}, {shortened(constraint)} = 0, is off by {phi[k]:.3g}"
        for k, constraint in enumerate(system.constraints)
        if not abs(phi[k]) <= EXACT * sizes[k]
    ]
    found = "; ".join(left[:_NAMED]) + (f"; and {len(left) - _NAMED} more" if len(left) > _NAMED else "")
    if named and len(named) == len(system.coordinates):
        return (
            f"the given coordinates, {_values(named, fixed)}, don't satisfy the constraints at t = {t:g} s: "
            f"{found}; give some of them as a guess instead, so that they are solved for"
        )
    nearest = _values(
        [name for name in system.coordinates if name not in fixed],
        dict(zip(system.coordinates, q, strict=True)),
    )
    what = f"with {_values(named, fixed)}" if named else "from the guess"
    return (
        f"no coordinates were found {what} that satisfy the constraints at t = {t:g} s; nearest, at "
        f"{nearest}: {found}; give fewer or other values, or a guess={{coordinate: value}} near a solution"
    )


def _impossible(
    kinematics: Kinematics, t: float, error: Array, places: Sequence[int], fixed: Mapping[Expr, float]
) -> str:
    """Return which equation no speeds satisfy, and the way out.

    Args:
        kinematics: the constraints.
        t: the time, in s.
        error: the relative residuals of the equations for speeds.
        places: the indices of coordinates whose rates are fixed.
        fixed: the values of fixed speeds and rates.
    """
    system = kinematics.system
    rates = [time_derivative(system.coordinates[place]) for place in places]
    conditions = [
        *(f"satisfy constraint {k + 1}, {shortened(phi)} = 0," for k, phi in enumerate(system.constraints)),
        *(f"give {rate} = {fixed[rate]:.6g}" for rate in rates),
    ]
    worst = conditions[int(np.argmax(np.where(np.isfinite(error), error, np.inf)))]
    named = [name for name in dict.fromkeys((*system.speeds, *rates)) if name in fixed]
    if not named:
        return (
            f"{_WHERE}: no speeds {worst} at t = {t:g} s in this position: the constraints change with time, and the "
            "system can't follow; give other coordinates"
        )
    return (
        f"{_WHERE}: no speeds with {_values(named, fixed)} {worst} at t = {t:g} s in this position; give some of them "
        "as a guess instead, so that they are solved for"
    )


_NAMED = 4


def _values(names: Sequence[Expr], values: Mapping[Expr, float]) -> str:
    shown = ", ".join(f"{name} = {values[name]:.6g}" for name in names[:_LISTED])
    return shown + (", ..." if len(names) > _LISTED else "")


_LISTED = 12
