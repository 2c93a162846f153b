"""Machines and suspensions as their users build them: joints and links, loads, a start and a guess by names."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from symbody import (
    Frame,
    Link,
    Mechanism,
    Point,
    assemble,
    cos,
    cylindrical,
    free,
    gear,
    ground,
    pi,
    point_on_curve,
    prismatic,
    rack,
    revolute,
    rotate,
    screw,
    sin,
    spherical,
    spring,
    translate,
    universal,
)
from symbody.multibody import Load
from symbody.multibody.joint.joint import Joint

Place = tuple[float, float, float]


class Machine(NamedTuple):
    """A mechanism with its loads, and values of its coordinates and rates by their names."""

    mechanism: Mechanism
    start: Mapping[str, float]
    guess: Mapping[str, float] = {}
    loads: tuple[Load, ...] = ()


def part(name: str, mass: float = 1.0, size: float = 0.1, center: Place = (0, 0, 0)) -> Link:
    return Link(name, mass, size, 1.2 * size, 0.9 * size, center=center)


def strut(made: Mechanism, one: str, other: str, stiffness: float, free_length: float) -> Load:
    """Return the spring between the origins of two links, as of a cylinder with its piston."""
    return spring(
        made.point(one, 0, 0, 0),
        made.point(other, 0, 0, 0),
        stiffness,
        free_length=free_length,
        on=made.body(one),
        reaction=made.body(other),
    )


def swing_axle() -> Machine:
    """Two half axles that swing about the body's length, with wheels that spin."""
    body, wheels = part("body", 300, 50), [part(name, 15, 0.5) for name in ("left_wheel", "right_wheel")]
    joints = [prismatic("H", ground, body, axis="Z")]
    for side, wheel in zip((1, -1), wheels, strict=True):
        half, name = part(f"half_{wheel}", 10, 0.4, (0, 0.3 * side, 0)), f"{wheel}"[0]
        joints += [
            revolute(f"P{name}", body, half, at=(0, 0.2 * side, 0), axis="X"),
            revolute(f"W{name}", half, wheel, at=(0, 0.6 * side, 0), axis="Y"),
        ]
    made = assemble(joints)
    sides = [
        (wheel, made.point(body, 0, 0.5 * side, 0.5)) for side, wheel in zip((1, -1), wheels, strict=True)
    ]
    loads = [
        spring(
            made.point(wheel, 0, 0, 0),
            seat,
            2e4,
            free_length=0.75,
            on=made.body(wheel),
            reaction=made.body(body),
        )
        for wheel, seat in sides
    ]
    loads.append(spring(made.point(body, 0, 0, 0), Point(ground, 0, 0, 1), 2e4, on=made.body(body)))
    return Machine(made, {"phi_Wl'": 20, "phi_Pl": 0.05}, loads=tuple(loads))


def differential() -> Machine:
    """A differential whose left half shaft turns a wheel by a universal joint, at an angle of 0.1."""
    case, planet = part("case", 5), part("planet", 0.3, 0.01, (0, 0, 0.05))
    left, right, wheel = part("left", 2, 0.05), part("right", 2, 0.05), part("wheel", 10, 0.5)
    C, P = revolute("C", ground, case, axis="X"), revolute("P", case, planet)
    L, R = (
        revolute("L", case, left, at=rotate("Y", pi / 2)),
        revolute("R", case, right, at=rotate("Y", -pi / 2)),
    )
    joints = [C, P, L, R, gear("G1", L, P, 0.1, 0.05), gear("G2", R, P, 0.1, 0.05)]
    joints.append(universal("U", left, wheel, axes="XY", at=(0, 0, 0.3)))
    joints.append(cylindrical("W", ground, wheel, at=translate(0.3, 0, 0) * rotate("Y", pi / 2 + 0.1)))
    start = {"phi_C": 0, "phi_L": 0, "phi_C'": 3, "phi_L'": 1}
    return Machine(assemble(joints), start, {"theta_U": 0.1, "phi_U": 0})


