"""Constraints that are dependent where a mechanism moves, but independent at almost all positions or parameters.

Three parallel cranks move a coupler because their lengths agree; six independent equations for six coordinates would
allow no motion. Symbolic rank is generic rank, and at generic positions these coordinates are locked. In the same
way ``k (x - y) = 0`` is a constraint unless k = 0. Such constraints follow from the others, and are left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics.equations.constraint_force import constraint_jacobian
from symbody.errors import ConstraintError
from symbody.multibody import Variables
from symbody.multibody.named_constraint import named_constraints
from symbody.symbolic import Expr, Matrix
from symbody.symbolic.given.wording import joined_by_and

from .kinematics import Kinematics
from .least_norm import least_norm
from .redundant_constraints import STEPS, Redundancy, redundancy
from .vanishing_combinations import vanishing_combinations
from .walk import (
    CANCELLED,
    SURE,
    TRIES,
    ConfigurationSpace,
    scaled,
    time_goes_on,
    walk_configurations,
)

__all__ = ["overconstraint"]

Array = NDArray[np.float64]

_SHARE = 1e-6
"""The size of a direction above which it is not a rounding error."""
_STANDING = 2
"""The number of positions of a walk that can't leave the first one."""
_NEARLY = 1e-3
"""The ratio of singular values up to which constraints that leave no motion may have been meant to be dependent."""


def overconstraint(
    kinematics: Kinematics,
    p: Array,
    time: float,
    q: Array,
    known: Iterable[Redundancy] = (),
    where: str = "simulate",
) -> Redundancy | None:
    """Return which constraints are redundant where a mechanism moves.

    A constraint that holds the time is redundant only if it follows from the others at all instants.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        time: the time, in s.
        q: the coordinates of a position.
        known: what was found for other parameters or positions; if it suits here, the mechanism isn't moved again.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: the constraints leave no motion, or only at this position.
    """
    system = kinematics.system
    m = len(system.conditions)
    with np.errstate(all="ignore"):
        A, b = (part[:m] for part in kinematics.velocity(time, q, p))
    slopes = np.column_stack([A, b]) if kinematics.is_rheonomic else A
    kernel = least_norm(slopes, np.zeros(m))[1]
    redundant = m - kinematics.rank
    is_usual = kernel.shape[1] == slopes.shape[1] - m + redundant
    if is_usual:
        _check_motion_is_left(system, slopes, kernel, where)
        if not redundant:
            return None
    if kinematics.is_rheonomic and not time_goes_on(kinematics, p, time, q):
        return None  # they contradict each other from now on
    suitable = next((each for each in known if each.suits(system, slopes)), None)
    if suitable is not None:
        return suitable
    gradients = [scaled(J) for J in walk_configurations(kinematics, p, time, q, STEPS)]
    found = redundancy(system, gradients)
    is_standing = len(gradients) <= _STANDING  # what holds at one position alone is no redundancy
    if not is_usual and (is_standing or found.count == redundant):
        _check_moves_elsewhere(system, slopes, kernel, where)
        if not gradients:
            _check_has_neighbours(kinematics, p, time, q, where)
    return found if found.count and (is_usual or not is_standing) else None


def _check_motion_is_left(system: Variables, A: Array, kernel: Array, where: str) -> None:
    """Check that constraints which demand no motion allow one.

    Args:
        system: the mechanism.
        A: the Jacobian of the constraints with respect to the speeds, and the time if it leads them, at a position.
        kernel: a basis of the speeds that they allow, as columns, shape (n, f).
        where: the function that the user called, for messages.
    """
    if kernel.shape[1] or A.shape[1] > len(system.speeds):  # with the time, some motion is demanded
        return
    s = np.linalg.svd(scaled(A), compute_uv=False)
    ratio = float(s[len(system.speeds) - 1] / s[0])
    nearly = (
        f". They are nearly dependent (ratio of singular values {ratio:.1e}): if the mechanism moves by its special "
        "dimensions, give these with more digits"
        if ratio < _NEARLY
        else ""
    )
    raise ConstraintError(
        f"{where}: the constraints leave no motion: {len(system.speeds)} of them are independent at the initial "
        f"position, as many as there are speeds; expected fewer, or one that drives the system and holds the time t"
        f"{nearly}"
    )


def _check_moves_elsewhere(system: Variables, A: Array, kernel: Array, where: str) -> None:
    """Check that speeds which the constraints allow at a singular position are not zero at all others.

    Args:
        system: the mechanism.
        A: the Jacobian of the constraints with respect to the speeds, and the time if it leads them, at the position.
        kernel: a basis of the speeds that they allow there, as columns, shape (n, f).
        where: the function that the user called, for messages.
    """
    phi_q, moves = constraint_jacobian(system), np.abs(kernel).max(axis=1) > _SHARE
    locked = [
        speed
        for speed, is_free in zip(system.speeds, moves, strict=False)
        if is_free and _is_locked(system.speeds, phi_q, speed)
    ]
    if locked:
        rows = sorted(
            {int(row) for y in vanishing_combinations(scaled(A), CANCELLED) for row in np.flatnonzero(y)}
        )
        raise ConstraintError(
            f"{where}: the constraints let {', '.join(map(str, locked))} be other than zero at the initial position, "
            f"but at no position nearby: constraints {joined_by_and(named_constraints(system.conditions, rows))} "
            "depend on each other there alone; leave out a constraint, or start at another position"
        )


def _check_has_neighbours(kinematics: Kinematics, p: Array, time: float, q: Array, where: str) -> None:
    """Check that a position whose constraints allow speeds, but no motions along them, doesn't stand alone.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        time: the time, in s.
        q: the coordinates.
        where: the function that the user called, for messages.
    """
    space = ConfigurationSpace(kinematics, p, time, follows_time=kinematics.is_rheonomic)
    place = np.append(q, time) if kinematics.is_rheonomic else q
    if next(space.neighbours(place, TRIES, SURE), None) is None:
        raise ConstraintError(
            f"{where}: the constraints allow speeds at the initial position, along which no motion leads: there they "
            "restrain it by terms of second order alone, as a stretched chain of bars or (x - y)**2 = 0 does; start at "
            "another position, correct a dimension, or give conditions whose gradients don't vanish"
        )


def _is_locked(speeds: Sequence[Expr], phi_q: Matrix, speed: Expr) -> bool:
    """Return whether the constraints make a speed zero at almost every position, as a combination of their rates."""
    row = [int(other == speed) for other in speeds]
    return Matrix([*phi_q.tolist(), row]).rank() == phi_q.rank()
