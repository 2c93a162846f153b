"""Consistent velocities: speeds that satisfy the rates of constraints, as close as possible to given values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError
from symbody.multibody.named_constraint import named_constraint
from symbody.symbolic import Expr, time_derivative
from symbody.symbolic.given.arguments import brief

from .consistent_position import EXACT, ROUNDED, listed_values
from .contradiction import contradiction_between, contradictory_equations
from .kinematics import Kinematics
from .least_norm import RANK, least_norm
from .singular_kinematics import another_choice, singular_kinematics

__all__ = ["velocities"]

Array = NDArray[np.float64]

_WHERE = "consistent_state"
POLISHED = 1e-3
"""The largest correction of given speeds, relative to the largest speed."""


def velocities(
    kinematics: Kinematics,
    p: Array,
    t: float,
    q: Array,
    fixed: Mapping[Expr, float],
    guess: Mapping[Expr, float],
) -> Array:
    """Return the speeds, shape (n,): the fixed values, and the smallest change of the others from their guess.

    If rates of coordinates are fixed and no speeds of the user's choice, the other rates change least from their guess:
    such speeds are combinations of rates, and of a coordinate that nobody mentions one expects that it rests.

    Where the speeds are momenta and none of these is given, they are those of such speeds. Fixed rates of coordinates
    that are not speeds, ``q' = K u + k``, are conditions like those of the constraints; so are eliminated speeds.

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
    if kinematics.system.momenta and kinematics.system.momenta.keys().isdisjoint((*fixed, *guess)):
        whole = kinematics.in_speeds
        u = velocities(whole, kinematics.parameters_of(whole, p), t, q, fixed, guess)
        return np.asarray(kinematics.momenta(t, np.concatenate([q, u]), p), dtype=np.float64)
    speeds, m = kinematics.system.speeds, len(kinematics.constraints)
    A, b = kinematics.velocity(t, q, p)
    if kinematics.eliminated:
        more, rest = kinematics.eliminated_speeds(t, q, p)
        A, b = np.vstack([A, more]), np.append(b, rest)
    K, k = A[m:], b[m:]
    near = _guessed(kinematics, K, k, guess)
    u, is_free = near.copy(), np.array([speed not in fixed for speed in speeds])
    u[~is_free] = [fixed[speed] for speed in speeds if speed in fixed]
    places, values = _given_rates(kinematics, fixed)
    rows = [*range(m), *(m + place for place in places)]
    _check_finite(kinematics, q, A, b, rows if not _has_rates_only(kinematics, fixed) else range(len(A)))
    A, b = A[rows], -b[rows] + np.array([0.0] * m + values)
    least = np.append(_usual_sizes(kinematics, p, t, q), np.zeros(len(places)))
    change, kernel = least_norm(A[:, is_free], b - A @ u)
    u[is_free] += change
    if _has_rates_only(kinematics, fixed):
        excess = K @ u + k - _rates_near(kinematics, K @ near + k, guess)
        of_coordinates = slice(len(kinematics.system.coordinates))
        u[is_free] += kernel @ _quietest(excess[of_coordinates], (K[:, is_free] @ kernel)[of_coordinates])
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
            contradiction = contradiction_between(kinematics.system.conditions, against)
            raise ConstraintError(f"{_WHERE}: at t = {t:g} s {contradiction}")
        singular = singular_kinematics(kinematics, p, t, q) if places else ""
        raise ConstraintError(_impossible(kinematics, t, error, places, fixed, singular))
    return u


def _check_finite(kinematics: Kinematics, q: Array, A: Array, b: Array, rows: Sequence[int]) -> None:
    """Check that the rates of constraints, and the rates of coordinates that are needed, are finite.

    Args:
        kinematics: the constraints and the kinematics.
        q: the coordinates.
        A: the rates by the speeds.
        b: the rates at zero speeds.
        rows: the rows of those that are needed.
    """
    worst = next((k for k in rows if not (np.isfinite(A[k]).all() and np.isfinite(b[k]))), None)
    if worst is None:
        return
    system, m = kinematics.system, len(kinematics.constraints)
    place = listed_values(system.coordinates, dict(zip(system.coordinates, q, strict=True)))
    if worst < m:
        raise ConstraintError(
            f"{_WHERE}: the rate of constraint {worst + 1}, {named_constraint(system.conditions[worst])}, is not "
            f"finite at {place}; expected no division by zero, and no root or logarithm of a negative value, there"
        )
    raise ConstraintError(
        f"{_WHERE}: the kinematics {_equation(kinematics, worst - m)} are not finite at {place}; "
        f"{another_choice(kinematics)}"
    )


