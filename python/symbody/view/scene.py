"""Scenes: what is drawn of a motion, in numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.geometry import Frame, Point, ground
from symbody.multibody import Body
from symbody.view.camera import view_of
from symbody.view.equivalent import equivalent_shape
from symbody.view.link import joint, links
from symbody.view.motion import Motion
from symbody.view.pose import arrows, constants, paths, poses
from symbody.view.shape import Shape

Array = NDArray[np.float64]

COLORS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#17becf", "#bcbd22")
GREY = "#888888"


@dataclass(frozen=True)
class Wishes:
    """What a user asks for beside bodies and links."""

    shapes: Mapping[Body, Shape | Sequence[Shape]] = field(default_factory=dict)
    frames: Sequence[Frame] = ()
    points: Sequence[Point] = ()
    traces: Sequence[Point] = ()
    lines: Sequence[tuple[Point, Point]] = ()
    forces: bool = False


def scene(motion: Motion, wishes: Wishes, title: str) -> dict[str, Any]:
    """Return the scene of a motion as the page reads it.

    Raises:
        ViewError: there is nothing to draw, a value isn't finite, or a shape is given for a body of no part.
    """
    bodies = motion.system.bodies
    _check_shapes(wishes.shapes, bodies)
    frames = _Table()
    centres = poses(motion, [body.frame for body in bodies])[:, :, :3]
    chain = _chain(motion, frames)
    given = [_given(motion, frames, wishes.shapes.get(body)) for body in bodies]
    points = [*wishes.points, *wishes.traces, *(end for line in wishes.lines for end in line)]
    places = paths(motion, points)
    tracks = poses(motion, frames.frames)
    parts = [*chain, *(part for parts in given for part in parts)]
    core = _extent(centres, places, tracks, parts)
    around = _surroundings(motion, given, centres).reshape(-1, 3)
    view = view_of(np.concatenate([core, around]), core, _up(motion))
    least = 0.04 * view.radius
    for part in chain:
        part["radius"] = least / 4
    page = {
        "title": title,
        "view": view.entry,
        "times": motion.t.tolist(),
        "bodies": _bodies(motion, frames, given, least),
        "links": chain,
        "axes": [{"name": frame.name, "pose": frames.place(frame)} for frame in (ground, *wishes.frames)],
        **_points(wishes, places),
        "arrows": _arrows(motion, view.radius) if wishes.forces else [],
    }
    return {**page, "poses": [_rounded(track) for track in poses(motion, frames.frames)]}


class _Table:
    """The frames of the page, each with its place in the list of poses."""

    def __init__(self) -> None:
        self._places: dict[Frame, int] = {}

    @property
    def frames(self) -> list[Frame]:
        return list(self._places)

    def place(self, frame: Frame) -> int:
        """Return the place of a frame, which is added if it is new."""
        return self._places.setdefault(frame, len(self._places))


def _check_shapes(shapes: Mapping[Body, object], bodies: Sequence[Body]) -> None:
    for body in shapes:
        if body not in bodies:
            raise ViewError(
                f"view: there is a shape for {body!r}, which is no body of the system; "
                f"expected one of {', '.join(map(repr, bodies))}"
            )


def _up(motion: Motion) -> Array:
    """Return the direction against gravity, or z."""
    gravity = motion.system.gravity
    if gravity is None:
        return np.array([0.0, 0, 1])
    down = arrows(motion, [gravity])[0, 0]
    size = float(np.linalg.norm(down))
    return np.asarray(-down / size) if size else np.array([0.0, 0, 1])


def _chain(motion: Motion, frames: _Table) -> list[dict[str, Any]]:
    found = links(motion.system.bodies)
    ends = constants(motion, [x for link in found for x in link.to]).reshape(-1, 3)
    return [
        {
            "kind": "rod",
            "pose": frames.place(link.frame),
            "from": [0.0] * 3,
            "to": end.tolist(),
            "color": COLORS[owner % len(COLORS)] if owner >= 0 else GREY,
        }
        for (link, owner), end in zip(found.items(), ends, strict=True)
    ]


def _given(motion: Motion, frames: _Table, shapes: Shape | Sequence[Shape] | None) -> list[dict[str, Any]]:
    if shapes is None:
        return []
    parts = []
    for shape in [shapes] if isinstance(shapes, Shape) else shapes:
        part = shape.part([float(x) for x in constants(motion, shape.lengths)])
        parts.append(part if shape.frame is None else {**part, "pose": frames.place(shape.frame)})
    return parts


def _bodies(
    motion: Motion, frames: _Table, given: list[list[dict[str, Any]]], least: float
) -> list[dict[str, Any]]:
    entries = []
    for k, (body, parts) in enumerate(zip(motion.system.bodies, given, strict=True)):
        own = {"pose": frames.place(body.frame)}
        entries.append(
            {
                "name": body.name or f"body {k + 1}",
                "color": COLORS[k % len(COLORS)],
                **own,
                "parts": [{**own, **part} for part in parts or [_equivalent(motion, body, least)]],
            }
        )
    return entries


def _equivalent(motion: Motion, body: Body, least: float) -> dict[str, Any]:
    mass, *rest = constants(motion, [body.mass, *body.inertia_entries, *joint(body).coordinates])
    arm = -np.array(rest[9:])
    link = arm if np.linalg.norm(arm) > 0 else None
    return equivalent_shape(float(mass), np.array(rest[:9]).reshape(3, 3), link, least)


def _surroundings(motion: Motion, given: Sequence[Sequence[dict[str, Any]]], centres: Array) -> Array:
    """Return centres of mass, moved to all sides by how far the solids reach, or by their radii of gyration."""
    bodies = motion.system.bodies
    table = constants(motion, [x for body in bodies for x in (body.mass, *body.moments)]).reshape(-1, 4)
    with np.errstate(divide="ignore", invalid="ignore"):
        gyration = np.sqrt(1.5 * np.nan_to_num(table[:, 1:].max(axis=1) / table[:, 0], posinf=0.0).clip(0))
    sizes = [max((_half(part) for part in parts), default=0.0) for parts in given]
    reach = np.where([bool(parts) for parts in given], sizes, gyration)
    sides = np.concatenate([np.eye(3), -np.eye(3)])
    return np.asarray(centres[:, :, None] + (reach[:, None, None] * sides)[:, None])


def _half(part: dict[str, Any]) -> float:
    """Return half of the longest side of a box, and the longest half axis of an ellipsoid."""
    return float(max(part.get("size", [0.0]))) / (2 if part["kind"] == "box" else 1)


def _extent(centres: Array, places: Array, tracks: Array, parts: Sequence[dict[str, Any]]) -> Array:
    """Return the points that the picture must hold: centres of mass, points, ends of links and corners of shapes."""
    found = [centres.reshape(-1, 3), places.reshape(-1, 3), np.zeros((1, 3))]
    found += [track[:, :3] for track in tracks]
    for part in parts:
        if part["kind"] == "rod" and "pose" in part:
            found.append(_carried(tracks[part["pose"]], np.array(part["to"])))
    return np.concatenate(found)


def _carried(track: Array, place: Array) -> Array:
    """Return the path of a point that is fixed in a frame: ``p + v + 2 w (q x v) + 2 q x (q x v)``."""
    q, w = track[:, 3:6], track[:, 6:]
    turned = np.cross(q, np.broadcast_to(place, q.shape))
    return np.asarray(track[:, :3] + place + 2 * w * turned + 2 * np.cross(q, turned))


def _points(wishes: Wishes, places: Array) -> dict[str, Any]:
    """Return points, traces and lines, whose ends are cut from all places in this order."""
    n, k = len(wishes.points), len(wishes.traces)
    ends = places[n + k :]
    return {
        "points": [
            {"name": point.name, "path": _rounded(path)}
            for point, path in zip([*wishes.points, *wishes.traces], places[: n + k], strict=True)
        ],
        "traces": list(range(n, n + k)),
        "lines": [
            {"from": _rounded(start), "to": _rounded(end)}
            for start, end in zip(ends[::2], ends[1::2], strict=True)
        ],
    }


def _arrows(motion: Motion, radius: float) -> list[dict[str, Any]]:
    """Return the forces, of which the largest is drawn as long as half of the radius."""
    actions = [a for load in motion.system.loads for a in load.actions if a.point is not None]
    names = [load.name for load in motion.system.loads for a in load.actions if a.point is not None]
    where = paths(motion, [a.point for a in actions if a.point is not None])
    what = arrows(motion, [a.vector for a in actions])
    largest = float(np.linalg.norm(what, axis=2).max(initial=0)) or 1.0
    return [
        {"name": name, "at": _rounded(at), "vector": _rounded(vector * radius / (2 * largest))}
        for name, at, vector in zip(names, where, what, strict=True)
    ]


def _rounded(track: Array) -> list[float]:
    """Return a track as numbers of seven digits: more than a screen shows."""
    return [float(f"{x:.7g}") for x in track.ravel()]
