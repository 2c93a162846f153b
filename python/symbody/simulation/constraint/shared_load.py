"""How redundant constraints share a load where numbers are known: see `multibody/shared_multiplier.py`.

With the combinations N of multipliers that have no effect, what is borne is ``R(lambda) + B N s``, and the least is
that of ``s = -(B N)^+ R(lambda)``. Forces h that hold coordinates from outside come first: these are needed only where
nothing else bears the load, so that s makes ``h + H s`` the least, and of those s what is borne.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics.formalism.self_stress import borne
from symbody.multibody import Variables
from symbody.symbolic import Expr, jacobian

__all__ = ["shared_load"]

Array = NDArray[np.float64]
_NONE = 1e-12
"""The effect of a combination of forces of size one that counts as none."""


def shared_load(
    system: Variables, forces: Array, N: Sequence[Array], evaluate: Callable[[Sequence[Expr]], Array]
) -> Array:
    """Return multipliers, and forces after them, that balance the same loads, with the least of what is borne.

    Args:
        system: the system.
        forces: multipliers and the forces that hold coordinates after them, in balance, shape (instants, m + k).
        N: combinations of them that have no effect, as columns, one matrix for each instant.
        evaluate: the function that returns values at these multipliers, shape (expressions, instants).
    """
    R, slopes = _linear(system)
    m, count = len(system.multipliers), len(forces)
    places = [(i, k) for i, row in enumerate(slopes) for k, _ in row]
    values = evaluate([slope for row in slopes for _, slope in row]).reshape(len(places), count)
    B = np.zeros((count, len(R), m))
    for (i, k), value in zip(places, values, strict=True):
        B[:, i, k] = value
    BN = [b @ free[:m] for b, free in zip(B, N, strict=True)]
    moved = np.flatnonzero(np.max([np.abs(each).max(axis=1, initial=0.0) for each in BN], axis=0) > _NONE)
    rest = evaluate([R[i] for i in moved]).reshape(len(moved), count)
    shared = forces.copy()
    for k, (free, effect) in enumerate(zip(N, BN, strict=True)):
        s, Z = _least_holding(free[m:], forces[k, m:])
        rows = effect[moved]
        shared[k] += free @ (s - Z @ np.linalg.lstsq(rows @ Z, rest[:, k] + rows @ s, rcond=None)[0])
    return shared


def _least_holding(H: Array, h: Array) -> tuple[Array, Array]:
    """Return s with the least ``h + H s``, and a basis of the changes of s that leave it, as columns."""
    U, sizes, Vt = np.linalg.svd(H)
    rank = int(np.sum(sizes > _NONE))
    return -Vt[:rank].T @ (U[:, :rank].T @ h / sizes[:rank]), Vt[rank:].T


@lru_cache(maxsize=32)
def _linear(system: Variables) -> tuple[tuple[Expr, ...], list[list[tuple[int, Expr]]]]:
    """Return what is borne, and its derivatives by the multipliers that aren't zero, with the places of these."""
    R = tuple(borne(system))
    rows = jacobian(list(R), list(system.multipliers)).tolist() if R else []
    return R, [[(k, each) for k, each in enumerate(row) if not each.is_zero] for row in rows]
