"""Machines at rest: positions and forces that statics gives in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    Link,
    Mechanism,
    Point,
    Torque,
    Vector,
    assemble,
    equilibrium,
    functions_of_time,
    ground,
    line_force,
    motor,
    newton_euler,
    pi,
    prismatic,
    project,
    reaction,
    revolute,
    rotate,
    spherical,
    spring,
    steady,
    symbols,
    time_derivative,
    torsion_spring,
    translate,
    universal,
)

G = 9.81


def test_the_triangles_of_a_tensegrity_prism_are_turned_by_150_degrees() -> None:
    """Three struts stand on three points, held by strings alone: tops are 90 - 180/3 degrees beyond the strings' feet.

    These are 120 degrees beyond the struts' [Connelly & Terrell 1995, Globally rigid symmetric tensegrities].
    """
    struts = [Link(f"strut{k}", 0.1, 0.05, 0.05, center=(0, 0, 1.1)) for k in range(3)]
    feet = [
        universal(f"S{k}", ground, strut, at=rotate("Z", 2 * pi * k / 3) * translate(1, 0, 0), axes="XY")
        for k, strut in enumerate(struts)
    ]
    made = assemble(feet)
    bodies, tops = [made.body(strut) for strut in struts], [made.point(strut, 0, 0, 2.2) for strut in struts]
    strings = []
    for k in range(3):
        after = (k + 1) % 3
        foot = Point(ground, math.cos(2 * math.pi * after / 3), math.sin(2 * math.pi * after / 3), 0)
        ends = {"on": bodies[k], "reaction": bodies[after]}
        strings.append(spring(tops[k], tops[after], 500, free_length=1.4, damping=20, name=f"top{k}", **ends))
        strings.append(spring(tops[k], foot, 500, free_length=1, damping=20, on=bodies[k], name=f"side{k}"))
    guess = {q: -0.6 for foot in feet for q in foot.coordinates}
    rest = equilibrium(newton_euler(made.system(strings)), {}, guess=guess)
    for k, top in enumerate(tops):
        x, y, _ = (each.evaluate(rest.coordinates) for each in project(top, ground).coordinates)
        assert_allclose((math.degrees(math.atan2(y, x)) - 120 * k) % 360, 150, atol=1e-6)
    assert rest.is_stable


def roll_of_car(bar: float, moment: float = 200.0) -> float:
    """Return the roll of a body on two wheels that an anti-roll bar joins, by a moment."""
    k, w, r, d = 2e4, 1.5, 0.2, 0.2
    carriage, body = Link("carriage"), Link("body", 1000, 400)
    heave, roll = prismatic("heave", ground, carriage, axis="Z"), revolute("roll", carriage, body, axis="X")
    joints, sides = [heave, roll], {"left": w / 2, "right": -w / 2}
    for side, y in sides.items():
        arm, rod, wheel = Link(f"{side}_arm"), Link(f"{side}_rod"), Link(f"{side}_wheel", 40)
        joints += [
            prismatic(f"{side}_travel", ground, wheel, axis="Z", at=(0, y, 0)),
            revolute(f"{side}_bar", body, arm, axis="Y", at=(0, y, 0)),
            universal(f"{side}_upper", arm, rod, at=(r, 0, 0), axes="XY"),
            spherical(f"{side}_lower", rod, wheel, at=(0, 0, -d), to=(r, 0, -d), axes="XYZ", loop=True),
        ]
    made = assemble(joints)
    chassis = made.body(body)
    twist = made.joint("left_bar").coordinate - made.joint("right_bar").coordinate
    loads = [
        torsion_spring(twist, bar, on=made.body("left_arm"), reaction=made.body("right_arm")),
        Torque(ground, moment, 0, 0, on=chassis),
    ]
    for side, y in sides.items():
        wheel_body, hub = made.body(f"{side}_wheel"), made.point(f"{side}_wheel", 0, 0, 0)
        seat, road = made.point(body, 0, y, 0.5), Point(ground, 0, y, -0.3)
        loads.append(spring(seat, hub, k, free_length=0.5, on=chassis, reaction=wheel_body, name=f"{side} s"))
        loads.append(spring(hub, road, 2e8, free_length=0.3, on=wheel_body, name=f"{side} tyre"))
    return float(equilibrium(newton_euler(made.system(loads)), {})[roll.coordinate])


@pytest.mark.parametrize("bar", [50.0, 500.0])
def test_an_anti_roll_bar_adds_its_stiffness_by_the_square_of_track_over_arm(bar: float) -> None:
    """``M = (k w^2/2 + kb (w/r)^2) phi``: 0.4 degrees, on tyres that are stiff."""
    assert_allclose(200.0 / roll_of_car(bar), 2e4 * 1.5**2 / 2 + bar * (1.5 / 0.2) ** 2, rtol=3e-4)


def excavator() -> tuple[Mechanism, Equations, tuple[Expr, ...]]:
    """Return a boom on a cylinder of two parts, and a stick on one without mass."""
    F1, F2 = functions_of_time("F1 F2")
    boom, stick = Link("boom", 800, center=(2, 0, 0)), Link("stick", 400, center=(1.25, 0, 0))
    barrel, piston = Link("barrel"), Link("piston")
    made = assemble(
        [
            revolute("A", ground, boom),
            revolute("B", boom, stick, at=(4, 0, 0)),
            revolute("foot", ground, barrel, at=(0.6, 0, 0)),
            prismatic("cylinder", barrel, piston),
            revolute("eye", piston, boom, to=(1.5, 0, 0), loop=True),
        ]
    )
    bodies: dict[str, Body] = {body.name: body for body in made.bodies}
    lift = motor(made.joint("cylinder").coordinate, F1, on=bodies["piston"], reaction=bodies["barrel"])
    ends = made.point(boom, 1, 0.5, 0), made.point(stick, -0.4, 0.1, 0)
    crowd = line_force(F2, *ends, on=bodies["boom"], reaction=bodies["stick"])
    equations = newton_euler(made.system([lift, crowd], gravity=Vector(ground, 0, -G, 0)))
    return made, equations, (F1, F2)


def test_cylinders_of_an_excavator_hold_it_by_virtual_work() -> None:
    """``F dl = dV`` with the law of cosines, ``l^2 = 0.6^2 + 1.5^2 - 1.8 cos(A)``, and Newton's law on the pins."""
    made, equations, (F1, F2) = excavator()
    A, B = made.joint("A").coordinate, made.joint("B").coordinate
    at = {A: 0.7, B: -1.2}
    guess = {made.joint("foot").coordinate: 1.2, made.joint("cylinder").coordinate: 1.2}
    held = steady(equations, {}, given=at, unknown=[F1, F2], guess=guess)
    length = math.sqrt(0.36 + 2.25 - 1.8 * math.cos(0.7))
    assert held[made.joint("cylinder").coordinate] == pytest.approx(length, rel=1e-9)

    def weight(a: float, b: float) -> float:
        return G * (800 * 2 * math.sin(a) + 400 * (4 * math.sin(a) + 1.25 * math.sin(a + b)))

    def stick_cylinder(b: float) -> float:
        """Its length: the eye of the stick, in the axes of the boom."""
        x, y = 4 - 0.4 * math.cos(b) - 0.1 * math.sin(b), -0.4 * math.sin(b) + 0.1 * math.cos(b)
        return math.hypot(x - 1, y - 0.5)

    h = 1e-5
    by_boom = (weight(0.7 + h, -1.2) - weight(0.7 - h, -1.2)) / (2 * h)
    by_stick = (weight(0.7, -1.2 + h) - weight(0.7, -1.2 - h)) / (2 * h)
    slope = (stick_cylinder(-1.2 + h) - stick_cylinder(-1.2 - h)) / (2 * h)
    assert held[F1] * 0.9 * math.sin(0.7) / length == pytest.approx(by_boom, rel=1e-8)
    assert -held[F2] * slope == pytest.approx(by_stick, rel=1e-8)
    pin = reaction(equations, "A").force.projected(ground).components
    feet = reaction(equations, "foot").force.projected(ground).components
    total = np.array([held[a] + held[b] for a, b in zip(pin, feet, strict=True)])
    assert_allclose(total, [0, 1200 * G, 0], atol=1e-6)


def test_the_carriage_of_a_forklift_rises_twice_as_fast_as_its_mast() -> None:
    """The chain adds the travel of the mast to that of the carriage: the cylinder carries ``(m1 + 2 m2) g``."""
    m1, m2, s = *symbols("m1 m2"), functions_of_time("s")
    mast, carriage = Link("mast", m1), Link("carriage", m2)
    rails = [
        prismatic("rails", ground, mast, axis="Z", coordinate=s),
        prismatic("chain", mast, carriage, axis="Z", coordinate=s),
    ]
    made, F = assemble(rails), symbols("F")
    lift = motor(s, F, on=made.body(mast))
    (residual,) = newton_euler(made.system([lift], gravity=Vector(ground, 0, 0, -G))).residuals
    assert residual == (m1 + 4 * m2) * time_derivative(s, 2) + (m1 + 2 * m2) * G - F
