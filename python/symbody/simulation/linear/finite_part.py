"""The finite part of linear equations whose E is singular: what is left of them without the conditions they hold.

``E x' = A0 x + B0 r`` with a singular E holds conditions: a combination of rows without x' is ``0 = G x + H r``. Its
rate ``G x' = -H r'`` takes the place of these rows, until E is regular: the shuffle algorithm [Luenberger 1978]. All
conditions together leave a subspace, in which the equations are ordinary differential equations. Their variables are
some of the states, so that they have names, and are the same over a parameter. Eigenvalues at infinity play no part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["FinitePart", "finite_part"]

Array = NDArray[np.float64]

_SINGULAR = 1e-11
"""The singular value, relative to the largest one of scaled rows and columns, up to which it is zero."""


@dataclass(frozen=True, eq=False)
class FinitePart:
    """The equations ``v' = A v + sum B_i r^(i)`` of some states v, and all states ``x = V v + sum X_i r^(i)``.

    Attributes:
        A: m x m, for m finite eigenvalues.
        basis: V, n x m.
        places: the places of the states v among x.
        inputs: B_i by the order i of the rate of the inputs, m x number of inputs each.
        offsets: X_i, n x number of inputs each, as many.
    """

    A: Array
    basis: Array
    places: tuple[int, ...]
    inputs: tuple[Array, ...]
    offsets: tuple[Array, ...]


def finite_part(
    E: Array, A0: Array, inputs: Sequence[Array] = (), places: Sequence[int] | None = None
) -> FinitePart | None:
    """Return the finite part of a regular pencil; None if other states are needed than those that were asked for.

    Args:
        E: n x n, singular or not.
        A0: n x n.
        inputs: the coefficients of the inputs and of their rates, by order.
        places: the places of the states v; by default, they are chosen.

    >>> part = finite_part(np.diag([1.0, 0.0]), np.array([[-1.0, 1.0], [2.0, -1.0]]))
    >>> part.A, (part.basis / part.basis[0]).round(9)
    (array([[1.]]), array([[1.],
           [2.]]))
    """
    n = len(E)
    rates, rest, r = E, A0, [np.asarray(each) for each in inputs]
    conditions: list[Array] = [np.zeros((0, n))]
    of_inputs: list[list[Array]] = [[each[:0] for each in r]]
    for _ in range(n + 1):
        null, others = _left_null_space(rates, rest)
        if not null.shape[1]:
            break
        conditions.append(null.T @ rest)
        of_inputs.append([null.T @ each for each in r])
        rates = np.vstack([others.T @ rates, conditions[-1]])
        rest = np.vstack([others.T @ rest, np.zeros((null.shape[1], n))])
        shifted = [np.zeros_like(each) for each in of_inputs[-1][:1]] + [-each for each in of_inputs[-1]]
        widened = [*r, *([np.zeros_like(r[0])] if r else [])]
        r = [np.vstack([others.T @ own, moved]) for own, moved in zip(widened, shifted, strict=True)]
    else:
        return None  # not a regular pencil
    return _restricted(rates, rest, r, (conditions, of_inputs), places)


def _left_null_space(E: Array, A0: Array) -> tuple[Array, Array]:
    """Return bases of the combinations of rows without x', and of the others."""
    rows = _sizes(np.hstack([E, A0]), axis=1)
    scaled = E / rows[:, None]
    scaled = scaled / _sizes(scaled, axis=0)
    U, s, _ = np.linalg.svd(scaled)
    rank = int(np.sum(s > _SINGULAR * max(s.max(initial=0.0), 1e-300)))
    U = U / rows[:, None]
    return U[:, rank:], U[:, :rank]


def _sizes(matrix: Array, axis: int) -> Array:
    found = np.abs(matrix).max(axis=axis, initial=0.0)
    return np.asarray(np.where(found > 0, found, 1.0))


def _restricted(
    E: Array,
    A0: Array,
    inputs: Sequence[Array],
    conditions: tuple[Sequence[Array], Sequence[Sequence[Array]]],
    places: Sequence[int] | None,
) -> FinitePart | None:
    """Return the part within the subspace of conditions.

    Args:
        E: regular.
        A0: the coefficients of the states.
        inputs: those of the inputs and of their rates.
        conditions: G of ``G x + sum H_i r^(i) = 0`` by stages, and H_i.
        places: the places of the states v.
    """
    G = np.vstack(conditions[0])
    sizes = _sizes(G, axis=1)
    V, inverse = _subspace(G / sizes[:, None])
    count = len(inputs)
    H = (
        [
            np.vstack(
                [_of_order(stage, k, G_k) for stage, G_k in zip(conditions[1], conditions[0], strict=True)]
            )
            for k in range(count)
        ]
        if inputs
        else []
    )
    chosen = _chosen(V) if places is None else tuple(places)
    if len(chosen) != V.shape[1] or (V.shape[1] and np.linalg.cond(V[list(chosen)]) > 1 / _SINGULAR):
        return None
    own = list(chosen)
    V = np.asarray(np.linalg.solve(V[own].T, V.T).T) if own else V
    offsets = [-inverse @ (each / sizes[:, None]) for each in H]
    offsets = [each - V @ each[own] for each in offsets]
    rates = np.linalg.solve(E, np.hstack([A0, *inputs]))
    n = len(E)
    F, K = rates[own, :n], np.split(rates[own, n:], count, axis=1) if count else []
    B = [F @ X + K_i for X, K_i in zip(offsets, K, strict=True)]
    return FinitePart(F @ V, V, chosen, tuple(B), tuple(offsets))


def _of_order(stage: Sequence[Array], order: int, G: Array) -> Array:
    """Return H_i of a stage, which has none beyond some order."""
    if order < len(stage):
        return stage[order]
    width = stage[0].shape[1] if stage else 0
    return np.zeros((len(G), width))


def _subspace(G: Array) -> tuple[Array, Array]:
    """Return a basis of the null space of G, and its pseudo-inverse."""
    n = G.shape[1]
    if not len(G):
        return np.eye(n), np.zeros((n, 0))
    columns = _sizes(G, axis=0)
    U, s, Vt = np.linalg.svd(G / columns)
    rank = int(np.sum(s > _SINGULAR * s.max(initial=0.0)))
    inverse = (Vt[:rank].T / s[:rank]) @ U[:, :rank].T
    return Vt[rank:].T / columns[:, None], inverse / columns[:, None]


def _chosen(V: Array) -> tuple[int, ...]:
    """Return the places of as many rows of V as it has columns that are far from dependent."""
    from scipy.linalg import qr  # noqa: PLC0415 - slow to load

    found: Any = qr((V / _sizes(V, axis=0)).T, pivoting=True, mode="r")
    return tuple(sorted(int(k) for k in found[1][: V.shape[1]]))
