"""Models whose equations of motion are printed: the book's equations, in the names of the model."""

from __future__ import annotations

from symbody import models
from tests.page.classic import Classic

_A = "(m1*a1**2 + m2*l1**2 + I1)"
_B = "(m1*a1 + m2*l1)"
_M13 = "(m2*r1*cos(theta2) + m3*l1*cos(theta2))"

CLASSICS = (
    Classic(
        "cart_pole(2)",
        "Bogdanov, Optimal Control of a Double Inverted Pendulum on a Cart, 2004, with friction",
        lambda: models.cart_pole(2).system,
        (
            (
                f"(M + m1 + m2)*x'' + {_B}*cos(theta1)*theta1'' + m2*a2*cos(theta2)*theta2''"
                f" - {_B}*sin(theta1)*theta1'**2 - m2*a2*sin(theta2)*theta2'**2 + b*x' = F"
            ),
            (
                f"{_B}*cos(theta1)*x'' + {_A}*theta1'' + m2*l1*a2*cos(theta1 - theta2)*theta2''"
                f" + m2*l1*a2*sin(theta1 - theta2)*theta2'**2 - {_B}*g*sin(theta1) = 0"
            ),
            (
                "m2*a2*cos(theta2)*x'' + m2*l1*a2*cos(theta1 - theta2)*theta1'' + (m2*a2**2 + I2)*theta2''"
                " - m2*l1*a2*sin(theta1 - theta2)*theta1'**2 - m2*a2*g*sin(theta2) = 0"
            ),
        ),
    ),
    Classic(
        "planar_arm(2)",
        "Spong, IEEE Control Systems Magazine 15 (1995), p. 49, with a motor in both joints",
        lambda: models.planar_arm(2).system,
        (
            (
                "(m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2)) + I1 + I2)*q1''"
                " + (m2*(lc2**2 + l1*lc2*cos(q2)) + I2)*q2''"
                " - m2*l1*lc2*sin(q2)*q2'**2 - 2*m2*l1*lc2*sin(q2)*q2'*q1'"
                " + (m1*lc1 + m2*l1)*g*cos(q1) + m2*lc2*g*cos(q1 + q2) = tau1"
            ),
            (
                "(m2*(lc2**2 + l1*lc2*cos(q2)) + I2)*q1'' + (m2*lc2**2 + I2)*q2''"
                " + m2*l1*lc2*sin(q2)*q1'**2 + m2*lc2*g*cos(q1 + q2) = tau2"
            ),
        ),
    ),
)

ELBOW = (
    (
        "Iy2*sin(theta2)**2 + Iy3*sin(theta2 + theta3)**2 + Iz1 + Iz2*cos(theta2)**2 + Iz3*cos(theta2 + theta3)**2"
        " + m2*r1**2*cos(theta2)**2 + m3*(l1*cos(theta2) + r2*cos(theta2 + theta3))**2"
    ),
    "Ix2 + Ix3 + m3*l1**2 + m2*r1**2 + m3*r2**2 + 2*m3*l1*r2*cos(theta3)",
    "Ix3 + m3*r2**2 + m3*l1*r2*cos(theta3)",
    "Ix3 + m3*r2**2",
)
"""The entries 11, 22, 23 and 33 of the mass matrix of the elbow manipulator [Murray, Li & Sastry 1994, ex. 4.3]."""

ELBOW_WEIGHT = (
    "-(m2*g*r1 + m3*g*l1)*cos(theta2) - m3*g*r2*cos(theta2 + theta3)",
    "-m3*g*r2*cos(theta2 + theta3)",
)
"""The moments of its weight about the second and the third axis."""

BALANCING = (
    "(mB + 2*mW + 2*J/R**2)*v' + mB*l*cos(theta)*theta'' - mB*l*sin(theta)*(theta'**2 + r**2) - (TL + TR)/R",
    (
        "(I3 + 2*K + (mW + J/R**2)*d**2/2 - (I3 - I1 - mB*l**2)*sin(theta)**2)*r'"
        " + (mB*l*v - 2*(I3 - I1 - mB*l**2)*cos(theta)*theta')*r*sin(theta) - (TR - TL)*d/(2*R)"
    ),
    (
        "mB*l*cos(theta)*v' + (I2 + mB*l**2)*theta'' + (I3 - I1 - mB*l**2)*sin(theta)*cos(theta)*r**2"
        " - mB*g*l*sin(theta) + (TL + TR)"
    ),
)
"""The equations of a two-wheeled robot [Kim & Kwon 2015], in its speed v and the rate r of its turn."""
