"""Matrices whose variables are angles: they are rotations by themselves, or wrong.

Natural coordinates and quaternions become rotations by constraints. Angles are free: if a matrix of their sines and
cosines isn't a rotation, a sign or an entry is wrong.
"""

from __future__ import annotations

from math import isfinite, pi

from symbody.errors import SymbodyError
from symbody.geometry.motion.frame_motion import Rows
from symbody.geometry.motion.placement import is_rotation
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.expression.traverse import post_order

from .orientation import distance_from_rotation

_WAVES = ("sin", "cos", "tan")
_GOLDEN = 0.6180339887498949
_POSITIONS = 3


def least_distance(rows: Rows) -> float:
    """Return how far a matrix of angles is from a rotation, the least over some positions; zero for other matrices.

    The distance is numeric, so that doubles in the matrix, such as ``math.cos(0.3)``, may be rounded.
    """
    entries = [entry for row in rows for entry in row]
    if is_rotation(rows) or not _has_angles_alone(entries):
        return 0.0
    leaves = sorted(free_symbols(entries), key=str)
    distances = []
    for turn in range(1, _POSITIONS + 1):
        position = {leaf: pi * ((turn * place * _GOLDEN) % 1) for place, leaf in enumerate(leaves, start=1)}
        distances.append(_distance(rows, position))
    return min(distances)


def _has_angles_alone(entries: list[Expr]) -> bool:
    """Whether variables occur in sines, cosines and tangents only."""
    nodes = post_order(entries, _parts_outside_of_waves, lambda node: node.id)
    return not any(node.is_variable for node in nodes)


def _parts_outside_of_waves(node: Expr) -> tuple[Expr, ...]:
    return () if node.kind == "function" and node.name in _WAVES else node.args


def _distance(rows: Rows, position: dict[Expr, float]) -> float:
    try:
        numbers = [[entry.evaluate(position) for entry in row] for row in rows]
    except SymbodyError:
        return 0.0
    return distance_from_rotation(numbers) if all(isfinite(n) for row in numbers for n in row) else 0.0
