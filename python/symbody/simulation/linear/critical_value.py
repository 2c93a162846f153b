"""Critical values of a parameter: where eigenvalues cross the imaginary axis, or leave it."""

from __future__ import annotations

from bisect import bisect, insort
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .branch_tracking import likeness

__all__ = ["CriticalValue", "critical_values"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_ROUNDED = 1e-9
"""The real part, relative to the largest eigenvalue, up to which an eigenvalue that may cross the axis is on it."""
_ON_AXIS = 1e-6
"""The same of eigenvalues that meet there: rounding spreads these by the root of the machine precision."""
_MOST = 200
"""The most steps of a search."""


class _Family(Protocol):
    """Linear models over a parameter."""

    def eigenvalues(self, values: Array) -> Complex:
        """Return the eigenvalues at N values, (N, n), in no order."""
        ...

    def eigenvectors(self, values: Array) -> tuple[Complex, Complex]:
        """Return the eigenvalues at N values, (N, n), and their vectors as columns, (N, n, n)."""
        ...


@dataclass(frozen=True)
class CriticalValue:
    """A value of the parameter at which a branch becomes stable or unstable.

    Attributes:
        value: the value of the parameter.
        kind: ``"flutter"``: a pair crosses the imaginary axis (weave, hunting); ``"divergence"``: a real eigenvalue
            crosses zero (capsize); ``"meeting"``: two eigenvalues on the imaginary axis meet and leave it, as those of
            a top that is too slow.
        eigenvalue: the eigenvalue there, with a non-negative imaginary part; its real part is zero.
        branch: the place of the branch; of a pair, that with the positive imaginary part.
        grows: ``"above"`` or ``"below"`` the value, the mode grows.

    >>> import numpy
    >>> from symbody import equations_of, functions_of_time, linearize, root_locus, symbols, time_derivative, Matrix
    >>> x, c = functions_of_time("x"), symbols("c")
    >>> linear = linearize(equations_of(Matrix([[1]]), [-4 * x - c * time_derivative(x)], [x]))
    >>> critical, = root_locus(linear, over={c: numpy.linspace(-1, 1, 10)}).critical
    >>> round(critical.value, 12), critical.kind, round(critical.frequency, 12)
    (0.0, 'flutter', 2.0)
    """

    value: float
    kind: str
    eigenvalue: complex
    branch: int
    grows: str

    @property
    def frequency(self) -> float:
        """The frequency of the oscillation there, in rad/s."""
        return abs(self.eigenvalue.imag)


def critical_values(family: _Family, values: Array, branches: Complex) -> tuple[CriticalValue, ...]:
    """Return the critical values of tracked branches, located to rounding errors, by their size.

    Args:
        family: the linear models over the parameter.
        values: the values of the parameter, increasing.
        branches: the eigenvalues by branches, (N, n).
    """
    scale = max(float(np.abs(branches).max(initial=0.0)), np.finfo(float).tiny)
    found = [
        *_crossings(family, values, branches, scale),
        *_meetings(family, values, branches, scale),
    ]
    return tuple(sorted(found, key=lambda each: (each.value, each.branch)))


def _crossings(family: _Family, values: Array, branches: Complex, scale: float) -> Iterator[CriticalValue]:
    """Yield where the real part of a branch changes its sign."""
    idle = (
        np.abs(branches).max(axis=0) <= _ON_AXIS * scale
    )  # such as that of a heading, on which nothing depends
    for i, branch in enumerate(branches.T):
        if idle[i]:
            continue
        away = np.flatnonzero(np.abs(branch.real) > _ROUNDED * scale)
        for k, m in pairwise(away):
            if branch.real[k] * branch.real[m] > 0 or branch[k].imag + branch[m].imag < -1e-12 * scale:
                continue
            value, s = _crossing(family, values[k : m + 1], branch[k : m + 1], int(idle.sum()))
            kind = "flutter" if abs(s.imag) > _ON_AXIS * scale else "divergence"
            grows = "above" if branch.real[m] > 0 else "below"
            yield CriticalValue(value, kind, 1j * abs(s.imag) if kind == "flutter" else 0j, i, grows)


def _crossing(family: _Family, values: Array, branch: Complex, idle: int) -> tuple[float, complex]:
    """Return where the real part of a branch vanishes between two values, and the eigenvalue there.

    Args:
        family: the linear models over the parameter.
        values: the values of the parameter, on both sides.
        branch: the eigenvalues there.
        idle: how many other eigenvalues are always zero.
    """
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to load

    all_found, all_vectors = family.eigenvectors(values)
    known = [
        _Sample(float(v), found, vectors, int(np.argmin(np.abs(found - s))))
        for v, s, found, vectors in zip(values, branch, all_found, all_vectors, strict=True)
    ]

    def real_part(value: float) -> float:
        s = _on_branch(family, known, value)
        found = next(each.found for each in known if each.value == value)
        near = found[np.argsort(np.abs(found), kind="stable")[: idle + 1]]
        # beside zeros, with which it is defective as it becomes zero, the sum is exact, and its terms are not
        return float(near.sum().real) if idle and s in near.tolist() else s.real

    root = float(brentq(real_part, values[0], values[-1], xtol=1e-15, rtol=1e-14, maxiter=_MOST))
    return root, _on_branch(family, known, root)


@dataclass(frozen=True, eq=False)
class _Sample:
    """The eigenvalues and their vectors at a value of the parameter, and the place of the branch among them."""

    value: float
    found: Complex
    vectors: Complex
    place: int

    @property
    def eigenvalue(self) -> complex:
        return complex(self.found[self.place])


def _on_branch(family: _Family, known: list[_Sample], value: float) -> complex:
    """Return the eigenvalue of a branch, and know it from now on.

    It is the one whose vector is like that of the nearest known one: others may cross the axis at the same place.
    """
    places = [each.value for each in known]
    if value in places:
        return known[places.index(value)].eigenvalue
    k = min(max(bisect(places, value), 1), len(known) - 1)
    before, after = known[k - 1], known[k]
    share = (value - before.value) / (after.value - before.value)
    expected = before.eigenvalue + (after.eigenvalue - before.eigenvalue) * share
    near = before if share < 0.5 else after
    (found,), (vectors,) = family.eigenvectors(np.array([value]))
    like = np.abs(likeness(near.vectors[None], vectors[None])[0, near.place])
    size = float(np.abs(found).max()) or 1.0
    place = int(np.argmin(1 - np.clip(like, 0, 1) + np.abs(found - expected) / size))
    insort(known, _Sample(value, found, vectors, place), key=lambda each: each.value)
    return complex(found[place])


def _meetings(family: _Family, values: Array, branches: Complex, scale: float) -> Iterator[CriticalValue]:
    """Yield where two branches on the imaginary axis meet and leave it: ``s`` and ``-s*``."""
    on_axis = np.abs(branches.real) <= _ON_AXIS * scale
    seen: list[tuple[int, set[int]]] = []
    for i in range(branches.shape[1]):
        for k in np.flatnonzero(on_axis[:-1, i] != on_axis[1:, i]).tolist():
            away = k if on_axis[k + 1, i] else k + 1
            s = branches[away, i]
            if s.imag < -_ROUNDED * scale:
                continue
            mirror = np.abs(branches[away] + s.conjugate())
            mirror[i] = np.inf
            j = int(np.argmin(mirror))
            if mirror[j] > _ON_AXIS * scale or (k, {i, j}) in seen:
                continue
            seen.append((k, {i, j}))
            near = slice(max(k - 1, 0), k + 3)
            value, mean = _meeting(family, values[near], branches[near][:, [i, j]])
            grows = "above" if away == k + 1 else "below"
            eigenvalue = 1j * abs(mean.imag) if abs(mean.imag) > _ON_AXIS * scale else 0j
            yield CriticalValue(value, "meeting", eigenvalue, i, grows)


def _meeting(family: _Family, values: Array, pair: Complex) -> tuple[float, complex]:
    """Return where two eigenvalues meet: the zero of the square of their difference, which is smooth there."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to load

    known = [(float(v), *_invariants(s, r)) for v, (s, r) in zip(values, pair, strict=True)]

    def square(value: float) -> float:
        return _of_pair(family, known, value)[1].real

    signs = [each[2].real for each in known]
    k = next((k for k, (a, b) in enumerate(pairwise(signs)) if a * b <= 0), None)
    if k is None:  # a meeting without a change of sign: the axis is touched
        best = int(np.argmin(np.abs(signs)))
        return known[best][0], known[best][1]
    root = float(brentq(square, known[k][0], known[k + 1][0], xtol=1e-15, rtol=1e-14, maxiter=_MOST))
    return root, _of_pair(family, known, root)[0]


def _invariants(s: complex, r: complex) -> tuple[complex, complex]:
    return complex((s + r) / 2), complex((s - r) ** 2)


def _of_pair(
    family: _Family, known: list[tuple[float, complex, complex]], value: float
) -> tuple[complex, complex]:
    """Return the mean of two branches and the square of their difference; both are known from now on."""
    places = [v for v, _, _ in known]
    if value in places:
        return known[places.index(value)][1:]
    k = min(max(bisect(places, value), 1), len(known) - 1)
    (a, mean_a, square_a), (b, mean_b, square_b) = known[k - 1], known[k]
    share = (value - a) / (b - a)
    mean, square = mean_a + (mean_b - mean_a) * share, square_a + (square_b - square_a) * share
    found = family.eigenvalues(np.array([value]))[0]
    size = float(np.abs(found).max()) or 1.0
    candidates = [_invariants(s, r) for s, r in combinations(found.tolist(), 2)]
    best = min(candidates, key=lambda each: size * abs(each[0] - mean) + abs(each[1] - square))
    insort(known, (value, *best), key=lambda each: each[0])
    return best
