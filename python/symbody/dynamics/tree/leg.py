"""Legs: the displacements of a frame, each in the axes in which it is fixed.

A displacement that is given in other axes, as a point of the ground, is taken apart. If a leg d turns with the last
rotation R about e, whose angle changes by the coordinate q, the given p has ``d = -e x R^T dp/dq``. It must not depend
on q, nor hold sines and cosines, but may depend on other coordinates, such as the length of a rope. The rotations are
those of the frames, and those whose sines and cosines are in p: a particle may be given without its rotations. For a
constant angle, such as that of a ramp, the parameter of the angle takes the place of q.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import NamedTuple, TypeAlias

from symbody.geometry import Triple
from symbody.geometry.component.triple import NULL, is_null
from symbody.geometry.motion.principal_rotation import Rotation, along
from symbody.symbolic import Expr, add3, cross3, number, scale3, sub3, without_idle_symbols

from .orientation_path import OrientationTree, Placed, Turn, Word, joined, variables

Legs: TypeAlias = dict[Word, Triple]
"""The displacements of a frame by the orientations in which they are fixed."""

_MOST = 3
"""The most rotations, one after the other, that are looked for in a displacement."""


class _Part(NamedTuple):
    """A leg that is found behind some rotations."""

    turns: tuple[Turn, ...]
    leg: Triple


def legs(place: Placed, tree: OrientationTree) -> Legs:
    """Return the legs of a frame; what lies along the axis of a rotation is counted with the axes before it.

    Args:
        place: how the frame is given.
        tree: the orientations that are known.
    """
    result: Legs = {(): NULL}
    for word, d in place.displacements:
        _add(result, word, d)
    for source in tuple(result):
        parts, result[source] = _taken_apart(result[source], source, tree)
        for part in parts:
            _add(result, joined(source, part.turns), part.leg)
    for word in sorted(result, key=len, reverse=True):
        if word:
            axis, before = word[-1].axis, word[:-1]
            shift = along(axis, result[word][axis])
            if not is_null(shift):
                result[word] = sub3(result[word], shift)
                _add(result, before, shift)
    return {word: d for word, d in result.items() if not word or not is_null(d)}


def _add(found: Legs, word: Word, d: Triple) -> None:
    """Add a displacement; where it is the only one, its form is kept."""
    before = found.get(word, NULL)
    found[word] = d if is_null(before) else add3(before, d)


def in_order(every: Mapping[bytes, Legs]) -> dict[bytes, Legs]:
    """Return the legs of frames in one order.

    Legs in which a frame of few legs is fixed come first; then those of few rotations; then those that slide. Slides
    along axes of rotation are put behind the last one of the rotations about the axis.
    """
    rank = ranks(every.values())
    return {key: _outwards(_ordered(found, rank)) for key, found in every.items()}


def ranks(every: Iterable[Legs]) -> dict[Word, int]:
    """Return, by orientation, the fewest legs of a frame with a leg in it."""
    result: dict[Word, int] = {}
    for found in every:
        for word in found:
            result[word] = min(len(found) if word else 0, result.get(word, len(found)))
    return result


def _ordered(found: Legs, rank: Mapping[Word, int]) -> Legs:
    words = sorted(found, key=lambda word: (rank[word], len(word), not slides(found[word])))
    return {word: found[word] for word in words}


def _outwards(found: Legs) -> Legs:
    """Return legs with slides along axes of rotation behind the last ones of the rotations about them."""
    result = dict(found)
    for word, d in found.items():
        for axis in range(3):
            last = [other for other in found if other[:-1] == word and other and other[-1].axis == axis]
            if last and d[axis].depends_on_time:
                shift = along(axis, d[axis])
                result[word] = sub3(result[word], shift)
                result[last[-1]] = add3(result[last[-1]], shift)
    return result


def slides(d: Triple) -> bool:
    """Return whether a displacement changes in its axes."""
    return any(component.depends_on_time for component in d)


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


def _taken_apart(p: Triple, source: Word, tree: OrientationTree) -> tuple[list[_Part], Triple]:
    """Return the parts of a displacement that turn with rotations beyond its axes, and the rest."""
    parts, count = list[_Part](), -1
    while len(parts) > count and any(component.depends_on_time for component in p):
        count = len(parts)
        for turns in _known(p, source, tree):
            part = _turning_part(p, turns)
            if part is not None:
                parts.append(part)
                p = _without(p, part)
        for angle in sorted(angles_in(p), key=variables, reverse=True):
            for turn in _turns(angle):
                for part in _found(p, (turn,)):
                    parts.append(part)
                    p = _without(p, part)
    return parts, p


def _known(p: Triple, source: Word, tree: OrientationTree) -> list[tuple[Turn, ...]]:
    """Return the ways on from an orientation with which a displacement may turn, the longest first."""
    x, y, z = p
    leaves = x.free_symbols | y.free_symbols | z.free_symbols
    before = tree.path(source)
    ways = (tree.path(word) for word in tree.words if leaves & word[-1].angle.free_symbols)
    on = [tuple(turn for _, turn in way[len(before) :]) for way in ways if way[: len(before)] == before]
    return sorted(filter(None, on), key=len, reverse=True)


def _turns(angle: Expr) -> Iterator[Turn]:
    """Return the rotations by an angle, of which only the sines and cosines are known, or by its negative."""
    return (Turn(axis, signed) for signed in (angle, -angle) for axis in range(3))


def _turning_part(p: Triple, turns: tuple[Turn, ...]) -> _Part | None:
    """Return the part of a displacement that turns with the last one of some rotations."""
    q = _own_coordinate(turns)
    arm = None if q is None else _arm(p, turns, q)
    return None if arm is None or angles_in(arm) else _Part(turns, arm)


def _found(p: Triple, turns: tuple[Turn, ...]) -> Iterator[_Part]:
    """Return the parts of a displacement that turn with rotations found by the angles in it."""
    for q in sorted(turns[-1].angle.free_symbols, key=str):
        arm = _arm(p, turns, q)
        if arm is None:
            continue
        angles = angles_in(arm)
        if not angles:
            yield _Part(turns, arm)
        elif len(turns) < _MOST:
            for turn in chain.from_iterable(map(_turns, angles)):
                if turn.axis != turns[-1].axis:
                    yield from _found(p, (*turns, turn))
        return


def _arm(p: Triple, turns: Sequence[Turn], q: Expr) -> Triple | None:
    """Return what turns with the last rotation if q changes, in the axes behind it; None if the angle changes it.

    What turns with a constant angle must move, as a slide does on a ramp.
    """
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
    arm = scale3(1 / slope, cross3(velocity, along(last.axis, number(1))))
    moves = last.angle.depends_on_time or any(component.depends_on_time for component in arm)
    if is_null(arm) or not moves or not all(component.diff(q).is_zero for component in arm):
        return None
    arm = bare(arm)
    return None if any(last.angle.free_symbols & component.free_symbols for component in arm) else arm


def _own_coordinate(turns: Sequence[Turn]) -> Expr | None:
    """Return a coordinate that turns the last one of some rotations, and none of the others; or else a parameter."""
    others = frozenset[Expr]().union(*(turn.angle.free_symbols for turn in turns[:-1]))
    own = turns[-1].angle.free_symbols - others
    return min(own, key=lambda leaf: (not leaf.depends_on_time, str(leaf)), default=None)


def _without(p: Triple, part: _Part) -> Triple:
    """Return the rest of a displacement without a part of it."""
    d = part.leg
    for turn in reversed(part.turns):
        d = Rotation(turn.axis, turn.angle).to_parent(d)
    return bare(sub3(p, d))
