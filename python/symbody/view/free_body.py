"""Free-body diagrams: a part that is cut off, and everything that acts on it at one instant."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Reaction
from symbody.dynamics.formalism.part import body_of, cut_joints, things_of
from symbody.dynamics.formalism.reaction import reaction_in
from symbody.errors import ViewError
from symbody.geometry import Point, Vector, origin
from symbody.multibody import Body, Link, System
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief, given_twice, with_known_names
from symbody.view.drawable_motion import DrawableMotion, drawable, mechanism_of
from symbody.view.drawing_options import DrawingOptions
from symbody.view.part_camera import facing
from symbody.view.pose import arrows, paths, values
from symbody.view.scene import scene
from symbody.view.sketch import sketch_of
from symbody.view.solid import corners
from symbody.view.svg import sketch_svg
from symbody.view.whole_file import file_of, write_whole

__all__ = ["free_body_diagram"]

Drawn: TypeAlias = Annotated[
    Any, "a motion, an equilibrium, a steady motion, or a system without coordinates"
]

Array = NDArray[np.float64]

_WHERE = "free_body_diagram"

LONGEST = 0.6
"""The length of the longest force, and of the largest moment, in radii of the part."""

LEAST = 1e-5
"""Forces and moments below this part of the largest one are not drawn: they are rounding, or can't be seen."""

SMALL = 0.01
"""Moments below this part of the largest force times the radius are drawn smaller than the largest arc."""

BALANCED = 1e-9
"""Forces and moments whose resultant is below this part of the largest are an action and its reaction."""

SAMPLES = 25
"""The largest number of instants of a motion that determine the direction from which a part is seen."""

HUGE = 1.5
"""Solids longer than this multiple of the part's extent, as some that are found by inertia, would hide its forces."""

_SUPPORT = "support"
"""The name of what holds a part beside joints."""

COLORS = {"reaction": "#2563a8", "load": "#c0392b", "weight": "#6b5b00"}


@dataclass(frozen=True)
class _Acting:
    """A force or a moment on the part."""

    name: str
    kind: str
    at: Point
    vector: Vector
    is_moment: bool = False


@dataclass(frozen=True)
class _Instants:
    """A motion at some of its instants."""

    motion: DrawableMotion
    indices: Sequence[int]

    @property
    def t(self) -> Array:
        return self.motion.t[[*self.indices]]

    @property
    def system(self) -> Any:
        return self.motion.system

    def __getitem__(self, expression: Expr) -> Array:
        return np.asarray(self.evaluate([expression])[0])

    def evaluate(self, expressions: Sequence[Expr]) -> Array:
        rows = np.asarray(self.motion.evaluate(expressions), dtype=np.float64)
        return np.broadcast_to(rows, (len(expressions), len(self.motion.t)))[:, [*self.indices]]


@with_known_names
def free_body_diagram(
    motion: Drawn,
    part: Body | Link | str | Collection[Body | Link | str],
    path: str | os.PathLike[str],
    *,
    t: float | None = None,
    parameters: Mapping[Expr, float] | None = None,
) -> Path:
    """Draw a part that is cut off, with its loads, weights and the reactions of its joints, and return the SVG file.

    What holds it beside joints, such as constraints or the coordinates of bodies without joints, is drawn as "support",
    at the centre of mass of a body, or at the origin for several.

    The lengths of forces are proportional to their magnitudes, and those of moments to theirs, which stand beside the
    names, in N and N m if the model is in SI units. A moment about an axis towards the viewer is an arc, any other one
    an arrow with two heads. What is zero is not drawn, nor what acts between bodies of the part, such as a spring.

    A part that stays in a plane with its forces is seen along the normal of the plane. Any other part is seen from one
    direction at all instants of a motion; this direction separates the points of action.

    Args:
        motion: a motion of a system with bodies, an equilibrium, or a steady motion at its first instant; or a system
            in which nothing moves.
        part: a body or link, its name, or several.
        path: the file.
        t: the instant; by default the first one. The nearest instant of the motion is drawn.
        parameters: the values of the symbols of a system in which nothing moves.

    Raises:
        ViewError: a body is none of the system, or a value is missing.
        PictureError: the file can't be written.

    >>> import os, tempfile
    >>> from symbody import Link, Vector, assemble, free_body_diagram, ground, newton_euler, revolute, simulate
    >>> bob = Link("bob", 1, center=(0, -1, 0))
    >>> pendulum = assemble([revolute("A", ground, bob)])
    >>> equations = newton_euler(pendulum.system(gravity=Vector(ground, 0, -9.81, 0)))
    >>> motion = simulate(equations, {}, {equations.coordinates[0]: 0.5}, t=(0, 1))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     free_body_diagram(motion, bob, os.path.join(folder, "bob.svg"), t=0.5).name
    'bob.svg'
    """
    file = _svg_file(path)
    whole = drawable(motion, _WHERE, parameters)
    system = mechanism_of(whole, _WHERE)
    members = _members(system, part)
    index = 0 if t is None else _index(whole.t, t)
    drawn, series = _Instants(whole, [index]), _Instants(whole, [index, *_samples(len(whole.t))])
    content = scene(drawn, DrawingOptions(), "")
    along = scene(series, DrawingOptions(), "")["view"]
    content["view"] |= {"direction": along["direction"], "up": along["up"]}
    kept = [k for k, body in enumerate(system.bodies) if body in members]
    members = [system.bodies[k] for k in kept]
    content["bodies"] = [{**content["bodies"][k], "has_axes": False} for k in kept]
    content["links"] = [rod for rod in content["links"] if rod["body"] in kept]
    content["links"] += _arms(drawn, system, members, content["bodies"])
    content["axes"], content["lines"] = [], []
    content["points"] = _points(drawn, system, members)
    acting = [*_loads(drawn, system, members), *_weights(system, members), *_reactions(system, members)]
    at, vectors = (
        paths(series, [each.at for each in acting]),
        arrows(series, [each.vector for each in acting]),
    )
    radius = _radius(content)
    actions = [_entries(acting, at[:, k], vectors[:, k], radius) for k in range(len(series.t))]
    content["actions"] = actions[0]
    content["view"] |= facing(content["view"], _places_along(series, system, members), actions)
    content["bodies"] = _without_what_hides(content)
    return write_whole(file, _writer(sketch_svg(sketch_of(content))), where=_WHERE)


