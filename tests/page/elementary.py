"""Bodies on slopes, wires, walls and springs, in tubes, and on shafts."""

from __future__ import annotations

from symbody import (
    Body,
    Expr,
    Force,
    Point,
    System,
    Torque,
    Vector,
    cos,
    functions_of_time,
    ground,
    origin,
    rotate,
    sin,
    spring,
    symbols,
    t,
    translate,
)

from .classic import Classic

m, m1, m2, m3, M, g, k, l, R, r, W, T = symbols("m m1 m2 m3 M g k l R r W T")
k1, k2, k3, k4, J1, J2, J3 = symbols("k1 k2 k3 k4 J1 J2 J3")
DOWN = Vector(ground, 0, -g, 0)


def cylinder_in_cylinder() -> System:
    """A cylinder that rolls in a hollow one."""
    eta = functions_of_time("eta")
    frame = rotate("Z", eta) * translate(0, -(R - r), 0) * rotate("Z", -R * eta / r)
    return System([Body(frame, m, Iz=m * r**2 / 2)], coordinates=[eta], gravity=DOWN)


def hoop_on_wedge() -> System:
    """A hoop that rolls down a wedge, which slides."""
    (x, u), alpha = functions_of_time("X u"), symbols("alpha")
    wedge = Body(translate(x, 0, 0), M)
    frame = translate(x, 0, 0) * rotate("Z", -alpha) * translate(u, r, 0) * rotate("Z", -u / r)
    return System([wedge, Body(frame, m, Iz=m * r**2)], coordinates=[x, u], gravity=DOWN)


def bar_on_springs() -> System:
    """A bar on two springs, for small angles in their forces."""
    (y, beta), (l1, l2, J) = functions_of_time("y beta"), symbols("l1 l2 J")
    frame = translate(0, y, 0) * rotate("Z", beta)
    bar = Body(frame, m, Iz=J)
    ends = [(k1, -l1), (k2, l2)]
    forces = [Force(ground, 0, -c * (y + s * beta), 0, at=Point(frame, s, 0, 0), on=bar) for c, s in ends]
    return System([bar], forces, [y, beta])


def chain_of_masses() -> System:
    """Three masses between two walls, with four springs."""
    x1, x2, x3 = places = functions_of_time("x1 x2 x3")
    bodies = [Body(translate(x, 0, 0), mass) for x, mass in zip(places, (m1, m2, m3), strict=True)]
    extensions = [(k1, x1, 0, None), (k2, x2 - x1, 1, 0), (k3, x3 - x2, 2, 1), (k4, x3, 2, None)]
    forces = [
        Force(
            ground,
            -c * e,
            0,
            0,
            at=bodies[i].center_of_mass,
            on=bodies[i],
            reaction=None if j is None else bodies[j],
        )
        for c, e, i, j in extensions
    ]
    return System(bodies, forces, places)


def ladder() -> System:
    """A rod that slides down a wall and away from it."""
    angle = functions_of_time("vartheta")
    frame = translate(l / 2 * sin(angle), l / 2 * cos(angle), 0) * rotate("Z", angle)
    return System([Body(frame, m, Iz=m * l**2 / 12)], coordinates=[angle], gravity=DOWN)


def bead_on_parabola() -> System:
    """A bead on a parabolic wire that rotates about its axis."""
    q, a = functions_of_time("q"), symbols("a")
    bead = Body(rotate("Z", W * t) * translate(q, 0, a * q**2), m)
    return System([bead], coordinates=[q], gravity=Vector(ground, 0, 0, -g))


def shaft() -> System:
    """Three discs on an elastic shaft."""
    p1, p2, p3 = angles = functions_of_time("p1 p2 p3")
    discs = [Body(rotate("Z", p), 0, Iz=inertia) for p, inertia in zip(angles, (J1, J2, J3), strict=True)]

    def torsion(stiffness: Expr, angle: Expr, on: Body, reaction: Body) -> Torque:
        return Torque(ground, 0, 0, -stiffness * angle, on=on, reaction=reaction)

    loads = [torsion(k1, p2 - p1, discs[1], discs[0]), torsion(k2, p3 - p2, discs[2], discs[1])]
    return System(discs, [*loads, Torque(ground, 0, 0, T, on=discs[0])], angles)


