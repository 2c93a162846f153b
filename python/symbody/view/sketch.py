"""Sketches: the mechanism at one instant as flat shapes, which any format of vector graphics can contain."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError
from scipy.spatial.transform import Rotation

from symbody.view.camera import AXES
from symbody.view.drawable_motion import DrawableMotion
from symbody.view.drawing_options import DrawingOptions
from symbody.view.label_placement import with_placed_labels
from symbody.view.mark import Dot, Ellipse, Label, Line, Mark, Patch, Place, Sketch, outermost
from symbody.view.scene import scene
from symbody.view.solid import INSIDE, corners

Array = NDArray[np.float64]

WIDTH = 640
"""The width of a sketch, in points."""

MARGIN = 40
"""The margin around what is drawn, in points, which holds the names."""

TALLEST = 480
"""The height of a sketch at most, in points."""

ROUND = 32
"""The corners of a circle."""

BODY_AXES = 0.09
"""The length of the axes of bodies, in radii of the picture."""

HEAD = 11
"""The length of the head of an arrow, in points."""

AXIS_COLORS = ("#c0392b", "#27824a", "#2563a8")


def sketch(motion: DrawableMotion, instant: int = 0, options: DrawingOptions | None = None) -> Sketch:
    """Return the mechanism of a motion at one instant: bodies with their axes, rods, threads, points, and the ground.

    Args:
        motion: the motion. What its points and threads belong to is found from all of its instants.
        instant: the index of the instant that is drawn.
        options: what else to show.

    Raises:
        ViewError: there is nothing to draw, or a value is not finite.

    >>> import numpy as np
    >>> from types import SimpleNamespace
    >>> from symbody import Body, System, functions_of_time, translate
    >>> x = functions_of_time("x")
    >>> system = System([Body(translate(x, 0, 0), 1, name="cart")], coordinates=[x])
    >>> values = lambda wanted: np.array([[e.evaluate({x: 0.5})] for e in wanted])
    >>> motion = SimpleNamespace(t=np.zeros(1), system=system, evaluate=values)
    >>> [mark.text for mark in sketch(motion).marks if isinstance(mark, Label)]
    ['x', 'y', 'z', 'ground', 'cart']
    """
    content = scene(motion, options or DrawingOptions(), "")
    return sketch_of(content, instant)


def sketch_of(content: Mapping[str, Any], instant: int = 0) -> Sketch:
    """Return a scene at one instant; its `actions` are forces and moments to be drawn as arrows."""
    return _Projection(content, instant).sketch()


class _Projection:
    """The marks of a scene at an instant, seen from its camera in parallel projection."""

    def __init__(self, content: Mapping[str, Any], instant: int) -> None:
        self.content, self.instant = content, instant
        self.poses = [np.array(track).reshape(-1, 7)[instant] for track in content["poses"]]
        view = content["view"]
        towards, up = np.array(view["direction"]), np.array(view["up"])
        right = np.cross(up, towards)
        right /= np.linalg.norm(right)
        self.towards = towards
        self.plane = np.array([right, -np.cross(towards, right)])
        self.follow = (
            np.array(content["follow"]).reshape(-1, 3)[instant] if content["follow"] else np.zeros(3)
        )
        self.radius = float(view["radius"])
        self.scale, self.origin = 1.0, np.zeros(2)
        self.is_measuring = True
        """Whether lengths in points, such as those of the heads of arrows, mean nothing yet."""

    def sketch(self) -> Sketch:
        """Return the sketch: everything is measured first, and drawn to the scale that fills it."""
        flat = np.array([place for mark in self._marks() for place in outermost(mark)])
        low, high = flat.min(axis=0), flat.max(axis=0)
        extent = np.maximum(high - low, 1e-9 * self.radius)
        self.scale = float(min((WIDTH - 2 * MARGIN) / extent[0], (TALLEST - 2 * MARGIN) / extent[1]))
        self.is_measuring = False
        height = extent[1] * self.scale + 2 * MARGIN
        self.origin = np.array([WIDTH, height]) / 2 - self.scale * (low + high) / 2
        marks = tuple(with_placed_labels(self._marks()))
        return Sketch(_width(marks), _height(marks, float(height)), marks)

    def _marks(self) -> list[Mark]:
        solids = sorted(self._solids(), key=lambda each: each[0])
        marks: list[Mark] = [mark for _, marks in solids for mark in marks]
        behind = [*self._axes(), *self._rods_and_threads("thin")]
        ahead = [*self._rods_and_threads(""), *self._body_axes(), *self._points(), *self._names()]
        ahead += [mark for each in self.content.get("actions", ()) for mark in self._action(each)]
        return [*behind, *marks, *ahead]

    def _flat(self, places: Array) -> list[Place]:
        flat = (places - self.follow) @ self.plane.T * self.scale + self.origin
        digits = 15 if self.is_measuring else 2
        return [
            (round(float(x), digits) + 0.0, round(float(y), digits) + 0.0) for x, y in np.atleast_2d(flat)
        ]

    def _in_root(self, pose: int, places: Sequence[Sequence[float]] | Array) -> Array:
        row = self.poses[pose]
        return np.asarray(row[:3] + Rotation.from_quat(row[3:]).apply(np.array(places, dtype=float)))

    def _solids(self) -> Iterator[tuple[float, list[Mark]]]:
        """Yield the solids with their distances towards the camera; each is its outline and its faces."""
        for body in self.content["bodies"]:
            for part in body["parts"]:
                opacity = 0.12 if part.get("glass") else 0.3
                if part["kind"] == "ellipsoid":
                    yield self._ellipsoid(part, body["color"], opacity)
                    continue
                faces = [self._in_root(part["pose"], face) for face in _faces(part)]
                depth = float(np.concatenate(faces).mean(axis=0) @ self.towards)
                outline = self._outline(np.concatenate(faces))
                edges = [
                    side for face in faces if self._is_seen(face) for side in self._sides(face, body["color"])
                ]
                yield depth, [Patch(outline, body["color"], opacity), *edges]

    def _ellipsoid(self, part: Mapping[str, Any], color: str, opacity: float) -> tuple[float, list[Mark]]:
        """Return the distance of an ellipsoid, and its outline: the image of a ball under a linear map, an ellipse.

        With the semi-axes as the columns of A, and the map P to the picture, it is ``x = P A n``, ``|n| = 1``, whose
        semi-axes are the singular values of P A, along the left singular vectors.
        """
        (centre,) = self._in_root(part["pose"], [part["at"]])
        axes = Rotation.from_quat(self.poses[part["pose"]][3:]).as_matrix() * np.array(part["size"])
        sides, radii, _ = np.linalg.svd(self.scale * self.plane @ axes)
        is_round = radii[0] - radii[1] < 1e-6 * radii[0]
        turn = 0.0 if is_round else float(np.degrees(np.arctan2(sides[1, 0], sides[0, 0]))) % 180
        digits = 15 if self.is_measuring else 2
        first, second = (round(float(radius), digits) for radius in radii)
        (at,) = self._flat(centre)
        return float(centre @ self.towards), [Ellipse(at, (first, second), round(turn, 2), color, opacity)]

    def _outline(self, places: Array) -> tuple[Place, ...]:
        flat = (places - self.follow) @ self.plane.T
        try:
            kept = places[ConvexHull(flat).vertices]
        except QhullError:  # seen edge on, or without extent
            kept = places[[int(np.argmin(flat[:, 0])), int(np.argmax(flat[:, 0]))]]
        outline = self._flat(kept)
        first = outline.index(min(outline))  # where the hull begins depends on rounding
        return (*outline[first:], *outline[:first])

    def _is_seen(self, face: Array) -> bool:
        """Return whether a face, whose corners go round counter-clockwise from outside, is turned to the camera."""
        normal = np.cross(face[1] - face[0], face[2] - face[1])
        return bool(normal @ self.towards > -1e-9 * np.linalg.norm(normal))

    def _sides(self, face: Array, color: str) -> list[Line]:
        if len(face) > ROUND:
            return []
        flat = self._flat(face)
        return [Line(a, b, color, 0.8) for a, b in zip(flat, [*flat[1:], flat[0]], strict=True)]

    def _rods_and_threads(self, kind: str) -> Iterator[Line]:
        for rod in self.content["links"]:
            if bool(rod.get("thin")) == bool(kind):
                start, end = self._flat(self._in_root(rod["pose"], [rod["from"], rod["to"]]))
                yield Line(start, end, rod["color"], 1.0 if kind else 4.0, is_dashed=bool(kind))
        for line in [] if kind else self.content["lines"]:
            ends = [np.array(line[end]).reshape(-1, 3)[self.instant] for end in ("from", "to")]
            start, end = self._flat(np.array(ends))
            path = _coil(start, end) if line.get("is_spring") and not self.is_measuring else [start, end]
            yield from (Line(a, b, "#444444", 1.2) for a, b in pairwise(path))

    def _axes(self) -> Iterator[Mark]:
        for axes in self.content["axes"]:
            size = AXES * self.radius
            start, *tips = self._tripod(axes["pose"], size)
            for name, tip, color in zip("xyz", tips, AXIS_COLORS, strict=True):
                if max(abs(a - b) for a, b in zip(start, tip, strict=True)) > 0.1 * size * self.scale:
                    yield Line(start, tip, color, 1.6)
                    yield Label(tip, name, color)
            if axes["name"]:
                yield Label(start, axes["name"], "#1c2733")

    def _body_axes(self) -> Iterator[Line]:
        """Yield the axes x, y and z of each body, in the colours of the ground's; particles have none.

        They are no longer than half of the body.
        """
        for body in self.content["bodies"]:
            if body["has_axes"]:
                extent = max(
                    (float(np.ptp(corners(part), axis=0).max()) for part in body["parts"]), default=np.inf
                )
                start, *tips = self._tripod(body["pose"], min(BODY_AXES * self.radius, extent / 2))
                yield from (
                    Line(start, tip, color, 1.2) for tip, color in zip(tips, AXIS_COLORS, strict=True)
                )

    def _tripod(self, pose: int, size: float) -> list[Place]:
        """Return the origin of a frame, and the tips of its axes."""
        return self._flat(self._in_root(pose, np.vstack([np.zeros(3), size * np.eye(3)])))

    def _action(self, action: Mapping[str, Any]) -> list[Mark]:
        """Return the arrow of a force, or that of a moment: an arc about its axis, or a double head from aside."""
        at, vector = np.array(action["at"]), np.array(action["vector"])
        size = float(np.linalg.norm(vector)) or 1.0
        is_arc = action["is_moment"] and abs(vector @ self.towards) > size / 2
        path = self._flat(_arc(at, vector) if is_arc else np.array([at, at + vector]))
        heads = (
            [_head(path, HEAD)]
            if is_arc or not action["is_moment"]
            else [_head(path, HEAD), _head(path, 2 * HEAD)]
        )
        lines = [Line(a, b, action["color"], 2.0) for a, b in pairwise(path)]
        if self.is_measuring:
            return [*lines]
        patches = [Patch(head, action["color"], 1.0) for head in heads]
        return [*lines, *patches, Label(_beside_tip(path), action["name"], action["color"])]

    def _points(self) -> Iterator[Mark]:
        for body in self.content["bodies"]:
            (centre,) = self._flat(self._in_root(body["pose"], [[0.0, 0.0, 0.0]]))
            if not body["parts"] or self._is_among(centre, body["parts"]):
                yield Dot(centre, body["color"], 3.5)
        for point in self.content["points"]:
            (place,) = self._flat(np.array(point["path"]).reshape(-1, 3)[self.instant])
            yield Dot(place, "#1c2733", 2.5)
            if point["name"]:
                yield Label(place, point["name"], "#1c2733")

    def _names(self) -> Iterator[Label]:
        """Yield the names of bodies, at their centres of mass; at the first solid of one whose solids are elsewhere."""
        for body in self.content["bodies"]:
            if body["is_named"]:
                (place,) = self._flat(self._in_root(body["pose"], [[0.0, 0.0, 0.0]]))
                if body["parts"] and not self._is_among(place, body["parts"]):
                    place = self._middle(body["parts"][0])
                yield Label(place, body["name"], body["color"])

    def _is_among(self, place: Place, parts: Sequence[dict[str, Any]]) -> bool:
        """Return whether a place is seen well within the rectangle around solids."""
        seen = np.array([corner for part in parts for corner in self._box_around(part)])
        low, high = seen.min(axis=0), seen.max(axis=0)
        return bool(np.all(np.abs(np.array(place) - (low + high) / 2) <= INSIDE * (high - low) / 2 + 0.5))

    def _middle(self, part: dict[str, Any]) -> Place:
        across, down = np.mean(self._box_around(part), axis=0)
        return (round(float(across), 2), round(float(down), 2))

    def _box_around(self, part: dict[str, Any]) -> list[Place]:
        return self._flat(self._in_root(part["pose"], corners(part)))


def _coil(start: Place, end: Place) -> list[Place]:
    """Return the zigzag by which books draw a spring; of one that is seen end on, or very short, its line."""
    way = np.array(end) - np.array(start)
    length = float(np.linalg.norm(way))
    if length < _SHORT:
        return [start, end]
    turns = min(max(round(length / _PITCH), 3), _TURNS)
    along = np.linspace(0.15, 0.85, 2 * turns + 1)
    side = np.array([0, *(_AMPLITUDE * (-1) ** k for k in range(2 * turns - 1)), 0])
    places = start + along[:, None] * way + side[:, None] * np.array([-way[1], way[0]]) / length
    return [start, *((round(float(x), 2), round(float(y), 2)) for x, y in places), end]


_TURNS, _PITCH, _AMPLITUDE, _SHORT = 16, 12.0, 6.0, 24.0
"""The most turns of a spring; and the length of a turn, half the width of the spring and its least length in points."""


def _arc(at: Array, vector: Array) -> Array:
    """Return three quarters of a circle about the axis of a moment, in its sense; the radius is half its length."""
    size = float(np.linalg.norm(vector))
    axis = vector / size
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    angle = np.linspace(0, 3 / 2 * np.pi, ROUND)[:, None]
    return np.asarray(at + size / 2 * (np.cos(angle) * first + np.sin(angle) * np.cross(axis, first)))


def _head(path: Sequence[Place], length: float) -> tuple[Place, ...]:
    """Return the head of an arrow at the end of a path; twice as long, it is the second one of a moment."""
    (x, y), tip = path[-2], np.array(path[-1])
    way = tip - [x, y]
    way /= float(np.linalg.norm(way)) or 1.0
    tip = tip - (length - HEAD) * way
    across = HEAD / 3 * np.array([-way[1], way[0]])
    corners = (tip, tip - HEAD * way + across, tip - HEAD * way - across)
    return tuple((round(float(a), 2), round(float(b), 2)) for a, b in corners)


def _beside_tip(path: Sequence[Place]) -> Place:
    """Return where the name of an arrow begins: names go to the right, so that one on the left is below its shaft."""
    (before, above), (x, y) = path[-2:]
    return (x, y + 22) if before > x and above <= y else (x, y)


def _width(marks: Sequence[Mark]) -> float:
    """Return the width that holds all names, some of which are longer than the margin."""
    ends = (mark.at[0] + _LETTER * len(mark.text) + 10 for mark in marks if isinstance(mark, Label))
    return max([WIDTH, *ends])


def _height(marks: Sequence[Mark], height: float) -> float:
    """Return the height that holds all names, some of which are moved down."""
    return round(max([height, *(mark.at[1] + 6 for mark in marks if isinstance(mark, Label))]), 2)


_LETTER = 8
"""The width of a letter at most, in points."""


def _faces(part: Mapping[str, Any]) -> list[Array]:
    """Return the faces of a solid in the frame of its part; those of round ones have many corners."""
    match part["kind"]:
        case "box":
            return _box(part)
        case "plate":
            flat, z = np.array(part["corners"], dtype=float), float(part["z"])
            turned = np.sign(np.sum(np.cross(flat - flat[0], np.roll(flat, -1, axis=0) - flat[0]))) or 1.0
            flat = flat if turned > 0 else flat[::-1]
            half = float(part["thickness"]) / 2
            top = np.column_stack([flat, np.full(len(flat), z + half)])
            return [top, (top - [0, 0, 2 * half])[::-1]]
        case _:
            return _cylinder(part)


def _box(part: Mapping[str, Any]) -> list[Array]:
    half, turn = np.array(part["size"], dtype=float) / 2, np.array(part.get("rotation", np.eye(3)))
    faces = []
    for axis, side in product(range(3), (1, -1)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        corners = np.zeros((4, 3))
        corners[:, axis] = side
        corners[:, i], corners[:, j] = (-1, 1, 1, -1), (-1, -1, 1, 1)
        faces.append((corners[:: int(side)] * half) @ turn.T + np.array(part["at"], dtype=float))
    return faces


def _cylinder(part: Mapping[str, Any]) -> list[Array]:
    start, end = np.array(part["from"], dtype=float), np.array(part["to"], dtype=float)
    axis = (end - start) / (float(np.linalg.norm(end - start)) or 1.0)
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    angle = np.linspace(0, 2 * np.pi, ROUND, endpoint=False)[:, None]
    ring = float(part["radius"]) * (np.cos(angle) * first + np.sin(angle) * np.cross(axis, first))
    return [end + ring, (start + ring)[::-1]]
