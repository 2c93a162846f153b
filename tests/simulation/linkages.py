"""Linkages for the tests of states, equilibria and prescribed motions."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Point,
    System,
    Torque,
    Vector,
    floating_frame,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    project,
    rotate,
    sin,
    symbols,
    t,
    translate,
)
from symbody.errors import ModelNotice


@dataclass(frozen=True)
class Linkage:
    """Equations of motion, numbers for their parameters, and their variables by name."""

    equations: Equations
    parameters: Mapping[Expr, float]
    names: Mapping[str, Expr]

    def __getitem__(self, name: str) -> Expr:
        return self.names[name]


def double_pendulum(*, driven: bool = False) -> Linkage:
    """Point masses on massless rods, absolute angles from the vertical, z down, with a torque at each joint.

    The torques are parameters, or functions of time where it is driven.
    """
    m1, m2, l1, l2, g = symbols("m1 m2 l1 l2 g")
    T1, T2 = functions_of_time("T1 T2") if driven else symbols("T1 T2")
    q1, q2 = functions_of_time("theta1 theta2")
    first = rotate("Y", q1)
    elbow = first * translate(0, 0, l1)
    second = elbow * rotate("Y", q2 - q1)
    tip = second * translate(0, 0, l2)
    upper, lower = Body(elbow, m1, name="upper"), Body(tip, m2, name="lower")
    system = System(
        [upper, lower],
        [Torque(ground, 0, T1, 0, on=upper), Torque(ground, 0, T2, 0, on=lower, reaction=upper)],
        [q1, q2],
        gravity=Vector(ground, 0, 0, g),
    )
    values = {m1: 1.5, m2: 0.7, l1: 1.1, l2: 0.6, g: 9.81}
    if not driven:
        values |= {T1: 0.0, T2: 0.0}
    names = {str(each): each for each in (*values, T1, T2, q1, q2)}
    return Linkage(newton_euler(system), values, names)


def fourbar() -> Linkage:
    """The four-bar of tests/reference: A and C hang on ground, B joins them, a force H at the pin of B and C."""
    LN, LA, LB, LC, mA, mB, mC, g, H = symbols("LN LA LB LC mA mB mC g H")
    qA, qB, qC = functions_of_time("qA qB qC")
    A, C = rotate("Z", qA), translate(0, LN, 0) * rotate("Z", qC)
    B = A * translate(LA, 0, 0) * rotate("Z", qB - qA)
    bodies = [
        Body(Point(frame, length / 2, 0, 0), mass, 0, 0, mass * length**2 / 12)
        for frame, length, mass in ((A, LA, mA), (B, LB, mB), (C, LC, mC))
    ]
    pin = Point(B, LB, 0, 0)
    gap = project(pin - Point(C, LC, 0, 0), ground).components[:2]
    push = Force(ground, 0, H, 0, at=Point(C, LC, 0, 0), on=bodies[2])
    system = System(bodies, [push], [qA, qB, qC], gap, Vector(ground, g, 0, 0))
    numbers = (1.0, 1.0, 2.0, 2.0, 10.0, 20.0, 20.0, 9.81, 200.0)
    values = dict(zip((LN, LA, LB, LC, mA, mB, mC, g, H), numbers, strict=True))
    names = {str(each): each for each in (*values, qA, qB, qC)}
    return Linkage(newton_euler(system), values, names)


def slider_crank() -> Linkage:
    """A crank, a rod and a slider along x, without gravity; a torque T turns the crank, a force F pushes the slider."""
    r, l, m2, m3, I1, I2, T, F = symbols("r l m2 m3 I1 I2 T F")
    phi, beta, s = functions_of_time("phi beta s")
    crank_frame = rotate("Z", phi)
    rod_frame = crank_frame * translate(r, 0, 0) * rotate("Z", -beta - phi)
    crank = Body(crank_frame, 0, 0, 0, I1)
    rod = Body(Point(rod_frame, l / 2, 0, 0), m2, 0, 0, I2)
    slider = Body(translate(s, 0, 0), m3)
    gap = project(Point(rod_frame, l, 0, 0) - Point(ground, s, 0, 0), ground).components[:2]
    loads = [
        Torque(ground, 0, 0, T, on=crank),
        Force(ground, F, 0, 0, at=slider.center_of_mass, on=slider),
    ]
    system = System([crank, rod, slider], loads, [phi, beta, s], gap)
    values = {r: 0.1, l: 0.3, m2: 0.5, m3: 0.8, I1: 1e-3, I2: 4e-3, T: 0.0, F: 0.0}
    names = {str(each): each for each in (*values, phi, beta, s)}
    return Linkage(lagrange_equations(system), values, names)


def pendulum_on_rail(*, twice: bool = False) -> Linkage:
    """A bob at (x, y) on a rod of length l about a pivot that moves by a sin(w t); the rod may be given twice."""
    m, l, g, a, w = symbols("m l g a w")
    x, y = functions_of_time("x y")
    rod = (x - a * sin(w * t)) ** 2 + y**2 - l**2
    constraints = [rod, 3 * rod] if twice else [rod]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        system = System([Body(translate(x, y, 0), m)], (), [x, y], constraints, Vector(ground, 0, -g, 0))
        equations = newton_euler(system)
    values = {m: 1.2, l: 2.0, g: 9.81, a: 0.3, w: 2.0}
    return Linkage(equations, values, {str(each): each for each in (*values, x, y)})


def hanging_box() -> Linkage:
    """A free body whose corner is held by a ball joint, with a rotor inside: quasi-velocities and constraints."""
    m, I1, I2, I3, J, c, g, T = symbols("m I1 I2 I3 J c g T")
    phi = functions_of_time("phi")
    hull = floating_frame()
    box, rotor = Body(hull, m, I1, I2, I3), Body(hull * rotate("Z", phi), 0, Iz=J)
    motor = Torque(hull, 0, 0, T, on=rotor, reaction=box)
    held = project(Point(hull, c, c / 2, c / 3) - Point(ground, 0, 0, 0), ground).components
    system = System([box, rotor], [motor], [phi], held, Vector(ground, 0, 0, -g))
    values = {m: 2.0, I1: 0.2, I2: 0.3, I3: 0.35, J: 0.05, c: 0.4, g: 9.81, T: 0.0}
    names = {str(each): each for each in (*values, *system.coordinates, *system.speeds)}
    return Linkage(newton_euler(system), values, names)
