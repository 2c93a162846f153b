"""Gyroscopes, legs of platforms and closed chains."""

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
    models,
    rotate,
    sin,
    symbols,
    translate,
)

from .classic import Classic

m1, m2, m3, m4, l1, l2, l3, l4 = symbols("m1 m2 m3 m4 l1 l2 l3 l4")
lc1, lc2, lc3, lc4, I1, I2, I3, I4, g = symbols("lc1 lc2 lc3 lc4 I1 I2 I3 I4 g")
q1, q2, q3, q4, psi, theta, phi, alpha, beta, L = functions_of_time("q1 q2 q3 q4 psi theta phi alpha beta L")


def stewart_leg() -> System:
    """A leg on a universal joint: a cylinder that hangs from it, and a piston whose end is at the distance L."""
    r1, r2, f = symbols("r1"), symbols("r2"), functions_of_time("f")
    leg = rotate("Y", alpha) * rotate("X", beta)
    cylinder = Body(Point(leg, 0, 0, r1), m1, I1, I1)
    piston = Body(Point(leg, 0, 0, L - r2), m2, I2, I2)
    drive = Force(leg, 0, 0, f, at=piston.center_of_mass, on=piston, reaction=cylinder)
    return System([cylinder, piston], [drive], [alpha, beta, L], gravity=Vector(ground, 0, 0, -g))


def parallelogram() -> System:
    """Links 1 and 2 are driven from one pivot, link 3 is parallel to link 1, and link 4 to link 2."""
    tau1, tau2 = functions_of_time("tau1 tau2")
    first, second = rotate("Z", q1), rotate("Z", q2)
    links = [
        Body(Point(first, lc1, 0, 0), m1, Iz=I1),
        Body(Point(second, lc2, 0, 0), m2, Iz=I2),
        Body(Point(second * translate(l2, 0, 0) * rotate("Z", q1 - q2), lc3, 0, 0), m3, Iz=I3),
        Body(Point(first * translate(l1, 0, 0) * rotate("Z", q2 - q1), -lc4, 0, 0), m4, Iz=I4),
    ]
    motors = [Torque(ground, 0, 0, tau1, on=links[0]), Torque(ground, 0, 0, tau2, on=links[1])]
    return System(links, motors, [q1, q2], gravity=Vector(ground, 0, -g, 0))


def five_bar() -> System:
    """Two arms of two links each on pivots with the distance d, pinned together at their ends."""
    d, tau1, tau3 = symbols("d"), *functions_of_time("tau1 tau3")
    left, right = rotate("Z", q1), translate(d, 0, 0) * rotate("Z", q3)
    links = [
        Body(Point(left, lc1, 0, 0), m1, Iz=I1),
        Body(Point(left * translate(l1, 0, 0) * rotate("Z", q2 - q1), lc2, 0, 0), m2, Iz=I2),
        Body(Point(right, lc3, 0, 0), m3, Iz=I3),
        Body(Point(right * translate(l3, 0, 0) * rotate("Z", q4 - q3), lc4, 0, 0), m4, Iz=I4),
    ]
    motors = [Torque(ground, 0, 0, tau1, on=links[0]), Torque(ground, 0, 0, tau3, on=links[2])]
    closed = [
        l1 * cos(q1) + l2 * cos(q2) - d - l3 * cos(q3) - l4 * cos(q4),
        l1 * sin(q1) + l2 * sin(q2) - l3 * sin(q3) - l4 * sin(q4),
    ]
    return System(links, motors, [q1, q2, q3, q4], closed, Vector(ground, 0, -g, 0))


_J = "(I1 + I2 + m1*r1**2 + m2*(L - r2)**2)"

