"""Numeric axes and rotation matrices taken as angles.

The entries of a numeric rotation matrix are rounded in the sixteenth digit, so that its rows are never exactly
orthonormal, and two right derivations would differ. Angles make exact rotations: the sine and the cosine of any number
lie on the circle.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import atan2, hypot, isclose, sqrt

from symbody.errors import notify
from symbody.symbolic import Expr, cos, multiple_of_pi, number, sin
from symbody.symbolic import sqrt as root

from .triple import Triple

SNAP = 1e-12
"""An angle or a component that was computed this near to a multiple of pi, or a root, is that number."""

ROUGH = 1e-6
"""How far from orthonormal a matrix of printed digits may be."""

LARGEST_DENOMINATOR = 1000
"""Of squares of an axis' components: (1, 2, 3)/sqrt(14) has 1/14, 4/14, 9/14."""


def report_rounding(defect: float, what: str, way_out: str) -> None:
    """Give a notice of numbers that are farther from orthonormal than rounding explains, and are corrected."""
    if defect > SNAP:
        notify(f"{what} by {defect:.3g}, more than rounding of doubles explains; {way_out}")


def exact_axis(x: float, y: float, z: float) -> Triple:
    """Return the unit vector along (x, y, z), of length exactly one: by roots of fractions, else by angles."""
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
    """Return a number of radians, as a multiple of pi (half degrees, small fractions) where rounding hides one."""
    if abs(value) <= SNAP:
        return number(0)
    multiple = multiple_of_pi(value, SNAP)
    return number(value) if multiple is None else multiple


def turns(r: Sequence[Sequence[float]]) -> tuple[tuple[int, Expr], ...]:
    """Return the angles about z, y and x, in this order, whose rotations make a numeric rotation matrix."""
    cosine = hypot(r[0][0], r[1][0])
    pitch = _computed_angle(atan2(-r[2][0], cosine))
    if cosine < SNAP:  # the first and the third axis coincide: leave the third alone
        return (2, _computed_angle(atan2(-r[0][1], r[1][1]))), (1, pitch)
    yaw, roll = _computed_angle(atan2(r[1][0], r[0][0])), _computed_angle(atan2(r[2][1], r[2][2]))
    return (2, yaw), (1, pitch), (0, roll)


def distance_from_rotation(r: Sequence[Sequence[float]]) -> float:
    """Return the largest entry of ``R R^T - 1``, or 2 for a left-handed triad."""
    defect = max(abs(sum(r[i][k] * r[j][k] for k in range(3)) - (i == j)) for i in range(3) for j in range(3))
    determinant = sum(
        r[0][i] * (r[1][(i + 1) % 3] * r[2][(i + 2) % 3] - r[1][(i + 2) % 3] * r[2][(i + 1) % 3])
        for i in range(3)
    )
    return max(defect, 2.0) if determinant < 0 else defect
