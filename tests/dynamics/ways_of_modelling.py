"""Mechanisms in one set of coordinates, each modelled in four ways that a user may choose.

A mechanism is a list of links. A link hangs at a point of another one and has an orientation: rotations about principal
axes that lead there from the axes of ground.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from symbody import (
    Body,
    Expr,
    Frame,
    Point,
    System,
    Vector,
    atan2,
    functions_of_time,
    ground,
    moving_frame,
    number,
    rotate,
    symbols,
    translate,
)

Rotations = tuple[tuple[str, Expr], ...]
Offset = tuple[Expr | int, Expr | int, Expr | int]
Inertia = tuple[Expr | int, ...]


@dataclass(frozen=True)
class Link:
    """A link: what carries it, where and how it is turned, and its body.

    Attributes:
        carrier: the place of the link that carries it in the list of links; None for ground.
        joint: where it hangs, in the axes of the carrier.
        rotations: its orientation, from the axes of ground.
        centre: its centre of mass, in its own axes.
        inertia: its mass, and its inertia as `Body` takes it.
    """

    carrier: int | None
    joint: Offset
    rotations: Rotations
    centre: Offset
    inertia: Inertia


@dataclass(frozen=True)
class Mechanism:
    """Links, their coordinates, the direction of weight, and the frame on which the links are, with its speeds."""

    links: tuple[Link, ...]
    coordinates: tuple[Expr, ...]
    gravity: Vector
    base: Frame = ground
    speeds: tuple[Expr, ...] = ()


def turned(frame: Frame, rotations: Rotations) -> Frame:
    for axis, angle in rotations:
        frame *= rotate(axis, angle)
    return frame


def turned_back(frame: Frame, rotations: Rotations) -> Frame:
    return turned(frame, tuple((axis, -angle) for axis, angle in reversed(rotations)))


def between(first: Rotations, second: Rotations) -> Rotations:
    """Return the rotations from one orientation to another: only what differs."""
    shared = 0
    while shared < min(len(first), len(second)) and first[shared] == second[shared]:
        shared += 1
    back, on = first[shared:], second[shared:]
    if len(back) == 1 and on and back[0][0] == on[0][0]:  # about one axis: one rotation by the difference
        return (on[0][0], on[0][1] - back[0][1]), *on[1:]
    return *((axis, -angle) for axis, angle in reversed(back)), *on


def chain(mechanism: Mechanism) -> list[Body]:
    """Model each link on its carrier: ``frame * translate(joint) * rotate(axis, angle)``."""
    frames, bodies = list[Frame](), list[Body]()
    for link in mechanism.links:
        start = mechanism.base if link.carrier is None else frames[link.carrier]
        before = () if link.carrier is None else mechanism.links[link.carrier].rotations
        frames.append(turned(start * translate(*link.joint), between(before, link.rotations)))
        bodies.append(Body(frames[-1] * translate(*link.centre), *link.inertia))
    return bodies


def with_rotations_turned_back(mechanism: Mechanism) -> list[Body]:
    """Model frames parallel to ground, from joint to joint; each rotation is turned back behind the displacement."""
    places, bodies = list[Frame](), list[Body]()
    for link in mechanism.links:
        place = mechanism.base * translate(*link.joint)
        if link.carrier is not None:
            before = mechanism.links[link.carrier].rotations
            place = turned_back(turned(places[link.carrier], before) * translate(*link.joint), before)
        places.append(place)
        centre = turned(place, link.rotations) * translate(*link.centre)
        is_particle = len(link.inertia) == 1
        bodies.append(Body(turned_back(centre, link.rotations) if is_particle else centre, *link.inertia))
    return bodies


def joint_frames(mechanism: Mechanism) -> list[Frame]:
    frames = list[Frame]()
    for link in mechanism.links:
        start = mechanism.base if link.carrier is None else frames[link.carrier]
        joint = Point(start, *link.joint).projected(mechanism.base).coordinates
        frames.append(turned(mechanism.base * translate(*joint), link.rotations))
    return frames


def by_offsets_of_points(mechanism: Mechanism) -> list[Body]:
    """Model a frame for each link, at its joint as a point of the ground, and the body as a point of this frame."""
    return [
        Body(Point(frame, *link.centre), *link.inertia)
        for frame, link in zip(joint_frames(mechanism), mechanism.links, strict=True)
    ]


def by_points_of_ground(mechanism: Mechanism) -> list[Body]:
    """Model each centre of mass as a point of the ground, with a frame only where there is inertia."""
    bodies = []
    for frame, link in zip(joint_frames(mechanism), mechanism.links, strict=True):
        centre = Point(frame, *link.centre).projected(mechanism.base).coordinates
        rotations = link.rotations if len(link.inertia) > 1 else ()
        bodies.append(Body(turned(mechanism.base * translate(*centre), rotations), *link.inertia))
    return bodies


WAYS: Mapping[str, Callable[[Mechanism], list[Body]]] = {
    "chain": chain,
    "turned back": with_rotations_turned_back,
    "offsets of points": by_offsets_of_points,
    "points of ground": by_points_of_ground,
}


def modelled(mechanism: Mechanism, way: str) -> System:
    """Return the system of a mechanism, modelled in one of the four ways."""
    return System(
        WAYS[way](mechanism),
        coordinates=mechanism.coordinates,
        speeds=mechanism.speeds,
        gravity=mechanism.gravity,
        name=way,
    )


# --- mechanisms ---

DOWN_Y = Vector(ground, 0, -symbols("g"), 0)
DOWN_Z = Vector(ground, 0, 0, -symbols("g"))
NOWHERE: Offset = (0, 0, 0)


def angles(n: int, name: str = "q") -> tuple[Expr, ...]:
    return tuple(functions_of_time(f"{name}{i}") for i in range(1, n + 1))


def planar(i: int) -> Inertia:
    m, J = symbols(f"m{i} J{i}")
    return m, 0, 0, J


def general(i: int) -> Inertia:
    return tuple(symbols(f"m{i} Ix{i} Iy{i} Iz{i} Cyz{i} Cxz{i} Cxy{i}"))


def pendulum_on_a_cart(n: int) -> Mechanism:
    """Return point masses on massless links, with absolute angles: P1 of `benchmarks/derive`."""
    x, q = functions_of_time("q0"), angles(n)
    links = [Link(None, (x, 0, 0), (), NOWHERE, (symbols("m0"),))]
    for i in range(1, n + 1):
        joint: Offset = (0, symbols(f"l{i - 2}"), 0) if i > 1 else NOWHERE
        links.append(
            Link(i - 1, joint, (("Z", q[i - 1]),), (0, symbols(f"l{i - 1}"), 0), (symbols(f"m{i}"),))
        )
    return Mechanism(tuple(links), (x, *q), DOWN_Y)


def rods(n: int) -> Mechanism:
    """Return a pendulum of rods with absolute angles."""
    q, links = angles(n), list[Link]()
    for i in range(1, n + 1):
        joint: Offset = (0, -symbols(f"l{i - 1}"), 0) if i > 1 else NOWHERE
        links.append(
            Link(i - 2 if i > 1 else None, joint, (("Z", q[i - 1]),), (0, -symbols(f"c{i}"), 0), planar(i))
        )
    return Mechanism(tuple(links), q, DOWN_Y)


def crane() -> Mechanism:
    """Return a trolley, a rope whose length changes, and a load that swings on it."""
    x, r, a, b = functions_of_time("x r a b")
    links = (
        Link(None, (x, 0, 0), (), NOWHERE, (symbols("m0"),)),
        Link(0, NOWHERE, (("Z", a),), (0, -r, 0), (symbols("m1"),)),
        Link(1, (0, -r, 0), (("Z", b),), (0, -symbols("c"), 0), planar(2)),
    )
    return Mechanism(links, (x, r, a, b), DOWN_Y)


def spatial_crane() -> Mechanism:
    """Return a trolley, and a load that swings in two angles on a rope whose length changes."""
    x, r, a, b = functions_of_time("x r a b")
    links = (
        Link(None, (x, 0, 0), (), NOWHERE, (symbols("m0"),)),
        Link(0, NOWHERE, (("X", a), ("Y", b)), (0, 0, -r), planar(1)),
    )
    return Mechanism(links, (x, r, a, b), DOWN_Z)


def wheel_with_poles() -> Mechanism:
    """Return a wheel that rolls, with two poles on its axle, one on the other."""
    phi, q = functions_of_time("phi"), angles(2)
    links = (
        Link(None, (-symbols("r") * phi, symbols("r"), 0), (("Z", phi),), NOWHERE, planar(0)),
        Link(0, NOWHERE, (("Z", q[0]),), (0, symbols("c1"), 0), planar(1)),
        Link(1, (0, symbols("l1"), 0), (("Z", q[1]),), (0, symbols("c2"), 0), planar(2)),
    )
    return Mechanism(links, (phi, *q), DOWN_Y)


def planar_arm(n: int, *, relative: bool) -> Mechanism:
    """Return an arm in the plane whose centres of mass lie anywhere."""
    q, links, angle = angles(n), list[Link](), number(0)
    for i in range(1, n + 1):
        angle = angle + q[i - 1] if relative else q[i - 1]
        joint: Offset = (symbols(f"l{i - 1}"), 0, 0) if i > 1 else NOWHERE
        centre: Offset = (*symbols(f"cx{i} cy{i}"), 0)
        links.append(Link(i - 2 if i > 1 else None, joint, (("Z", angle),), centre, planar(i)))
    return Mechanism(tuple(links), q, DOWN_Y)


def spatial_arm(axes: str) -> Mechanism:
    """Return general bodies on joints about principal axes."""
    q, links, rotations = angles(len(axes)), list[Link](), ()
    for i, axis in enumerate(axes, start=1):
        rotations = (*rotations, (axis, q[i - 1]))
        joint: Offset = tuple(symbols(f"px{i} py{i} pz{i}"))
        links.append(
            Link(i - 2 if i > 1 else None, joint, rotations, tuple(symbols(f"cx{i} cy{i} cz{i}")), general(i))
        )
    return Mechanism(tuple(links), q, DOWN_Z)


def tree(carriers: Sequence[int]) -> Mechanism:
    """Return a trunk with branches in the plane, with absolute angles."""
    q, links = angles(len(carriers)), list[Link]()
    for i, carrier in enumerate(carriers):
        joint: Offset = (symbols(f"a{i}"), symbols(f"b{i}"), 0) if i else NOWHERE
        links.append(Link(carrier if i else None, joint, (("Z", q[i]),), (symbols(f"c{i}"), 0, 0), planar(i)))
    return Mechanism(tuple(links), q, DOWN_Y)


def universal_pendulum(n: int) -> Mechanism:
    """Return point masses on massless links in space, on universal joints with absolute angles."""
    a, b, links = angles(n, "a"), angles(n, "b"), list[Link]()
    for i in range(n):
        joint: Offset = (0, 0, -symbols(f"l{i - 1}")) if i else NOWHERE
        rotations: Rotations = (("X", a[i]), ("Y", b[i]))
        links.append(
            Link(i - 1 if i else None, joint, rotations, (0, 0, -symbols(f"l{i}")), (symbols(f"m{i}"),))
        )
    return Mechanism(tuple(links), tuple(x for pair in zip(a, b, strict=True) for x in pair), DOWN_Z)


def ropes(n: int, axes: str) -> Mechanism:
    """Return particles on ropes whose lengths change, each on the last one, on a trolley; absolute angles."""
    x, lengths = functions_of_time("x"), angles(n, "r")
    down, gravity = ((0, -1, 0), DOWN_Y) if axes == "Z" else ((0, 0, -1), DOWN_Z)
    q = {axis: angles(n, f"q{axis}") for axis in axes}
    links = [Link(None, (x, 0, 0), (), NOWHERE, (symbols("m0"),))]
    for i in range(n):
        joint: Offset = along(down, lengths[i - 1]) if i else NOWHERE
        rotations = tuple((axis, q[axis][i]) for axis in axes)
        links.append(Link(i, joint, rotations, along(down, lengths[i]), (symbols(f"m{i + 1}"),)))
    return Mechanism(tuple(links), (x, *lengths, *(angle for axis in axes for angle in q[axis])), gravity)


def along(direction: tuple[int, int, int], length: Expr) -> Offset:
    x, y, z = direction
    return x * length, y * length, z * length


def tower_crane() -> Mechanism:
    """Return a turning jib, a trolley on it, and a load that swings in two angles on a rope whose length changes."""
    x, r, p, a, b = functions_of_time("x r p a b")
    jib: Rotations = (("Z", p),)
    links = (
        Link(None, NOWHERE, jib, NOWHERE, planar(0)),
        Link(0, (x, 0, symbols("h")), jib, NOWHERE, (symbols("m1"),)),
        Link(1, NOWHERE, (*jib, ("X", a), ("Y", b)), (0, 0, -r), (symbols("m2"),)),
    )
    return Mechanism(links, (x, r, p, a, b), DOWN_Z)


def elastic_double_pendulum(*, relative: bool) -> Mechanism:
    """Return two particles on springs, one on the other."""
    r, q = angles(2, "r"), angles(2)
    links = (
        Link(None, NOWHERE, (("Z", q[0]),), (r[0], 0, 0), (symbols("m1"),)),
        Link(0, (r[0], 0, 0), (("Z", q[0] + q[1] if relative else q[1]),), (r[1], 0, 0), (symbols("m2"),)),
    )
    return Mechanism(links, (*r, *q), DOWN_Y)


def slide_on_a_link(body: Inertia) -> Mechanism:
    """Return a link that turns, and a slide on it."""
    q, x = functions_of_time("q x")
    links = (
        Link(None, NOWHERE, (("Z", q),), (symbols("c1"), 0, 0), planar(1)),
        Link(0, (x, symbols("h"), 0), (("Z", q),), (symbols("c2"), 0, 0), body),
    )
    return Mechanism(links, (q, x), DOWN_Y)


def arm_with_a_slide() -> Mechanism:
    """Return an arm in the plane: a link that turns, a slide on it, and a link that turns on the slide."""
    q, x, p = functions_of_time("q x p")
    links = (
        Link(None, NOWHERE, (("Z", q),), (symbols("c1"), 0, 0), planar(1)),
        Link(0, (x, 0, 0), (("Z", q),), (symbols("c2"), 0, 0), planar(2)),
        Link(1, (symbols("l2"), 0, 0), (("Z", q + p),), (symbols("c3"), 0, 0), planar(3)),
    )
    return Mechanism(links, (q, x, p), DOWN_Y)


def crane_with_a_boom() -> Mechanism:
    """Return a boom that is raised and gets longer, with a load on a rope."""
    p, x, b, r = functions_of_time("p x b r")
    links = (
        Link(None, NOWHERE, (("Z", p),), (symbols("c1"), 0, 0), planar(1)),
        Link(0, (x, 0, 0), (("Z", p),), (-symbols("c2"), 0, 0), planar(2)),
        Link(1, NOWHERE, (("Z", b),), (0, -r, 0), (symbols("m3"),)),
    )
    return Mechanism(links, (p, x, b, r), DOWN_Y)


def ball_on_a_beam() -> Mechanism:
    """Return a beam, and a ball that rolls on it."""
    (q, x), r = functions_of_time("q x"), symbols("r")
    links = (
        Link(None, NOWHERE, (("Z", q),), NOWHERE, planar(1)),
        Link(0, (x, r, 0), (("Z", q - x / r),), NOWHERE, planar(2)),
    )
    return Mechanism(links, (q, x), DOWN_Y)


def stanford_arm() -> Mechanism:
    """Return the first four joints of the Stanford arm, the third of which slides."""
    q1, q2, d, q4 = functions_of_time("q1 q2 d q4")
    second: Rotations = (("Z", q1), ("X", q2))
    links = (
        Link(None, NOWHERE, second[:1], (0, symbols("c1"), 0), planar(1)),
        Link(0, (0, 0, symbols("h")), second, (symbols("e"), 0, 0), general(2)),
        Link(1, (symbols("e"), 0, d), second, (0, 0, -symbols("c3")), general(3)),
        Link(2, NOWHERE, (*second, ("Y", q4)), (0, symbols("c4"), 0), general(4)),
    )
    return Mechanism(links, (q1, q2, d, q4), DOWN_Z)


def scara() -> Mechanism:
    """Return an arm of two parallel axes, and a tool that slides along them."""
    q1, q2, z = functions_of_time("q1 q2 z")
    links = (
        Link(None, NOWHERE, (("Z", q1),), (symbols("c1"), 0, 0), planar(1)),
        Link(0, (symbols("l1"), 0, 0), (("Z", q2),), (symbols("c2"), 0, 0), planar(2)),
        Link(1, (symbols("l2"), 0, z), (("Z", q2),), NOWHERE, (symbols("m3"),)),
    )
    return Mechanism(links, (q1, q2, z), DOWN_Z)


def trolley_on_a_ramp() -> Mechanism:
    """Return a trolley on a ramp whose angle is given by its sides, and a pendulum on it."""
    x, q = functions_of_time("x q")
    a, b = symbols("a b")
    links = (
        Link(None, NOWHERE, (("Z", atan2(b, a)),), (x, 0, 0), (symbols("m1"),)),
        Link(0, (x, 0, 0), (("Z", q),), (0, -symbols("l"), 0), (symbols("m2"),)),
    )
    return Mechanism(links, (x, q), DOWN_Y)


def bent_link() -> Mechanism:
    """Return two links, with a constant angle between them where the second one does not turn."""
    q1, q2 = functions_of_time("q1 q2")
    a, b = symbols("a b")
    links = (
        Link(None, NOWHERE, (("Z", q1),), (symbols("c1"), 0, 0), planar(1)),
        Link(0, (symbols("l"), 0, 0), (("Z", q1 + atan2(b, a) + q2),), (symbols("c2"), 0, 0), planar(2)),
    )
    return Mechanism(links, (q1, q2), DOWN_Y)


def furuta_pendulum() -> Mechanism:
    """Return a particle on an arm that turns about the vertical."""
    p, q = functions_of_time("p q")
    links = (
        Link(None, NOWHERE, (("Z", p),), NOWHERE, planar(1)),
        Link(0, (symbols("L"), 0, 0), (("Z", p), ("X", -q)), (0, 0, symbols("l")), (symbols("m"),)),
    )
    return Mechanism(links, (p, q), DOWN_Z)


def car_with_trailers(n: int) -> Mechanism:
    """Return a car, given by the speeds of its moving frame, and trailers, by their angles against the car."""
    x, y, psi = functions_of_time("x y psi")
    u, v, r = functions_of_time("u v r")
    car = moving_frame(u, v, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", psi))
    q, links = angles(n), [Link(None, NOWHERE, (), NOWHERE, planar(0))]
    for i in range(n):
        centre: Offset = (-symbols(f"c{i + 1}"), 0, 0)
        links.append(Link(i, (-symbols(f"l{i}"), 0, 0), (("Z", q[i]),), centre, planar(i + 1)))
    return Mechanism(tuple(links), q, DOWN_Z, car, (u, v, r))


MECHANISMS: Mapping[str, Mechanism] = {
    "pendulum of 30 links on a cart": pendulum_on_a_cart(30),
    "six rods": rods(6),
    "crane": crane(),
    "crane in two angles": spatial_crane(),
    "wheel with two poles": wheel_with_poles(),
    "planar arm, absolute angles": planar_arm(5, relative=False),
    "planar arm, relative angles": planar_arm(5, relative=True),
    "spatial arm": spatial_arm("ZXXZXZ"),
    "spatial arm, three parallel axes": spatial_arm("ZYYYZX"),
    "tree of seven links": tree((0, 0, 0, 1, 1, 2, 2)),
    "pendulum of four universal joints": universal_pendulum(4),
    "load on a rope": ropes(1, "Z"),
    "three ropes": ropes(3, "Z"),
    "load on a rope in two angles": ropes(1, "XY"),
    "two ropes in two angles": ropes(2, "XY"),
    "tower crane": tower_crane(),
    "crane with a boom": crane_with_a_boom(),
    "elastic double pendulum, absolute angles": elastic_double_pendulum(relative=False),
    "elastic double pendulum, relative angles": elastic_double_pendulum(relative=True),
    "particle that slides on a link": slide_on_a_link((symbols("m2"),)),
    "body that slides on a link": slide_on_a_link(planar(2)),
    "arm with a slide": arm_with_a_slide(),
    "ball on a beam": ball_on_a_beam(),
    "Stanford arm": stanford_arm(),
    "SCARA": scara(),
    "trolley on a ramp": trolley_on_a_ramp(),
    "bent link": bent_link(),
    "Furuta pendulum": furuta_pendulum(),
    "eight rods": rods(8),
    "spatial arm, three axes": spatial_arm("XYZ"),
    "car with a trailer": car_with_trailers(1),
    "car with two trailers": car_with_trailers(2),
}
