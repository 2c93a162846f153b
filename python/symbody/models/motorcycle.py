"""The motorcycle of Sharp's type: four bodies on tyres that need a length of road to build up their forces."""

from __future__ import annotations

from symbody.geometry import Point, rotate, translate
from symbody.multibody import Body, friction, motor, tire_kinematics
from symbody.symbolic import cos, functions_of_time, sin, symbols, time_derivative

from .classic_system import ClassicSystem
from .lagging_tyre import TyreLaw, lagging_tyre, system_on_tyres

_NUMBERS = {
    "mr": 217.45,
    "mf": 30.65,
    "h": 0.6157,
    "a": 0.9485,
    "b": 0.4798,
    "e": 0.0244,
    "f": 0.02835,
    "tn": 0.1158,
    "eps": 0.4715,
    "Rr": 0.3048,
    "Rf": 0.3048,
    "Irx": 31.184,
    "Iry": 30.0,
    "Irz": 21.068,
    "Crxz": 1.7354,
    "Ifx": 1.2338,
    "Ify": 1.2,
    "Ifz": 0.442,
    "iry": 1.0508,
    "ify": 0.7186,
    "Cr1": 15831.0,
    "Cr2": 1325.6,
    "Cf1": 11174.0,
    "Cf2": 938.6,
    "sigma": 0.2438,
    "K": 6.7791,
    "g": 9.81,
}


def motorcycle() -> ClassicSystem:
    """Return Sharp's motorcycle: a frame with its rider, a front fork that steers, and two wheels with thin tyres.

    x points forward, y to the left and z up; the origin of the frame is on the ground below its centre of mass, which
    is at the height h. The rear wheel is b behind it. The steering axis has the angle eps from the vertical and the
    distance a from the origin; the fork has its centre of mass at e ahead of it and f above, and the trail tn. The
    wheels touch the ground and roll along, which four constraints keep. The lateral forces Yr and Yf are states that
    follow slip and camber with the relaxation length sigma: ``sigma Y' = -VS (C1 alpha + C2 gamma + Y)``, for motions
    forward, VS > 0.

    The coordinates are the place, yaw psi, lean phi and pitch theta of the frame, the steering angle delta and the
    angles of the wheels. A damper K and the input tau act on the steering, the input drive on the rear wheel. The
    numbers are Sharp's in SI units, as later work quotes them, but for Iry and Ify, which are typical. With these, the
    eigenvalues of straight running are those of his tables 1 to 3.

    >>> model = motorcycle()
    >>> *model.system.states, len(model.system.constraints)
    (Yr, Yf, 4)
    """
    parameters = symbols(" ".join(_NUMBERS))
    mr, mf, h, a, b, e, f, tn, eps, Rr, Rf, Irx, Iry, Irz, Crxz, *others = parameters
    Ifx, Ify, Ifz, iry, ify, Cr1, Cr2, Cf1, Cf2, sigma, K, g = others
    coordinates = functions_of_time("x y z psi phi theta delta phir phif")
    x, y, z, psi, phi, theta, delta, phir, phif = coordinates
    Yr, Yf, tau, drive = functions_of_time("Yr Yf tau drive")

    heading = translate(x, y, z) * rotate("Z", psi)
    main = heading * rotate("X", phi) * rotate("Y", theta)
    fork = main * rotate("Y", -eps) * translate(a, 0, 0) * rotate("Z", delta)
    front_contact = (a - tn) / cos(eps)
    hub = translate(Rf * sin(eps) - tn, 0, Rf * cos(eps) - front_contact * sin(eps))
    frame = Body(Point(main, 0, 0, h), mr, Irx, Iry, Irz, Cxz=-Crxz, name="frame")
    steered = Body(Point(fork, e, 0, f), mf, Ifx, Ify, Ifz, name="fork")
    rear = Body(main * translate(-b, 0, Rr) * rotate("Y", phir), 0, Iy=iry, name="rear wheel")
    front = Body(fork * hub * rotate("Y", phif), 0, Iy=ify, name="front wheel")

    drives = [
        motor(delta, tau, on=steered, reaction=frame, name="steering torque"),
        friction(delta, viscous=K, on=steered, reaction=frame, name="steering damper"),
        motor(phir, drive, on=rear, reaction=frame, name="drive"),
    ]
    tyres = [
        lagging_tyre(rear, tire_kinematics(rear, Rr, carrier=heading), Yr, TyreLaw(Cr1, Cr2, sigma)),
        lagging_tyre(front, tire_kinematics(front, Rf), Yf, TyreLaw(Cf1, Cf2, sigma)),
    ]
    bodies = [frame, steered, rear, front]
    system = system_on_tyres(bodies, drives, coordinates, tyres, g, "Motorcycle")
    return ClassicSystem(
        system,
        "Sharp, The stability and control of motorcycles, J. Mechanical Engineering Science 13 (1971), p. 316, with"
        " numbers in SI units as later work quotes them; Iry and Ify, which do not occur there, are typical",
        {each: _NUMBERS[str(each)] for each in parameters},
        {time_derivative(x): 15.0, time_derivative(phi): 0.2},
        {tau: 0.0, drive: 0.0},
    )
