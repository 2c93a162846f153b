"""Numeric axes and rotation matrices taken as angles.

The entries of a numeric rotation matrix are rounded in the sixteenth digit, so that its rows are never exactly
orthonormal, and two right derivations would differ. Angles make exact rotations: the sine and the cosine of any number
lie on the circle.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, hypot, isclose, pi

from symbody.symbolic import Expr, cos, number, sin
from symbody.symbolic import pi as PI

from .triple import Triple

SNAP = 1e-12
"""A rounded angle this near to a multiple of 15 degrees is that multiple."""

ROUGH = 1e-6
"""How far from orthonormal a matrix of printed digits may be."""


def exact_angle(value: float) -> Expr:
    """Return a number of radians, exactly a multiple of 15 degrees where it is within rounding of one."""
    twelfths = round(value * 12 / pi)
    if isclose(value, twelfths * pi / 12, rel_tol=0, abs_tol=SNAP):
        return PI * twelfths / 12
    return number(value)


def exact_axis(x: float, y: float, z: float) -> Triple:
    """Return the unit vector along (x, y, z), of length exactly one."""
    azimuth, polar = exact_angle(atan2(y, x)), exact_angle(atan2(hypot(x, y), z))
    return sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar)


def turns(r: Sequence[Sequence[float]]) -> tuple[tuple[int, Expr], ...]:
    """Return the angles about z, y and x, in this order, whose rotations make a numeric rotation matrix."""
    cosine = hypot(r[0][0], r[1][0])
    pitch = exact_angle(atan2(-r[2][0], cosine))
    if cosine < SNAP:  # the first and the third axis coincide: leave the third alone
        return (2, exact_angle(atan2(-r[0][1], r[1][1]))), (1, pitch)
    yaw, roll = exact_angle(atan2(r[1][0], r[0][0])), exact_angle(atan2(r[2][1], r[2][2]))
    return (2, yaw), (1, pitch), (0, roll)


def distance_from_rotation(r: Sequence[Sequence[float]]) -> float:
    """Return the largest entry of ``R R^T - 1``, or 2 for a left-handed triad."""
    defect = max(abs(sum(r[i][k] * r[j][k] for k in range(3)) - (i == j)) for i in range(3) for j in range(3))
    determinant = sum(
        r[0][i] * (r[1][(i + 1) % 3] * r[2][(i + 2) % 3] - r[1][(i + 2) % 3] * r[2][(i + 1) % 3])
        for i in range(3)
    )
    return max(defect, 2.0) if determinant < 0 else defect