def five_link_suspension() -> Machine:
    """An upright on five links of numbers, each between a universal and a spherical joint."""
    inner = [(0.2, 0.3, 0.1), (-0.2, 0.3, 0.1), (0.25, 0.35, -0.1), (-0.25, 0.35, -0.1), (0.1, 0.3, 0.02)]
    outer = [
        (0.03, 0.7, 0.13),
        (-0.03, 0.7, 0.12),
        (0.05, 0.75, -0.13),
        (-0.02, 0.74, -0.12),
        (0.15, 0.72, 0),
    ]
    upright, joints, guess = part("upright", 20, 0.5), list[Joint](), dict[str, float]()
    for k, (a, b) in enumerate(zip(inner, outer, strict=True)):
        length = math.dist(a, b)
        rod = Link(f"rod{k}", 1, 0.001, 0.05, 0.05, center=(length / 2, 0, 0))
        joints += [
            universal(f"I{k}", ground, rod, at=a, axes="ZY"),
            spherical(f"O{k}", rod, upright, at=(length, 0, 0), to=b),
        ]
        x, y, z = (np.array(b) - np.array(a)) / length
        guess |= {f"phi_I{k}": math.atan2(y, x), f"theta_I{k}": -math.asin(z)}
    yaw, pitch = guess["phi_I0"], guess["theta_I0"]  # the upright is parallel to the ground
    guess |= {"psi_O0": -yaw, "theta_O0": -pitch * math.cos(yaw), "phi_O0": -pitch * math.sin(yaw)}
    made = assemble(joints)
    hub = made.point(upright, 0, 0.72, 0)
    load = spring(hub, Point(ground, 0, 0.6, 0.5), 2e4, free_length=0.5, on=made.body(upright))
    return Machine(made, {}, guess, (load,))


def drive_shaft() -> Machine:
    """Two universal joints in a shaft, at equal angles and in one plane: both ends turn at one speed."""
    first, middle, second = part("first"), part("middle", 1, 0.05), part("second")
    made = assemble(
        [
            revolute("A", ground, first, axis="X"),
            universal("U", first, middle, axes="YZ"),
            universal("V", middle, second, at=(1, 0, 0), axes="ZY"),
            cylindrical(
                "B",
                ground,
                second,
                at=translate(math.cos(0.2), math.sin(0.2), 0) * rotate("Z", 0.4),
                axis="X",
            ),
        ]
    )
    return Machine(made, {"phi_A": 0, "phi_A'": 3}, {"theta_U": 0.2, "phi_V": 0.2})


def cam() -> Machine:
    """A follower on a cam of the radius ``0.1 + 0.02 cos(2 s)``, pressed by a spring."""
    disc, follower = part("disc", 2), part("follower")
    made = assemble(
        [
            revolute("A", ground, disc),
            prismatic("B", ground, follower, axis="X"),
            point_on_curve(
                "K",
                disc,
                follower,
                curve=lambda s: ((0.1 + 0.02 * cos(2 * s)) * cos(s), (0.1 + 0.02 * cos(2 * s)) * sin(s), 0),
                axes="Z",
                loop=True,
            ),
        ]
    )
    load = spring(made.point(follower, 0, 0, 0), Point(ground, -0.5, 0, 0), 50, on=made.body(follower))
    return Machine(made, {"phi_A": 0, "phi_A'": 4}, {"s_B": 0.12, "s_K": 0}, (load,))


def worm_gear() -> Machine:
    """A worm of the lead 2 pi 0.005: its thread is a link that slides, in mesh with the wheel as a rack."""
    worm, thread, wheel = part("worm", 1, 0.01), part("thread", 0.1, 0.001), part("wheel", 2)
    T, G = prismatic("T", ground, thread), revolute("G", ground, wheel, at=(0, 0.1, 0))
    W = revolute("W", ground, worm, axis="X")
    thread_on_worm = screw("S", worm, thread, pitch=0.005, axis="X", loop=True)
    return Machine(assemble([W, T, G, thread_on_worm, rack("K", G, T, 0.1)]), {"phi_W'": 30})


def excavator() -> Machine:
    """A boom and a stick, moved by hydraulic cylinders, with a bucket that hangs."""
    boom, stick = part("boom", 500, 300, (2, 0, 0)), part("stick", 200, 60, (1, 0, 0))
    bucket = part("bucket", 150, 20, (0.4, 0, 0.3))
    joints = [
        revolute("A", ground, boom, axis="Y"),
        revolute("B", boom, stick, at=(4, 0, 0), axis="Y"),
        revolute("C", stick, bucket, at=(2, 0, 0), axis="Y"),
    ]
    seats: list[tuple[str, Link | Frame, Place, Link, Place]] = [
        ("K", ground, (0.5, 0, -0.5), boom, (1.8, 0, 0.4)),
        ("M", boom, (2.0, 0, 0.6), stick, (-0.6, 0, 0.3)),
    ]
    for name, carrier, at, driven, to in seats:
        barrel = part(f"{name}_barrel", 20, 2, (0.5, 0, 0))
        piston = part(f"{name}_piston", 15, 2, (-0.4, 0, 0))
        joints += [
            revolute(f"{name}1", carrier, barrel, at=at, axis="Y"),
            prismatic(f"{name}2", barrel, piston),
            revolute(f"{name}3", piston, driven, to=to, axis="Y", loop=True),
        ]
    made = assemble(joints)
    oil = tuple(
        strut(made, f"{name}_piston", f"{name}_barrel", 4e5, length)
        for name, length in (("K", 1.7), ("M", 1.6))
    )
    start = {"phi_A": -0.3, "phi_B": 0.9, "phi_C": 0.3}
    return Machine(made, start, {"phi_K1": -0.7, "s_K2": 1.7, "phi_M1": 0.1, "s_M2": 1.4}, oil)


