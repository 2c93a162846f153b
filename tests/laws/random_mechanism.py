"""Random mechanisms: trees and loops of links with every kind of joint. A seed gives one mechanism.

A loop is closed at a position that is drawn before: the place of the joint on its child is where the tree has it then.
So there is a position that keeps all constraints, to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from random import Random

import numpy as np

from symbody import (
    Expr,
    Frame,
    Link,
    Mechanism,
    assemble,
    cos,
    cylindrical,
    fixed,
    free,
    functions_of_time,
    gear,
    ground,
    number,
    pi,
    planar,
    point_on_curve,
    prismatic,
    rack,
    revolute,
    rolling,
    rotate,
    screw,
    sin,
    spherical,
    translate,
    universal,
)
from symbody.multibody.joint.joint import Joint

Make = Callable[..., Joint]


def _by_axis(kind: Make) -> Make:
    return lambda draw, *parts, **places: kind(*parts, axis=draw.choice("XYZ"), **places)


def _universal(draw: Random, *parts: object, **places: object) -> Joint:
    return universal(*parts, axes="".join(draw.sample("XYZ", 2)), **places)  # type: ignore[arg-type]


def _spherical(draw: Random, *parts: object, **places: object) -> Joint:
    return spherical(*parts, axes=draw.choice(["ZYX", "ZXZ", "XYZ", "YXY"]), **places)  # type: ignore[arg-type]


def _helix(s: Expr) -> tuple[Expr, Expr, Expr]:
    return 2 * cos(s), sin(s), s + s**2 / 4


def _free(draw: Random, *parts: object, **places: object) -> Joint:
    return free(*parts, axes=draw.choice(["ZYX", "ZXZ"]), **places)  # type: ignore[arg-type]


KINDS: dict[str, Make] = {
    "revolute": _by_axis(revolute),
    "prismatic": _by_axis(prismatic),
    "cylindrical": _by_axis(cylindrical),
    "spherical": _spherical,
    "ball": lambda draw, *parts, **places: spherical(*parts, quaternion=True, **places),
    "universal": _universal,
    "planar": _by_axis(planar),
    "fixed": lambda draw, *parts, **places: fixed(*parts, **places),
    "free": _free,
    "floater": lambda draw, *parts, **places: free(*parts, quaternion=True, **places),
    "screw": lambda draw, *parts, **places: screw(
        *parts, axis=draw.choice("XYZ"), pitch=number(draw.choice(["-2", "1", "1/2"])), **places
    ),
    "rolling": lambda draw, *parts, **places: rolling(
        *parts, radius=2, crown=number(draw.choice(["0", "2", "1/2"])), **places
    ),
    "point_on_curve": lambda draw, *parts, **places: point_on_curve(
        *parts, curve=_helix, axes=draw.choice(["ZYX", "XY", "Z", ""]), **places
    ),
}
"""A joint of each kind, from what is drawn: its axes. A ball and a floater have Euler parameters."""

BY_QUATERNION = ("ball", "floater")
"""Kinds that are in a mechanism only if they are asked for."""

MESHES = ("gear", "rack")
"""Kinds that couple two joints."""

COUPLINGS = (*MESHES, "bevel", "closing gear")
"""The same, with gears whose axes meet, and one whose joint closes a loop."""


@dataclass
class RandomMechanism:
    """A mechanism, and a position of it at which all loops are closed."""

    mechanism: Mechanism
    position: dict[Expr, float]


def random_mechanism(
    seed: int, closing: str | None = None, links: int = 4, opening: str = ""
) -> RandomMechanism:
    """Return a mechanism of numbers.

    Args:
        seed: of what is drawn.
        closing: the kind of joint that closes a loop; None for a tree.
        links: how many links there are.
        opening: a kind that is in the tree for certain.
    """
    draw = Random(seed)
    joints, members = list[Joint](), list[Link]()
    kinds = [kind for kind in KINDS if closing is None or kind not in ("free", "fixed", "rolling")]
    kinds = [kind for kind in kinds if kind not in BY_QUATERNION]
    for k in range(links):
        link = _link(draw, f"L{k}")
        parent = (
            draw.choice([*members[-2:], ground]) if closing is None else (members[-1] if members else ground)
        )
        kind = opening if opening and k == 1 else draw.choice(kinds)
        parts = (parent, link) if draw.random() < 0.7 else (link, parent)
        joints.append(KINDS[kind](draw, f"J{k}", *parts, at=_place(draw), to=_place(draw)))
        members.append(link)
    tree = assemble(joints)
    position = {q: round(draw.uniform(0.3, 1.2), 3) for q in tree.coordinates}
    for joint in joints:
        position |= _unit_quaternion(joint, position)
    if closing in COUPLINGS:
        joints += _meshing(draw, closing, members[-1])
        position |= {q: 0.3 for q in assemble(joints).coordinates if q not in position}
    elif closing is not None:
        joints.append(_closing(draw, closing, tree, position, members))
    made = assemble(joints)
    if closing == "rack":
        position[functions_of_time("s_B")] = -0.6
    if closing in ("gear", "closing gear", "bevel"):
        position[functions_of_time("phi_B")] = -0.6 if closing == "bevel" else 0.6
    if closing == "closing gear":
        position |= dict.fromkeys(functions_of_time("x_P y_P"), 0.0)
    return RandomMechanism(made, position)


def _unit_quaternion(joint: Joint, position: dict[Expr, float]) -> dict[Expr, float]:
    """Return the Euler parameters of a joint in numbers, of the length 1; none if it has other coordinates."""
    own = [q for q in joint.coordinates if q.name.startswith("e")]
    length = np.sqrt(sum(position[q] ** 2 for q in own))
    return {q: position[q] / length for q in own}


def _meshing(draw: Random, kind: str, carrier: Link) -> list[Joint]:
    """Return two joints on a carrier, and the mesh of their children, at angles 0.3 and 0.6 or -0.6 (or shifted)."""
    place, pinion, to = _place(draw), _link(draw, "pinion"), _place(draw)
    first = revolute("A", carrier, pinion, at=place, to=to, loop=True if kind == "closing gear" else None)
    if kind == "rack":
        at = place * translate(number("0.7"), 2, 0)
        second = prismatic("B", carrier, _link(draw, "bar"), at=at, to=_place(draw), axis="X")
        return [first, second, rack("G", first, second, 2)]
    if kind == "bevel":
        at = place * rotate("X", number("2/3") * pi) * translate(0, 0, 2)
        second = revolute("B", carrier, _link(draw, "bevel"), at=at, to=_place(draw))
        return [first, second, gear("G", first, second, 2, 1)]
    at = place * translate(0, -1, number("0.4"))
    second = revolute("B", carrier, _link(draw, "ring"), at=at, to=_place(draw))
    mesh = gear("G", first, second, 2, 1, internal=True)
    if kind == "closing gear":
        return [planar("P", carrier, pinion, at=place, to=to), first, second, mesh]
    return [first, second, mesh]


def _closing(
    draw: Random, kind: str, tree: Mechanism, position: dict[Expr, float], members: list[Link]
) -> Joint:
    """Return a joint of the last link with ground, or with the first link, that fits at a position."""
    at, last = _place(draw), members[-1]
    parent = draw.choice([ground, members[0]])
    trial = KINDS[kind](draw, "C", parent, last, at=at)
    motion = trial.pair.motion(trial.coordinates)
    somewhere = {q: round(draw.uniform(-0.9, 0.9), 3) for q in trial.coordinates}
    position |= {q: somewhere[q] for q in trial.pair.keeps}
    base = tree.frame(parent) if isinstance(parent, Link) else parent
    target = _numbers(base * at, position) @ _numbers(motion, somewhere)
    to = np.linalg.solve(_numbers(tree.frame(last), position), target)
    return replace(trial, mounting=replace(trial.mounting, to=Frame(to.tolist()), loop=True))


def _numbers(frame: Frame, values: dict[Expr, float]) -> np.ndarray:
    return np.array([float(entry.evaluate(values)) for entry in frame.matrix.entries]).reshape(4, 4)


def _link(draw: Random, name: str) -> Link:
    moments = [draw.randint(8, 12) for _ in range(3)]
    products = [draw.randint(-2, 2) for _ in range(3)]
    center = [number(str(round(draw.uniform(-1, 1), 2))) for _ in range(3)]
    return Link(name, draw.randint(1, 4), *moments, *products, center=center)


def _place(draw: Random) -> Frame:
    if draw.random() < 0.2:
        return ground
    shift = [number(str(round(draw.uniform(-1, 1), 2))) for _ in range(3)]
    turned = rotate(draw.choice("XYZ"), number(str(round(draw.uniform(-1, 1), 2))))
    return translate(*shift) * turned if draw.random() < 0.7 else translate(*shift)
