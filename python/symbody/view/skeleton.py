"""Skeletons: the mechanism of a model, drawn with its bodies as rods, points and threads."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.geometry import Point, origin
from symbody.multibody import System
from symbody.multibody.quantity.coordinate_kind import natural_points
from symbody.view.attachment import RIGID, Attachment, Thread, attachment, threads
from symbody.view.chain import carried_by_segments, guides, segments
from symbody.view.drawable_motion import DrawableMotion, mechanism_of
from symbody.view.frame_table import FrameTable
from symbody.view.pose import constants, paths, values

Array = NDArray[np.float64]

COLORS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#17becf", "#bcbd22")
GREY = "#888888"
BEYOND = 0.1
"""The length of a guide beyond the motion, relative to the length of the motion."""


@dataclass(frozen=True)
class Skeleton:
    """The rods of a page, points by name and path, lines by the paths of their ends, and the threads that they show.

    `carried` has the bodies to which rods lead that move with none, by the number of the rod.
    """

    rods: list[dict[str, Any]]
    points: list[tuple[str, Array]]
    lines: list[tuple[Array, Array]]
    threads: list[Thread]
    carried: Mapping[int, set[int]]

    def without(self, bodies: Collection[int]) -> Skeleton:
        """Return the skeleton without the rods of bodies whose shapes are given, or that lead to these alone."""

        def is_hidden(number: int, rod: dict[str, Any]) -> bool:
            return {*bodies} >= (self.carried.get(number) or {rod["body"]})

        return replace(
            self, rods=[rod for k, rod in enumerate(self.rods) if not is_hidden(k, rod)], carried={}
        )

    def longest_arm(self, pose: int) -> Array | None:
        """Return the vector from the origin of a frame to the farthest end of its rods, if it has any."""
        ends = [np.array(rod["to"]) for rod in self.rods if rod["pose"] == pose and not rod.get("thin")]
        return max(ends, key=lambda end: float(np.linalg.norm(end)), default=None)


def skeleton(motion: DrawableMotion, table: FrameTable, tracks: Array) -> Skeleton:
    """Return the skeleton of a model in motion.

    Rods are the constant distances in the chains of frames (segments), the lines along which frames slide (guides), and
    the lines from a centre of mass to the points where forces act and to the natural coordinates of its body (arms).

    Args:
        motion: the motion.
        table: the frames of the page; those of the rods are added.
        tracks: the poses of the bodies, shape (bodies, N, 7).
    """
    named, places, fixed, size = _confirmed(motion, tracks)
    found = threads(mechanism_of(motion), named)
    points, lines, shown = _points(named, places, fixed, size), [], []
    for thread, end in zip(found, paths(motion, [thread.end for thread in found]), strict=True):
        k = named.index(thread.start)
        if _is_drawn(fixed[k], attachment(tracks, end, size), thread, named, end, size):
            shown.append(thread)
            lines.append((places[k], end))
            if np.ptp(end, axis=0).max() < RIGID * size:
                points.append(("", end))
    arms = [*fixed, *_points_of_action(motion, tracks, size)]
    bodies = mechanism_of(motion).bodies
    rods = [*_segments(motion, table), *_guides(motion, table), *_arms(motion, table, arms, RIGID * size)]
    return Skeleton(rods, points, lines, shown, carried_by_segments(bodies))


def _confirmed(
    motion: DrawableMotion, tracks: Array
) -> tuple[list[Point], list[Array], list[Attachment], float]:
    """Return the natural coordinates that move with a body: points, paths, and places; and the size of the picture."""
    named = natural_points(mechanism_of(motion))
    places = paths(motion, named)
    every = np.concatenate([tracks[:, :, :3].reshape(-1, 3), places.reshape(-1, 3), np.zeros((1, 3))])
    size = float(np.linalg.norm(np.ptp(every, axis=0))) or 1.0
    fixed = [attachment(tracks, path, size) for path in places]
    kept = [(p, path, each) for p, path, each in zip(named, places, fixed, strict=True) if each is not None]
    return [p for p, _, _ in kept], [path for _, path, _ in kept], [each for _, _, each in kept], size


def _points(
    named: Sequence[Point], places: Sequence[Array], fixed: Sequence[Attachment], size: float
) -> list[tuple[str, Array]]:
    """Return the points that are not the centre of mass of their body."""
    return [
        (point.name, path)
        for point, path, each in zip(named, places, fixed, strict=True)
        if np.linalg.norm(each.place) > RIGID * size
    ]


def _is_drawn(
    start: Attachment,
    end: Attachment | None,
    thread: Thread,
    named: Sequence[Point],
    path: Array,
    size: float,
) -> bool:
    """Return whether a thread joins a body or a point with another one, or with a fixed place.

    Args:
        start: the attachment of its start.
        end: the attachment of its end; None if it moves with no body.
        thread: the thread.
        named: the natural points of the model.
        path: the path of its end, shape (N, 3).
        size: the size of the picture.
    """
    if end is not None and start.body == end.body:
        return False
    stays = np.ptp(path, axis=0).max() < RIGID * size
    return bool(stays) or end is not None or thread.end in named


def _points_of_action(motion: DrawableMotion, tracks: Array, size: float) -> list[Attachment]:
    """Return the points where forces act, or joints close loops, that are fixed on their bodies."""
    system = mechanism_of(motion)
    bodies = list(system.bodies)
    actions = [a for load in system.loads for a in load.actions if a.body in bodies]
    held = [(bodies.index(action.body), action.point) for action in actions if action.point is not None]
    found = []
    for k, point in (*held, *_loops(system)):
        (path,) = paths(motion, [point])
        each = attachment(tracks[k : k + 1], path, size)
        if each is not None:
            found.append(Attachment(k, each.place))
    return found


def _loops(system: System) -> list[tuple[int, Point]]:
    """Return the points of joints that close loops, on both sides, each with the index of its body."""
    names = [body.name for body in system.bodies]
    return [
        (names.index(name), origin(side))
        for joint in system.joints
        if not joint.opens
        for name, side in joint.ends
        if name in names
    ]


def _segments(motion: DrawableMotion, table: FrameTable) -> list[dict[str, Any]]:
    found = segments(mechanism_of(motion).bodies)
    ends = constants(motion, [x for segment in found for x in segment.to]).reshape(-1, 3)
    return [
        _rod(table.place(segment.frame), np.zeros(3), end, owner)
        for (segment, owner), end in zip(found.items(), ends, strict=True)
    ]


def _guides(motion: DrawableMotion, table: FrameTable) -> list[dict[str, Any]]:
    rods = []
    for guide in guides(mechanism_of(motion).bodies):
        places = values(motion, guide.displacement).T
        low, high = places.min(axis=0), places.max(axis=0)
        more = BEYOND * (high - low)
        rods.append({**_rod(table.place(guide.frame), low - more, high + more, -1), "thin": True})
    return rods


def _arms(
    motion: DrawableMotion, table: FrameTable, arms: Sequence[Attachment], least: float
) -> list[dict[str, Any]]:
    bodies = mechanism_of(motion).bodies
    return [
        _rod(table.place(bodies[arm.body].frame), np.zeros(3), arm.place, arm.body)
        for arm in arms
        if np.linalg.norm(arm.place) > least
    ]


def _rod(pose: int, start: Array, end: Array, body: int) -> dict[str, Any]:
    """Return a rod in the colour of a body, or in grey if the index is -1."""
    color = COLORS[body % len(COLORS)] if body >= 0 else GREY
    ends = {"from": start.tolist(), "to": end.tolist()}
    return {"kind": "rod", "pose": pose, **ends, "body": body, "color": color}
