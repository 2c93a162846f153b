"""The length of a vector that may vanish, such as a velocity at rest."""

from __future__ import annotations

from symbody.geometry import Vector
from symbody.symbolic import Abs, Expr, Piecewise, dot3, number, sqrt


def norm(vector: Vector) -> Expr:
    """Return the length of a vector; its derivative is zero, not 0/0, where the length is.

    Implicit methods differentiate forces, and a motion from rest begins with the velocity zero.
    """
    parts = [component for component in vector.components if not component.is_zero]
    if len(parts) < 2:
        return Abs(parts[0]) if parts else number(0)
    square = dot3(vector.components, vector.components)
    return Piecewise((sqrt(square), square), otherwise=0) if square.depends_on_time else sqrt(square)
