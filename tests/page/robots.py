"""Robot arms and flying robots."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Point,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    rotate,
    symbols,
    translate,
)

from .classic import Classic

m, m1, m2, m3, m4, l, l1, l2, g, I, I1, I2, r = symbols("m m1 m2 m3 m4 l l1 l2 g I I1 I2 r")
lc1, lc2, lc3, I3 = symbols("lc1 lc2 lc3 I3")
q1, q2, q3, theta, theta1, theta2, theta3, theta4, x, y, z = functions_of_time(
    "q1 q2 q3 theta theta1 theta2 theta3 theta4 x y z"
)
tau, tau1, tau2, u1, u2 = functions_of_time("tau tau1 tau2 u1 u2")
DOWN = Vector(ground, 0, -g, 0)


def acrobot() -> System:
    first = rotate("Z", q1)
    second = first * translate(l1, 0, 0) * rotate("Z", q2)
    links = Body(Point(first, lc1, 0, 0), m1, Iz=I1), Body(Point(second, lc2, 0, 0), m2, Iz=I2)
    motor = Torque(ground, 0, 0, tau, on=links[1], reaction=links[0])
    return System(links, [motor], [q1, q2], gravity=DOWN)


def two_link_arm() -> System:
    first = rotate("Z", theta1) * translate(l1, 0, 0)
    second = first * rotate("Z", theta2) * translate(l2, 0, 0)
    links = Body(first, m1), Body(second, m2)
    motors = [
        Torque(ground, 0, 0, tau1, on=links[0]),
        Torque(ground, 0, 0, tau2, on=links[1], reaction=links[0]),
    ]
    return System(links, motors, [theta1, theta2], gravity=DOWN)


def three_link_arm() -> System:
    first = rotate("Z", q1)
    second = first * translate(l1, 0, 0) * rotate("Z", q2)
    third = second * translate(l2, 0, 0) * rotate("Z", q3)
    return System(
        [
            Body(Point(first, lc1, 0, 0), m1, Iz=I1),
            Body(Point(second, lc2, 0, 0), m2, Iz=I2),
            Body(Point(third, lc3, 0, 0), m3, Iz=I3),
        ],
        coordinates=[q1, q2, q3],
        gravity=DOWN,
    )


def scara() -> System:
    r1, r2, I4 = symbols("r1 r2 I4")
    first = rotate("Z", theta1)
    second = first * translate(0, l1, 0) * rotate("Z", theta2)
    third = second * translate(0, l2, 0) * rotate("Z", theta3)
    fourth = third * translate(0, 0, theta4)
    return System(
        [
            Body(Point(first, 0, r1, 0), m1, Iz=I1),
            Body(Point(second, 0, r2, 0), m2, Iz=I2),
            Body(third, m3, Iz=I3),
            Body(fourth, m4, Iz=I4),
        ],
        coordinates=[theta1, theta2, theta3, theta4],
        gravity=Vector(ground, 0, 0, -g),
    )


def planar_quadrotor() -> System:
    frame = translate(x, y, 0) * rotate("Z", theta)
    body = Body(frame, m, Iz=I)
    rotors = [
        Force(frame, 0, u1, 0, at=Point(frame, r, 0, 0), on=body),
        Force(frame, 0, u2, 0, at=Point(frame, -r, 0, 0), on=body),
    ]
    return System([body], rotors, [x, y, theta], gravity=DOWN)


def planar_quadrotor_with_a_load() -> System:
    """A load on a rope whose angle phi is that from the vertical."""
    M, phi, f = symbols("M"), *functions_of_time("phi f")
    frame = translate(x, y, 0) * rotate("Z", theta)
    body = Body(frame, M, Iz=I)
    load = Body(translate(x, y, 0) * rotate("Z", phi) * translate(0, -l, 0), m)
    thrust = Force(frame, 0, f, 0, at=body.center_of_mass, on=body)
    moment = Torque(ground, 0, 0, tau, on=body)
    return System([body, load], [thrust, moment], [x, y, theta, phi], gravity=DOWN)


def polar_arm() -> System:
    """A link that turns and a mass that slides along it."""
    d, f = functions_of_time("d f")
    link, slider = Body(Point(rotate("Z", theta), lc1, 0, 0), m1, Iz=I1), None
    slider = Body(link.frame * translate(d - lc1, 0, 0), m2, Iz=I2)
    motors = [
        Torque(ground, 0, 0, tau, on=link),
        Force(link.frame, f, 0, 0, at=slider.center_of_mass, on=slider, reaction=link),
    ]
    return System([link, slider], motors, [theta, d], gravity=DOWN)


_A = "I2 + I3 + I4 + m2*r2**2 + (m3 + m4)*l2**2"
_G = "(r2*m2 + l2*(m3 + m4))*l1"

ROBOTS = (
    Classic(
        "Acrobot",
        "Spong, IEEE Control Systems Magazine 15 (1995), p. 49, with the abbreviations put in",
        acrobot,
        (
            (
                "(m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2)) + I1 + I2)*q1''"
                " + (m2*(lc2**2 + l1*lc2*cos(q2)) + I2)*q2''"
                " - m2*l1*lc2*sin(q2)*q2'**2 - 2*m2*l1*lc2*sin(q2)*q2'*q1'"
                " + (m1*lc1 + m2*l1)*g*cos(q1) + m2*lc2*g*cos(q1 + q2) = 0"
            ),
            (
                "(m2*(lc2**2 + l1*lc2*cos(q2)) + I2)*q1'' + (m2*lc2**2 + I2)*q2''"
                " + m2*l1*lc2*sin(q2)*q1'**2 + m2*lc2*g*cos(q1 + q2) = tau"
            ),
        ),
    ),
    Classic(
        "Planar arm of two links with point masses",
        "Craig, Introduction to Robotics, 2005, sec. 6.7",
        two_link_arm,
        (
            (
                "m2*l2**2*(theta1'' + theta2'') + m2*l1*l2*cos(theta2)*(2*theta1'' + theta2'')"
                " + (m1 + m2)*l1**2*theta1'' - m2*l1*l2*sin(theta2)*theta2'**2"
                " - 2*m2*l1*l2*sin(theta2)*theta1'*theta2' + m2*l2*g*cos(theta1 + theta2)"
                " + (m1 + m2)*l1*g*cos(theta1) = tau1"
            ),
            (
                "m2*l1*l2*cos(theta2)*theta1'' + m2*l1*l2*sin(theta2)*theta1'**2"
                " + m2*l2*g*cos(theta1 + theta2) + m2*l2**2*(theta1'' + theta2'') = tau2"
            ),
        ),
    ),
    Classic(
        "Planar arm of three links",
        "standard form: that of the Acrobot, written for three links",
        three_link_arm,
        (
            (
                "(I1 + I2 + I3 + m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2))"
                " + m3*(l1**2 + l2**2 + lc3**2 + 2*l1*l2*cos(q2) + 2*l1*lc3*cos(q2 + q3) + 2*l2*lc3*cos(q3)))*q1''"
                " + (I2 + I3 + m2*(lc2**2 + l1*lc2*cos(q2))"
                " + m3*(l2**2 + lc3**2 + l1*l2*cos(q2) + l1*lc3*cos(q2 + q3) + 2*l2*lc3*cos(q3)))*q2''"
                " + (I3 + m3*(lc3**2 + l1*lc3*cos(q2 + q3) + l2*lc3*cos(q3)))*q3''"
                " - (m2*l1*lc2*sin(q2) + m3*l1*(l2*sin(q2) + lc3*sin(q2 + q3)))*(2*q1'*q2' + q2'**2)"
                " - m3*lc3*(l1*sin(q2 + q3) + l2*sin(q3))*(2*q1'*q3' + 2*q2'*q3' + q3'**2)"
                " + (m1*lc1 + (m2 + m3)*l1)*g*cos(q1) + (m2*lc2 + m3*l2)*g*cos(q1 + q2)"
                " + m3*lc3*g*cos(q1 + q2 + q3) = 0"
            ),
            (
                "(I2 + I3 + m2*(lc2**2 + l1*lc2*cos(q2))"
                " + m3*(l2**2 + lc3**2 + l1*l2*cos(q2) + l1*lc3*cos(q2 + q3) + 2*l2*lc3*cos(q3)))*q1''"
                " + (I2 + I3 + m2*lc2**2 + m3*(l2**2 + lc3**2 + 2*l2*lc3*cos(q3)))*q2''"
                " + (I3 + m3*(lc3**2 + l2*lc3*cos(q3)))*q3''"
                " + (m2*l1*lc2*sin(q2) + m3*l1*(l2*sin(q2) + lc3*sin(q2 + q3)))*q1'**2"
                " - m3*l2*lc3*sin(q3)*(2*q1'*q3' + 2*q2'*q3' + q3'**2)"
                " + (m2*lc2 + m3*l2)*g*cos(q1 + q2) + m3*lc3*g*cos(q1 + q2 + q3) = 0"
            ),
            (
                "(I3 + m3*(lc3**2 + l1*lc3*cos(q2 + q3) + l2*lc3*cos(q3)))*q1''"
                " + (I3 + m3*(lc3**2 + l2*lc3*cos(q3)))*q2'' + (I3 + m3*lc3**2)*q3''"
                " + m3*lc3*(l1*sin(q2 + q3) + l2*sin(q3))*q1'**2"
                " + m3*l2*lc3*sin(q3)*(2*q1'*q2' + q2'**2) + m3*lc3*g*cos(q1 + q2 + q3) = 0"
            ),
        ),
    ),
    Classic(
        "SCARA manipulator",
        "Murray, Li & Sastry, A Mathematical Introduction to Robotic Manipulation, 1994, ch. 4,"
        " with the abbreviations put in",
        scara,
        (
            (
                f"(I1 + {_A} + m1*r1**2 + (m2 + m3 + m4)*l1**2 + 2*{_G}*cos(theta2))*theta1''"
                f" + ({_A} + {_G}*cos(theta2))*theta2'' + (I3 + I4)*theta3''"
                f" - {_G}*sin(theta2)*(2*theta1'*theta2' + theta2'**2) = 0"
            ),
            (
                f"({_A} + {_G}*cos(theta2))*theta1'' + ({_A})*theta2'' + (I3 + I4)*theta3''"
                f" + {_G}*sin(theta2)*theta1'**2 = 0"
            ),
            "(I3 + I4)*theta1'' + (I3 + I4)*theta2'' + (I3 + I4)*theta3'' = 0",
            "m4*theta4'' + m4*g = 0",
        ),
    ),
    Classic(
        "Planar quadrotor",
        "Tedrake, Underactuated Robotics, 2023, ch. 3",
        planar_quadrotor,
        (
            "m*x'' = -(u1 + u2)*sin(theta)",
            "m*y'' = (u1 + u2)*cos(theta) - m*g",
            "I*theta'' = r*(u1 - u2)",
        ),
    ),
    Classic(
        "Planar quadrotor with a slung load",
        "standard form: the cart with a pole, with two directions of the support",
        planar_quadrotor_with_a_load,
        (
            "(M + m)*x'' + m*l*cos(phi)*phi'' - m*l*sin(phi)*phi'**2 = -f*sin(theta)",
            "(M + m)*y'' + m*l*sin(phi)*phi'' + m*l*cos(phi)*phi'**2 + (M + m)*g = f*cos(theta)",
            "I*theta'' = tau",
            "m*l*cos(phi)*x'' + m*l*sin(phi)*y'' + m*l**2*phi'' + m*g*l*sin(phi) = 0",
        ),
    ),
    Classic(
        "Polar arm of a link and a slider",
        "Craig, Introduction to Robotics, 2005, sec. 6.8 (the RP manipulator)",
        polar_arm,
        (
            "(m1*lc1**2 + I1 + I2 + m2*d**2)*theta'' + 2*m2*d*theta'*d' + (m1*lc1 + m2*d)*g*cos(theta) = tau",
            "m2*d'' - m2*d*theta'**2 + m2*g*sin(theta) = f",
        ),
    ),
)