def scissor_lift() -> Machine:
    """A platform on two crossed bars, whose lower and upper ends slide."""
    bars = [part(name, 3, 0.3, (0.5, 0, 0)) for name in ("rising", "falling")]
    platform, foot, head = part("platform", 20, 1), part("foot"), part("head")
    rising, falling = bars
    made = assemble(
        [
            revolute("A", ground, rising, axis="Y"),
            prismatic("F", ground, foot),
            revolute("B", foot, falling, axis="Y"),
            revolute("M", rising, falling, at=(0.5, 0, 0), to=(0.5, 0, 0), axis="Y"),
            revolute("T", falling, platform, at=(1, 0, 0), axis="Y"),
            prismatic("G", platform, head),
            revolute("U", rising, head, at=(1, 0, 0), axis="Y"),
        ]
    )
    return Machine(made, {"phi_A": -0.5}, {"s_F": 0.88, "phi_B": -2.64, "phi_T": 2.64, "s_G": 0.88})


def screw_jack() -> Machine:
    """Four bars of a car jack: a screw pulls the nut on one side to the bearing on the other."""
    bars = [part(f"bar{k}", 1, 0.05, (0.15, 0, 0)) for k in range(4)]
    nut, bearing, top, spindle = (part(name, 0.5, 0.01) for name in ("nut", "bearing", "top", "spindle"))
    made = assemble(
        [
            *(revolute(f"A{k}", ground, bars[k], axis="Y") for k in range(2)),
            *(
                revolute(f"N{k}", bars[k], each, at=(0.3, 0, 0), axis="Y")
                for k, each in enumerate((nut, bearing))
            ),
            *(revolute(f"T{k}", each, bars[2 + k], axis="Y") for k, each in enumerate((nut, bearing))),
            *(revolute(f"X{k}", bars[2 + k], top, at=(0.3, 0, 0), axis="Y") for k in range(2)),
            prismatic("Z", ground, top, axis="Z"),
            screw("S", nut, spindle, pitch=0.002, axis="X"),
            revolute("R", bearing, spindle, axis="X"),
        ]
    )
    guess = {"phi_A0": -0.6, "phi_A1": -2.54, "phi_N0": 0.6, "phi_N1": 2.54, "phi_T0": -2.54, "phi_T1": -0.6}
    return Machine(made, {}, guess | {"phi_X0": 2.54, "s_Z": 0.34, "phi_S": -240})


def tripod_coupling() -> Machine:
    """A shaft with three trunnions, whose balls slide in the grooves of the other shaft, tilted by 0.15."""
    housing, shaft = part("housing", 2), part("shaft")
    joints = [revolute("A", ground, housing), free("F", ground, shaft)]
    for k in range(3):
        ball, carriage = part(f"ball{k}", 0.1, 0.001), part(f"carriage{k}", 0.1, 0.001)
        turned = rotate("Z", 2 * pi * k / 3)
        joints += [
            prismatic(f"T{k}", shaft, ball, at=turned),
            prismatic(f"S{k}", housing, carriage, at=turned * translate(0.05, 0, 0), axis="Z"),
            spherical(f"B{k}", ball, carriage, loop=True),
        ]
    joints.append(spherical("C", ground, shaft, at=(math.sin(0.15), 0, 1), to=(0, 0, 1), loop=True))
    slides = {f"s_T{k}": 0.05 for k in range(3)}
    return Machine(assemble(joints), {"phi_A": 0, "phi_A'": 3}, {"theta_F": 0.15} | slides)


def schmidt_coupling() -> Machine:
    """Three discs in a row, joined by three parallel links each; the middle one floats."""
    discs = [part(f"disc{k}", 2) for k in range(3)]
    joints = [revolute("I", ground, discs[0]), revolute("O", ground, discs[2], at=(0.25, 0.1, 0))]
    for side in range(2):
        for k in range(3):
            place = (0.2 * cos(2 * pi * k / 3), 0.2 * sin(2 * pi * k / 3), 0)
            rod = part(f"rod{side}{k}", 0.2, 0.01, (0.1, 0, 0))
            joints += [
                revolute(f"P{side}{k}", discs[side], rod, at=place),
                revolute(f"Q{side}{k}", rod, discs[side + 1], at=(0.2, 0, 0), to=place),
            ]
    guess = {f"phi_P{side}{k}": angle for side, angle in enumerate((1.0, -0.3)) for k in range(3)}
    return Machine(assemble(joints), {"phi_I": 0, "phi_I'": 2}, guess | {"phi_Q00": -1.0, "phi_O": 0})


