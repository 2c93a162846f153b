"""Sharp's motorcycle of 1994: a frame that is flexible, and a rider who leans."""

from __future__ import annotations

from math import cos as cosine
from math import sin as sine

from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Vector, rotate, translate
from symbody.multibody import Body, Element, air_force, motor, tire_kinematics, torsion_spring
from symbody.symbolic import Expr, cos, functions_of_time, sin, symbols, time_derivative
from symbody.symbolic.given.arguments import brief

from .classic_system import ClassicSystem
from .lagging_tyre import LaggingTyre, TyreLaw, lagging_tyre, system_on_tyres

_FASTEST = 70.0
"""The highest speed, in m/s: there, the front wheel still has half of its load at rest."""

_NUMBERS = {
    "Mf": 40.59,
    "Mr": 170.3,
    "Mb": 25.0,
    "Mp": 50.0,
    "Ifx": 3.97,
    "Ify": 4.0,
    "Ifz": 0.91,
    "Irx": 7.43,
    "Iry": 18.0,
    "Irz": 11.63,
    "Irxz": 7.4,
    "Ipx": 1.96,
    "Ipy": 2.0,
    "Ipz": 0.55,
    "Ipxz": 0.26,
    "irwx": 0.4,
    "irwy": 0.65,
    "ifwy": 0.58,
    "iry": 0.41,
    "aa": 0.527,
    "bb": 0.628,
    "bbb": 0.62,
    "bbp": 0.28,
    "ee": 0.049,
    "hh": 0.438,
    "hhb": 0.33,
    "hhp": 0.4,
    "hhs": 0.8,
    "jj": 0.527,
    "ll": 0.807,
    "Rf": 0.336,
    "Rr": 0.321,
    "ss": 0.77,
    "trail": 0.094,
    "eps": 0.47,
    "eps1": 1.435,
    "hhcp": 0.33,
    "kv": 1.04e6,
    "Dv": 456.0,
    "klambda": 46000.0,
    "Dlambda": 17.7,
    "kgamma": 61200.0,
    "Dgamma": 44.1,
    "kzeta": 10000.0,
    "Dzeta": 156.0,
    "ksteer": 50.0,
    "Dsteer": 6.0,
    "Dc": 0.377,
    "Lc": 0.05,
    "g": 9.81,
}

_POLYNOMIALS = {
    "Cr1": (-92.9, 23.129, -0.004663, -6.457e-07, 1.887e-10),
    "Cf1": (-300.0, 28.577, -0.0143, 1.431e-06, 3.347e-10),
    "Cr2": (27.38, 0.9727, -4e-06),
    "Cf2": (-13.25, 1.302, -0.000139),
    "Cr3": (9.0, 0.3573, 3.378e-05),
    "Cf3": (-0.281, 0.2442, 8.575e-05),
    "Cr4": (2.056, 0.01282, 4.928e-06),
    "Cf4": (2.788, 0.0165, 3.9e-06),
    "Cr5": (0.0, 0.07),
    "Cf5": (0.0, 0.06),
    "sigmar": (0.03594, 0.0001941, -5.667e-08, 5.728e-12),
    "sigmaf": (0.1012, 0.0001297, -3.267e-08),
}
"""Coefficients of the tyres in powers of their loads in N: of slip, camber, and their moments, and the lengths."""


