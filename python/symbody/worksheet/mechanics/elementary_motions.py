"""The elementary motions of which a matrix is the product, found again from its entries.

``save`` writes a frame as a matrix, and older sheets write matrices by hand. In ``T = (R, p)`` with sines and cosines
of angles a, b, .. the first rotation is about an axis e that is constant: ``dR/da R^T = k [e x]``, so that
``R = R_e(k a) R(a = 0)``. It turns a part r of the displacement, ``dp/da = k e x r``; the rest, ``p - r``, comes before
it. What is left at a = 0 is taken apart in the same way. At the end, the product of the motions is compared with the
matrix.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from symbody.errors import FrameError
from symbody.geometry import Frame, ground, rotate, translate
from symbody.symbolic import (
    Expr,
    Matrix,
    add3,
    cross3,
    dot3,
    expand,
    number,
    scale3,
    sqrt,
    sub3,
    substitute,
    symbol,
)
from symbody.symbolic.expression.traverse import post_order

__all__ = ["frame_of"]

Triple = tuple[Expr, Expr, Expr]
Rows = tuple[Triple, Triple, Triple]

_TRIGONOMETRIC = frozenset({"sin", "cos", "tan", "sec", "csc", "cot"})
_MOST = 12
"""The most angles for which a matrix is searched: with more of them it is no frame that anybody makes at once."""

_known: dict[tuple[int, ...], Frame | None] = {}
"""The frames of matrices that were taken apart, by their entries."""


def frame_of(entries: Sequence[Expr]) -> Frame | None:
    """Return the frame of the 16 entries of a matrix as a chain of elementary motions; None if none is found."""
    key = tuple(entry.id for entry in entries[:12])
    if len(_known) > 10_000:
        _known.clear()
    if key not in _known:
        _known[key] = _found(tuple(entries[:12]))
    return _known[key]


def _found(entries: tuple[Expr, ...]) -> Frame | None:
    held = _angles(entries)
    if not held.angles or len(held.angles) > _MOST:
        return None
    pose = _pose(substitute(entries, held.functions))
    frame = ground
    angles = list(held.angles)
    while any(_depends(pose.rows[i], angles) for i in range(3)):
        first = _first_rotation(pose, angles)
        if first is None:
            return None
        frame = frame * translate(*first.before) * rotate(first.axis, first.rate * first.angle)
        angles.remove(first.angle)
        pose = first.rest
    try:
        frame = (frame * _last(pose)).subs(held.angles)
    except FrameError:
        return None
    return frame if tuple(frame.matrix.entries[:12]) == entries else None


# --- angles -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Held:
    """Angles as variables of their own.

    Attributes:
        angles: each variable, and the angle that it stands for.
        functions: each sine, cosine, .. of the matrix, in these variables.
    """

    angles: dict[Expr, Expr]
    functions: dict[Expr, Expr]


def _angles(entries: Sequence[Expr]) -> _Held:
    """Return the angles in sines and cosines, each argument a sum of multiples of them."""
    known: dict[Expr, Expr] = {}
    functions: dict[Expr, Expr] = {}
    for node in post_order(entries, lambda node: node.args, lambda node: node.id):
        if node.kind != "function" or node.name not in _TRIGONOMETRIC:
            continue
        multiples = {angle: k for k, angle in _multiples(node.args[0])}
        for angle in multiples:
            known.setdefault(angle, symbol(f"_angle{len(known)}"))
        functions[node] = node.subs({node.args[0]: _argument(node.args[0], multiples, known)})
    return _Held({variable: angle for angle, variable in known.items()}, functions)


def _argument(argument: Expr, multiples: Mapping[Expr, Expr], known: Mapping[Expr, Expr]) -> Expr:
    """Return an argument with the variables of its angles; what is constant in it stays."""
    rest = argument - sum((k * angle for angle, k in multiples.items()), start=number(0))
    return rest + sum((k * known[angle] for angle, k in multiples.items()), start=number(0))


def _multiples(argument: Expr) -> Iterable[tuple[Expr, Expr]]:
    """Return the terms of a sum that aren't constant, as numbers times angles."""
    whole = expand(argument)
    for term in whole.args if whole.kind == "sum" else (whole,):
        if term.is_constant:
            continue
        k = number(1)
        for factor in term.args if term.kind == "product" else ():
            k = k * factor if factor.is_number else k
        yield k, term / k


