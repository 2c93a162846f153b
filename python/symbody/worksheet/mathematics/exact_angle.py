"""Angles that are multiples of pi/12: ``arctan(sqrt(3))`` is ``1/3*Pi``, as Maple evaluates it."""

from __future__ import annotations

import math
from collections.abc import Callable

from symbody.symbolic import Expr, cos, number, pi, sin, tan
from symbody.worksheet.values.numeric import as_float
from symbody.worksheet.values.structure import tree_of, walk

__all__ = ["with_exact_angles"]

_PARTS = 12
_DIRECT: dict[str, Callable[[Expr], Expr]] = {"asin": sin, "acos": cos, "atan": tan}


def with_exact_angles(value: Expr) -> Expr:
    """Return a value with multiples of pi/12 in place of the inverse functions that are equal to them."""
    found = {node.value: _angle(node.value) for node in walk(tree_of(value)) if node.kind == "function"}
    angles = {node: angle for node, angle in found.items() if angle is not None}
    return value.subs(angles) if angles else value


def _angle(node: Expr) -> Expr | None:
    """Return the multiple of pi/12 that is equal to an inverse function of exact numbers; None if none is."""
    if node.kind != "function" or node.name not in (*_DIRECT, "atan2") or not node.is_constant:
        return None
    size = as_float(node)
    if size is None or any(argument.is_decimal for argument in node.args):
        return None
    turns = size / math.pi * _PARTS
    angle = number(round(turns)) / _PARTS * pi
    return angle if abs(turns - round(turns)) < 1e-9 and _is_of(node, angle) else None


def _is_of(node: Expr, angle: Expr) -> bool:
    """Whether an angle that is numerically close to an inverse function is exactly equal to it."""
    if node.name == "atan2":
        y, x = node.args
        return bool((y * cos(angle) - x * sin(angle)).is_zero)
    return bool((_DIRECT[node.name](angle) - node.args[0]).is_zero)
