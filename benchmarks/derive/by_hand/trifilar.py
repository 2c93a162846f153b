"""The trifilar pendulum in natural coordinates, by hand: the 21 equations of the worksheet.

A plate, an equilateral triangle ABC of side l, hangs by three ropes of length h. Coordinates are the positions of the
vertices and the normal w; the axes of the plate are u = (B + C - 2A)/(sqrt(3) l), v = (C - B)/l and w.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..engines.base import Algebra, Expression
from .vector import Vector, add, dot, scale

COORDINATES = [x + point for point in "ABC" for x in "xyz"] + ["wx", "wy", "wz"]


def equations(algebra: Algebra, *, own_frame: bool) -> list[Expression]:
    """Return Lagrange's equations with multipliers, then the constraints in Baumgarte's form."""
    q, u, a = (algebra.symbols([name + prime for name in COORDINATES]) for prime in ("", "'", "''"))
    constraints = _constraints(algebra, q)
    kinetic = _kinetic_energy(algebra, q, u, own_frame=own_frame)
    momentum_rates = algebra.rate(algebra.gradient(kinetic, u), [*q, *u], [*u, *a])
    multipliers = algebra.symbols([f"lambda{k}" for k in range(1, len(constraints) + 1)])
    work = sum((m * phi for m, phi in zip(multipliers, constraints, strict=True)), start=kinetic)
    m, g = algebra.symbols(["m", "g"])
    weight = [-m * g / 3 if name in {"zA", "zB", "zC"} else 0 for name in COORDINATES]
    slopes = algebra.gradient(work, q)
    motion = [p - s - f for p, s, f in zip(momentum_rates, slopes, weight, strict=True)]
    return motion + _baumgarte(algebra, constraints, q, u, a)


def _points(q: Sequence[Expression]) -> tuple[Vector, Vector, Vector, Vector]:
    """Return A, B, C and w."""
    return (q[0], q[1], q[2]), (q[3], q[4], q[5]), (q[6], q[7], q[8]), (q[9], q[10], q[11])


def _plate_axes(algebra: Algebra, q: Sequence[Expression]) -> tuple[Vector, Vector, Vector]:
    A, B, C, w = _points(q)
    l = algebra.symbol("l")
    u = scale(1 / (algebra.sqrt(3) * l), add(add(B, C), scale(-2, A)))
    v = scale(1 / l, add(C, scale(-1, B)))
    return u, v, w


def _constraints(algebra: Algebra, q: Sequence[Expression]) -> list[Expression]:
    """Return the six of an orthonormal frame and the three of the ropes."""
    u, v, w = _plate_axes(algebra, q)
    l, h = algebra.symbols(["l", "h"])
    along, across = algebra.sqrt(3) * l / 2, l / 2
    anchors = ((0, 0, h), (along, across, h), (along, -across, h))
    ropes = [add(end, scale(-1, anchor)) for end, anchor in zip(_points(q), anchors, strict=False)]
    angles = [dot(u, v), dot(u, w), dot(v, w)]
    lengths = [dot(axis, axis) - 1 for axis in (w, v, u)]
    return angles + lengths + [dot(rope, rope) - h**2 for rope in ropes]


def _kinetic_energy(
    algebra: Algebra, q: Sequence[Expression], speeds: Sequence[Expression], *, own_frame: bool
) -> Expression:
    """Return the energy of the plate, translational only where its inertia is in a frame parallel to ground."""
    A, B, C, _ = _points(speeds)
    total = add(add(A, B), C)
    energy = algebra.symbol("m") * dot(total, total) / 18
    return energy + _rotational_energy(algebra, q, speeds) if own_frame else energy


def _rotational_energy(algebra: Algebra, q: Sequence[Expression], speeds: Sequence[Expression]) -> Expression:
    u, v, w = _plate_axes(algebra, q)
    du, dv, dw = _plate_axes(algebra, speeds)
    x, y, z = dot(w, dv), dot(u, dw), dot(v, du)
    Jxx, Jyy, Jzz, Jyz, Jxz, Jxy = algebra.symbols(["Jxx", "Jyy", "Jzz", "Jyz", "Jxz", "Jxy"])
    squares = Jxx * x**2 + Jyy * y**2 + Jzz * z**2
    return squares / 2 - Jyz * y * z - Jxz * x * z - Jxy * x * y


def _baumgarte(
    algebra: Algebra,
    constraints: Sequence[Expression],
    q: Sequence[Expression],
    u: Sequence[Expression],
    a: Sequence[Expression],
) -> list[Expression]:
    """Return ``omega**2 phi + 2 zeta omega phi' + phi''``."""
    omega, zeta = algebra.symbols(["omega", "zeta"])
    first = algebra.rate(constraints, q, u)
    second = algebra.rate(first, [*q, *u], [*u, *a])
    return [
        omega**2 * phi + 2 * zeta * omega * d1 + d2
        for phi, d1, d2 in zip(constraints, first, second, strict=True)
    ]