# --- rotations --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Pose:
    rows: Rows
    origin: Triple


@dataclass(frozen=True, slots=True)
class _Rotation:
    """The first rotation of a chain.

    Attributes:
        angle: its variable.
        rate: how many times the variable it turns.
        axis: "X", "Y", "Z", or a unit vector.
        before: the displacement before it.
        rest: the pose after it.
    """

    angle: Expr
    rate: Expr
    axis: str | Triple
    before: Triple
    rest: _Pose


def _pose(entries: Sequence[Expr]) -> _Pose:
    a, b, c, x, d, e, f, y, g, h, i, z = entries
    return _Pose(((a, b, c), (d, e, f), (g, h, i)), (x, y, z))


def _depends(triple: Triple, angles: Iterable[Expr]) -> bool:
    return any(not entry.diff(angle).is_zero for angle in angles for entry in triple)


def _first_rotation(pose: _Pose, angles: Sequence[Expr]) -> _Rotation | None:
    """Return a rotation about a constant axis, if possible one before which no angle occurs."""
    found = [each for angle in angles if (each := _rotation(pose, angle, angles)) is not None]
    plain = [each for each in found if not _depends(each.before, angles)]
    return next(iter([*plain, *found]), None)


def _rotation(pose: _Pose, angle: Expr, angles: Sequence[Expr]) -> _Rotation | None:
    at_rest = dict.fromkeys(angles, number(0))
    turning = _turning(pose.rows, angle)
    axis = _three(substitute(turning, at_rest))
    if axis != turning or all(component.is_zero for component in axis):
        return None
    rate, unit, name = _unit(axis)
    change = _three(entry.diff(angle) for entry in pose.origin)
    turned = add3(
        scale3(-1 / rate, cross3(unit, change)), scale3(_varying(dot3(unit, pose.origin), angles), unit)
    )
    before = sub3(pose.origin, turned)
    if _depends(before, [angle]):  # the displacement depends on the angle in another way
        before, turned = pose.origin, _three([number(0)] * 3)
    if not _depends(before, angles):
        before = _three(substitute(before, at_rest))
    rest = substitute((*pose.rows[0], *pose.rows[1], *pose.rows[2], *turned), {angle: number(0)})
    rows = (_three(rest[:3]), _three(rest[3:6]), _three(rest[6:9]))
    return _Rotation(angle, rate, name, before, _Pose(rows, _three(rest[9:])))


def _varying(expression: Expr, angles: Sequence[Expr]) -> Expr:
    """Return the terms of a sum in which angles occur: along the axis, the others are displacements before it."""
    whole = expand(expression)
    terms = whole.args if whole.kind == "sum" else (whole,)
    return sum((term for term in terms if term.free_symbols & set(angles)), start=number(0))


def _turning(rows: Rows, angle: Expr) -> Triple:
    """Return the axial vector of dR/da R^T."""
    x, y, z = rows
    dx, dy, dz = (_three(entry.diff(angle) for entry in row) for row in rows)
    return dot3(dz, y), dot3(dx, z), dot3(dy, x)


def _unit(axis: Triple) -> tuple[Expr, Triple, str | Triple]:
    """Return the length of a vector with its sign, its direction, and the name of the direction."""
    for i, name in enumerate("XYZ"):
        if all(component.is_zero for k, component in enumerate(axis) if k != i):
            unit = _three(number(int(k == i)) for k in range(3))
            return axis[i], unit, name
    length = sqrt(dot3(axis, axis))
    unit = scale3(1 / length, axis)
    return length, unit, unit


def _three(items: Iterable[Expr]) -> Triple:
    x, y, z = items
    return x, y, z


def _last(pose: _Pose) -> Frame:
    """Return the frame of a pose whose axes are constant."""
    x, y, z = pose.rows
    if all(entry == int(i == k) for i, row in enumerate(pose.rows) for k, entry in enumerate(row)):
        return translate(*pose.origin)
    a, b, c = pose.origin
    return Frame(Matrix([[*x, a], [*y, b], [*z, c], [0, 0, 0, 1]]))