def particle_in_tube() -> System:
    """A particle that slides in a tube, which a motor turns."""
    (sigma, h), inertia = functions_of_time("sigma h"), symbols("I")
    tube = Body(rotate("Z", sigma), 0, Iz=inertia)
    particle = Body(rotate("Z", sigma) * translate(h, 0, 0), m)
    return System([tube, particle], [Torque(ground, 0, 0, T, on=tube)], [sigma, h])


def rotor_on_turntable() -> System:
    """A spinning rotor whose axis tilts on a turntable of given speed."""
    (lean, spin), (A, C) = functions_of_time("lean spin"), symbols("A C")
    rotor = Body(rotate("Z", W * t) * rotate("X", lean) * rotate("Z", spin), 0, A, A, C)
    return System([rotor], coordinates=[lean, spin])


def elastic_pendulum_by_places() -> System:
    """A mass on a spring, by its Cartesian coordinates."""
    (xi, zeta), L = functions_of_time("xi zeta"), symbols("L")
    bob = Body(translate(xi, zeta, 0), m)
    rope = spring(bob.center_of_mass, origin(ground), k, free_length=L, on=bob)
    return System([bob], [rope], [xi, zeta], gravity=DOWN)


ELEMENTARY: tuple[Classic, ...] = (
    Classic(
        "Cylinder that rolls in a hollow one",
        "standard form",
        cylinder_in_cylinder,
        ("3/2*m*(R - r)**2*eta'' + m*g*(R - r)*sin(eta) = 0",),
    ),
    Classic(
        "Hoop that rolls down a sliding wedge",
        "standard form",
        hoop_on_wedge,
        ("(M + m)*X'' + m*cos(alpha)*u'' = 0", "m*cos(alpha)*X'' + 2*m*u'' - m*g*sin(alpha) = 0"),
    ),
    Classic(
        "Bar on two springs",
        "standard form",
        bar_on_springs,
        (
            "m*y'' + (k1 + k2)*y + (k2*l2 - k1*l1)*beta = 0",
            "J*beta'' + (k2*l2 - k1*l1)*cos(beta)*y + (k1*l1**2 + k2*l2**2)*beta*cos(beta) = 0",
        ),
    ),
    Classic(
        "Three masses between two walls",
        "standard form",
        chain_of_masses,
        (
            "m1*x1'' + k1*x1 + k2*(x1 - x2) = 0",
            "m2*x2'' + k2*(x2 - x1) + k3*(x2 - x3) = 0",
            "m3*x3'' + k3*(x3 - x2) + k4*x3 = 0",
        ),
    ),
    Classic(
        "Ladder that slides down a wall",
        "standard form",
        ladder,
        ("1/3*m*l**2*vartheta'' - 1/2*m*g*l*sin(vartheta) = 0",),
    ),
    Classic(
        "Bead on a rotating parabola",
        "standard form",
        bead_on_parabola,
        ("m*(1 + 4*a**2*q**2)*q'' + 4*m*a**2*q*q'**2 + (2*m*g*a - m*W**2)*q = 0",),
    ),
    Classic(
        "Three discs on an elastic shaft",
        "standard form",
        shaft,
        (
            "J1*p1'' + k1*(p1 - p2) = T",
            "J2*p2'' + k1*(p2 - p1) + k2*(p2 - p3) = 0",
            "J3*p3'' + k2*(p3 - p2) = 0",
        ),
    ),
    Classic(
        "Particle in a turning tube",
        "standard form",
        particle_in_tube,
        ("(I + m*h**2)*sigma'' + 2*m*h*h'*sigma' = T", "m*h'' - m*h*sigma'**2 = 0"),
    ),
    Classic(
        "Rotor on a turntable",
        "standard form",
        rotor_on_turntable,
        (
            "A*lean'' - (A - C)*W**2*sin(lean)*cos(lean) + C*W*sin(lean)*spin' = 0",
            "C*spin'' - C*W*sin(lean)*lean' = 0",
        ),
    ),
    Classic(
        "Elastic pendulum by Cartesian coordinates",
        "standard form",
        elastic_pendulum_by_places,
        (
            "m*xi'' + k*xi*(1 - L/sqrt(xi**2 + zeta**2)) = 0",
            "m*zeta'' + m*g + k*zeta*(1 - L/sqrt(xi**2 + zeta**2)) = 0",
        ),
    ),
)
