"""Linkages that close loops: in the plane, and Bricard's in space."""

from __future__ import annotations

from math import asin, cos, pi

from symbody.geometry import Point, Vector, ground, project, rotate, translate
from symbody.multibody import (
    Body,
    Constraint,
    Force,
    Link,
    System,
    Torque,
    assemble,
    prismatic,
    revolute,
    spring,
)
from symbody.symbolic import Expr, functions_of_time, number, symbols, time_derivative

from .classic_system import ClassicSystem


def four_bar() -> ClassicSystem:
    """Return a four-bar linkage that hangs in a plane, x downwards; a force H pulls the pin of bars B and C aside.

    A hangs from the origin, B from the end of A, C from a pin at the distance LN; the ends of B and C meet. Angles are
    measured from the vertical. The numbers are those of the source.

    >>> from symbody import newton_euler
    >>> newton_euler(four_bar().system)
    Equations(3 equations of motion, 2 constraints, coordinates qA, qB, qC)
    """
    LN, LA, LB, LC, mA, mB, mC, g, H = symbols("LN LA LB LC mA mB mC g H")
    qA, qB, qC = functions_of_time("qA qB qC")
    A, B, C = (_bar(*each) for each in (("A", LA, mA), ("B", LB, mB), ("C", LC, mC)))
    joints = [
        revolute("O", ground, A, coordinate=qA),
        revolute("P", A, B, at=(LA, 0, 0), coordinate=qB - qA),
        revolute("R", ground, C, at=(0, LN, 0), coordinate=qC),
        revolute("Q", C, B, at=(LC, 0, 0), to=(LB, 0, 0)),
    ]
    linkage = assemble(joints)
    pull = Force(ground, 0, H, 0, at=linkage.point(C, LC, 0, 0), on=linkage.body(C), name="pull")
    return ClassicSystem(
        linkage.system([pull], gravity=Vector(ground, g, 0, 0), name="Four-bar linkage"),
        "Mitiguy, Four-bar linkage statics and dynamics, an example of MotionGenesis (motiongenesis.com)",
        {LN: 1.0, LA: 1.0, LB: 2.0, LC: 2.0, mA: 10.0, mB: 20.0, mC: 20.0, g: 9.81, H: 200.0},
        {qA: 0.5},
        guess={qB: 1.2, qC: 0.7},
    )


def _bar(name: str, length: Expr, mass: Expr) -> Link:
    return Link(name, mass, Iz=mass * length**2 / 12, center=(length / 2, 0, 0))


def slider_crank() -> ClassicSystem:
    """Return a slider-crank whose rod has the length 2 and slides with its middle; a force F pushes its other end.

    A spring with a damper joins the middle of the crank and a point of the rod. The numbers are those of the source.

    >>> from symbody import newton_euler
    >>> newton_euler(slider_crank().system)
    Equations(3 equations of motion, 2 constraints, coordinates q, x, p)
    """
    a, J1, m2, J2, k, c, l0, F = symbols("a J1 m2 J2 k c l0 F")
    q, x, p = functions_of_time("q x p")
    crank, guide, rod = Link("crank", Iz=J1), Link("guide"), Link("rod", m2, Iz=J2)
    linkage = assemble(
        [
            revolute("O", ground, crank, coordinate=q),
            prismatic("rail", ground, guide, axis="X", coordinate=x),
            revolute("G", guide, rod, coordinate=p),
            revolute("E", crank, rod, at=(a, 0, 0), to=(-1, 0, 0)),
        ]
    )
    on, other = linkage.body(rod), linkage.body(crank)
    ends = linkage.point(rod, -number(1) / 2, 0, 0), linkage.point(crank, a / 2, 0, 0)
    loads = [
        spring(*ends, k, free_length=l0, damping=c, on=on, reaction=other, name="spring"),
        Force(ground, F, 0, 0, at=linkage.point(rod, 1, 0, 0), on=on, name="push"),
    ]
    angle = asin(-0.5)
    return ClassicSystem(
        linkage.system(loads, name="Slider-crank"),
        "Lawrence Livermore National Laboratory, SUNDIALS, example idaSlCrank_dns",
        {a: 0.5, J1: 1.0, m2: 1.0, J2: 2.0, k: 1.0, c: 1.0, l0: 1.0, F: 1.0},
        {q: pi / 2, time_derivative(q): 0.0},
        guess={x: cos(angle), p: angle},
    )


_ANDREWS = {
    "m1": 0.04325,
    "m2": 0.00365,
    "m3": 0.02373,
    "m4": 0.00706,
    "m5": 0.0705,
    "m6": 0.00706,
    "m7": 0.05498,
    "xa": -0.06934,
    "ya": -0.00227,
    "xb": -0.03635,
    "yb": 0.03273,
    "xc": 0.014,
    "yc": 0.072,
    "c0": 4530.0,
    "i1": 2.194e-06,
    "i2": 4.41e-07,
    "i3": 5.255e-06,
    "i4": 5.667e-07,
    "i5": 1.169e-05,
    "i6": 5.667e-07,
    "i7": 1.912e-05,
    "d": 0.028,
    "da": 0.0115,
    "e": 0.02,
    "ea": 0.01421,
    "rr": 0.007,
    "ra": 0.00092,
    "l0": 0.07785,
    "ss": 0.035,
    "sa": 0.01874,
    "sb": 0.01043,
    "sc": 0.018,
    "sd": 0.02,
    "ta": 0.02308,
    "tb": 0.00916,
    "u": 0.04,
    "ua": 0.01228,
    "ub": 0.00449,
    "zf": 0.02,
    "zt": 0.04,
    "fa": 0.01421,
    "mom": 0.033,
}


