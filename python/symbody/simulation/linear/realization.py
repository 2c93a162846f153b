"""Linear models from inputs to outputs as ``y = (C (s - A)^-1 B + D_0 + D_1 s + ...) r``, also where E is singular.

With the finite part ``v' = A v + sum B_i r^(i)`` and ``x = V v + sum X_i r^(i)``, where r^(i) are rates of the inputs,
``s^i (s - A)^-1 = A^i (s - A)^-1 + sum_(j<i) A^(i-1-j) s^j`` moves all rates into B and D. A step of an input has no
finite rate; what depends on it jumps, and an output with D_1 holds an impulse.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .finite_part import finite_part
from .transfer import Transfer

__all__ = ["Realization", "realization"]

Array = NDArray[np.float64]

_ROUNDED = 1e-11
"""The size of an entry of D, relative to its terms, up to which it is rounding."""


@dataclass(frozen=True, eq=False)
class Realization:
    """The matrices A, B, C, and D by the order of the rate of the inputs."""

    A: Array
    B: Array
    C: Array
    D: tuple[Array, ...]


def realization(found: Transfer) -> Realization:
    """Return the matrices of a linear model from its inputs, without their rates, to its outputs."""
    m = found.matrices
    part = finite_part(m.E, m.A0, _by_order(found, m.B0))
    assert part is not None, "the pencil is regular"
    A, V, orders = part.A, part.basis, len(part.inputs)
    powers = [np.linalg.matrix_power(A, k) for k in range(orders)]
    B = sum((power @ B_i for power, B_i in zip(powers, part.inputs, strict=True)), start=0 * part.inputs[0])
    X = [
        offset + V @ sum((powers[i - 1 - j] @ part.inputs[i] for i in range(j + 1, orders)), start=0 * B)
        for j, offset in enumerate(part.offsets)
    ]
    C = m.C0 @ V + m.C1 @ V @ A
    nothing, direct = 0 * X[0], _by_order(found, m.D0)
    D = []
    for k in range(orders + 1):
        terms = [
            direct[k] if k < len(direct) else 0 * direct[0],
            m.C0 @ (X[k] if k < orders else nothing),
            m.C1 @ (X[k - 1] if k else V @ B),
        ]
        value, size = sum(terms), sum(map(np.abs, terms))
        D.append(np.where(np.abs(value) > _ROUNDED * size, value, 0.0))
    return Realization(A, B, C, tuple(D))


def _by_order(found: Transfer, columns: Array) -> list[Array]:
    """Return coefficients of the inputs and of their rates by order, a column for each input."""
    count = 1 + max(order for _, order in found.orders)
    by_order = [np.zeros((len(columns), len(found.inputs))) for _ in range(count)]
    for k, (place, order) in enumerate(found.orders):
        by_order[order][:, place] += columns[:, k]
    return by_order