def flexible_motorcycle(speed: float = 40.0) -> ClassicSystem:
    """Return Sharp's motorcycle of 1994: its frame twists, its steering head yields, and the rider leans.

    x points forward, y to the left and z up; the origin of the frame is on the ground below its centre of mass. The
    rear wheel and its arm twist by lamda about an axis at eps1 from the vertical. The steering head twists by gamma
    across the steering axis, and moves aside by v; the fork steers by delta. The upper body of the rider leans by zeta.
    Hands are on the bar. Forces and moments of the tyres are states with relaxation lengths; the wheels roll as thin
    discs, with overturning moments. The input tau is the torque on the steering, the input drive that on the rear
    wheel; it keeps the speed.

    The coefficients of the tyres are those at the loads of straight running at a speed in m/s, by the polynomials of
    the source. Pitch inertias Ify, Iry and Ipy do not occur there: they are typical. The products of inertia count
    with z downwards, as in Sharp's paper of 1971. The port names the rider's and the frame's inertias the other way
    round, and has masses of wheels (26.5 kg), which its loads do not count; they are in Mf and Mb here. No eigenvalues
    of this machine were found in print. With stiff springs, and the numbers of the machine of 1971, weave, wobble and
    capsize are those of the tables in Sharp's paper of 1971.

    >>> model = flexible_motorcycle(20.0)
    >>> *model.system.states, len(model.system.coordinates)
    (Yr, Mr, Yf, Mf, 13)
    """
    _check_speed(speed)
    p = dict(zip(_NUMBERS, symbols(" ".join(_NUMBERS)), strict=True))
    coordinates = functions_of_time("x y z psi phi theta lamda gamma v delta zeta phir phif")
    x, *_, phir, _ = coordinates
    machine = _machine(p, coordinates)
    tau, drive = functions_of_time("tau drive")
    frame, steered = machine["rear frame"], machine["fork"]
    tyres, coefficients = _tyres(machine["rear wheel"], machine["front wheel"])
    pressure = Point(machine["rear frame"].frame, (p["ll"] - p["bb"]) / 2, 0, p["hhcp"] - p["hh"])
    loads = [
        *_springs(p, machine, coordinates),
        motor(coordinates[9], tau, on=steered, reaction=machine["steering head"], name="steering torque"),
        motor(phir, drive, on=machine["rear wheel"], reaction=machine["rear arm"], name="drive"),
        air_force(
            pressure,
            on=frame,
            density=2,
            drag_area=p["Dc"],
            lift_area=p["Lc"],
            span=Vector(frame.frame, 0, 1, 0),
            name="air",
        ),
    ]
    system = system_on_tyres([*machine.values()], loads, coordinates, tyres, p["g"], "Flexible motorcycle")
    numbers = {p[name]: value for name, value in _NUMBERS.items()}
    rolling = {time_derivative(x): speed, time_derivative(coordinates[4]): 0.05}
    return ClassicSystem(
        system,
        "Sharp, Vibrational modes of motorcycles and their design parameter sensitivities, Int. Conf. Vehicle NVH and"
        " Refinement, Birmingham 1994, by the port of MathWorks, The Sharp 1994 bike model (1998-2002)",
        numbers | _at_loads(speed, coefficients),
        rolling,
        {tau: 0.0, drive: _NUMBERS["Dc"] * speed**2 * _NUMBERS["Rr"]},
    )


def _machine(p: dict[str, Expr], coordinates: tuple[Expr, ...]) -> dict[str, Body]:
    """Return the bodies by their names."""
    x, y, z, psi, phi, theta, lamda, gamma, v, delta, zeta, phir, phif = coordinates
    ce, se = cos(p["eps"]), sin(p["eps"])
    main = translate(x, y, z) * rotate("Z", psi) * rotate("X", phi) * rotate("Y", theta)
    arm = _turned(main, (p["aa"] * cos(p["eps1"]) - p["bb"], p["aa"] * sin(p["eps1"])), p["eps1"], lamda)
    top = p["ll"] + p["trail"] / ce - p["ss"] * se / ce
    head = main * translate(top, 0, p["ss"]) * rotate("Y", -p["eps"]) * rotate("X", gamma)
    moved = head * translate(0, v, 0)
    fork = moved * rotate("Z", delta)
    rider = main * translate(-p["bbp"], 0, p["hhs"]) * rotate("X", zeta)
    low = (p["trail"] * se - p["ss"]) / ce  # the foot of the trail, along the steering axis
    axle = fork * translate(p["Rf"] * se - p["trail"], 0, p["Rf"] * ce + low)
    center = Point(fork, p["ee"], 0, (p["jj"] - p["ee"] * se - p["ss"]) / ce)
    rear_axle = arm * translate(-p["bb"], 0, p["Rr"])
    return {
        body.name: body
        for body in (
            Body(
                Point(main, 0, 0, p["hh"]),
                p["Mr"],
                p["Irx"],
                p["Iry"],
                p["Irz"],
                Cxz=-p["Irxz"],
                name="rear frame",
            ),
            Body(Point(arm, -p["bbb"], 0, p["hhb"]), p["Mb"], p["irwx"], name="rear arm"),
            Body(head, 0, name="twisted head"),
            Body(moved, 0, name="steering head"),
            Body(center, p["Mf"], p["Ifx"], p["Ify"], p["Ifz"], name="fork"),
            Body(
                Point(rider, 0, 0, p["hhp"]),
                p["Mp"],
                p["Ipx"],
                p["Ipy"],
                p["Ipz"],
                Cxz=-p["Ipxz"],
                name="rider",
            ),
            Body(rear_axle * rotate("Y", phir), 0, Iy=p["irwy"], name="rear wheel"),
            Body(main * translate(0, 0, p["hh"]) * rotate("Y", phir), 0, Iy=p["iry"], name="engine"),
            Body(axle * rotate("Y", phif), 0, Iy=p["ifwy"], name="front wheel"),
        )
    }


