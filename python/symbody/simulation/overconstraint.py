"""Overconstrained mechanisms: constraints that depend on each other along the motion, and at no other position.

Three parallel cranks move a coupler because their lengths agree; six independent equations for six coordinates would
let nothing move. Expressions know what holds at almost every position, so there these coordinates stand still.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ConstraintError
from symbody.symbolic import Expr, Matrix, t

from .least_norm import least_norm
from .model import Model

__all__ = ["check_special_dimensions"]

Array = NDArray[np.float64]

_SHARE = 1e-6
"""The part of a direction, or of a combination of constraints, that is no rounding error."""


def check_special_dimensions(model: Model, phi_q: Array, where: str = "simulate") -> None:
    """See that what the constraints let move at a position, they let move at almost every other one.

    Args:
        model: what moves.
        phi_q: the derivatives of the constraints by the speeds, at a position.
        where: the function that the user called.

    Raises:
        ConstraintError: they don't.
    """
    kernel = least_norm(phi_q, np.zeros(len(phi_q)))[1]
    is_driven = any(t in phi.free_symbols for phi in model.constraints)
    if is_driven or kernel.shape[1] == len(model.speeds) - model.independent_constraints:
        return
    moves = np.abs(kernel).max(axis=1) > _SHARE
    special = [
        speed
        for speed, is_free in zip(model.speeds, moves, strict=True)
        if is_free and _is_locked(model, speed)
    ]
    if special:
        combinations = least_norm(phi_q.T, np.zeros(phi_q.shape[1]))[1]
        places = [str(k + 1) for k, row in enumerate(combinations) if np.abs(row).max() > _SHARE]
        raise ConstraintError(
            f"{where}: the constraints let {', '.join(map(str, special))} be other than zero at this position, but at "
            f"almost no other one: constraints {', '.join(places)} depend on each other here. If they do so "
            "wherever the mechanism moves, by its special dimensions, leave out as many of them as follow from the "
            "others; if they don't, begin at another position"
        )


def _is_locked(model: Model, speed: Expr) -> bool:
    """Whether the constraints make a speed zero at almost every position: it's a combination of their rates."""
    phi_q = model.equations.constraint_jacobian
    row = [int(other == speed) for other in model.speeds]
    return Matrix([*phi_q.tolist(), row]).rank() == model.independent_constraints
