"""Coordinates of joints that close loops: what their coordinates would be, from the axes of both sides.

With ``R_ij`` the axis i of P times the axis j of C, the angles of rotations in turn are those of the textbooks on Euler
angles, as of two or three rotations about any axes: ``R = R_a(psi) R_b(theta) R_c(phi)``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from symbody.geometry import Vector, angular_velocity, cross, dot
from symbody.symbolic import (
    ENERGY,
    Expr,
    atan2,
    derivation,
    diff,
    functions_of_time,
    number,
    sqrt,
    substitute,
    symbols,
    t,
    time_derivative,
)

from .closure import AXES, Sides
from .constant_angle import constant_angle, driven_angle

Entry: TypeAlias = Callable[[int, int], Expr]


def angles(turns: str, entry: Entry) -> tuple[Expr, ...]:
    """Return the angles of rotations about axes in turn, from -pi to pi.

    The second one of three is from -pi/2 to pi/2 for three different axes, and from 0 to pi if the third axis is the
    first one.

    Args:
        turns: the axes: one, two different ones, or three of which neighbours differ.
        entry: the entries of the rotation matrix from C to P.
    """
    match [AXES.index(axis) for axis in turns]:
        case [a]:
            i, j = (a + 1) % 3, (a + 2) % 3
            return (atan2(entry(j, i), entry(i, i)),)
        case [a, b]:
            k, s = _third(a, b)
            return atan2(s * entry(k, b), entry(b, b)), atan2(s * entry(a, k), entry(a, a))
        case [a, b, c] if c != a:
            s = _third(a, b)[1]
            middle = atan2(s * entry(a, c), sqrt(entry(a, a) ** 2 + entry(a, b) ** 2))
            return atan2(-s * entry(b, c), entry(c, c)), middle, atan2(-s * entry(a, b), entry(a, a))
        case [a, b, _]:
            k, s = _third(a, b)
            middle = atan2(sqrt(entry(b, a) ** 2 + entry(k, a) ** 2), entry(a, a))
            return atan2(entry(b, a), -s * entry(k, a)), middle, atan2(entry(a, b), s * entry(a, k))
        case _:
            return ()


def _third(a: int, b: int) -> tuple[int, int]:
    """Return the third axis, and the sign with which it is ``a x b``."""
    return 3 - a - b, 1 if (b - a) % 3 == 1 else -1


def cone_angle(entry: Entry) -> Expr:
    """Return the angle between the z axes of P and C, from 0 to pi."""
    return atan2(sqrt(entry(0, 2) ** 2 + entry(1, 2) ** 2), entry(2, 2))


def turning_axis(sides: Sides, turns: str, which: int) -> Vector:
    """Return the vector n of an angle, ``phi' = n . w`` for the angular velocity w of C relative to P.

    As ``(p_i . c_j)' = (c_j x p_i) . w``, it is the sum of ``dphi/dR_ij c_j x p_i``.
    """
    names = {(i, j): symbols(f"_R_{i}{j}") for i in range(3) for j in range(3)}
    angle = angles(turns, lambda i, j: names[i, j])[which]
    values = {name: sides.entry(*place) for place, name in names.items()}
    n = sides.of_parent(0) * 0
    for place, name in names.items():
        slope = diff(angle, name)
        if not slope.is_zero:
            i, j = place
            n += substitute([slope], values)[0] * cross(sides.of_child(j), sides.of_parent(i))
    return n.projected(sides.parent)


def over_all_turns(sides: Sides, axis: int) -> Expr | None:
    """Return the angle about an axis that both sides share at every position, as a sum of coordinates.

    It is smooth over any number of turns, as in a plane mechanism. None if the angular velocity is no sum of rates, of
    coordinates and of expressions of time.

    Args:
        sides: P and C, whose axes are parallel by themselves.
        axis: the one that they share.
    """
    with derivation(order=ENERGY):
        w = angular_velocity(sides.child).projected(sides.parent) - angular_velocity(sides.parent)
        rate = dot(sides.of_parent(axis), w)
        total = number(0)
        moving = (leaf for leaf in rate.free_symbols if leaf.kind == "time_function")
        for leaf in sorted(moving, key=str):
            slope = diff(rate, leaf)
            if slope.is_zero:  # its terms cancel, as those of the motion of a carrier do
                continue
            coordinate = _coordinate(leaf)
            if coordinate is None or not slope.is_number:
                return None
            total += slope * coordinate
        rest = rate - time_derivative(total)
        driven = rest * t if rest.is_number else driven_angle(sides, axis)
        if not (rest - time_derivative(driven)).is_zero:
            return None
        total += driven
        i, j = (axis + 1) % 3, (axis + 2) % 3
        return total + constant_angle(sides, axis, sides.entry(j, i), sides.entry(i, i))


def _coordinate(leaf: Expr) -> Expr | None:
    """Return the coordinate of a rate; None for anything else."""
    return functions_of_time(leaf.name) if leaf.kind == "time_function" and leaf.order == 1 else None
