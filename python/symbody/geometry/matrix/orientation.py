"""Numeric axes and rotation matrices, converted to angles.

The entries of a numeric rotation matrix are rounded in the sixteenth digit. Its rows are never exactly orthonormal, and
two correct derivations would differ. Angles make exact rotations, whatever their numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import atan2, hypot, isclose, sqrt
from math import cos as cosine_of
from math import sin as sine_of
from typing import TypeAlias

from symbody.errors import notify
from symbody.geometry.component.triple import Triple
from symbody.symbolic import Expr, cos, multiple_of_pi, number, sin
from symbody.symbolic import sqrt as root

Numbers: TypeAlias = Sequence[Sequence[float]]
"""A 3x3 matrix of numbers by rows."""

SNAP = 1e-12
"""An angle or a component that was computed this near to a multiple of pi, or a root, is that number."""

ROUGH = 1e-6
"""The largest deviation from orthonormality of a matrix of printed digits."""

LARGEST_DENOMINATOR = 1000
"""Of squares of an axis' components: (1, 2, 3)/sqrt(14) has 1/14, 4/14, 9/14."""


def report_rounding(defect: float, what: str, way_out: str) -> None:
    """Give a notice of numbers that are farther from orthonormal than rounding explains, and were corrected."""
    if defect > SNAP:
        notify(f"{what} by {defect:.3g}, more than rounding of doubles explains; {way_out}")


def exact_axis(x: float, y: float, z: float) -> Triple:
    """Return the unit vector along (x, y, z), of length exactly one: by roots of fractions, or by angles."""
    length = hypot(x, y, z)
    components = x / length, y / length, z / length
    squares = [Fraction(c * c).limit_denominator(LARGEST_DENOMINATOR) for c in components]
    is_exact = all(
        isclose(sqrt(s), abs(c), rel_tol=0, abs_tol=SNAP) for s, c in zip(squares, components, strict=True)
    )
    if is_exact and sum(squares) == 1:
        a, b, c = (root(number(s)) * (-1 if c < 0 else 1) for s, c in zip(squares, components, strict=True))
        return a, b, c
    azimuth, polar = _computed_angle(atan2(y, x)), _computed_angle(atan2(hypot(x, y), z))
    return sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar)


def _computed_angle(value: float) -> Expr:
    """Return a number of radians; a rounded multiple of pi (half degrees, small fractions) becomes an exact one."""
    if abs(value) <= SNAP:
        return number(0)
    multiple = multiple_of_pi(value, SNAP)
    return number(_without_last_digits(value)) if multiple is None else multiple


def _without_last_digits(value: float) -> float:
    """Return 0.7 for 0.7000000000000002: a decimal of few digits, if it differs from the number by rounding only."""
    short = round(value, 12)
    return short if isclose(short, value, rel_tol=4e-16, abs_tol=0) else value


def nearest_rotation(r: Numbers) -> Numbers:
    """Return the nearest orthonormal matrix to one that is nearly so: the orthogonal factor U of ``R = U H``.

    Newton and Schulz: ``U <- U (3 - U^T U)/2`` squares the distance at each step [Higham, Functions of Matrices, 8.3].
    """
    for _ in range(3):
        gram = _product(_transposed(r), r)
        r = _product(r, [[(3 * (i == j) - gram[i][j]) / 2 for j in range(3)] for i in range(3)])
    return r


def turns(r: Numbers) -> tuple[tuple[int, Expr], ...]:
    """Return the angles about z, y and x, in this order, whose rotations make an orthonormal matrix of numbers.

    Near a pitch of a right angle, yaw and roll are nearly the same rotation, and yaw is determined by rounding errors.
    Roll is therefore read from the matrix turned back by this yaw, so that both fit together.
    """
    cosine = hypot(r[0][0], r[1][0])
    pitch = _computed_angle(atan2(-r[2][0], cosine))
    if cosine < SNAP:  # the first and the third axis coincide: leave the third alone
        return (2, _computed_angle(atan2(-r[0][1], r[1][1]))), (1, pitch)
    yaw = _computed_angle(atan2(r[1][0], r[0][0]))
    c, s = cosine_of(float(yaw)), sine_of(float(yaw))
    second, third = (c * r[1][k] - s * r[0][k] for k in (1, 2))
    return (2, yaw), (1, pitch), (0, _computed_angle(atan2(-third, second)))


def largest_difference(a: Numbers, b: Numbers) -> float:
    """Return the largest difference between corresponding entries."""
    return max(abs(x - y) for row, other in zip(a, b, strict=True) for x, y in zip(row, other, strict=True))


def _transposed(r: Numbers) -> Numbers:
    return list(zip(*r, strict=True))


def _product(a: Numbers, b: Numbers) -> Numbers:
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def distance_from_rotation(r: Numbers) -> float:
    """Return the largest entry of ``R R^T - 1``, or 2 for a left-handed triad."""
    defect = max(abs(sum(r[i][k] * r[j][k] for k in range(3)) - (i == j)) for i in range(3) for j in range(3))
    determinant = sum(
        r[0][i] * (r[1][(i + 1) % 3] * r[2][(i + 2) % 3] - r[1][(i + 2) % 3] * r[2][(i + 1) % 3])
        for i in range(3)
    )
    return max(defect, 2.0) if determinant < 0 else defect
