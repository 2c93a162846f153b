"""Normal frames: one form for frames that different users build in different ways.

All forms are made of the legs of the frames (`leg.py`). In *local axes*, a frame is placed by the orientations on its
way, and displacements in the axes of each. In *axes of the base*, such as the ground, a frame is displaced once, as a
point of the base, and then turned; a particle is not turned at all. In *axes of bodies*, a particle is a point of the
body that carries it. In *chains*, a frame is linked by its legs one after the other, with rotations from the axes of
one leg to those of the next. A particle is left in the axes of its last leg, or turned back.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeAlias

from symbody.deferred import cached_property
from symbody.geometry import Frame
from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.motion.principal_rotation import Rotation, along
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import Expr, add3, number, sub3

from .leg import Legs, bare, in_order, legs, ranks, slides
from .orientation_path import (
    OrientationTree,
    Placed,
    Step,
    Turn,
    Word,
    between,
    carried_back,
    displaced,
)

_FEW = 8
"""The most particles for which other forms than points of the ground may be shorter, if no link turns with another."""

_SLIDING = 12
"""The most frames for which further forms are tried if one of them slides."""

FEW_BODIES = 3
"""The most bodies of a system in which particles are tried as points of the base in any case."""

Displacing: TypeAlias = Callable[[Frame, Triple], Frame]
"""How a frame is displaced: the frame that is displaced, and where to."""


def at_once(frame: Frame, d: Triple) -> Frame:
    """Return a displaced frame."""
    return frame.then(Translation(d))


def by_slides(frame: Frame, d: Triple) -> Frame:
    """Return a displaced frame: first by what moves, as a slide that other frames share, then by what does not."""
    x, y, z = map(_constant, d)
    moving = sub3(d, (x, y, z))
    return at_once(frame, d) if is_null(moving) else at_once(at_once(frame, moving), (x, y, z))


def _constant(component: Expr) -> Expr:
    """Return the term of a component without coordinates, if it is linear in these."""
    moving = [leaf for leaf in component.free_symbols if leaf.depends_on_time]
    if any(component.diff(leaf).depends_on_time for leaf in moving):
        return number(0)
    return component.subs(dict.fromkeys(moving, 0))


def by_base(places: Iterable[Placed]) -> list[list[Placed]]:
    """Return the places of frames on each base."""
    result: dict[bytes, list[Placed]] = {}
    for place in places:
        result.setdefault(place.base.key, []).append(place)
    return list(result.values())


class NormalFrames:
    """The normal forms of some frames on one base.

    Args:
        places: how the frames are placed on the base, which may be the ground.
        free: the keys of those that may be left without their rotations, because only particles are in them.
    """

    def __init__(self, places: Sequence[Placed], free: frozenset[bytes]) -> None:
        self._places = {place.frame.key: place for place in places}
        self._free = free

    @cached_property
    def _legs(self) -> dict[bytes, Legs]:
        every = {key: legs(place, self._given_tree) for key, place in self._places.items()}
        return in_order(every)

    @cached_property
    def _given_tree(self) -> OrientationTree:
        """The orientations of frames and of displacements, as they are given."""
        places = self._places.values()
        return OrientationTree(
            word for place in places for word in (place.word, *(w for w, _ in place.displacements))
        )

    @cached_property
    def _tree(self) -> OrientationTree:
        found = (word for legs in self._legs.values() for word in legs)
        return OrientationTree((*self._given_tree.words, *found))

    @cached_property
    def _words(self) -> dict[bytes, Word]:
        """The orientations in which frames are displaced at last: their own.

        Of a particle, or of a frame that never turns, it is the one in which its outermost leg is fixed, or slides.
        """
        rank = ranks(self._legs.values())

        def outermost(found: Legs) -> Word:
            return max(reversed(found), key=lambda word: (rank[word], len(word), slides(found[word])))

        return {key: self._turned(key, ()) or outermost(found) for key, found in self._legs.items()}

    @cached_property
    def _paths(self) -> dict[bytes, list[Step]]:
        return {key: self._tree.path(word) for key, word in self._words.items()}

    @property
    def are_free(self) -> bool:
        """Whether all frames may be left without their rotations."""
        return self._places.keys() <= self._free

    @property
    def are_parallel(self) -> bool:
        """Whether several orientations are reached, none of them through another one."""
        ends, inner = _ends(self._paths.values())
        return len(ends) > 1 and not ends & inner

    @property
    def hold_few_particles(self) -> bool:
        """Whether some of a few frames may be left without their rotations."""
        return len(self._places) <= FEW_BODIES and not self._free.isdisjoint(self._places)

    @property
    def are_many_points(self) -> bool:
        """Whether these are so many particles, none of them turned with another one, that points are the shortest."""
        if not self.are_free or len(self._places) <= _FEW:
            return False
        ends, inner = _ends(self._given_tree.path(place.word) for place in self._places.values())
        return len(ends) != 1 and not ends & inner

    @property
    def share_legs(self) -> bool:
        """Whether these are particles that hang on links of others, two each on average, which turn on the base alone.

        In local axes, each leg of another link is turned to the axes of the last one; points of the base share it.
        """
        if not (self.are_free and self.are_parallel) or self.slide:
            return False
        turned = [[word for word in found if word] for found in self._legs.values()]
        count = sum(map(bool, turned))
        return (
            all(len(word) == 1 for words in turned for word in words) and sum(map(len, turned)) >= 2 * count
        )

    @cached_property
    def slide(self) -> bool:
        """Whether a leg in turned axes changes, and the frames are not too many to try more forms for that."""
        return len(self._places) <= _SLIDING and any(
            slides(d) for found in self._legs.values() for word, d in found.items() if word
        )

    def as_points(self) -> dict[bytes, Frame]:
        """Return the frames as points of the base without rotations, from their displacements as they are given."""
        sums: dict[tuple[Triple, tuple[Word, Triple]], Triple] = {}
        result = {}
        for key, place in self._places.items():
            total = NULL
            for step in place.displacements:  # which frames of one chain share
                if (total, step) not in sums:
                    word, d = step
                    sums[total, step] = add3(total, carried_back(d, self._given_tree.path(word)))
                total = sums[total, step]
            result[key] = _chained(place, (), [total])
        return result

    def in_axes_of_base(self) -> dict[bytes, Frame]:
        """Return the frames as points of the base with rotations."""
        result = {}
        for key, place in self._places.items():
            total = displaced((), self._displacements(key))[0]
            path = self._tree.path(self._turned(key, ()))
            result[key] = _chained(place, path, [total] + [NULL] * len(path))
        return result

    def in_local_axes(self, displaced_by: Displacing = at_once) -> dict[bytes, Frame]:
        """Return the frames by displacements in the axes of the orientations on their ways."""
        return self._displaced(self._paths, displaced_by)

    def in_axes_of_bodies(self) -> dict[bytes, Frame]:
        """Return the frames in local axes, but free ones by displacements in those of others alone."""
        turned = {self._places[key].word for key in self._places.keys() - self._free}
        paths = {}
        for key, path in self._paths.items():
            shared = [count for count, (word, _) in enumerate(path, start=1) if word in turned]
            paths[key] = path[: max(shared, default=0)] if key in self._free else path
        return self._displaced(paths, at_once)

    def _displaced(
        self, paths: Mapping[bytes, Sequence[Step]], displaced_by: Displacing
    ) -> dict[bytes, Frame]:
        """Return the frames by displacements in the axes on some paths."""
        places = {key: displaced(path, self._displacements(key)) for key, path in paths.items()}
        _align(paths, places)
        result = {}
        for key, place in self._places.items():
            local = _chained(place, paths[key], list(map(bare, places[key])), displaced_by)
            word = paths[key][-1][0] if paths[key] else ()
            result[key] = _turned(local, between(word, self._turned(key, word))).named(place.frame.name)
        return result

    def in_chains(self, displaced_by: Displacing = at_once) -> dict[bytes, Frame]:
        """Return the frames by their legs, one after the other; a free one in the axes of the last leg."""
        return {
            key: _linked(
                place, self._legs[key], self._turned(key, next(reversed(self._legs[key]))), displaced_by
            )
            for key, place in self._places.items()
        }

    def in_chains_turned_back(self) -> dict[bytes, Frame]:
        """Return the frames by their legs, one after the other; a free one turned back to the axes of the base."""
        return {
            key: _linked(place, self._legs[key], self._turned(key, ()), at_once)
            for key, place in self._places.items()
        }

    def _turned(self, key: bytes, free: Word) -> Word:
        """Return the orientation of a frame, or that given for free ones."""
        return free if key in self._free else self._places[key].word

    def _displacements(self, key: bytes) -> list[tuple[Sequence[Step], Triple]]:
        return [(self._tree.path(word), d) for word, d in self._legs[key].items()]


def _ends(paths: Iterable[Sequence[Step]]) -> tuple[set[Word], set[Word]]:
    """Return the orientations in which ways end, and those on the ways."""
    several = [[word for word, _ in path] for path in paths]
    return {words[-1] for words in several if words}, {word for words in several for word in words[:-1]}


def _chained(
    place: Placed, path: Sequence[Step], places: Sequence[Triple], displaced_by: Displacing = at_once
) -> Frame:
    result = displaced_by(place.base, places[0])
    for (_, turn), d in zip(path, places[1:], strict=True):
        result = displaced_by(result.then(Rotation(turn.axis, turn.angle)), d)
    return result.named(place.frame.name)


def _turned(frame: Frame, turns: Iterable[Turn]) -> Frame:
    for turn in turns:
        frame = frame.then(Rotation(turn.axis, turn.angle))
    return frame


def _linked(place: Placed, found: Legs, word: Word, displaced_by: Displacing) -> Frame:
    """Return a frame by its legs one after the other, the one in its own axes last."""
    result = displaced_by(place.base, found[()])
    before: Word = ()
    for turned in (*(other for other in found if other and other != word), word):
        result = _turned(result, between(before, turned))
        if turned:
            result = displaced_by(result, found.get(turned, NULL))
        before = turned
    return result.named(place.frame.name)


def _align(paths: Mapping[bytes, Sequence[Step]], places: Mapping[bytes, list[Triple]]) -> None:
    """Put displacements along axes of rotation behind the rotations, where those of parallel axes add up."""
    for key, path in paths.items():
        here = places[key]
        for level, (_, turn) in enumerate(path):
            shift = along(turn.axis, here[level][turn.axis])
            here[level], here[level + 1] = sub3(here[level], shift), add3(here[level + 1], shift)
