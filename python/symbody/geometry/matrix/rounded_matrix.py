"""Rotation matrices in symbols and doubles: those of Denavit and Hartenberg, with ``math.cos(math.pi/2)`` in them.

Their rows are orthonormal only if 6e-17 is taken as zero, and 0.7071067811865476 as the root of 1/2.
"""

from __future__ import annotations

from math import asin, prod

from symbody.geometry.motion.frame_motion import Rows
from symbody.geometry.motion.placement import is_rotation
from symbody.symbolic import Expr, multiple_of_pi, number, sin
from symbody.symbolic.expression.traverse import post_order

from .orientation import SNAP


def without_rounding(rows: Rows) -> Rows:
    """Return the exact rotation matrix of which the doubles in a matrix are rounded, or the matrix if there is none."""
    if is_rotation(rows):
        return rows
    x, y, z = ((_exact(a), _exact(b), _exact(c)) for a, b, c in rows)
    return (x, y, z) if is_rotation((x, y, z)) else rows


def _exact(entry: Expr) -> Expr:
    """Return an entry with decimals that are rounded sines of multiples of pi replaced by exact ones."""
    exact: dict[int, Expr] = {}
    for node in post_order([entry], _parts, lambda node: node.id):
        parts = [exact[part.id] for part in _parts(node)]
        if node.kind == "sum":
            exact[node.id] = sum(parts, start=number(0))
        else:
            exact[node.id] = prod(parts, start=number(1)) if parts else _sine(node)
    return exact[entry.id]


def _parts(node: Expr) -> tuple[Expr, ...]:
    return node.args if node.kind in ("sum", "product") else ()


def _sine(node: Expr) -> Expr:
    if not (node.is_number and node.is_decimal and abs(float(node)) <= 1):
        return node
    angle = asin(float(node))
    if abs(angle) <= SNAP:
        return number(0)
    multiple = multiple_of_pi(angle, SNAP)
    return node if multiple is None else sin(multiple)
