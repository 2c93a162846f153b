"""The kinematic tree of a system: its frames, parents before children."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from symbody.errors import ModelError
from symbody.geometry import Frame
from symbody.geometry.motion import Motion
from symbody.multibody import Action, Body, System
from symbody.multibody.selection import select
from symbody.multibody.system import rate_of_any
from symbody.symbolic import Expr, derivation

from .added_mass import check_loads
from .partial_motion import PartialTwist, partial_twists
from .shifted_origin import with_shifted_origins


@dataclass(frozen=True)
class FrameTree:
    """All frames between the root and the bodies and loads of a system.

    Attributes:
        frames: the root first, every parent before its children.
        parents: the place of each frame's parent in the list.
        coordinates: the coordinates, by place, on which each frame's motion depends.
        carried: whether some motion at or before the frame depends on a coordinate.
        actions: what the loads do.
    """

    frames: tuple[Frame, ...]
    parents: tuple[int, ...]
    coordinates: tuple[tuple[int, ...], ...]
    carried: tuple[bool, ...]
    actions: tuple[Action, ...]
    places: dict[bytes, int]
    system: System
    _twists: dict[int, dict[int, PartialTwist]] = field(default_factory=dict)

    def index(self, frame: Frame) -> int:
        """Return the place of a frame in the list."""
        return self.places[frame.key]

    def motion(self, place: int) -> Motion:
        """Return the motion that takes the parent to the frame."""
        motion = self.frames[place].motion
        assert motion is not None, "only the root has no motion"
        return motion

    def partial_twists(self, place: int) -> dict[int, PartialTwist]:
        """Return what each coordinate, by its place, does to the motion of a frame."""
        if place not in self._twists:
            moving = self.coordinates[place]
            twists = partial_twists(self.motion(place), [self.system.coordinates[k] for k in moving])
            self._twists[place] = dict(zip(moving, twists, strict=True))
        return self._twists[place]

    @property
    def is_rigid(self) -> bool:
        """Whether all frames are rigid, whatever the values of the coordinates."""
        return all(frame.is_rigid for frame in self.frames)


def frame_tree(system: System) -> FrameTree:
    """Return the tree of a system; one derivation makes it once."""
    with derivation() as current:
        trees: dict[System, FrameTree] = current.cache.setdefault("frame tree", {})
        if system not in trees:
            trees[system] = _build(system)
        return trees[system]


def checked_tree(system: System, where: str) -> FrameTree:
    """Return the tree of a system, or raise an error where it can't have equations of motion in its coordinates."""
    if system.root.carrier is not None:
        raise ModelError(
            f"{where}: the bodies hang on the moving master frame {system.root}, whose velocities are no rates of "
            "coordinates; use newton_equations and euler_equations"
        )
    tree = frame_tree(system)
    for frame in tree.frames:
        rate = None if frame.motion is None else rate_of_any(system.coordinates, frame.motion.leaves)
        if rate is not None:
            raise ModelError(
                f"{where}: {frame} holds the rate {rate}; expected frames of coordinates and time alone"
            )
    used = {system.coordinates[k] for moving in tree.coordinates for k in moving}
    used.update(leaf for constraint in system.constraints for leaf in constraint.free_symbols)
    for coordinate in system.coordinates:
        if coordinate not in used:
            raise ModelError(
                f"{where}: the coordinate {coordinate} appears in no frame of a body and in no constraint; "
                "leave it out of the coordinates, or build a frame with it"
            )
    check_loads(system, where)
    return tree


def _build(system: System) -> FrameTree:
    actions = tuple(select(system, "System").actions("System"))
    targets = [body.frame for body in system.bodies]
    targets += [action.anchor.frame for action in actions if action.is_force]
    given, _ = _ordered(system.root, targets)
    numeric = all(_is_numeric(body) for body in system.bodies)
    needed = targets[len(system.bodies) :] if numeric else targets
    moved = with_shifted_origins(given, needed, numeric=numeric)
    ordered, parents = _ordered(system.root, [moved[frame.key] for frame in targets])
    places = {frame.key: place for place, frame in enumerate(ordered)}
    places |= {key: places[frame.key] for key, frame in moved.items() if frame.key in places}
    coordinates = _dependence(ordered, system.coordinates)
    carried = [False]
    for place in range(1, len(ordered)):
        carried.append(carried[parents[place]] or bool(coordinates[place]))
    return FrameTree(tuple(ordered), tuple(parents), coordinates, tuple(carried), actions, places, system)


def _is_numeric(body: Body) -> bool:
    return all(entry.is_constant for entry in (body.mass, *body.moments, *body.products))


def _ordered(root: Frame, targets: Sequence[Frame]) -> tuple[list[Frame], list[int]]:
    """Return the frames up to the targets, and the places of their parents."""
    places, ordered, parents = {root.key: 0}, [root], [0]
    for frame in targets:
        for link in _missing(frame, places):
            if link.parent is None:
                raise ModelError(
                    f"System: one body hangs on {root}, another one on {link}; build all on the same one"
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


def _dependence(frames: list[Frame], coordinates: tuple[Expr, ...]) -> tuple[tuple[int, ...], ...]:
    place = {coordinate: k for k, coordinate in enumerate(coordinates)}
    return tuple(
        ()
        if frame.motion is None
        else tuple(sorted(place[leaf] for leaf in frame.motion.leaves if leaf in place))
        for frame in frames
    )