def andrews_mechanism() -> ClassicSystem:
    """Return Andrews' squeezing mechanism: seven bodies in the plane, driven by a motor, closed by three loops.

    The crank K1 turns about O, K2 hangs on its end; its other end P is held by the triangle K3 about B, on which a
    spring pulls, by the pair K5-K4 about A and by the pair K7-K6 about A. The numbers are those of the source.

    >>> from symbody import newton_euler
    >>> newton_euler(andrews_mechanism().system)
    Equations(7 equations of motion, 6 constraints, coordinates beta, Theta, gamma, Phi, delta, Omega, epsilon)
    """
    s = {name: symbols(name) for name in _ANDREWS}
    coordinates = functions_of_time("beta Theta gamma Phi delta Omega epsilon")
    beta, Theta, gamma, Phi, delta, Omega, epsilon = coordinates
    centers = {
        1: (s["ra"], 0, 0),
        2: (-s["da"], 0, 0),
        3: (s["sb"], -s["sa"], 0),
        4: (0, s["ea"] - s["e"], 0),
        5: (s["ta"], s["tb"], 0),
        6: (s["zf"] - s["fa"], 0, 0),
        7: (-s["ub"], -s["ua"], 0),
    }
    K = {k: Link(f"K{k}", s[f"m{k}"], Iz=s[f"i{k}"], center=center) for k, center in centers.items()}
    A, B = ((s[f"x{n}"], s[f"y{n}"], 0) for n in "ab")
    P = (-s["d"], 0, 0)
    linkage = assemble(
        [
            revolute("O", ground, K[1], coordinate=beta),
            revolute("F", K[1], K[2], at=(s["rr"], 0, 0), coordinate=Theta),
            revolute("B", ground, K[3], at=B, coordinate=gamma),
            revolute("H", K[5], K[4], at=(s["zt"], 0, 0), coordinate=Phi),
            revolute("A5", ground, K[5], at=A, coordinate=delta),
            revolute("G", K[7], K[6], at=(0, -s["u"], 0), coordinate=Omega),
            revolute("A7", ground, K[7], at=A, coordinate=epsilon),
            revolute("P3", K[3], K[2], at=(0, -s["ss"], 0), to=P),
            revolute("P4", K[4], K[2], at=(0, -s["e"], 0), to=P),
            revolute("P6", K[6], K[2], at=(s["zf"], 0, 0), to=P),
        ]
    )
    D, C = linkage.point(K[3], s["sd"], -s["sc"], 0), Point(ground, s["xc"], s["yc"], 0)
    pull = spring(D, C, s["c0"], free_length=s["l0"], on=linkage.body(K[3]), name="spring")
    drive = Torque(ground, 0, 0, s["mom"], on=linkage.body(K[1]), name="motor")
    start = (
        *(-0.06171389001427645, 0.0, 0.45527981916307037, 0.22266839016588588),
        *(0.48736497954384256, -0.22266839016588588, 1.2305474445498212),
    )
    return ClassicSystem(
        linkage.system([pull, drive], name="Andrews' squeezing mechanism"),
        "Hairer & Wanner, Solving Ordinary Differential Equations II, Springer 1996, sec. VII.7",
        {s[name]: value for name, value in _ANDREWS.items()},
        {coordinates[0]: start[0], time_derivative(coordinates[0]): 0.0},
        guess=dict(zip(coordinates[1:], start[1:], strict=True)),
    )


def bricard_mechanism() -> ClassicSystem:
    """Return Bricard's mechanism: five bars on the edges of a cube, hinged across them; the sixth edge is the ground.

    It is overconstrained: five conditions close it, and one of them follows from the others. It is left out here. The
    numbers are those of the source.

    >>> len(bricard_mechanism().system.constraints)
    4
    """
    m, l, g = symbols("m l g")
    angles = functions_of_time("q1 q2 q3 q4 q5")
    bar, end, bodies = ground, ground, []
    for k, (axis, angle, edge) in enumerate(zip("YZXYZ", angles, _EDGES, strict=True), start=1):
        bar = end * rotate(axis, angle)
        inertia = [m * l**2 / 12 * (1 - abs(part)) for part in edge]
        bodies.append(Body(bar * translate(*(l * part / 2 for part in edge)), m, *inertia, name=f"bar {k}"))
        end = bar * translate(*(l * part for part in edge))
    gap = project(Point(end, 0, 0, 0) - Point(ground, 0, 0, l), ground).components
    (*_, across) = project(Vector(bar, 1, 0, 0), ground).components
    closing = [
        *(
            Constraint(each, f"the end meets the ground along {axis}")
            for axis, each in zip("xyz", gap, strict=True)
        ),
        Constraint(across, "the last hinge is level"),
    ]
    return ClassicSystem(
        System(bodies, (), angles, closing, Vector(ground, 0, -g, 0), name="Bricard's mechanism"),
        "Gonzalez, Dopico, Lugris & Cuadrado, A benchmarking system for MBS simulation software, Multibody System"
        " Dynamics 16 (2006), p. 179",
        {m: 1.0, l: 1.0, g: 9.81},
        {angles[0]: 0.0},
    )


_EDGES = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0))
