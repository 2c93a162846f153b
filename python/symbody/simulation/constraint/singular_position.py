"""Singular positions: constraints are dependent there, but not at neighbouring positions.

The constraints of mechanisms that move because of their special dimensions are dependent at all positions; none of
these is singular. Therefore the rank at a position is compared with the ranks at others that the mechanism reaches
from it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr

from .kinematics import Kinematics
from .many_systems import least_ratios
from .vanishing_combinations import vanishing_combinations
from .walk import CANCELLED, ConfigurationSpace, scaled

__all__ = [
    "SINGULAR",
    "dependent_rows",
    "equilibrated",
    "is_singular",
    "may_be_singular",
    "may_be_singular_of_many",
]

Array = NDArray[np.float64]

SINGULAR = 1e-6
"""The ratio to the largest singular value below which one counts as zero: positions are not more accurate."""
LOOK = 1e-4
"""The ratio below which a position is examined further."""
DIRECTIONS = 6
"""The number of directions to neighbouring positions."""
ROUNDED = 1e-9
"""The ratio to the longest column below which a column counts as zero."""


def equilibrated(matrices: Array) -> Array:
    """Scale matrices of one kind at several positions: rows and columns have the length 1 where they are longest.

    The result does not depend on units, and rows or columns that vanish at one position are small there.
    """
    rows = np.linalg.norm(matrices, axis=2).max(axis=0)
    by_row = matrices / np.where(rows > 0, rows, 1.0)[:, None]
    columns = np.abs(by_row).max(axis=(0, 1), initial=0.0)
    whole: Array = by_row / np.where(columns > ROUNDED * columns.max(initial=0.0), columns, 1.0)
    return whole


def dependent_rows(matrices: Array) -> list[Array]:
    """Return the combinations of rows of the first matrix that vanish, relative to all matrices.

    >>> matrices = np.array([[[1.0, 0], [2, 0], [0, 0]], [[1.0, 1], [0, 1], [0, 1]]])
    >>> [np.flatnonzero(combination).tolist() for combination in dependent_rows(matrices)]
    [[2], [0, 1]]
    """
    lengths = np.linalg.norm(matrices, axis=2).max(axis=0)
    here = equilibrated(matrices)[0]
    near = SINGULAR / max(float(np.linalg.norm(here, 2)), SINGULAR)
    return [y / np.where(lengths > 0, lengths, 1.0) for y in vanishing_combinations(here, near)]


def may_be_singular(kinematics: Kinematics, p: Array, t: float, q: Array, independent: int) -> bool:
    """Return whether constraints are dependent at a position, or nearly so: a quick test before `is_singular`.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        q: the coordinates.
        independent: the number of constraints that are independent at almost every position.
    """
    with np.errstate(all="ignore"):
        _, phi_q, sizes = kinematics.position(t, q, p)
        J = kinematics.velocity(t, q, p)[0][: len(kinematics.constraints)]
    if not (np.isfinite(J).all() and np.isfinite(phi_q).all() and np.isfinite(sizes).all()):
        return False
    if (np.abs(phi_q) @ np.maximum(np.abs(q), 1) <= LOOK * sizes).any():
        return True
    s = np.linalg.svd(equilibrated(J[None]), compute_uv=False)[0]
    return bool(independent and s[independent - 1] <= LOOK * s[0])


def may_be_singular_of_many(
    kinematics: Kinematics, p: Array, t: float, q: Array, independent: int
) -> NDArray[np.bool_]:
    """Return at which of k positions `may_be_singular` is true, shape (k,).

    Args:
        kinematics: the constraints, which hold no states.
        p: the values of their parameters, shape (k, parameters).
        t: the time, in s.
        q: the coordinates, shape (k, n).
        independent: the number of constraints that are independent at almost every position.
    """
    with np.errstate(all="ignore"):
        _, phi_q, sizes = kinematics.position_of_many(t, q.T, p.T)
        J = kinematics.velocity_of_many(t, q.T, p.T)[0][: len(kinematics.constraints)]
        reach = (np.abs(phi_q) * np.maximum(np.abs(q.T), 1)).sum(axis=1)
        found: NDArray[np.bool_] = (reach <= LOOK * sizes).any(axis=0)
    is_finite = (
        np.isfinite(J).all(axis=(0, 1)) & np.isfinite(reach).all(axis=0) & np.isfinite(sizes).all(axis=0)
    )
    if independent:
        found[is_finite] |= _are_nearly_dependent(J[..., is_finite], independent)
    return np.asarray(found & is_finite)


def _are_nearly_dependent(J: Array, independent: int) -> NDArray[np.bool_]:
    """Return where the rows of k matrices (m, n, k) are dependent or nearly so, relative to each matrix itself."""
    rows = np.sqrt((J * J).sum(axis=1, keepdims=True))
    by_row = J / np.where(rows > 0, rows, 1.0)
    columns = np.abs(by_row).max(axis=0, keepdims=True, initial=0.0)
    longest = columns.max(axis=1, keepdims=True, initial=0.0)
    whole = by_row / np.where(columns > ROUNDED * longest, columns, 1.0)
    are_dependent = np.ones(J.shape[-1], dtype=bool)
    if independent == len(J):
        are_dependent = least_ratios(whole) <= LOOK
    s = np.linalg.svd(np.moveaxis(whole[..., are_dependent], -1, 0), compute_uv=False)
    are_dependent[are_dependent] = s[:, independent - 1] <= LOOK * s[:, 0]
    return are_dependent


def is_singular(kinematics: Kinematics, p: Array, t: float, q: Array, held: Sequence[Expr] = ()) -> bool:
    """Return whether constraints are dependent at a position, but not at others that the mechanism reaches.

    A position from which no other one can be reached is singular, too, if the constraints allow nonzero speeds there.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        t: the time, in s.
        q: the coordinates.
        held: the coordinates that are held.
    """
    space = ConfigurationSpace(kinematics, p, t, held)
    here = space.slopes(q)[0]
    if not np.isfinite(here).all():
        return False
    is_alone = True
    for beside in space.neighbours(q, DIRECTIONS):
        J = space.slopes(beside)[0]
        if np.isfinite(J).all():
            ranks = np.sum(
                np.linalg.svd(equilibrated(np.array([here, J])), compute_uv=False) > SINGULAR, axis=1
            )
            if ranks[0] < ranks[1]:
                return True
            is_alone = False
    return is_alone and bool(np.linalg.matrix_rank(scaled(here), CANCELLED) < min(here.shape))
