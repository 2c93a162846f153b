"""The kinematic tree of a system: its frames, parents before children."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple
from weakref import WeakKeyDictionary

from symbody.deferred import cached_property
from symbody.errors import ModelError
from symbody.geometry import Frame
from symbody.geometry.component.triple import NULL
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.geometry.motion.translation import Translation
from symbody.multibody import Action, Body, System
from symbody.symbolic import Expr, current_derivation, derivation, free_symbols
from symbody.symbolic.given.arguments import brief

from .anchored_action import anchor_of
from .given_twist import by_speeds, given_twist
from .partial_motion import PartialTwist, partial_twists, partial_twists_by_speeds, twist_of
from .shifted_origin import with_shifted_origins


@dataclass(frozen=True)
class FrameTree:
    """All frames between the root and the bodies and loads of a system.

    Attributes:
        frames: the root first, every parent before its children.
        parents: the place of each frame's parent in the list.
        moved_by: for each frame, the speeds that move it in its parent, by their places in those of the system.
        carried: for each frame, whether speeds move it, or a frame before it.
        places: the places of frames in the list, by their keys; also of the frames whose origin was shifted.
        actions: the actions of the loads on the bodies of the system.
        system: the system.
    """

    frames: tuple[Frame, ...]
    parents: tuple[int, ...]
    moved_by: tuple[tuple[int, ...], ...]
    carried: tuple[bool, ...]
    places: dict[bytes, int]
    actions: tuple[Action, ...]
    system: System
    _twists: dict[tuple[int, int | None], dict[int, PartialTwist]] = field(default_factory=dict)

    def index(self, frame: Frame) -> int:
        """Return the place of a frame in the list."""
        return self.places[frame.key]

    @cached_property
    def motions(self) -> tuple[FrameMotion, ...]:
        """The motions that take parents to the frames; the identity for the root, which has none."""
        identity = Translation(NULL)
        return tuple(frame.motion or identity for frame in self.frames)

    def partial_twists(self, place: int) -> dict[int, PartialTwist]:
        """Return what each speed, by its place, does to the motion of a frame in its parent."""
        current = current_derivation()
        key = place, None if current is None else current.order
        if key not in self._twists:
            self._twists[key] = dict(zip(self.moved_by[place], self._made(place), strict=True))
        return self._twists[key]

    def _made(self, place: int) -> list[PartialTwist]:
        moving, given = self.moved_by[place], given_twist(self.frames[place])
        if not moving:
            return []
        motion, speeds = self.motions[place], [self.system.speeds[k] for k in moving]
        if given is not None:
            return partial_twists_by_speeds(given, speeds)
        if not motion.leaves.isdisjoint(self.system.coordinate_rates):
            return partial_twists_by_speeds(twist_of(motion, self.system.rate), speeds)
        return partial_twists(motion, [self.system.driving[k] for k in moving])

    @property
    def is_rigid(self) -> bool:
        """Whether all frames are rigid, whatever the values of the coordinates."""
        return all(frame.is_rigid for frame in self.frames)


class _Arrangement(NamedTuple):
    """The frames of a tree and how they hang together, without the system to which they belong; see `FrameTree`."""

    frames: tuple[Frame, ...]
    parents: tuple[int, ...]
    moved_by: tuple[tuple[int, ...], ...]
    carried: tuple[bool, ...]
    places: dict[bytes, int]


_arranged: WeakKeyDictionary[System, dict[int | None, _Arrangement]] = WeakKeyDictionary()
"""By system and by the order to which small variables are kept: the arrangement of its own frames."""


def frame_tree(system: System) -> FrameTree:
    """Return the tree of a system, with partial twists that are derived once per derivation.

    The frames are arranged once, by a derivation of their own: what is made of them doesn't depend on what came before.
    """
    with derivation() as current:
        trees: dict[System, FrameTree] = current.cache.setdefault("frame tree", {})
        if system not in trees:
            known = _arranged.setdefault(system, {})
            if current.order not in known:
                with derivation(fresh=True, order=current.order):
                    known[current.order] = _arrangement(system, {})
            trees[system] = _tree(system, known[current.order])
        return trees[system]


def _tree(system: System, arrangement: _Arrangement) -> FrameTree:
    return FrameTree(*arrangement, system.actions, system)


def targets(system: System) -> list[Frame]:
    """Return the frames of the bodies of a system, then those on which forces act."""
    frames = [body.frame for body in system.bodies]
    return frames + [anchor_of(action).frame for action in system.actions if action.is_force]


def tree_of_forms(system: System, forms: Mapping[bytes, Frame]) -> FrameTree:
    """Return the tree of a system with the frames of its bodies and forces in other forms, by their keys."""
    return _tree(system, _arrangement(system, forms))


def _arrangement(system: System, forms: Mapping[bytes, Frame]) -> _Arrangement:
    given = targets(system)
    chosen = [by_speeds(forms.get(frame.key, frame), system) for frame in given]
    root = by_speeds(system.root, system)
    frames, _ = _ordered(root, chosen)
    numeric = all(_is_numeric(body) for body in system.bodies)
    needed = chosen[len(system.bodies) :] if numeric else chosen
    moved = with_shifted_origins(frames, needed, numeric=numeric)
    ordered, parents = _ordered(root, [moved[frame.key] for frame in chosen])
    places = {frame.key: place for place, frame in enumerate(ordered)}
    places |= {key: places[frame.key] for key, frame in moved.items() if frame.key in places}
    places |= {
        frame.key: places[form.key] for frame, form in zip(given, chosen, strict=True) if form.key in places
    }
    moved_by = _dependence(ordered, system)
    carried = [bool(moved_by[0])]
    for place in range(1, len(ordered)):
        carried.append(carried[parents[place]] or bool(moved_by[place]))
    return _Arrangement(tuple(ordered), tuple(parents), moved_by, tuple(carried), places)


def _is_numeric(body: Body) -> bool:
    return all(entry.is_constant for entry in (body.mass, *body.moments, *body.products))


def _ordered(root: Frame, targets: Sequence[Frame]) -> tuple[list[Frame], list[int]]:
    """Return the frames up to the targets, and the places of their parents."""
    places, ordered, parents = {root.key: 0}, [root], [0]
    for frame in targets:
        for link in _missing(frame, places):
            if link.parent is None:
                raise ModelError(
                    f"System: one body is attached to {brief(root)}, another one to {brief(link)}; build all on "
                    "the same one"
                )
            parents.append(places[link.parent.key])
            places[link.key] = len(ordered)
            ordered.append(link)
    return ordered, parents


def _missing(frame: Frame, places: dict[bytes, int]) -> list[Frame]:
    missing = []
    link: Frame | None = frame
    while link is not None and link.key not in places:
        missing.append(link)
        link = link.parent
    missing.reverse()
    return missing


def _dependence(frames: Sequence[Frame], system: System) -> tuple[tuple[int, ...], ...]:
    by_speed: dict[Expr, tuple[int, ...]] = {speed: (k,) for k, speed in enumerate(system.speeds)}
    by_coordinate = _speeds_by_coordinate(system)
    moving = []
    for frame in frames:
        twist = given_twist(frame)
        if twist is not None:
            leaves, places = free_symbols((*twist.angular, *twist.linear)), by_speed
        else:
            leaves = frozenset() if frame.motion is None else frame.motion.leaves
            places = by_coordinate
        moving.append(tuple(sorted({k for leaf in leaves for k in places.get(leaf, ())})))
    return tuple(moving)


def _speeds_by_coordinate(system: System) -> dict[Expr, tuple[int, ...]]:
    """Return the places of the speeds of which the rate of each coordinate is made."""
    quasi, places = len(system.quasi_velocities), {speed: k for k, speed in enumerate(system.speeds)}
    made: dict[Expr, tuple[int, ...]] = {q: (k,) for k, q in enumerate(system.driving) if k >= quasi}
    for q, rate in system.coordinate_rates.items():
        made[q] = tuple(places[leaf] for leaf in rate.free_symbols if leaf in places)
    return made