def _equation(kinematics: Kinematics, place: int) -> str:
    """Return the equation that gives the rate of a coordinate, or an eliminated speed."""
    system, left = kinematics.system, _rates(kinematics)[place]
    right = system.eliminated[left] if left.order == 0 else system.kinematics[left]
    return f"{left} = {brief(right)}"


def _usual_sizes(kinematics: Kinematics, p: Array, t: float, q: Array) -> Array:
    """Return the usual magnitudes of the constraints' gradients, even where these vanish: terms over coordinates."""
    with np.errstate(all="ignore"):
        _, _, sizes = kinematics.position(t, q, p)
    return kinematics.among_all(np.where(np.isfinite(sizes), sizes, 0.0) / float(np.abs(q).max(initial=1.0)))


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
    """Return the speeds of minimum norm with the guessed values of speeds and of rates of coordinates."""
    u = np.array([guess.get(speed, 0.0) for speed in kinematics.system.speeds])
    places, values = _given_rates(kinematics, guess)
    shift: Array = least_norm(K[places], np.array(values) - k[places] - K[places] @ u)[0]
    return u + shift


def _has_rates_only(kinematics: Kinematics, fixed: Mapping[Expr, float]) -> bool:
    """Return whether rates are fixed, and none of the speeds that are no rates, of which there are some."""
    system = kinematics.system
    chosen = {u for u in (*system.speeds, *system.eliminated) if u.order == 0}
    return bool(chosen) and chosen.isdisjoint(fixed) and any(rate in fixed for rate in _rates(kinematics))


def _rates_near(kinematics: Kinematics, near: Array, guess: Mapping[Expr, float]) -> Array:
    """Return the rates near which the others should be: those of guessed speeds, or the guessed ones, or zero."""
    rates = _rates(kinematics)
    if any(name.order == 0 and name in guess for name in (*kinematics.system.speeds, *kinematics.eliminated)):
        return near
    return np.array([guess.get(rate, 0.0) for rate in rates])


def _quietest(rates: Array, slopes: Array) -> Array:
    """Return the shortest x with the least ``|rates + slopes x|``: unlike in `least_norm`, all rates count alike."""
    return np.asarray(np.linalg.lstsq(slopes, -rates, rcond=RANK)[0], dtype=np.float64)


def _given_rates(kinematics: Kinematics, given: Mapping[Expr, float]) -> tuple[list[int], list[float]]:
    """Return the places of rates of coordinates, and of eliminated speeds, that are given but no speeds; the values."""
    speeds, rates = kinematics.system.speeds, _rates(kinematics)
    places = [place for place, rate in enumerate(rates) if rate in given and rate not in speeds]
    return places, [given[rates[place]] for place in places]


def _rates(kinematics: Kinematics) -> list[Expr]:
    """Return what may be given instead of speeds: the rates of the coordinates, then eliminated speeds."""
    return [*(time_derivative(q) for q in kinematics.system.coordinates), *kinematics.eliminated]


def _impossible(
    kinematics: Kinematics,
    t: float,
    error: Array,
    places: Sequence[int],
    fixed: Mapping[Expr, float],
    singular: str,
) -> str:
    """Return which equation no speeds satisfy, and the way out.

    Args:
        kinematics: the constraints.
        t: the time, in s.
        error: the relative residuals of the equations for speeds.
        places: the places of fixed rates and eliminated speeds.
        fixed: the values of fixed speeds and rates.
        singular: which speeds and rates hardly determine each other in this position.
    """
    system = kinematics.system
    rates = [_rates(kinematics)[place] for place in places]
    conditions = [
        *(
            f"satisfy constraint {k + 1}, {named_constraint(each)},"
            for k, each in enumerate(system.conditions)
        ),
        *(f"satisfy the kinematics {_equation(kinematics, place)}" for place in places),
    ]
    worst = conditions[int(np.argmax(np.where(np.isfinite(error), error, np.inf)))]
    named = [name for name in dict.fromkeys((*system.speeds, *rates)) if name in fixed]
    if not named:
        return (
            f"{_WHERE}: no speeds {worst} at t = {t:g} s in this position: the constraints change with time, and the "
            "system can't follow; give other coordinates"
        )
    way_out = (
        f"{singular}; {another_choice(kinematics)}"
        if singular
        else "give some of them as a guess instead, so that they are solved for"
    )
    return f"{_WHERE}: no speeds with {listed_values(named, fixed)} {worst} at t = {t:g} s in this position; {way_out}"
