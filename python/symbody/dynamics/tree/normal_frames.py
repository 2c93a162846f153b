"""Normal frames: one form for frames that different users build in different ways.

There are three forms. In *local axes*, a frame is placed by the orientations on its way, and displacements in the axes
of each. Displacements given in the axes of ground are taken apart: if p turns with the last rotation R about e, then
``d = -e x R^T dp/dq`` belongs behind it, and the rest before it. In *axes of ground*, a frame is displaced once, as a
point of the ground, and then turned; a particle isn't turned at all. In *chains*, frames that turn about one axis are
linked one after the other, by rotations through the differences of their angles. An angle by which only a particle
turns, given as a point of the ground, is found as an argument of the sines and cosines in its place.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from symbody.geometry import Frame
from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.motion.principal_rotation import Rotation, along
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import Expr, add3, cross3, number, scale3, sub3, time_derivative, without_idle_symbols

from .orientation_path import (
    OrientationTree,
    Placed,
    Step,
    Turn,
    Word,
    carried_back,
    carried_on,
    displaced,
    placed,
    turn_of,
)


class NormalFrames:
    """The normal forms of some frames of one root.

    Args:
        frames: the frames.
        free: the keys of those that may be left without their rotations, because only particles are in them.
    """

    def __init__(self, frames: Sequence[Frame], free: Collection[bytes]) -> None:
        self._free = free
        self._placed: dict[bytes, Placed] = {}
        self._frames = {frame.key: frame for frame in frames}
        for frame in self._frames.values():
            place = placed(frame)
            if place is not None:
                self._placed[frame.key] = place
        self.are_known = len(self._placed) == len(self._frames)
        if self.are_known:
            words = [
                word
                for place in self._placed.values()
                for word in (place.word, *(w for w, _ in place.displacements))
            ]
            self._tree = OrientationTree(words)
            self._paths = {key: self._tree.path(place.word) for key, place in self._placed.items()}
            self._hidden = _hidden_words(self._tree.words, self._placed.values())
            self._turning = _turning_coordinates((*self._tree.words, *self._hidden))

    @property
    def are_parallel(self) -> bool:
        """Whether several orientations are reached, none of them through another one, or some only by particles."""
        ends = {path[-1][0] for path in self._paths.values() if path}
        inner = {step[0] for path in self._paths.values() for step in path[:-1]}
        return bool(self._hidden) or (len(ends) > 1 and not ends & inner)

    def in_axes_of_ground(self) -> dict[bytes, Frame]:
        """Return the frames as points of the ground with rotations."""
        result = {}
        for key, frame in self._frames.items():
            total = displaced((), self._displacements(key))[0]
            path = () if key in self._free else self._paths[key]
            result[key] = _chained(frame, path, [total] + [NULL] * len(path))
        return result

    def in_local_axes(self) -> dict[bytes, Frame]:
        """Return the frames by displacements in the axes of the orientations on their ways."""
        places = {key: displaced(path, self._displacements(key)) for key, path in self._paths.items()}
        for key, path in self._paths.items():
            _take_apart(path, places[key], self._turning)
        _align(self._paths, places)
        bare = {key: [_bare(d) for d in displacements] for key, displacements in places.items()}
        return {key: _chained(frame, self._paths[key], bare[key]) for key, frame in self._frames.items()}

    def in_chains(self) -> dict[bytes, Frame]:
        """Return frames that turn about one axis, each on the last one; none if they turn otherwise."""
        if not _is_planar(self._tree.words):
            return {}
        tree = OrientationTree((*self._tree.words, *self._hidden))
        legs = {key: self._legs(key, tree) for key in self._frames}
        lengths: dict[Word, int] = {}
        for key, leg in legs.items():
            for word in (self._placed[key].word, *(word for word in self._hidden if word in leg)):
                lengths[word] = min(len(leg), lengths.get(word, len(leg)))
        return {
            key: _linked(frame, self._placed[key].word, legs[key], lengths)
            for key, frame in self._frames.items()
        }

    def _legs(self, key: bytes, tree: OrientationTree) -> dict[Word, Triple]:
        """Return the displacements of a frame by the orientations in which they are fixed."""
        legs: dict[Word, Triple] = {(): NULL}
        for word, d in self._placed[key].displacements:
            legs[word] = add3(legs.get(word, NULL), d)
        for word in tree.words:
            path = tree.path(word)
            part = _turning_part(path, legs[()], 0, len(path), self._turning)
            if part is not None:
                legs[()] = _without(legs[()], carried_back(part, path))
                legs[word] = add3(legs.get(word, NULL), part)
        return {word: d for word, d in legs.items() if not word or not is_null(d)}

    def _displacements(self, key: bytes) -> list[tuple[Sequence[Step], Triple]]:
        return [(self._tree.path(word), d) for word, d in self._placed[key].displacements]


def _chained(frame: Frame, path: Sequence[Step], places: Sequence[Triple]) -> Frame:
    result = frame.ancestor.then(Translation(places[0]))
    for (_, turn), d in zip(path, places[1:], strict=True):
        result = result.then(Rotation(turn.axis, turn.angle)).then(Translation(d))
    return result.named(frame.name)


def _is_planar(words: Sequence[Word]) -> bool:
    """Return whether all orientations are reached by one rotation about the same axis."""
    return len({word[0].axis for word in words}) == 1 and max(map(len, words)) == 1


def _hidden_words(words: Sequence[Word], places: Iterable[Placed]) -> tuple[Word, ...]:
    """Return the orientations that no frame of a plane has, though places in the axes of the root turn with them."""
    if not _is_planar(words):
        return ()
    axis, known = words[0][0].axis, {word[0].angle for word in words}
    components = [
        component for place in places for word, d in place.displacements if not word for component in d
    ]
    angles = (angle for angle in _angles(components) if angle not in known and -angle not in known)
    return tuple((Turn(axis, angle),) for angle in angles)


def _angles(components: Iterable[Expr]) -> Sequence[Expr]:
    """Return the arguments of sines and cosines that depend on time, the first one first."""
    found: dict[Expr, None] = {}
    seen = set[int]()
    pending = list(components)[::-1]
    while pending:
        node = pending.pop()
        if node.id in seen or not node.depends_on_time:
            continue
        seen.add(node.id)
        if node.kind == "function" and node.name in {"sin", "cos"}:
            found[node.args[0]] = None
        else:
            pending.extend(reversed(node.args))
    return tuple(found)


def _turning_coordinates(words: Iterable[Word]) -> frozenset[Expr]:
    leaves = frozenset[Expr]().union(*(turn.angle.free_symbols for word in words for turn in word))
    return frozenset(leaf for leaf in leaves if leaf.depends_on_time)


def _take_apart(path: Sequence[Step], places: list[Triple], turning: frozenset[Expr]) -> None:
    """Move parts of displacements behind the rotations with which they turn."""
    for level in range(len(path)):
        for last in range(len(path), level, -1):
            d = _turning_part(path, places[level], level, last, turning)
            if d is not None:
                places[level] = _without(places[level], carried_back(d, path[level:last]))
                places[last] = add3(places[last], d)


def _turning_part(
    path: Sequence[Step], p: Triple, level: int, last: int, turning: frozenset[Expr]
) -> Triple | None:
    """Return the part of a displacement that turns with a rotation, in the axes behind it.

    It may depend on coordinates that turn nothing, such as the length of a rope.

    Args:
        path: the rotations on the way to the frame.
        p: the displacement.
        level: the number of rotations before the axes in which it is given.
        last: the number of rotations up to the one with which the part turns.
        turning: the coordinates that turn frames.
    """
    _, turn = path[last - 1]
    q = _own_coordinate(path, last)
    if q is None or not any(q in component.free_symbols for component in p):
        return None
    slope = turn.angle.diff(q)
    x, y, z = p
    velocity = carried_on((x.diff(q), y.diff(q), z.diff(q)), path[level:last])
    arm = scale3(1 / slope, cross3(velocity, along(turn.axis, number(1))))
    if is_null(arm) or any(_depends_on(component, turning) for component in arm):
        return None
    part = _bare(arm)
    return None if any(turning & component.free_symbols for component in part) else part


def _depends_on(component: Expr, coordinates: frozenset[Expr]) -> bool:
    if time_derivative(component).is_zero:
        return False
    return any(not component.diff(q).is_zero for q in sorted(coordinates & component.free_symbols, key=str))


def _own_coordinate(path: Sequence[Step], last: int) -> Expr | None:
    """Return a coordinate that turns one orientation of a path, and none of the others."""
    others = frozenset[Expr]().union(
        *(turn.angle.free_symbols for k, (_, turn) in enumerate(path) if k != last - 1)
    )
    own = [q for q in path[last - 1][1].angle.free_symbols - others if q.depends_on_time]
    return min(own, key=str, default=None)


def _without(p: Triple, part: Triple) -> Triple:
    """Return the rest of a displacement without a part, in forms without the coordinates of the part."""
    return _bare(sub3(p, part))


def _bare(d: Triple) -> Triple:
    """Return a displacement in forms without symbols on which its values do not depend."""
    x, y, z = (without_idle_symbols((component,))[0] for component in d)
    return x, y, z


def _linked(frame: Frame, word: Word, legs: Mapping[Word, Triple], lengths: Mapping[Word, int]) -> Frame:
    """Return a frame by its legs one after the other, those of frames with the fewest legs first."""
    result, angle = frame.ancestor.then(Translation(legs[()])), number(0)
    others = [other for other in legs if other and other != word]
    for turned in (
        *sorted(others, key=lambda other: lengths.get(other, len(legs))),
        *((word,) if word else ()),
    ):
        (turn,) = turned
        result = result.then(Rotation(turn.axis, turn.angle - angle)).then(
            Translation(legs.get(turned, NULL))
        )
        angle = turn.angle
    if not word and others:
        result = result.then(Rotation(others[0][0].axis, -angle))
    return result.named(frame.name)


def _align(paths: Mapping[bytes, Sequence[Step]], places: Mapping[bytes, list[Triple]]) -> None:
    """Put displacements along axes of rotation behind the rotations, where those of parallel axes add up."""
    for key, path in paths.items():
        here = places[key]
        for level, (_, turn) in enumerate(path):
            shift = along(turn.axis, here[level][turn.axis])
            here[level], here[level + 1] = sub3(here[level], shift), add3(here[level + 1], shift)


def have_other_forms(frames: Sequence[Frame], parents: Sequence[int]) -> bool:
    """Return whether other forms may be shorter.

    So it is where angles cancel along the chains of frames, where displacements hold coordinates that turn frames, and
    where a displacement between two parallel axes of rotation has a part along them.

    Args:
        frames: parents before their children.
        parents: the place of each frame's parent.
    """
    turning = frozenset[Expr]()
    turns: list[Turn | None] = []
    moving = frozenset[Expr]()
    shifted: list[bool] = []
    """For each frame: whether it is displaced along the axis of its last rotation."""
    for frame, parent in zip(frames, parents, strict=True):
        motion, before = frame.motion, turns[parent] if turns else None
        is_shifted = bool(shifted) and shifted[parent]
        turn = None if motion is None else turn_of(motion)
        if motion is not None and turn is not None:
            turning |= {leaf for leaf in motion.leaves if leaf.depends_on_time}
            if before is not None and before.axis == turn.axis:
                angle = before.angle + turn.angle
                if is_shifted or angle.free_symbols < before.angle.free_symbols | motion.leaves:
                    return True
                turn = Turn(turn.axis, angle)
            before, is_shifted = turn, False
        elif motion is not None and not motion.rotates:
            moving |= {leaf for leaf in motion.leaves if leaf.depends_on_time}
            is_shifted |= before is not None and not motion.displacement[before.axis].is_zero
        turns.append(before)
        shifted.append(is_shifted)
    return not turning.isdisjoint(moving)
