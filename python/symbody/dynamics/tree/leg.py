"""Legs: the displacements of a frame, each in the axes in which it is fixed.

A displacement that is given in other axes, as a point of the ground, is taken apart. If a leg d turns with the last
rotation R about e, whose angle changes by the coordinate q, the given p has ``d = -e x R^T dp/dq``. It must not depend
on coordinates that turn frames, but may depend on others, such as the length of a rope. The rotations are those of the
frames, and those whose sines and cosines are in p: a particle is given without its rotations.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, TypeAlias

from symbody.geometry import Triple
from symbody.geometry.component.triple import NULL, is_null
from symbody.geometry.motion.principal_rotation import Rotation, along
from symbody.symbolic import Expr, add3, cross3, scale3, sub3, time_derivative, without_idle_symbols

from .orientation_path import OrientationTree, Placed, Turn, Word, joined, variables

Legs: TypeAlias = dict[Word, Triple]
"""The displacements of a frame by the orientations in which they are fixed."""


class _Part(NamedTuple):
    """A leg that is found behind some rotations."""

    turns: tuple[Turn, ...]
    leg: Triple


def legs(place: Placed, tree: OrientationTree, turning: frozenset[Expr]) -> Legs:
    """Return the legs of a frame.

    Args:
        place: how the frame is given.
        tree: the orientations that are known.
        turning: the coordinates that turn frames, or are in sines and cosines of displacements.
    """
    result: Legs = {(): NULL}
    for word, d in place.displacements:
        result[word] = add3(result.get(word, NULL), d)
    for source in tuple(result):
        rest = result[source]
        if not is_null(rest) and any(turning & component.free_symbols for component in rest):
            parts, result[source] = _taken_apart(rest, source, tree, turning)
            for part in parts:
                word = joined(source, part.turns)
                result[word] = add3(result.get(word, NULL), part.leg)
    return {word: d for word, d in result.items() if not word or not is_null(d)}


def turning_coordinates(words: Iterable[Word], places: Iterable[Placed]) -> frozenset[Expr]:
    """Return the coordinates that turn orientations, or are in sines and cosines of displacements."""
    angles = [turn.angle for word in words for turn in word]
    angles += angles_in(component for place in places for _, d in place.displacements for component in d)
    leaves = frozenset[Expr]().union(*(angle.free_symbols for angle in angles))
    return frozenset(leaf for leaf in leaves if leaf.depends_on_time)


def angles_in(components: Iterable[Expr]) -> Sequence[Expr]:
    """Return the arguments of sines and cosines in what depends on time, the first one first."""
    found: dict[Expr, None] = {}
    seen = set[int]()
    pending = [component for component in components if component.depends_on_time][::-1]
    while pending:
        node = pending.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        if node.kind == "function" and node.name in {"sin", "cos"}:
            found[node.args[0]] = None
        elif node.depends_on_time:
            pending.extend(reversed(node.args))
    return tuple(found)


def bare(d: Triple) -> Triple:
    """Return a displacement in forms without symbols on which its values do not depend."""
    x, y, z = (without_idle_symbols((component,))[0] for component in d)
    return x, y, z


def _taken_apart(
    p: Triple, source: Word, tree: OrientationTree, turning: frozenset[Expr]
) -> tuple[list[_Part], Triple]:
    """Return the parts of a displacement that turn with rotations beyond its axes, and the rest."""
    parts = list[_Part]()
    for turns in _known(source, tree):
        part = _turning_part(p, turns, _own_coordinates(turns), turning)
        if part is not None:
            parts.append(part)
            p = bare(sub3(p, _carried_back(part)))
    for angle in sorted(angles_in(p), key=variables, reverse=True):
        for axis in range(3):
            for part in _found(p, (Turn(axis, angle),), turning):
                parts.append(part)
                p = bare(sub3(p, _carried_back(part)))
    return parts, p


def _known(source: Word, tree: OrientationTree) -> Iterator[tuple[Turn, ...]]:
    """Return the ways on from an orientation, the longest first."""
    before = tree.path(source)
    ways = (tree.path(word) for word in tree.words)
    on = [tuple(turn for _, turn in way[len(before) :]) for way in ways if way[: len(before)] == before]
    return iter(sorted(filter(None, on), key=len, reverse=True))


def _found(p: Triple, turns: tuple[Turn, ...], turning: frozenset[Expr]) -> Iterator[_Part]:
    """Return the parts of a displacement that turn with rotations found by the angles in it."""
    inner = turns[-1]
    for q in sorted(inner.angle.free_symbols, key=str):
        arm = _arm(p, turns, q)
        if arm is None or any(inner.angle.free_symbols & component.free_symbols for component in arm):
            continue
        if not any(turning & component.free_symbols for component in arm):
            if any(component.depends_on_time for component in (inner.angle, *arm)):
                yield _Part(turns, arm)
            return
        if len(turns) < 3:
            for angle in angles_in(arm):
                for axis in range(3):
                    if axis != inner.axis:
                        yield from _found(p, (*turns, Turn(axis, angle)), turning)
            return


def _turning_part(
    p: Triple, turns: tuple[Turn, ...], coordinates: Iterable[Expr], turning: frozenset[Expr]
) -> _Part | None:
    """Return the part of a displacement that turns with the last one of some rotations."""
    for q in coordinates:
        arm = _arm(p, turns, q)
        if arm is not None and not any(turning & component.free_symbols for component in arm):
            return _Part(turns, arm)
    return None


def _arm(p: Triple, turns: Sequence[Turn], q: Expr) -> Triple | None:
    """Return what turns with the last rotation if a coordinate changes, in the axes behind it."""
    if not any(q in component.free_symbols for component in p):
        return None
    last = turns[-1]
    slope = last.angle.diff(q)
    if slope.is_zero:
        return None
    x, y, z = p
    velocity = (x.diff(q), y.diff(q), z.diff(q))
    for turn in turns:
        velocity = Rotation(turn.axis, turn.angle).to_child(velocity)
    arm = scale3(1 / slope, cross3(velocity, along(last.axis, NULL[0] + 1)))
    return None if is_null(arm) else bare(arm)


def _own_coordinates(turns: Sequence[Turn]) -> Sequence[Expr]:
    """Return a coordinate, if there is one, that turns the last one of some rotations, and none of the others."""
    others = frozenset[Expr]().union(*(turn.angle.free_symbols for turn in turns[:-1]))
    own = [q for q in turns[-1].angle.free_symbols - others if q.depends_on_time]
    return sorted(own, key=str)[:1]


def _carried_back(part: _Part) -> Triple:
    d = part.leg
    for turn in reversed(part.turns):
        d = Rotation(turn.axis, turn.angle).to_parent(d)
    return d
