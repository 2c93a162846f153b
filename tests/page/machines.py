"""Oscillators with springs, pulleys, wedges, governors, and legs."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
    Torque,
    Vector,
    cos,
    functions_of_time,
    ground,
    rotate,
    sin,
    symbols,
    t,
    translate,
)

from .classic import Classic

m, m1, m2, m3, M, g, k, k1, k2, l, a, b, I = symbols("m m1 m2 m3 M g k k1 k2 l a b I")
theta, theta1, theta2, x, y, z = functions_of_time("theta theta1 theta2 x y z")
DOWN = Vector(ground, 0, -g, 0)


def wilberforce_pendulum() -> System:
    """A mass on a helical spring, which turns as it is drawn."""
    delta, epsilon = symbols("delta epsilon")
    bob = Body(translate(0, 0, z) * rotate("Z", theta), m, Iz=I)
    pull = Force(ground, 0, 0, -k * z - epsilon * theta / 2, at=bob.center_of_mass, on=bob)
    twist = Torque(ground, 0, 0, -delta * theta - epsilon * z / 2, on=bob)
    return System([bob], [pull, twist], [z, theta])


def coupled_pendulums() -> System:
    """Two pendulums, whose rods a spring joins at the depth d."""
    d = symbols("d")
    frames = [rotate("Z", theta1), translate(a, 0, 0) * rotate("Z", theta2)]
    bobs = [Body(frame * translate(0, -l, 0), m) for frame in frames]
    pull = k * d * (sin(theta1) - sin(theta2))
    ends = [Point(frame, 0, -d, 0) for frame in frames]
    forces = [
        Force(ground, sign * pull, 0, 0, at=end, on=bob)
        for sign, end, bob in zip((-1, 1), ends, bobs, strict=True)
    ]
    return System(bobs, forces, [theta1, theta2], gravity=DOWN)


def vibration_absorber() -> System:
    """A machine on a spring, and a small mass on a spring and a damper on top of it."""
    c2, f = symbols("c2"), functions_of_time("f")
    x1, x2 = functions_of_time("x1 x2")
    machine, absorber = Body(translate(x1, 0, 0), m1), Body(translate(x2, 0, 0), m2)
    between = k2 * (x1 - x2) + c2 * (x1 - x2).diff(t)
    forces = [
        Force(ground, f - k1 * x1 - between, 0, 0, at=machine.center_of_mass, on=machine),
        Force(ground, between, 0, 0, at=absorber.center_of_mass, on=absorber),
    ]
    return System([machine, absorber], forces, [x1, x2])


def double_atwood_machine() -> System:
    """A mass hangs on a rope opposite to a pulley, over which two others hang."""
    heights = (-x, x - y, x + y)
    bodies = [Body(translate(0, height, 0), mass) for height, mass in zip(heights, (m1, m2, m3), strict=True)]
    return System(bodies, coordinates=[x, y], gravity=DOWN)


def block_on_wedge() -> System:
    """A block slides down a wedge, which slides along a table."""
    alpha, s = symbols("alpha"), functions_of_time("s")
    wedge = Body(translate(x, 0, 0), M)
    block = Body(wedge.frame * rotate("Z", -alpha) * translate(s, 0, 0), m)
    return System([wedge, block], coordinates=[x, s], gravity=DOWN)


def governor() -> System:
    """Two balls on four rods turn about a vertical axis, along which a third mass slides."""
    Omega = symbols("Omega")
    spindle = rotate("Y", Omega * t)
    balls = [Body(spindle * rotate("Z", side * theta) * translate(0, -a, 0), m1) for side in (1, -1)]
    sleeve = Body(translate(0, -2 * a * cos(theta), 0), m2)
    return System([*balls, sleeve], coordinates=[theta], gravity=DOWN)


def compass_gait() -> System:
    """Two straight legs with point masses, and a hip: one leg stands, the other swings."""
    mH = symbols("mH")
    stance = rotate("Z", -theta1)
    hip = stance * translate(0, l, 0)
    swing = hip * rotate("Z", theta1 - theta2)
    bodies = [Body(stance * translate(0, a, 0), m), Body(hip, mH), Body(swing * translate(0, -b, 0), m)]
    return System(bodies, coordinates=[theta1, theta2], gravity=DOWN)


def spring_leg() -> System:
    """A mass on a spring that stands on the ground."""
    r, r0 = functions_of_time("r"), symbols("r0")
    leg = rotate("Z", -theta)
    body = Body(leg * translate(0, r, 0), m)
    spring = Force(leg, 0, -k * (r - r0), 0, at=body.center_of_mass, on=body)
    return System([body], [spring], [r, theta], gravity=DOWN)


MACHINES = (
    Classic(
        "Wilberforce's pendulum",
        "Berg & Marshall, Wilberforce pendulum oscillations and normal modes, Am. J. Phys. 59 (1991), p. 32",
        wilberforce_pendulum,
        ("m*z'' + k*z + 1/2*epsilon*theta = 0", "I*theta'' + delta*theta + 1/2*epsilon*z = 0"),
    ),
    Classic(
        "Two pendulums that a spring joins",
        "standard form",
        coupled_pendulums,
        (
            "m*l**2*theta1'' + m*g*l*sin(theta1) + k*d**2*(sin(theta1) - sin(theta2))*cos(theta1) = 0",
            "m*l**2*theta2'' + m*g*l*sin(theta2) - k*d**2*(sin(theta1) - sin(theta2))*cos(theta2) = 0",
        ),
    ),
    Classic(
        "Vibration absorber",
        "standard form",
        vibration_absorber,
        (
            "m1*x1'' + k1*x1 + k2*(x1 - x2) + c2*(x1' - x2') = f",
            "m2*x2'' + k2*(x2 - x1) + c2*(x2' - x1') = 0",
        ),
    ),
    Classic(
        "Double Atwood machine",
        "standard form",
        double_atwood_machine,
        (
            "m1*x'' + m2*(x'' - y'') + m3*(x'' + y'') = (m1 - m2 - m3)*g",
            "m3*(x'' + y'') - m2*(x'' - y'') = (m2 - m3)*g",
        ),
    ),
    Classic(
        "Block on a wedge that slides",
        "Taylor, Classical Mechanics, 2005, sec. 7.5, example 7.5",
        block_on_wedge,
        ("(M + m)*x'' + m*cos(alpha)*s'' = 0", "m*cos(alpha)*x'' + m*s'' = m*g*sin(alpha)"),
    ),
    Classic(
        "Governor at a given speed",
        "Landau & Lifshitz, Mechanics, 1976, sec. 5, problem 4 (the Lagrangian)",
        governor,
        (
            (
                "2*(m1 + 2*m2*sin(theta)**2)*a**2*theta'' + 4*m2*a**2*sin(theta)*cos(theta)*theta'**2"
                " - 2*m1*a**2*Omega**2*sin(theta)*cos(theta) + 2*(m1 + m2)*g*a*sin(theta) = 0"
            ),
        ),
    ),
    Classic(
        "Biped with compass gait",
        "standard form",
        compass_gait,
        (
            (
                "((mH + m)*l**2 + m*a**2)*theta1'' - m*l*b*cos(theta1 - theta2)*theta2''"
                " - m*l*b*sin(theta1 - theta2)*theta2'**2 - (mH*l + m*a + m*l)*g*sin(theta1) = 0"
            ),
            (
                "m*b**2*theta2'' - m*l*b*cos(theta1 - theta2)*theta1''"
                " + m*l*b*sin(theta1 - theta2)*theta1'**2 + m*b*g*sin(theta2) = 0"
            ),
        ),
    ),
    Classic(
        "Leg of a spring",
        "standard form",
        spring_leg,
        (
            "m*r'' - m*r*theta'**2 + k*(r - r0) + m*g*cos(theta) = 0",
            "m*r**2*theta'' + 2*m*r*r'*theta' - m*g*r*sin(theta) = 0",
        ),
    ),
)