def _turned(frame: Frame, at: tuple[Expr, Expr], tilt: Expr, angle: Expr) -> Frame:
    """Return a frame turned about an axis through a point x, z of its plane, at the angle tilt from its z axis."""
    there = frame * translate(at[0], 0, at[1]) * rotate("Y", -tilt) * rotate("Z", angle)
    return there * rotate("Y", tilt) * translate(-at[0], 0, -at[1])


def _springs(p: dict[str, Expr], machine: dict[str, Body], coordinates: tuple[Expr, ...]) -> list[Element]:
    *_, lamda, gamma, v, delta, zeta, _, _ = coordinates
    between = (
        ("lambda", lamda, "rear arm", "rear frame", "twist of the rear arm"),
        ("gamma", gamma, "twisted head", "rear frame", "twist of the head"),
        ("v", v, "steering head", "twisted head", "yielding of the head"),
        ("steer", delta, "fork", "steering head", "hands on the bar"),
        ("zeta", zeta, "rider", "rear frame", "lean of the rider"),
    )
    return [
        torsion_spring(
            along, p[f"k{k}"], damping=p[f"D{k}"], on=machine[on], reaction=machine[other], name=name
        )
        for k, along, on, other, name in between
    ]


def _tyres(rear: Body, front: Body) -> tuple[list[LaggingTyre], dict[str, Expr]]:
    """Return both tyres, and the symbols of their coefficients."""
    c = dict(zip(_POLYNOMIALS, symbols(" ".join(_POLYNOMIALS)), strict=True))
    Rr, Rf = symbols("Rr Rf")
    Yr, Mr, Yf, Mf = functions_of_time("Yr Mr Yf Mf")
    rows = (("r", rear, Rr, Yr, Mr), ("f", front, Rf, Yf, Mf))
    tyres = []
    for k, wheel, radius, force, moment in rows:
        law = TyreLaw(
            c[f"C{k}1"],
            c[f"C{k}2"],
            c[f"sigma{k}"],
            aligning=c[f"C{k}3"],
            twisting=c[f"C{k}4"],
            overturning=c[f"C{k}5"],
        )
        tyres.append(lagging_tyre(wheel, tire_kinematics(wheel, radius), force, law, moment))
    return tyres, c


def _check_speed(speed: object) -> None:
    if isinstance(speed, bool) or not isinstance(speed, int | float) or not 0 < speed <= _FASTEST:
        raise ModelError(
            f"flexible_motorcycle: speed is {brief(repr(speed))}; expected a number of m/s above 0 and up to "
            f"{_FASTEST:g}, for which the polynomials of the tyres hold"
        )


def _at_loads(speed: float, coefficients: dict[str, Expr]) -> dict[Expr, float]:
    """Return the coefficients at the loads of straight running."""
    n = _NUMBERS
    base = n["bb"] + n["ll"]
    ahead = n["ll"] + (n["ee"] + n["trail"] - n["jj"] * sine(n["eps"])) / cosine(n["eps"])
    moment = n["Mf"] * (n["bb"] + ahead) + n["Mr"] * n["bb"] + n["Mb"] * (n["bb"] - n["bbb"])
    moment += n["Mp"] * (n["bb"] - n["bbp"])
    front = (moment * n["g"] - speed**2 * (n["Dc"] * n["hhcp"] + n["Lc"] * base / 2)) / base
    rear = (n["Mf"] + n["Mr"] + n["Mb"] + n["Mp"]) * n["g"] - n["Lc"] * speed**2 - front
    loads = {"r": rear, "f": front}
    which = {name: loads[name.removeprefix("C").removeprefix("sigma")[0]] for name in _POLYNOMIALS}
    return {
        coefficients[name]: sum(c * which[name] ** k for k, c in enumerate(powers))
        for name, powers in _POLYNOMIALS.items()
    }
