"""Vectors of three components over any scalars."""

from __future__ import annotations

from typing import Any

Scalar = Any
Vector = tuple[Scalar, Scalar, Scalar]


def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scale(s: Scalar, a: Vector) -> Vector:
    """Return s a."""
    return (s * a[0], s * a[1], s * a[2])


def dot(a: Vector, b: Vector) -> Scalar:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotate(axis: int, cosine: Scalar, sine: Scalar, a: Vector) -> Vector:
    """Return R a, with R the rotation about a coordinate axis; -sine gives the inverse."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    result = list(a)
    result[j] = cosine * a[j] - sine * a[k]
    result[k] = sine * a[j] + cosine * a[k]
    return (result[0], result[1], result[2])


def along(axis: int, s: Scalar, a: Vector) -> Vector:
    """Return a + s e, with e the unit vector of a coordinate axis."""
    result = list(a)
    result[axis] = result[axis] + s
    return (result[0], result[1], result[2])
