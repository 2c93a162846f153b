"""Two hundred linear systems, with solutions by SciPy, or by many digits where doubles don't suffice."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import cycle, islice

import mpmath
import numpy as np
import scipy.linalg

SIZES = (2, 3, 4, 6, 7, 10, 13, 21, 40, 60)
SMALL_SIZES = (2, 3, 4, 6, 7, 10, 13)
EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class System:
    """A x = b, what x should be, and the equations that follow from those before them.

    The error of x is measured in the units of the unknowns, relative to the largest; `condition` is that of the system
    in those units.
    """

    kind: str
    a: np.ndarray
    b: np.ndarray
    x: np.ndarray
    dependent: tuple[int, ...] = ()
    condition: float = 1.0
    units: float | np.ndarray = 1.0

    @property
    def tolerance(self) -> float:
        return 4 * len(self.b) * EPS * self.condition

    def error(self, x: np.ndarray) -> float:
        largest = np.max(np.abs(self.x / self.units))
        return float(np.max(np.abs((x - self.x) / self.units)) / (largest or 1.0))


def _condition(a: np.ndarray, rank: int) -> float:
    values = np.linalg.svd(a, compute_uv=False)
    return float(values[0] / values[rank - 1])


def _regular(kind: str, a: np.ndarray, b: np.ndarray) -> System:
    return System(kind, a, b, scipy.linalg.solve(a, b), condition=_condition(a, len(b)))


def positive(n: int, draw: np.random.Generator) -> System:
    factor = draw.standard_normal((n, n))
    return _regular("positive definite", factor @ factor.T + np.eye(n), draw.standard_normal(n))


def unsymmetric(n: int, draw: np.random.Generator) -> System:
    return _regular("unsymmetric", draw.standard_normal((n, n)), draw.standard_normal(n))


def _saddle_matrix(n: int, draw: np.random.Generator) -> np.ndarray:
    """[[M, -J^T], [J, 0]] with the chain's M and constraints on neighbours."""
    free = n - n // 3
    i = np.arange(free)
    mass = np.where(abs(i[:, None] - i) < 2, draw.uniform(-0.4, 0.4, (free, free)), 0.0)
    mass = (mass + mass.T) / 2 + np.diag(draw.uniform(1, 3, free))
    a = np.zeros((n, n))
    a[:free, :free] = mass
    for k in range(n // 3):
        columns = np.arange(2 * k, min(2 * k + 3, free))
        a[free + k, columns] = draw.standard_normal(len(columns))
    a[:free, free:] = -a[free:, :free].T
    return a


def saddle(n: int, draw: np.random.Generator) -> System:
    return _regular("saddle point", _saddle_matrix(n, draw), draw.standard_normal(n))


def _repeat(a: np.ndarray, draw: np.random.Generator) -> tuple[int, ...]:
    """Make late constraints of a saddle point repeat or combine the first ones; where there is one only, empty it."""
    n, count = len(a), len(a) // 3
    free = n - count
    late = [free + k for k in range(max(count - 1 - count // 4, min(count - 1, 1)), count)]
    for row in late:
        first = a[free : late[0], :free]
        a[row, :free] = draw.choice([1.0, -2.0, 0.7], len(first[:2])) @ first[:2]
        a[:free, row] = -a[row, :free]
    return tuple(late)


def redundant(n: int, draw: np.random.Generator) -> System:
    n = max(n, 3)
    a = _saddle_matrix(n, draw)
    dependent = _repeat(a, draw)
    b = a @ draw.standard_normal(n)
    x = scipy.linalg.lstsq(a, b, cond=1e-11)[0]
    return System("redundant", a, b, x, dependent, _condition(a, n - len(dependent)))


def inconsistent(n: int, draw: np.random.Generator) -> System:
    """The equations with largest coefficients from 1 to 2 have equal weights: plain least squares."""
    n = max(n, 3)
    a = _saddle_matrix(n, draw)
    dependent = _repeat(a, draw)
    sizes = np.abs(a).max(axis=1, keepdims=True)
    a *= 1.5 / np.where(sizes > 0, sizes, 1.0)
    b = draw.standard_normal(n)
    x = scipy.linalg.lstsq(a, b, cond=1e-11)[0]
    return System("inconsistent", a, b, x, dependent, _condition(a, n - len(dependent)))


def weights(a: np.ndarray) -> np.ndarray:
    """For each equation the power of two that brings its largest coefficient between 1 and 2."""
    sizes = np.abs(a).max(axis=1)
    return np.asarray(2.0 ** -np.floor(np.log2(np.where(sizes > 0, sizes, 1.0))))


def weighted(n: int, draw: np.random.Generator) -> System:
    """Contradictory equations in any units are each divided by the power of two below their largest coefficient."""
    system = inconsistent(n, draw)
    a, b = _rescale(system.a, system.b, draw, columns=0)
    weight = weights(a)
    condition = _condition(weight[:, None] * a, len(a) - len(system.dependent))
    x = scipy.linalg.lstsq(weight[:, None] * a, weight * b, cond=1e-11)[0]
    return System("weighted", a, b, x, system.dependent, condition)


def _rescale(
    a: np.ndarray, b: np.ndarray, draw: np.random.Generator, *, columns: int
) -> tuple[np.ndarray, np.ndarray]:
    rows = 10.0 ** draw.uniform(-8, 8, (len(b), 1))
    return rows * a * 10.0 ** draw.uniform(-columns, columns, len(b)), rows[:, 0] * b


def _balanced(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The matrix with rows and columns divided by their largest coefficients, and the units of its unknowns."""
    a = a / np.where((sizes := np.abs(a).max(axis=1)) > 0, sizes, 1.0)[:, None]
    sizes = np.abs(a).max(axis=0)
    units = 1.0 / np.where(sizes > 0, sizes, 1.0)
    return a * units, units


def badly_scaled(n: int, draw: np.random.Generator) -> System:
    matrix = _saddle_matrix(n, draw) if n % 2 else draw.standard_normal((n, n))
    a, b = _rescale(matrix, draw.standard_normal(n), draw, columns=8)
    with mpmath.workdps(100):
        x = mpmath.lu_solve(mpmath.matrix(a.tolist()), mpmath.matrix(b.tolist()))
        exact = np.array([float(entry) for entry in x])
    balanced, units = _balanced(a)
    return System("badly scaled", a, b, exact, condition=_condition(balanced, n), units=units)


def redundant_badly_scaled(n: int, draw: np.random.Generator) -> System:
    """The least x that fits the independent equations, x = B^T (B B^T)^-1 c: the units of the unknowns matter."""
    system = redundant(n, draw)
    a, b = _rescale(system.a, system.b, draw, columns=8)
    kept = np.setdiff1d(np.arange(len(b)), system.dependent)
    with mpmath.workdps(150):
        rows = mpmath.matrix(a[kept].tolist())
        right = mpmath.matrix(b[kept].tolist())
        x = rows.T * mpmath.lu_solve(rows * rows.T, right)
        exact = np.array([float(entry) for entry in x])
    sizes = np.abs(a[kept]).max(axis=1)
    condition = _condition(a[kept] / sizes[:, None], len(kept))
    return System("redundant, badly scaled", a, b, exact, system.dependent, condition)


_KINDS: tuple[tuple[Callable[[int, np.random.Generator], System], tuple[int, ...], int], ...] = (
    (positive, SIZES, 30),
    (unsymmetric, SIZES, 30),
    (saddle, SIZES, 40),
    (redundant, SIZES, 30),
    (inconsistent, SIZES, 20),
    (weighted, SIZES, 10),
    (badly_scaled, SMALL_SIZES, 30),
    (redundant_badly_scaled, SMALL_SIZES, 10),
)


def _all() -> Iterator[System]:
    draw = np.random.default_rng(2026)
    for make, sizes, count in _KINDS:
        yield from (make(n, draw) for n in islice(cycle(sizes), count))


@cache
def systems() -> tuple[System, ...]:
    """Return the systems, the same ones each time."""
    return tuple(_all())
