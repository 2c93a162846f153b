"""Scenes: the data of a page, from a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.geometry import ground
from symbody.multibody import Body, Element
from symbody.symbolic.given.arguments import brief
from symbody.view.arrow import arrow_entries, load_arrows, reaction_arrows
from symbody.view.camera import view_of
from symbody.view.chain import joint
from symbody.view.drawable_motion import DrawableMotion, mechanism_of
from symbody.view.drawing_options import DrawingOptions
from symbody.view.equivalent import equivalent_shape
from symbody.view.frame_table import FrameTable
from symbody.view.pitch_disc import PitchDisc, pitch_discs
from symbody.view.pose import arrows, constants, fixed_paths, paths, poses, relative_path, rounded
from symbody.view.rolling_wheel import RollingWheel, rolling_wheels
from symbody.view.shape import Shape
from symbody.view.skeleton import COLORS, Skeleton, skeleton
from symbody.view.solid import corners, falls_short_of, hides

Array = NDArray[np.float64]
Part = dict[str, Any]

THICKNESS = 0.04
"""The thickness of the thinnest bodies, in radii of the picture; rods and threads are thinner."""

LOOKS = 200
"""The most instants that determine the camera."""


def scene(motion: DrawableMotion, options: DrawingOptions, title: str) -> dict[str, Any]:
    """Return the scene of a motion in the form that the page reads.

    Args:
        motion: the motion.
        options: what else to show.
        title: the title.

    Raises:
        ViewError: there is nothing to draw, a value is not finite, or a shape belongs to no body of the system.
    """
    bodies = mechanism_of(motion).bodies
    _check_shapes(options.shapes, bodies)
    table = FrameTable()
    own = [table.place(body.frame) for body in bodies]
    of_bodies = poses(motion, table.frames)
    bones = skeleton(motion, table, of_bodies[own])
    given = [_given(motion, table, body, options.shapes.get(body)) for body in bodies]
    bones = bones.without({k for k, shapes in enumerate(given) if shapes})
    wheels: list[PitchDisc | RollingWheel] = [*pitch_discs(motion, table), *rolling_wheels(motion, table)]
    axes = [{"name": frame.name, "pose": table.place(frame)} for frame in (ground, *options.frames)]
    tracks = np.concatenate([of_bodies, poses(motion, table.frames[len(of_bodies) :])])
    requested = _requested_paths(motion, options)
    up = _up(motion)
    shift = _shift(motion, options.follow, tracks[own], up)
    core = _core(tracks, own, bones, requested, shift)
    least = THICKNESS * _radius(np.concatenate([core, _reach(motion, tracks[own], given, shift)]))
    of_wheels = [[wheel.part(least) for wheel in wheels if wheel.body == body.name] for body in bodies]
    parts = [
        shapes or own_wheels or [_equivalent(motion, body, own[k], bones, least)]
        for k, (body, shapes, own_wheels) in enumerate(zip(bodies, given, of_wheels, strict=True))
    ]
    for k in (k for k, shapes in enumerate(given) if not shapes):
        is_glass = _is_glass(k, parts, tracks[:, 0], own, bones)
        parts[k] = [{**part, "glass": is_glass} for part in parts[k]]
    view = view_of(np.concatenate([core, _corners(tracks, parts, shift)]), core, up)
    drawn = [
        *load_arrows(options.forces),
        *(reaction_arrows(bones.threads) if options.reactions else []),
    ]
    shown, tips = arrow_entries(motion, drawn, view.radius)
    return {
        "title": title,
        "view": view.holding((tips - shift).reshape(-1, 3)).holding_axes().entry,
        "follow": rounded(shift) if options.follow else [],
        "thickness": least,
        "times": motion.t.tolist(),
        "bodies": _bodies(bodies, own, parts),
        "links": bones.rods,
        "axes": axes,
        **_lines_and_points(options, requested, bones, _along_lines(motion)),
        **shown,
        "poses": [rounded(track) for track in tracks],
    }


def _check_shapes(shapes: Mapping[Body, object], bodies: Sequence[Body]) -> None:
    for body in shapes:
        if body not in bodies:
            raise ViewError(
                f"view: there is a shape for {brief(body)}, which is not a body of the system; "
                f"expected one of {brief(', '.join(map(str, bodies)))}"
            )


def _up(motion: DrawableMotion) -> Array:
    """Return the direction opposite to gravity, or z without gravity."""
    gravity = mechanism_of(motion).gravity
    if gravity is None:
        return np.array([0.0, 0, 1])
    down = arrows(motion, [gravity])[0, 0]
    size = float(np.linalg.norm(down))
    return np.asarray(-down / size) if size else np.array([0.0, 0, 1])


def _shift(motion: DrawableMotion, follow: Body | None, tracks: Array, up: Array) -> Array:
    """Return the displacement of the camera that follows a body: horizontal, zero at the first instant."""
    if follow is None:
        return np.zeros((len(motion.t), 3))
    if follow not in mechanism_of(motion).bodies:
        raise ViewError(
            f"animate: {brief(follow)} to follow is not a body of the system; "
            f"expected one of {brief(', '.join(map(str, mechanism_of(motion).bodies)))}"
        )
    path = tracks[mechanism_of(motion).bodies.index(follow), :, :3]
    way = path - path[0]
    return np.asarray(way - (way @ up)[:, None] * up)


# --- given shapes, points and lines ---


def _given(
    motion: DrawableMotion, table: FrameTable, body: Body, shapes: Shape | Sequence[Shape] | None
) -> list[Part]:
    if shapes is None:
        return []
    parts = []
    for shape in [shapes] if isinstance(shapes, Shape) else shapes:
        part = shape.part([float(x) for x in constants(motion, shape.lengths)])
        parts.append({"pose": table.place(shape.frame or body.frame), **part})
    return parts


def _requested_paths(motion: DrawableMotion, options: DrawingOptions) -> Array:
    """Return the paths of points, traces and both ends of lines, in this order."""
    elements = (element.ends for element in _along_lines(motion))
    ends = (end for line in (*options.lines, *options.springs, *elements) for end in line)
    return paths(motion, [*options.points, *options.traces, *ends])


def _along_lines(motion: DrawableMotion) -> list[Element]:
    """Return the springs, dampers and actuators between two points."""
    loads = mechanism_of(motion).loads
    return [load for load in loads if isinstance(load, Element) and load.ends]


def _kind(element: Element) -> str:
    """Return how an element is drawn: a damper without stiffness is no spring, nor is a force that is given."""
    stiffness = element.law.get("stiffness")
    return "line" if stiffness is None or stiffness.is_zero else "spring"


def _lines_and_points(
    options: DrawingOptions, requested: Array, bones: Skeleton, elements: Sequence[Element]
) -> dict[str, Any]:
    n, k = len(options.points), len(options.traces)
    names = [point.name for point in (*options.points, *options.traces)]
    points = [*zip(names, requested[: n + k], strict=True), *bones.points]
    lines = [*zip(requested[n + k :: 2], requested[n + k + 1 :: 2], strict=True), *bones.lines]
    kinds = (
        ["line"] * len(options.lines)
        + ["spring"] * len(options.springs)
        + [_kind(element) for element in elements]
        + ["line"] * len(bones.lines)
    )
    return {
        "points": [{"name": name, "path": rounded(path)} for name, path in points],
        "traces": list(range(n, n + k)),
        "lines": [
            {"from": rounded(start), "to": rounded(end), **({"is_spring": True} if kind == "spring" else {})}
            for kind, (start, end) in zip(kinds, lines, strict=True)
        ],
    }


# --- bodies ---


def _bodies(bodies: Sequence[Body], own: Sequence[int], parts: Sequence[list[Part]]) -> list[dict[str, Any]]:
    return [
        {
            "name": body.name or f"body {k + 1}",
            "is_named": bool(body.name),
            "has_axes": not body.is_particle,
            "color": COLORS[k % len(COLORS)],
            "pose": own[k],
            "parts": parts[k],
        }
        for k, body in enumerate(bodies)
    ]


def _equivalent(motion: DrawableMotion, body: Body, pose: int, bones: Skeleton, least: float) -> Part:
    """Return the solid of a body without a given shape.

    Args:
        motion: the motion.
        body: the body.
        pose: the index of its frame.
        bones: the skeleton.
        least: the smallest visible length.
    """
    mass, *rest = constants(motion, [body.mass, *body.inertia_entries, *joint(body).coordinates])
    to_centre = -np.array(rest[9:])
    link = to_centre if np.linalg.norm(to_centre) > 0 else bones.longest_arm(pose)
    return {"pose": pose, **equivalent_shape(float(mass), np.array(rest[:9]).reshape(3, 3), link, least)}


def _is_glass(k: int, parts: Sequence[list[Part]], poses: Array, own: Sequence[int], bones: Skeleton) -> bool:
    """Return whether a solid hides smaller bodies or joints, or does not reach its own: it can't be the real shape.

    Args:
        k: the index of the body.
        parts: the parts of all bodies.
        poses: the poses of the frames at one instant, shape (frames, 7).
        own: the indices of the bodies' frames.
        bones: the skeleton.
    """
    part, pose = parts[k][0], poses[own[k]]
    sizes = [float(np.linalg.norm(np.ptp(corners(shapes[0]), axis=0))) for shapes in parts]
    smaller = [poses[own[j], :3] for j, size in enumerate(sizes) if size < 0.999 * sizes[k]]
    ends = [
        fixed_paths(poses[rod["pose"]][None], np.array([rod["from"], rod["to"]]))[:, 0] for rod in bones.rods
    ]
    joints = _apart([place for end in ends for place in end], pose[:3])
    arms = [end for rod, end in zip(bones.rods, ends, strict=True) if rod["body"] == k]
    reached = _apart([place for end in arms for place in end], pose[:3])
    is_short = part["kind"] != "ellipsoid" and falls_short_of(part, _seen(pose, reached))
    return is_short or hides(part, _seen(pose, [*smaller, *joints]))


def _apart(places: Sequence[Array], centre: Array) -> list[Array]:
    """Return the places that are not at the centre."""
    distances = [float(np.linalg.norm(place - centre)) for place in places]
    return [
        place for place, d in zip(places, distances, strict=True) if d > 1e-6 * max(distances, default=0.0)
    ]


def _seen(pose: Array, places: Sequence[Array]) -> Array:
    return np.array([relative_path(pose[None], place)[0] for place in places]).reshape(-1, 3)


# --- size ---


def _core(tracks: Array, own: Sequence[int], bones: Skeleton, requested: Array, shift: Array) -> Array:
    """Return the places of centres of mass, points and ends of rods, at all instants, relative to the camera.

    Args:
        tracks: the poses of the frames, shape (frames, N, 7).
        own: the indices of the bodies' frames.
        bones: the skeleton.
        requested: the paths of points that the user wants to see.
        shift: the displacement of the camera, shape (N, 3).
    """
    found = [tracks[:, :, :3], requested, *(path[None] for _, path in bones.points)]
    found += [np.array(line) for line in bones.lines]
    found += [fixed_paths(tracks[rod["pose"]], np.array([rod["from"], rod["to"]])) for rod in bones.rods]
    return np.concatenate([_seen_along(places, shift) for places in found])


def _seen_along(places: Array, shift: Array) -> Array:
    """Return places relative to a moving camera; what it leaves behind is ignored."""
    if shift.any():
        places = places[np.ptp(places, axis=1).any(axis=1)]
    return (places - shift).reshape(-1, 3)


def _radius(places: Array) -> float:
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    return float(np.linalg.norm(places - middle, axis=1).max()) or 1.0


def _reach(motion: DrawableMotion, tracks: Array, given: Sequence[list[Part]], shift: Array) -> Array:
    """Return centres of mass, displaced in all directions by the size of the solids, or by their radii of gyration."""
    bodies = mechanism_of(motion).bodies
    table = constants(motion, [x for body in bodies for x in (body.mass, *body.moments)]).reshape(-1, 4)
    with np.errstate(divide="ignore", invalid="ignore"):
        gyration = np.sqrt(1.5 * np.nan_to_num(table[:, 1:].max(axis=1) / table[:, 0], posinf=0.0).clip(0))
    sizes = [max((np.ptp(corners(part), axis=0).max() / 2 for part in parts), default=0.0) for parts in given]
    reach = np.where([bool(parts) for parts in given], sizes, gyration)
    sides = np.concatenate([np.eye(3), -np.eye(3)])
    centres = tracks[:, :, :3] - shift
    return np.asarray(centres[:, :, None] + (reach[:, None, None] * sides)[:, None]).reshape(-1, 3)


def _corners(tracks: Array, parts: Sequence[list[Part]], shift: Array) -> Array:
    """Return the corners of the boxes around all solids, at some instants."""
    step = -(-tracks.shape[1] // LOOKS)
    found = [fixed_paths(tracks[part["pose"], ::step], corners(part)) for shapes in parts for part in shapes]
    return (np.concatenate(found) - shift[::step]).reshape(-1, 3)
