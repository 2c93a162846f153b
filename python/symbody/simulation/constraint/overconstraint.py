"""Constraints that depend on each other along the motion, and for almost all other positions or parameters don't.

Three parallel cranks move a coupler because their lengths agree; six independent equations for six coordinates would
let nothing move. Expressions know what holds at almost every position, so there these coordinates stand still. In the
same way ``k (x - y) = 0`` makes the accelerations of x and y one expression, and k = 0 doesn't part them again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError
from symbody.simulation.model.model import Model
from symbody.simulation.model.named_constraint import listed
from symbody.symbolic import Expr, Matrix, number, t

from .kinematics import kinematics_of
from .least_norm import least_norm
from .redundant_constraints import redundancy
from .walk import scaled

__all__ = ["check_rank"]

Array = NDArray[np.float64]

OTHERS = 4
"""Other positions at which constraints are looked at."""
_SHARE = 1e-6
"""The part of a direction, or of a combination of constraints, that is no rounding error."""


def check_rank(model: Model, phi_q: Array, parameters: Mapping[Expr, float], where: str = "simulate") -> None:
    """See that what the constraints let move at a position, they let move at almost every other one.

    Args:
        model: what moves.
        phi_q: the derivatives of the constraints by the speeds, at a position.
        parameters: the values of the parameters.
        where: the function that the user called.

    Raises:
        ConstraintError: they don't, or a parameter that is zero takes a constraint away.
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
        f"{where}: with {named} fewer constraints are independent, and the equations were derived for other values; "
        f"leave out of the system what follows from the others then: {', '.join(without)}"
    )


def _without(matrix: Matrix, row: int) -> Matrix:
    rows = [entries for k, entries in enumerate(matrix.tolist()) if k != row]
    return Matrix.from_entries(len(rows), matrix.columns, [entry for entries in rows for entry in entries])


def _check_special_dimensions(
    model: Model, phi_q: Array, kernel: Array, parameters: Mapping[Expr, float], where: str
) -> None:
    moves = np.abs(kernel).max(axis=1) > _SHARE
    special = [
        speed
        for speed, is_free in zip(model.speeds, moves, strict=True)
        if is_free and _is_locked(model, speed)
    ]
    if special:
        found = redundancy(model.constraints, [scaled(phi_q)])
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
            f"wherever the mechanism moves, by its special dimensions, it is overconstrained: leave out "
            f"{found.count} of them{found.choices}; if they don't, begin at another position"
        )


def _is_so_anywhere(model: Model, rank: int, parameters: Mapping[Expr, float]) -> bool:
    """Whether no more constraints are independent at other positions, with these values of the parameters."""
    kinematics = kinematics_of(model.equations, dict(model.inputs))
    p = np.array([parameters[name] for name in kinematics.parameters])
    m, count = len(model.constraints), len(model.coordinates)
    draw = np.random.Generator(np.random.PCG64(1)).uniform(-1, 1, (OTHERS, count))
    with np.errstate(all="ignore"):
        slopes = [kinematics.velocity(0.0, q, p)[0][:m] for q in draw]
    fit = [J for J in slopes if np.isfinite(J).all()]
    return bool(fit) and all(J.shape[1] - least_norm(J, np.zeros(m))[1].shape[1] <= rank for J in fit)


def _values(model: Model, rows: Sequence[int], parameters: Mapping[Expr, float]) -> str:
    """Return the values of the parameters in some constraints."""
    leaves = {leaf for row in rows for leaf in model.constraints[row].free_symbols}
    named = [f"{name} = {parameters[name]:.6g}" for name in model.parameters if name in leaves]
    return listed(named) if named else "these values"


def _is_locked(model: Model, speed: Expr) -> bool:
    """Whether the constraints make a speed zero at almost every position: it's a combination of their rates."""
    phi_q = model.equations.constraint_jacobian
    row = [int(other == speed) for other in model.speeds]
    return Matrix([*phi_q.tolist(), row]).rank() == model.independent_constraints