SPATIAL = (
    Classic(
        "Gyroscope in gimbals",
        "Magnus, Kreisel: Theorie und Anwendungen, 1971 (the kinetic energy)",
        lambda: models.gyroscope_in_gimbals().system,
        (
            (
                "(C2 + (A + B1)*sin(theta)**2 + (C + C1)*cos(theta)**2)*psi'' + C*cos(theta)*phi''"
                " + 2*(A + B1 - C - C1)*sin(theta)*cos(theta)*psi'*theta' - C*sin(theta)*theta'*phi' = M1"
            ),
            (
                "(A + A1)*theta'' - (A + B1 - C - C1)*sin(theta)*cos(theta)*psi'**2 + C*sin(theta)*psi'*phi' = M2"
            ),
            "C*(phi'' + cos(theta)*psi'' - sin(theta)*psi'*theta') = M3",
        ),
    ),
    Classic(
        "Leg of a Stewart platform",
        "standard form: a spherical pendulum of variable length, in the angles of the universal joint",
        stewart_leg,
        (
            (
                f"{_J}*cos(beta)**2*alpha'' - 2*{_J}*sin(beta)*cos(beta)*alpha'*beta'"
                " + 2*m2*(L - r2)*cos(beta)**2*alpha'*L' - (m1*r1 + m2*(L - r2))*g*sin(alpha)*cos(beta) = 0"
            ),
            (
                f"{_J}*beta'' + {_J}*sin(beta)*cos(beta)*alpha'**2 + 2*m2*(L - r2)*beta'*L'"
                " - (m1*r1 + m2*(L - r2))*g*cos(alpha)*sin(beta) = 0"
            ),
            ("m2*L'' - m2*(L - r2)*(cos(beta)**2*alpha'**2 + beta'**2) + m2*g*cos(alpha)*cos(beta) = f"),
        ),
    ),
    Classic(
        "Five-bar linkage whose links are parallel",
        "Spong & Vidyasagar, Robot Dynamics and Control, 1989, ch. 6, with the abbreviations put in",
        parallelogram,
        (
            (
                "(m1*lc1**2 + m3*lc3**2 + m4*l1**2 + I1 + I3)*q1'' + (m3*l2*lc3 - m4*l1*lc4)*cos(q2 - q1)*q2''"
                " - (m3*l2*lc3 - m4*l1*lc4)*sin(q2 - q1)*q2'**2 + g*cos(q1)*(m1*lc1 + m3*lc3 + m4*l1) = tau1"
            ),
            (
                "(m3*l2*lc3 - m4*l1*lc4)*cos(q2 - q1)*q1'' + (m2*lc2**2 + m3*l2**2 + m4*lc4**2 + I2 + I4)*q2''"
                " + (m3*l2*lc3 - m4*l1*lc4)*sin(q2 - q1)*q1'**2 + g*cos(q2)*(m2*lc2 + m3*l2 - m4*lc4) = tau2"
            ),
        ),
    ),
    Classic(
        "Five-bar linkage",
        "standard form: two double pendulums, closed by two constraints with multipliers",
        five_bar,
        (
            (
                "(I1 + m1*lc1**2 + m2*l1**2)*q1'' + m2*l1*lc2*cos(q1 - q2)*q2''"
                " + m2*l1*lc2*sin(q1 - q2)*q2'**2 + (m1*lc1 + m2*l1)*g*cos(q1)"
                " = tau1 - l1*sin(q1)*lambda1 + l1*cos(q1)*lambda2"
            ),
            (
                "m2*l1*lc2*cos(q1 - q2)*q1'' + (I2 + m2*lc2**2)*q2'' - m2*l1*lc2*sin(q1 - q2)*q1'**2"
                " + m2*lc2*g*cos(q2) = -l2*sin(q2)*lambda1 + l2*cos(q2)*lambda2"
            ),
            (
                "(I3 + m3*lc3**2 + m4*l3**2)*q3'' + m4*l3*lc4*cos(q3 - q4)*q4''"
                " + m4*l3*lc4*sin(q3 - q4)*q4'**2 + (m3*lc3 + m4*l3)*g*cos(q3)"
                " = tau3 + l3*sin(q3)*lambda1 - l3*cos(q3)*lambda2"
            ),
            (
                "m4*l3*lc4*cos(q3 - q4)*q3'' + (I4 + m4*lc4**2)*q4'' - m4*l3*lc4*sin(q3 - q4)*q3'**2"
                " + m4*lc4*g*cos(q4) = l4*sin(q4)*lambda1 - l4*cos(q4)*lambda2"
            ),
        ),
    ),
)
