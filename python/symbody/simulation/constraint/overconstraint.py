"""Constraints that are dependent along the motion, but independent at almost all other positions or parameters.

Three parallel cranks move a coupler because their lengths agree; six independent equations for six coordinates would
allow no motion. Symbolic rank is generic rank, and at generic positions these coordinates are locked. In the same
way ``k (x - y) = 0`` makes the accelerations of x and y one expression, which stays one if k = 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError
from symbody.simulation.given.wording import joined_by_and
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, Matrix, number, t

from .kinematics import kinematics_of
from .least_norm import least_norm
from .redundant_constraints import redundancy
from .walk import scaled

__all__ = ["check_rank"]

Array = NDArray[np.float64]

OTHERS = 4
"""The number of other positions at which constraints are evaluated."""
_SHARE = 1e-6
"""The size of a direction, or of a combination of constraints, above which it is not a rounding error."""


def check_rank(model: Model, phi_q: Array, parameters: Mapping[Expr, float], where: str = "simulate") -> None:
    """Check that the motions that the constraints allow at a position are allowed at almost every position.

    Args:
        model: the model.
        phi_q: the Jacobian of the constraints with respect to the speeds, at a position, shape (m, n).
        parameters: the values of the parameters.
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: they are not, or a parameter with the value zero removes a constraint.
    """
    kernel = least_norm(phi_q, np.zeros(len(phi_q)))[1]
    if kernel.shape[1] == len(model.speeds) - model.independent_constraints:
        return
    _check_zeros(model, parameters, where)
    if not any(t in phi.free_symbols for phi in model.constraints):
        _check_special_dimensions(model, phi_q, kernel, parameters, where)


def _check_zeros(model: Model, parameters: Mapping[Expr, float], where: str) -> None:
    zeros = {name: number(0) for name in model.parameters if parameters[name] == 0}
    phi_q = model.equations.constraint_jacobian
    left = phi_q.subs(zeros)
    if not zeros or left.rank() == model.independent_constraints:
        return
    without = [
        str(phi)
        for k, phi in enumerate(model.constraints)
        if _without(phi_q, k).rank() < phi_q.rank() and _without(left, k).rank() == left.rank()
    ]
    named = " and ".join(f"{name} = 0" for name in zeros)
    raise ConstraintError(
        f"{where}: with {named} fewer constraints are independent than in the equations, which were derived for "
        f"other values; leave out of the system the constraints that then follow from the others: {', '.join(without)}"
    )


def _without(matrix: Matrix, row: int) -> Matrix:
    rows = [entries for k, entries in enumerate(matrix.tolist()) if k != row]
    return Matrix.from_entries(len(rows), matrix.columns, [entry for entries in rows for entry in entries])


def _check_special_dimensions(
    model: Model, phi_q: Array, kernel: Array, parameters: Mapping[Expr, float], where: str
) -> None:
    """Check that speeds which the constraints allow here are not zero at almost every position.

    Args:
        model: the model.
        phi_q: the Jacobian of the constraints with respect to the speeds, shape (m, n).
        kernel: a basis of the speeds that they allow, as columns, shape (n, f).
        parameters: the values of the parameters.
        where: the function that the user called, for messages.
    """
    moves = np.abs(kernel).max(axis=1) > _SHARE
    special = [
        speed
        for speed, is_free in zip(model.speeds, moves, strict=True)
        if is_free and _is_locked(model, speed)
    ]
    if special:
        found = redundancy(model.system.conditions, [scaled(phi_q)])
        places = [str(row + 1) for row in found.rows]
        if _is_so_anywhere(model, len(phi_q[0]) - kernel.shape[1], parameters):
            raise ConstraintError(
                f"{where}: with {_values(model, found.rows, parameters)} constraints {', '.join(places)} depend on "
                "each other at every position; the equations were derived for other values, for which "
                f"{', '.join(map(str, special))} can only be zero: leave out {found.count} of them{found.choices}"
            )
        raise ConstraintError(
            f"{where}: the constraints let {', '.join(map(str, special))} be other than zero at this position, but at "
            f"almost no other one: constraints {', '.join(places)} depend on each other here. If they do so "
            f"wherever the mechanism moves, because of its special dimensions, it is overconstrained: leave out "
            f"{found.count} of them{found.choices}; if not, start at another position"
        )


def _is_so_anywhere(model: Model, rank: int, parameters: Mapping[Expr, float]) -> bool:
    """Return whether no more constraints are independent at other positions, with these values of the parameters."""
    kinematics = kinematics_of(model.equations, dict(model.inputs))
    p = np.array([parameters[name] for name in kinematics.parameters])
    m, count = len(model.constraints), len(model.coordinates)
    random = np.random.Generator(np.random.PCG64(1))
    draw = random.uniform(-1, 1, (OTHERS, count))
    kinematics = kinematics.beside(random.uniform(-1, 1, len(model.states)))
    with np.errstate(all="ignore"):
        slopes = [kinematics.velocity(0.0, q, p)[0][:m] for q in draw]
    fit = [J for J in slopes if np.isfinite(J).all()]
    return bool(fit) and all(J.shape[1] - least_norm(J, np.zeros(m))[1].shape[1] <= rank for J in fit)


def _values(model: Model, rows: Sequence[int], parameters: Mapping[Expr, float]) -> str:
    """Return the values of the parameters in some constraints."""
    leaves = {leaf for row in rows for leaf in model.constraints[row].free_symbols}
    named = [f"{name} = {parameters[name]:.6g}" for name in model.parameters if name in leaves]
    return joined_by_and(named) if named else "these values"


def _is_locked(model: Model, speed: Expr) -> bool:
    """Return whether the constraints make a speed zero at almost every position, as a combination of their rates."""
    phi_q = model.equations.constraint_jacobian
    row = [int(other == speed) for other in model.speeds]
    return Matrix([*phi_q.tolist(), row]).rank() == model.independent_constraints
