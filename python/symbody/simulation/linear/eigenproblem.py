"""Eigenvalues of one pencil with their vectors: repeated and defective ones are recognised, rounding is removed.

``A0 v = s E v``. A computed eigenvalue is exact to about ``n eps |A| c`` with its condition number
``c = |w| |v| / |w^H v|``, of the left vector w and the right vector v [Golub & Van Loan 2013, sec. 7.2.2]. Where an
eigenvalue has fewer vectors than its multiplicity m, c is large or infinite, and its copies spread by at most about
``|A| (n eps)^(1/m)``; but their mean is exact to ``n eps |A| |P|``, with the projector P onto their subspace.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .finite_part import FinitePart, finite_part
from .regular_pencil import rates_matrix

__all__ = ["Cluster", "Spectrum", "spectrum"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_EPS = float(np.finfo(float).eps)
_ILL = 1e6
"""The condition number from which an eigenvalue may be defective: 6e7 is that of a double one in double precision."""
_KERNEL = 1e-9
"""The singular value, relative to the largest one, up to which a direction belongs to an eigenvalue."""


@dataclass(frozen=True, eq=False)
class Cluster:
    """An eigenvalue with its vectors.

    Attributes:
        value: the eigenvalue, in 1/s.
        multiplicity: how often it occurs.
        vectors: its right vectors, as columns; fewer than its multiplicity if it is defective.
        shares: |w_k v_k| of each state for each vector, with sum 1; NaN if it is defective.
    """

    value: complex
    multiplicity: int
    vectors: Complex
    shares: Array

    @property
    def is_defective(self) -> bool:
        """Whether it has fewer vectors than its multiplicity."""
        return bool(self.vectors.shape[1] < self.multiplicity)


@dataclass(frozen=True, eq=False)
class Spectrum:
    """The eigenvalues of a pencil.

    Attributes:
        clusters: the finite eigenvalues, the fastest growing first.
        infinite: how many eigenvalues are infinite, because E is singular.
    """

    clusters: tuple[Cluster, ...]
    infinite: int


def spectrum(E: Array, A0: Array) -> Spectrum:
    """Return the eigenvalues of ``A0 v = s E v``, with real parts and imaginary parts that are rounding set to zero.

    Args:
        E: n x n; the pencil is regular.
        A0: n x n.
    """
    A = rates_matrix(E, A0)
    if A is not None:
        return Spectrum(_ordered(_clusters(A)), 0)
    part = finite_part(E, A0)
    assert part is not None, "the pencil is regular"
    found = [_of_all_states(each, part, E, A0) for each in (_clusters(part.A) if len(part.A) else [])]
    return Spectrum(_ordered(found), len(E) - len(part.A))


def _of_all_states(cluster: Cluster, part: FinitePart, E: Array, A0: Array) -> Cluster:
    """Return an eigenvalue of the finite part with the vectors of all states.

    The left vectors w of the pencil, ``w^H A0 = s w^H E``, give ``E^H w``, which vanishes for infinite eigenvalues.
    """
    vectors = part.basis @ cluster.vectors
    count = vectors.shape[1]
    if cluster.is_defective:
        return replace(cluster, vectors=vectors, shares=np.full(vectors.shape, np.nan))
    shifted = A0 - cluster.value * E
    rows = np.abs(shifted).max(axis=1, keepdims=True)
    rows = np.where(rows > 0, rows, 1.0)
    U, _, _ = np.linalg.svd(shifted / rows)
    return replace(
        cluster,
        vectors=vectors,
        shares=_shares((E.T @ (U[:, -count:] / rows)).astype(np.complex128), vectors),
    )


def _eig(A: Array) -> tuple[Complex, Complex, Complex]:
    """Return eigenvalues, left vectors and right vectors."""
    from scipy.linalg import eig  # noqa: PLC0415 - slow to load

    found: Any = eig(A, left=True, right=True)
    values, left, right = (np.asarray(part, np.complex128) for part in found)
    return values, left, right


def _clusters(A: Array) -> list[Cluster]:
    """Return the eigenvalues of a matrix, with those that coincide together."""
    from scipy.linalg import matrix_balance  # noqa: PLC0415 - slow to load

    matrix, scales = matrix_balance(A, permute=False)
    balanced, units = np.asarray(matrix, np.float64), np.diag(scales)
    values, left, right = _eig(balanced)
    products = np.abs(np.sum(left.conj() * right, axis=0))
    conditions = 1 / np.maximum(products, _EPS)
    error = len(A) * _EPS * float(np.linalg.norm(balanced, 2))
    bounds = _spreads(values, conditions, error)
    found = []
    for members in _together(values, conditions, bounds):
        size = len(members)
        bound = float(bounds[members].min())
        if size > 1:
            bound = min(bound, 10 * error * _projector_norm(balanced, values, members))
        value = _without_rounding(complex(values[members].mean()), bound)
        if size == 1:
            k = members[0]
            vectors, shares = right[:, [k]], _shares(left[:, [k]], right[:, [k]])
        else:
            vectors, shares = _kernel(balanced, value, size)
        vectors = vectors.real.astype(np.complex128) if value.imag == 0 else vectors
        found.append(Cluster(value, size, units[:, None] * vectors, shares))
    return found


def _spreads(values: Complex, conditions: Array, error: float) -> Array:
    """Return how far rounding moves each eigenvalue: ``error c``, but not farther than copies of a defective one.

    The multiplicity m is the least with which m such eigenvalues are as near to each other as rounding spreads them.

    Args:
        values: the eigenvalues.
        conditions: their condition numbers c, infinite for copies that are defective without any rounding.
        error: the rounding error of the matrix, ``n eps |A|``.
    """
    n = len(values)
    multiplicities = np.arange(2, max(n, 2) + 1)
    rounding = n * _EPS
    most = error / rounding * rounding ** (1 / multiplicities)
    distances = np.abs(values[:, None] - values[conditions > _ILL])
    found = error * conditions
    for k in range(n):
        near = (distances[k] <= 10 * most[:, None]).sum(axis=1) >= multiplicities
        found[k] = min(found[k], most[int(np.argmax(near))])  # without any, the first: m = 2
    return found


def _projector_norm(A: Array, values: Complex, members: list[int]) -> float:
    """Return |P| of the projector onto the subspace of a cluster; infinite if it can't be told from the others."""
    from scipy.linalg import schur  # noqa: PLC0415 - slow to load

    others = np.delete(values, members)

    def is_member(s: complex) -> bool:
        away = np.abs(others - s).min(initial=np.inf)
        return bool(np.abs(values[members] - s).min() < away)

    bases = []
    ordered: Any = schur  # the types of its argument `sort` are those of real matrices
    for matrix in (A, A.T):
        _, vectors, size = ordered(matrix.astype(np.complex128), output="complex", sort=is_member)
        if size != len(members):
            return float("inf")
        bases.append(vectors[:, :size])
    right, left = bases
    least = float(np.linalg.svd(left.T @ right, compute_uv=False)[-1])  # A^T has the conjugate left vectors
    return 1 / max(least, _EPS)


