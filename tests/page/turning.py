"""Systems on frames that turn at a given rate, and bodies with rotors: rotor blades, gyroscopes, gyrostats."""

from __future__ import annotations

from symbody import (
    Body,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    moving_frame,
    rotate,
    symbols,
    t,
    time_derivative,
    translate,
)

from .classic import Classic

m, g, k, l, I, A, B, C, W = symbols("m g k l I A B C W")


def rotor_blade() -> System:
    """A blade on hinges of lag and flap beside the axis of a rotor that turns at a given rate."""
    (lag, flap), (Om, e, c, kf, kl) = functions_of_time("lag flap"), symbols("Om e c kf kl")
    hinge = rotate("Z", Om * t) * translate(e, 0, 0) * rotate("Z", lag)
    blade = Body(hinge * rotate("Y", -flap) * translate(c, 0, 0), m, Iy=I, Iz=I)
    return System([blade], [Torque(hinge, 0, kf * flap, -kl * lag, on=blade)], [lag, flap])


def rate_gyro() -> System:
    """A rotor in a gimbal with a spring and a damper, on a table that turns."""
    tilt, (n, d) = functions_of_time("tilt"), symbols("n d")
    table = rotate("Z", W * t)
    rotor = Body(table * rotate("X", tilt) * rotate("Y", n * t), 0, Ix=A, Iz=A, Iy=C)
    return System(
        [rotor], [Torque(table, -k * tilt - d * time_derivative(tilt), 0, 0, on=rotor)], coordinates=[tilt]
    )


def rod_on_turning_arm() -> System:
    """A rod that hangs on an arm of a shaft that turns."""
    nod, b = functions_of_time("nod"), symbols("b")
    inertia = m * l**2 / 12
    frame = rotate("Y", W * t) * translate(b, 0, 0) * rotate("Z", nod) * translate(0, -l / 2, 0)
    return System(
        [Body(frame, m, Ix=inertia, Iz=inertia)], coordinates=[nod], gravity=Vector(ground, 0, -g, 0)
    )


def gyrostat() -> System:
    """A body with a rotor about its first axis that a motor drives."""
    p, q, r, spin = functions_of_time("p q r spin")
    rotor_inertia, torque = symbols("Jr T")
    axes = moving_frame(0, 0, 0, p, q, r)
    hull, rotor = Body(axes, 0, A, B, C), Body(axes * rotate("X", spin), 0, Ix=rotor_inertia)
    return System(
        [hull, rotor],
        [Torque(axes, torque, 0, 0, on=rotor, reaction=hull)],
        coordinates=[spin],
        speeds=[p, q, r],
    )


TURNING = (
    Classic(
        "Rotor blade with lag and flap",
        "standard form, as in Johnson, Helicopter Theory, 1980, ch. 9, before it is made linear",
        rotor_blade,
        (
            (
                "(I + m*c**2)*cos(flap)**2*lag'' - 2*(I + m*c**2)*sin(flap)*cos(flap)*(Om + lag')*flap'"
                " + m*e*c*Om**2*sin(lag)*cos(flap) + kl*lag = 0"
            ),
            (
                "(I + m*c**2)*flap'' + (I + m*c**2)*sin(flap)*cos(flap)*(Om + lag')**2"
                " + m*e*c*Om**2*cos(lag)*sin(flap) + kf*flap = 0"
            ),
        ),
    ),
    Classic(
        "Rate gyro",
        "standard form",
        rate_gyro,
        ("A*tilt'' + (A - C)*W**2*sin(tilt)*cos(tilt) - C*n*W*cos(tilt) + d*tilt' + k*tilt = 0",),
    ),
    Classic(
        "Rod on an arm of a turning shaft",
        "standard form",
        rod_on_turning_arm,
        ("1/3*m*l**2*nod'' - 1/2*m*l*W**2*(b + 2/3*l*sin(nod))*cos(nod) + 1/2*m*g*l*sin(nod) = 0",),
    ),
    Classic(
        "Gyrostat with a driven rotor",
        "Wittenburg, Dynamics of Multibody Systems, 2008, sec. 4.6, by components",
        gyrostat,
        (
            "(A + Jr)*p' + Jr*spin'' + (C - B)*q*r = 0",
            "B*q' + (A + Jr - C)*p*r + Jr*r*spin' = 0",
            "C*r' + (B - A - Jr)*p*q - Jr*q*spin' = 0",
            "Jr*p' + Jr*spin'' = T",
        ),
    ),
)
