"""Pendulums, tops and beads."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
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

m, m1, m2, M, l, l1, l2, g = symbols("m m1 m2 M l l1 l2 g")
theta, phi, psi, theta1, theta2, phi1, phi2, x, r = functions_of_time(
    "theta phi psi theta1 theta2 phi1 phi2 x r"
)
DOWN = Vector(ground, 0, -g, 0)


def double_pendulum() -> System:
    first = rotate("Z", phi1) * translate(0, -l1, 0)
    second = first * rotate("Z", phi2 - phi1) * translate(0, -l2, 0)
    return System([Body(first, m1), Body(second, m2)], coordinates=[phi1, phi2], gravity=DOWN)


def double_pendulum_of_rods() -> System:
    inertia = m * l**2 / 12
    first = rotate("Z", theta1)
    second = first * translate(0, -l, 0) * rotate("Z", theta2 - theta1)
    rods = [Body(Point(frame, 0, -l / 2, 0), m, Iz=inertia) for frame in (first, second)]
    return System(rods, coordinates=[theta1, theta2], gravity=DOWN)


def spherical_pendulum() -> System:
    bob = rotate("Z", phi) * rotate("Y", theta) * translate(0, 0, l)
    return System([Body(bob, m)], coordinates=[theta, phi], gravity=Vector(ground, 0, 0, g))


def elastic_pendulum() -> System:
    l0, k = symbols("l0 k")
    rod = rotate("Z", theta)
    bob = Body(rod * translate(0, -l0 - x, 0), m)
    spring = Force(rod, 0, k * x, 0, at=bob.center_of_mass, on=bob)
    return System([bob], [spring], [x, theta], gravity=DOWN)


def kapitza_pendulum() -> System:
    a, gamma = symbols("a gamma")
    bob = translate(0, -a * cos(gamma * t), 0) * rotate("Z", phi) * translate(0, -l, 0)
    return System([Body(bob, m)], coordinates=[phi], gravity=DOWN)


def pendulum_on_a_circle() -> System:
    a, gamma = symbols("a gamma")
    support = translate(a * cos(gamma * t), a * sin(gamma * t), 0)
    bob = support * rotate("Z", phi) * translate(0, -l, 0)
    return System([Body(bob, m)], coordinates=[phi], gravity=DOWN)


def bead_on_a_hoop() -> System:
    R, omega = symbols("R omega")
    bead = rotate("Z", omega * t) * rotate("Y", theta) * translate(0, 0, -R)
    return System([Body(bead, m)], coordinates=[theta], gravity=Vector(ground, 0, 0, -g))


def heavy_top() -> System:
    I1, I3, mu = symbols("I1 I3 mu")
    top = rotate("Z", phi) * rotate("X", theta) * rotate("Z", psi)
    body = Body(Point(top, 0, 0, l), mu, I1, I1, I3)
    return System([body], coordinates=[theta, phi, psi], gravity=Vector(ground, 0, 0, -g))


def swinging_atwood_machine() -> System:
    """The counterweight M rises by the length r of the swinging part."""
    weight = Body(translate(0, r, 0), M)
    bob = Body(rotate("Z", theta) * translate(0, -r, 0), m)
    return System([weight, bob], coordinates=[r, theta], gravity=DOWN)


def pendulum_on_a_cart() -> System:
    cart = translate(x, 0, 0)
    bob = cart * rotate("Z", phi) * translate(0, -l, 0)
    return System([Body(cart, m1), Body(bob, m2)], coordinates=[x, phi], gravity=DOWN)


PENDULUMS = (
    Classic(
        "Double pendulum of two point masses",
        "Landau & Lifshitz, Mechanics, 1976, sec. 5, problem 1 (the Lagrangian)",
        double_pendulum,
        (
            (
                "(m1 + m2)*l1**2*phi1'' + m2*l1*l2*cos(phi1 - phi2)*phi2'' + m2*l1*l2*sin(phi1 - phi2)*phi2'**2"
                " + (m1 + m2)*g*l1*sin(phi1) = 0"
            ),
            (
                "m2*l1*l2*cos(phi1 - phi2)*phi1'' + m2*l2**2*phi2'' - m2*l1*l2*sin(phi1 - phi2)*phi1'**2"
                " + m2*g*l2*sin(phi2) = 0"
            ),
        ),
    ),
    Classic(
        "Double pendulum of two equal rods",
        "Wikipedia, Double pendulum (the Lagrangian)",
        double_pendulum_of_rods,
        (
            (
                "4/3*m*l**2*theta1'' + 1/2*m*l**2*cos(theta1 - theta2)*theta2''"
                " + 1/2*m*l**2*sin(theta1 - theta2)*theta2'**2 + 3/2*m*g*l*sin(theta1) = 0"
            ),
            (
                "1/2*m*l**2*cos(theta1 - theta2)*theta1'' + 1/3*m*l**2*theta2''"
                " - 1/2*m*l**2*sin(theta1 - theta2)*theta1'**2 + 1/2*m*g*l*sin(theta2) = 0"
            ),
        ),
    ),
    Classic(
        "Spherical pendulum",
        "Landau & Lifshitz, Mechanics, 1976, sec. 14, problem 1 (the Lagrangian)",
        spherical_pendulum,
        (
            "m*l**2*theta'' - m*l**2*sin(theta)*cos(theta)*phi'**2 + m*g*l*sin(theta) = 0",
            "m*l**2*sin(theta)**2*phi'' + 2*m*l**2*sin(theta)*cos(theta)*theta'*phi' = 0",
        ),
    ),
    Classic(
        "Elastic pendulum",
        "Wikipedia, Elastic pendulum (the Lagrangian)",
        elastic_pendulum,
        (
            "m*x'' - m*(l0 + x)*theta'**2 + k*x - g*m*cos(theta) = 0",
            "m*(l0 + x)**2*theta'' + 2*m*(l0 + x)*x'*theta' + m*g*(l0 + x)*sin(theta) = 0",
        ),
    ),
    Classic(
        "Kapitza's pendulum",
        "Landau & Lifshitz, Mechanics, 1976, sec. 5, problem 3 c (the Lagrangian)",
        kapitza_pendulum,
        ("m*l**2*phi'' + m*l*a*gamma**2*cos(gamma*t)*sin(phi) + m*g*l*sin(phi) = 0",),
    ),
    Classic(
        "Pendulum whose support moves along a circle",
        "Landau & Lifshitz, Mechanics, 1976, sec. 5, problem 3 a (the Lagrangian)",
        pendulum_on_a_circle,
        ("m*l**2*phi'' - m*l*a*gamma**2*cos(phi - gamma*t) + m*g*l*sin(phi) = 0",),
    ),
    Classic(
        "Bead on a rotating hoop",
        "Taylor, Classical Mechanics, 2005, sec. 7.5, example 7.6",
        bead_on_a_hoop,
        ("m*R**2*theta'' - m*R**2*omega**2*sin(theta)*cos(theta) + m*g*R*sin(theta) = 0",),
    ),
    Classic(
        "Heavy symmetric top",
        "Landau & Lifshitz, Mechanics, 1976, sec. 35, problem 1 (the Lagrangian)",
        heavy_top,
        (
            (
                "(I1 + mu*l**2)*theta'' - (I1 + mu*l**2 - I3)*sin(theta)*cos(theta)*phi'**2"
                " + I3*sin(theta)*phi'*psi' - mu*g*l*sin(theta) = 0"
            ),
            (
                "((I1 + mu*l**2)*sin(theta)**2 + I3*cos(theta)**2)*phi'' + I3*cos(theta)*psi''"
                " + 2*(I1 + mu*l**2 - I3)*sin(theta)*cos(theta)*theta'*phi' - I3*sin(theta)*theta'*psi' = 0"
            ),
            "I3*cos(theta)*phi'' + I3*psi'' - I3*sin(theta)*theta'*phi' = 0",
        ),
    ),
    Classic(
        "Atwood's machine with a swinging mass",
        "Tufillaro, Abbott & Griffiths, Am. J. Phys. 52 (1984), p. 895",
        swinging_atwood_machine,
        (
            "(M + m)*r'' - m*r*theta'**2 + g*(M - m*cos(theta)) = 0",
            "m*r**2*theta'' + 2*m*r*r'*theta' + m*g*r*sin(theta) = 0",
        ),
    ),
    Classic(
        "Pendulum whose support slides",
        "Landau & Lifshitz, Mechanics, 1976, sec. 5, problem 2 (the Lagrangian)",
        pendulum_on_a_cart,
        (
            "(m1 + m2)*x'' + m2*l*cos(phi)*phi'' - m2*l*sin(phi)*phi'**2 = 0",
            "m2*l*cos(phi)*x'' + m2*l**2*phi'' + m2*g*l*sin(phi) = 0",
        ),
    ),
)