def _together(values: Complex, conditions: Array, bounds: Array) -> list[list[int]]:
    """Return the places of eigenvalues that coincide: nearer than rounding errors move them."""
    left, found = list(range(len(values))), []
    while left:
        group = [left.pop(0)]
        for k in group:  # grows while it is read
            near = [
                j
                for j in left
                if abs(values[j] - values[k]) <= 10 * min(bounds[j], bounds[k])
                or (
                    min(conditions[j], conditions[k]) > _ILL
                    and abs(values[j] - values[k]) <= 30 * max(bounds[j], bounds[k])
                )
            ]
            group += near
            left = [j for j in left if j not in near]
        found.append(group)
    return found


def _without_rounding(value: complex, bound: float) -> complex:
    """Return an eigenvalue whose parts are zero where they are smaller than its error."""
    return complex(*(0.0 if abs(part) <= bound else part for part in (value.real, value.imag)))


def _kernel(A: Array, value: complex, size: int) -> tuple[Complex, Array]:
    """Return the vectors of a repeated eigenvalue in echelon form, and the shares of the states in them."""
    shifted = A - value * np.eye(len(A)) if value.imag else A - value.real * np.eye(len(A))
    u, s, vh = np.linalg.svd(shifted)
    count = max(1, min(size, int(np.sum(s <= _KERNEL * s[0])))) if s[0] else size
    vectors = _echelon(vh[-count:].conj().T.astype(np.complex128))
    if count < size:
        return vectors, np.full(vectors.shape, np.nan)
    return vectors, _shares(u[:, -count:].astype(np.complex128), vectors)


def _echelon(vectors: Complex) -> Complex:
    """Return combinations of vectors, each of which is 1 at a place where the others vanish."""
    found, places = vectors.copy(), list[int]()
    for k in range(found.shape[1]):
        sizes = np.abs(found[:, k:]).max(axis=1)
        sizes[places] = 0
        place = int(np.argmax(sizes > 0.999 * sizes.max()))
        best = k + int(np.argmax(np.abs(found[place, k:])))
        found[:, [k, best]] = found[:, [best, k]]
        found[:, k] /= found[place, k]
        others = [j for j in range(found.shape[1]) if j != k]
        found[:, others] -= np.outer(found[:, k], found[place, others])
        places.append(place)
    found[np.abs(found) < 1e-12 * np.abs(found).max()] = 0
    return found


def _shares(left: Complex, right: Complex) -> Array:
    """Return the participation factors ``|w_k v_k|`` with sum 1, for left vectors with ``W^H V = 1``.

    Args:
        left: the left vectors, as columns.
        right: the right vectors.
    """
    dual = left @ np.linalg.pinv(left.conj().T @ right).conj().T
    sizes = np.abs(dual * right)
    return np.asarray(sizes / sizes.sum(axis=0))


def _ordered(clusters: list[Cluster]) -> tuple[Cluster, ...]:
    """Return eigenvalues, the fastest growing first; of a pair, that with the negative imaginary part first."""
    scale = max((abs(each.value) for each in clusters), default=0.0) or 1.0
    return tuple(
        sorted(
            clusters,
            key=lambda each: (-round(each.value.real / scale, 9), abs(each.value.imag), each.value.imag),
        )
    )