def _samples(count: int) -> list[int]:
    """Return the indices of some instants of a motion, including the first and the last one."""
    return sorted({round(k) for k in np.linspace(0, count - 1, min(count, SAMPLES)).tolist()})


def _index(instants: Array, t: float) -> int:
    """Return the index of the instant that is nearest to t."""
    first, last = float(instants[0]), float(instants[-1])
    try:
        is_there = first <= t <= last
    except TypeError:
        is_there = False
    if not is_there:
        raise ViewError(
            f"{_WHERE}: t = {brief(repr(t))}; expected an instant of the motion, from {first:g} to {last:g}"
        )
    return int(np.argmin(np.abs(instants - t)))


def _svg_file(path: str | os.PathLike[str]) -> Path:
    file = file_of(path, "rod.svg")
    if file.suffix.lower() != ".svg":
        raise ViewError(
            f"{_WHERE}: {file} is no SVG file; expected a name such as {file.with_suffix('.svg').name}"
        )
    return file


def _writer(text: str) -> Callable[[Path], object]:
    return lambda file: file.write_text(text, encoding="utf-8")


def _members(system: System, part: Any) -> list[Body]:
    things = things_of(part)
    if not things:
        raise ViewError(f"{_WHERE}: no body is cut off; give at least one")
    found = []
    for thing in things:
        body = body_of(system, thing, _WHERE)
        if body is None:
            raise ViewError(
                f"{_WHERE}: {brief(thing)} is not a body of the system; expected one of "
                f"{brief(', '.join(map(str, system.bodies)))}"
            )
        found.append(body)
    if (twice := given_twice(found)) is not None:
        raise ViewError(f"{_WHERE}: the body {brief(twice)} is given twice; give it once")
    return found


def _arms(
    motion: DrawableMotion, system: System, members: Sequence[Body], shown: Sequence[dict[str, Any]]
) -> Iterator[dict[str, Any]]:
    """Yield rods from the centres of mass to the joints, for those that a neighbour's rod showed before."""
    for joint in system.joints:
        for name, side in joint.ends:
            for body, entry in zip(members, shown, strict=True):
                if name == body.name:
                    place = values(motion, origin(side).projected(body.frame).coordinates)[:, 0]
                    ends = {"from": [0.0, 0.0, 0.0], "to": place.tolist()}
                    yield {"pose": entry["pose"], "color": entry["color"], **ends}


def _points(motion: DrawableMotion, system: System, members: Sequence[Body]) -> list[dict[str, Any]]:
    """Return the points of the joints of the part."""
    return [{"name": "", "path": path.tolist()} for path in paths(motion, _of_joints(system, members))]


def _of_joints(system: System, members: Sequence[Body]) -> list[Point]:
    names = [body.name for body in members]
    return [joint.acting_point for joint in system.joints if any(name in names for name, _ in joint.ends)]


def _places_along(motion: DrawableMotion, system: System, members: Sequence[Body]) -> Array:
    """Return the centres of mass of the part and the points of its joints, shape (count, instants, 3)."""
    return paths(motion, [*(body.center_of_mass for body in members), *_of_joints(system, members)])


def _loads(motion: DrawableMotion, system: System, members: Sequence[Body]) -> Iterator[_Acting]:
    """Yield the loads on the part, without those that act between its bodies."""
    for load in system.loads:
        actions = [action for action in load.actions if action.body in members]
        found = [
            _Acting(
                load.name or getattr(load, "kind", "load"),
                "load",
                action.point or action.body.center_of_mass,
                action.vector,
                is_moment=not action.is_force,
            )
            for action in actions
        ]
        if len({action.body for action in actions}) < 2 or not _is_balanced(motion, found):
            yield from found