LEGS = [
    ((math.cos(b), math.sin(b), 0.0), (0.5 * math.cos(a), 0.5 * math.sin(a), 0.0))
    for k in range(6)
    for sign in [1 if k % 2 else -1]
    for a, b in [(2 * math.pi * (k // 2) / 3 + 0.2 * sign, 2 * math.pi * (k // 2) / 3 + 0.85 * -sign)]
]
"""The ends of the legs of the hexapod, on the ground and on the platform."""


def hexapod() -> Machine:
    """A Stewart platform: six legs of two parts each, with springs for the actuators."""
    top, guess = part("top", 10, 0.5), {"z_F": 0.8}
    joints = [free("F", ground, top)]
    for k, (low, high) in enumerate(LEGS):
        barrel, piston = part(f"barrel{k}", 1, 0.01, (0, 0, 0.2)), part(f"piston{k}", 1, 0.01, (0, 0, -0.2))
        joints += [
            universal(f"U{k}", ground, barrel, at=low, axes="XY"),
            prismatic(f"C{k}", barrel, piston, axis="Z"),
            spherical(f"S{k}", piston, top, to=high, loop=True),
        ]
        leg = np.array(high) + np.array((0, 0, 0.8)) - np.array(low)
        length = float(np.linalg.norm(leg))
        x, y, z = leg / length
        guess |= {f"s_C{k}": length, f"theta_U{k}": math.asin(x), f"phi_U{k}": math.atan2(-y, z)}
    made = assemble(joints)
    return Machine(
        made, {}, guess, tuple(strut(made, f"piston{k}", f"barrel{k}", 5e3, 1.0) for k in range(6))
    )


def delta_robot() -> Machine:
    """A platform on three arms with two parallel rods each; it is carried by slides, so that it can't turn."""
    platform = part("platform", 1, 0.01)
    carriers = [part(name, 0.1, 0.001) for name in ("along", "across")]
    joints = [
        prismatic("X", ground, carriers[0], axis="X"),
        prismatic("Y", carriers[0], carriers[1], axis="Y"),
        prismatic("Z", carriers[1], platform, axis="Z"),
    ]
    guess = {"s_Z": -0.75}
    for k in range(3):
        c, s = math.cos(2 * math.pi * k / 3), math.sin(2 * math.pi * k / 3)
        arm = part(f"arm{k}", 0.5, 0.01, (0.15, 0, 0))
        joints.append(
            revolute(f"A{k}", ground, arm, at=rotate("Z", 2 * pi * k / 3) * translate(0.2, 0, 0), axis="Y")
        )
        guess[f"phi_A{k}"] = 0.3
        for side, e in (("a", 0.05), ("b", -0.05)):
            rod = part(f"rod{k}{side}", 0.1, 0.005, (0.4, 0, 0))
            joints += [
                universal(f"U{k}{side}", arm, rod, at=(0.3, e, 0), axes="YZ"),
                spherical(
                    f"S{k}{side}",
                    rod,
                    platform,
                    at=(0.8, 0, 0),
                    to=(0.05 * c - e * s, 0.05 * s + e * c, 0),
                    loop=True,
                ),
            ]
            guess[f"phi_U{k}{side}"] = 1.8
    return Machine(assemble(joints), {}, guess)


def hoeken() -> Machine:
    """Hoeken's linkage, of the proportions 1, 2, 2.5 and 2.5."""
    crank, coupler = part("crank", 0.3, 0.01), part("coupler", 1, 0.3, (2.5, 0, 0))
    rocker = part("rocker", 1, 0.1, (1.25, 0, 0))
    made = assemble(
        [
            revolute("A", ground, crank, axis="Y"),
            revolute("B", crank, coupler, at=(1, 0, 0), axis="Y"),
            revolute("D", ground, rocker, at=(2, 0, 0), axis="Y"),
            revolute("C", coupler, rocker, at=(2.5, 0, 0), to=(2.5, 0, 0), axis="Y"),
        ]
    )
    start = {"phi_A": math.pi, "phi_A'": 6.0}
    return Machine(made, start, {"phi_B": -math.pi - 0.9, "phi_D": -1.5})


MACHINES: list[Callable[[], Machine]] = [
    *(swing_axle, differential, five_link_suspension, drive_shaft, cam, worm_gear, excavator),
    *(scissor_lift, screw_jack, hoeken),
]
LARGE: list[Callable[[], Machine]] = [tripod_coupling, schmidt_coupling, hexapod, delta_robot]
"""Those that take some seconds."""
