"""Consistent states: positions and velocities that satisfy the constraints, as close as possible to given values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ConstraintError, notify
from symbody.multibody import Variables
from symbody.multibody.named_constraint import named_constraints
from symbody.simulation.given.odd_values import warn_of_odd_values
from symbody.simulation.given.values import check_equations, parameter_values, state_values
from symbody.simulation.given.watched_limit import tell_passed_limits
from symbody.symbolic import Expr, ExprLike, number
from symbody.symbolic import t as time
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.numeric.deficiency import reporting

from .consistent_position import positions
from .consistent_velocity import velocities
from .kinematics import Kinematics, kinematics_of
from .singular_kinematics import another_choice, singular_kinematics
from .usual_states import usual_states

__all__ = ["consistent_state", "solved_state"]

_WHERE = "consistent_state"


@with_known_names
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
    that are not given [Nikravesh 1988, sec. 5.2; Eich-Soellner & Fuehrer 1998, sec. 5.4]. If rates q' are given and no
    speeds of the user's choice, ``|q' - q0'|^2`` is least instead of ``|u - u0|^2``. Constraints may be
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
        All coordinates, then all speeds, then the states beside the mechanics: as given, or zero.

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
        kinematics = kinematics_of(eqs, inputs)
        state = solved_state(kinematics, parameters, initial, guess, t)
    notice = _notice(kinematics, parameters, state, t)
    if notice:
        notify(f"{_WHERE}: {notice}")
    expressions = {name: number(value) for name, value in (inputs or {}).items()}
    warn_of_odd_values(eqs, parameters or {}, [*expressions.values()], _WHERE)
    tell_passed_limits(eqs.system, {**(parameters or {}), **state, time: t}, expressions, _WHERE)
    return state


def _notice(
    kinematics: Kinematics, parameters: Mapping[Expr, ArrayLike] | None, state: Mapping[Expr, float], t: float
) -> str:
    system = kinematics.system
    kinematics = kinematics.beside([state[z] for z in system.states])
    p = parameter_values(kinematics.parameters, parameters, where=_WHERE, beside=system.state_names)
    found = singular_kinematics(kinematics, p, t, np.array([state[q] for q in system.coordinates]))
    return found and f"the kinematics are ill-conditioned: {found}; {another_choice(kinematics)}"


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
    system = kinematics.system
    fixed = state_values(system, initial, where=_WHERE)
    near = state_values(system, guess, where=_WHERE, argument="guess")
    z = [fixed.get(state, near.get(state, 0.0)) for state in system.states]
    kinematics = kinematics.beside(z)
    kinematics.check_inputs(_WHERE)
    p = parameter_values(kinematics.parameters, parameters, where=_WHERE, beside=system.state_names)
    usual = usual_states(
        kinematics, p[np.newaxis], t, {name: np.array([x]) for name, x in fixed.items()}, near
    )
    if usual.are_found[0]:  # the others are looked for further
        return _named(system, usual.q[0], usual.u[0], z)
    q = positions(kinematics, p, t, fixed, near)
    _check_finite(kinematics, p, t, q)
    u = velocities(kinematics, p, t, q, fixed, near)
    return _named(system, q, u, z)


def _named(
    system: Variables, q: NDArray[np.float64], u: NDArray[np.float64], z: Iterable[float]
) -> dict[Expr, float]:
    names = (*system.coordinates, *system.speeds, *system.states)
    return dict(zip(names, map(float, [*q, *u, *z]), strict=True))


def _check_finite(kinematics: Kinematics, p: NDArray[np.float64], t: float, q: NDArray[np.float64]) -> None:
    """Check that the constraints are defined on the level of velocities at a position."""
    with np.errstate(all="ignore"):
        A, b = (part[: len(kinematics.constraints)] for part in kinematics.velocity(t, q, p))
    strange = np.flatnonzero(~np.isfinite(np.column_stack([A, b])).all(axis=1))
    if len(strange):
        (name,) = named_constraints(kinematics.system.conditions, strange[:1])
        place = ", ".join(
            f"{name} = {value:.6g}"
            for name, value in zip(kinematics.system.coordinates[:12], q, strict=False)
        )
        raise ConstraintError(
            f"{_WHERE}: constraint {name}, or its rate, isn't finite at {place}; expected a position at which it is "
            "defined: give other coordinates, or look for a division by zero"
        )
