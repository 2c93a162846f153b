"""Kinds of coordinates and speeds: angles, lengths and their rates, by the frames of the bodies."""

from __future__ import annotations

import re
from collections.abc import Iterable

from symbody.geometry import Point
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.multibody.system import System
from symbody.symbolic import Expr, number, pi, substitute

AXES = tuple((number(int(k == 0)), number(int(k == 1)), number(int(k == 2))) for k in range(3))
"""The unit vectors along the axes of a frame."""


def kinds_of_coordinates(system: System) -> dict[Expr, str]:
    """Return the kinds of functions of time, from the frames of bodies and the names of natural coordinates.

    One that displaces by itself is a length, as x in ``x`` and ``-x/r``; others that turn are angles, as phi in
    ``0.3*phi`` and ``-phi``.

    >>> from symbody import Body, functions_of_time, rotate, translate
    >>> x, phi = q = functions_of_time("x phi")
    >>> kinds_of_coordinates(System([Body(translate(x, 0, 0) * rotate("Z", phi), 1, 1, 1, 1)], coordinates=q))
    {x: 'length', phi: 'angle'}
    """
    found: dict[Expr, str] = {}
    motions = [m for body in system.bodies for m in body.frame.motions]
    twists = [m.twist for m in motions if m.twist is not None]
    twists += [] if system.root.carrier is None else [system.root.carrier]
    for kind, leaves in (
        ("length", (leaf for motion in motions for leaf in motion.displacement if leaf.depends_on_time)),
        ("angle", (leaf for motion in motions for leaf in _angles(motion))),
        ("length", (leaf for motion in motions for leaf in _moving_multiples(motion.displacement))),
        ("length", (x for point in natural_points(system) for x in point.coordinates)),
        ("velocity", (u for twist in twists for u in twist.linear)),
        ("angular velocity", (u for twist in twists for u in twist.angular)),
        ("component", (leaf for motion in motions for leaf in motion.leaves)),
    ):
        for leaf in (each for each in leaves if each.kind == "time_function"):
            found.setdefault(leaf, kind)
    return found


UNITS_OF_KINDS = {"angle": "rad", "length": "m", "angular velocity": "rad/s", "velocity": "m/s"}
"""The units of the kinds of coordinates and speeds."""


def units_of_coordinates(system: System) -> dict[Expr, str]:
    """Return the units of coordinates and speeds whose kinds are known from the frames."""
    kinds = kinds_of_coordinates(system)
    return {each: UNITS_OF_KINDS[kind] for each, kind in kinds.items() if kind in UNITS_OF_KINDS}


def natural_points(system: System) -> list[Point]:
    """Return the points whose places are coordinates, from their names: ``x1, y1`` is the point 1.

    >>> from symbody import Body, functions_of_time, translate
    >>> x, y = functions_of_time("xA yA")
    >>> [A] = natural_points(System([Body(translate(x, y, 0), 1)], coordinates=[x, y]))
    >>> A.name, A.coordinates
    ('A', (xA, yA, 0))
    """
    of_joints = {q for joint in system.joints for q in joint.coordinates}  # they are relative to the parent
    groups: dict[str, dict[int, Expr]] = {}
    for coordinate in (q for q in system.coordinates if q not in of_joints):
        found = re.fullmatch(r"([xyzXYZ])_?(.*)", coordinate.name)
        if found:
            groups.setdefault(found[2], {})["xyz".index(found[1].lower())] = coordinate
    return [
        Point(system.root, *(axes.get(k, number(0)) for k in range(3)), name=name)
        for name, axes in groups.items()
        if len(axes) >= 2
    ]


def multiples(expressions: Iterable[Expr]) -> list[Expr]:
    """Return the names that appear in expressions multiplied by a number other than zero.

    >>> from symbody import sin, symbols
    >>> a, b, c = symbols("a b c")
    >>> multiples([a / 2 - b, c * sin(a)])
    [a, b]
    """
    return [
        leaf
        for expression in expressions
        for leaf in sorted(expression.free_symbols, key=str)
        if (slope := expression.diff(leaf)).kind == "number" and not slope.is_zero
    ]


def pure_multiples(expressions: Iterable[Expr]) -> list[Expr]:
    """Return the names that are multiplied by 1, 2 or 1/2; other numbers may have units."""
    return [
        leaf
        for expression in expressions
        for leaf in multiples([expression])
        if is_pure(expression.diff(leaf) ** 2)
    ]


def is_pure(square: Expr) -> bool:
    """Return whether a number is the square of 1, 2 or 1/2, by which forces and lengths are multiplied."""
    return square in _PURE


_PURE = frozenset(number(square) for square in ("1", "4", "1/4"))


def _moving_multiples(expressions: Iterable[Expr]) -> list[Expr]:
    return [leaf for leaf in multiples(expressions) if leaf.depends_on_time]


def _angles(motion: FrameMotion) -> list[Expr]:
    """Return the functions of time for which a full turn changes nothing."""
    if motion.turn_axis is not None:
        return _moving_multiples(motion.variables)
    if not motion.rotates:
        return []
    entries = [x for axis in AXES for x in motion.to_parent(axis)]
    leaves = dict.fromkeys(leaf for x in entries for leaf in _moving(x))
    turned = {leaf: substitute(entries, {leaf: leaf + 2 * pi}) for leaf in leaves}
    return [leaf for leaf in leaves if list(turned[leaf]) == entries]


def _moving(expression: Expr) -> list[Expr]:
    return sorted((leaf for leaf in expression.free_symbols if leaf.depends_on_time), key=str)