def _is_balanced(motion: DrawableMotion, acting: Sequence[_Acting]) -> bool:
    """Return whether forces and moments are an action and its reaction: they have no resultant."""
    places = paths(motion, [each.at for each in acting])[:, 0]
    vectors = arrows(motion, [each.vector for each in acting])[:, 0]
    is_moment = np.array([each.is_moment for each in acting])
    forces, arms = vectors[~is_moment], (places - places[0])[~is_moment]
    turning = np.vstack([vectors[is_moment], np.cross(arms, forces)])
    scale = np.abs(vectors).max(initial=0.0) * max(1.0, np.abs(arms).max(initial=0.0))
    return bool(np.abs([*forces.sum(axis=0), *turning.sum(axis=0)]).max() <= BALANCED * scale)


def _weights(system: System, members: Sequence[Body]) -> Iterator[_Acting]:
    """Yield the weights of the part."""
    for body in members:
        if system.gravity is not None and not body.mass.is_zero:
            yield _Acting("weight", "weight", body.center_of_mass, body.mass * system.gravity)


def _reactions(system: System, members: Sequence[Body]) -> Iterator[_Acting]:
    """Yield the force and the moment of each joint between the part and what is cut off, then of what else holds it.

    That is constraints, coordinates that several bodies share, and what is carried: all of a system without joints.
    """
    rest = reaction_in(system, members)
    for joint, is_child in cut_joints(system, [body.name for body in members]):
        on = joint.ends[1 if is_child else 0][0]
        found: Reaction = reaction_in(system, joint.joint, on=on)
        yield from _of_reaction(joint.name, found)
        there = found.about(rest.at)
        rest = Reaction(rest.force - there.force, rest.moment - there.moment, rest.at, rest.on)
    yield from _of_reaction(_SUPPORT, rest)


def _of_reaction(name: str, found: Reaction) -> Iterator[_Acting]:
    yield _Acting(name, "reaction", found.at, found.force)
    yield _Acting(name, "reaction", found.at, found.moment, is_moment=True)


def _entries(given: Sequence[_Acting], places: Array, vectors: Array, radius: float) -> list[dict[str, Any]]:
    """Return the arrows at an instant, forces at one scale and moments at another.

    Args:
        given: the forces and moments.
        places: where they act, shape (count, 3).
        vectors: their components in the axes of the root, shape (count, 3).
        radius: the radius of the part.
    """
    sizes = np.linalg.norm(vectors, axis=1)
    largest = {
        kind: max(
            (size for size, each in zip(sizes, given, strict=True) if each.is_moment is kind), default=0.0
        )
        for kind in (False, True)
    }
    arm = max(largest[False] * radius, largest[True])
    longest = {False: largest[False], True: max(largest[True], SMALL * arm)}
    return [
        {
            "name": f"{each.name} {_three_digits(size)} {'N m' if each.is_moment else 'N'}",
            "at": place.tolist(),
            "vector": (vector * LONGEST * radius / longest[each.is_moment]).tolist(),
            "color": COLORS[each.kind],
            "is_moment": each.is_moment,
        }
        for each, place, vector, size in zip(given, places, vectors, sizes, strict=True)
        if size > LEAST * (arm if each.is_moment else largest[False])
    ]


def _three_digits(size: float) -> str:
    """Return a magnitude with three digits: 4320 and 0.0123, and powers of ten for what is much larger or smaller."""
    rounded = float(f"{size:.3g}")
    return np.format_float_positional(rounded, trim="-") if 1e-3 <= rounded < 1e6 else f"{rounded:g}"


def _without_what_hides(content: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the bodies without solids far larger than the part: rods to the joints show it, and forces are seen.

    Wheels with teeth have the size of their pitch circles, and stay.
    """
    places = _places(content)
    extent = float(np.ptp(places, axis=0).max())
    if extent < 0.1 * float(content["view"]["radius"]):
        return list(content["bodies"])
    return [
        {
            **body,
            "parts": [
                part
                for part in body["parts"]
                if part.get("is_true") or np.ptp(corners(part), axis=0).max() <= HUGE * extent
            ],
        }
        for body in content["bodies"]
    ]


def _radius(content: dict[str, Any]) -> float:
    """Return the radius of the part: of its points and centres of mass, or half of its solids' if that is more.

    Where there is neither, it is by the mechanism's.
    """
    places = _places(content)
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    sizes = [
        float(np.ptp(corners(solid), axis=0).max()) for body in content["bodies"] for solid in body["parts"]
    ]
    radius = max(float(np.linalg.norm(places - middle, axis=1).max()), max(sizes, default=0.0) / 4)
    whole = float(content["view"]["radius"])
    return radius if radius > 0.05 * whole else 0.2 * whole


def _places(content: dict[str, Any]) -> Array:
    """Return the centres of mass of the part and the points of its joints, shape (count, 3)."""
    centres = [np.array(content["poses"][body["pose"]]).reshape(-1, 7)[0, :3] for body in content["bodies"]]
    return np.array([*centres, *(np.array(point["path"]).reshape(-1, 3)[0] for point in content["points"])])
