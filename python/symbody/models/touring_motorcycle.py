"""The sport tourer: a motorcycle whose fork bends, on toroidal tyres."""

from __future__ import annotations

from math import radians

from symbody.geometry import Frame, Point, rotate, translate
from symbody.multibody import Body, air_force, friction, motor, tire_kinematics, torsion_spring
from symbody.symbolic import Expr, cos, functions_of_time, sin, symbols, time_derivative

from .classic_system import ClassicSystem
from .lagging_tyre import LaggingTyre, TyreLaw, lagging_tyre, system_on_tyres

_NUMBERS = {
    "w": 1.448,
    "eps": radians(26.8),
    "an": 0.105,
    "m": 270.0,
    "b": 0.688,
    "h": 0.64,
    "Ixx": 35.5,
    "Iyy": 60.0,
    "Izz": 59.3,
    "Ixz": -1.7,
    "mf": 34.0,
    "ef": 0.025,
    "hf": 0.6,
    "Ifxx": 4.3,
    "Ifyy": 4.4,
    "Ifzz": 0.83,
    "mb": 18.0,
    "eb": 0.0,
    "hb": 0.35,
    "Ibxx": 0.8,
    "Ibyy": 0.9,
    "Ibzz": 0.4,
    "Iwf": 0.6,
    "Iwr": 0.8,
    "Rf": 0.294,
    "Rr": 0.299,
    "rhof": 0.064,
    "rhor": 0.078,
    "kaf": 16.0,
    "kar": 14.5,
    "kgf": 0.85,
    "kgr": 0.95,
    "ksf": -0.2,
    "ksr": -0.2,
    "ktf": 0.015,
    "ktr": 0.018,
    "klf": 160000.0,
    "klr": 140000.0,
    "lb": 0.67,
    "kb": 38000.0,
    "cd": 1.0,
    "CdA": 0.467,
    "hA": 0.35,
    "rho": 1.2,
    "g": 9.80665,
}

_SPEED = 30.0


def touring_motorcycle() -> ClassicSystem:
    """Return a sport tourer with its rider: a frame, a fork whose lower part bends aside, and toroidal tyres.

    x points forward, y to the left and z up; the origin of the frame is on the ground below the rear wheel. The whole
    machine with its rider has the mass m, at b ahead of it and h above it. Of this, the front assembly has mf, at the
    height hf and ef ahead of the steering axis. The axis has the angle eps from the vertical and the normal trail an.
    The part mb of the fork, with the wheel, bends by beta about an axis across the fork, lb up the steering axis from
    the foot of the trail. So the bodies are the whole, less the front assembly where it is not steered, and so on.

    Forces and moments of the tyres are states, and in proportion to the loads Nr and Nf, the multipliers of the
    contacts: ``sigma Y' = -VS (N (ka alpha + kg gamma) + Y)``, and alike the moment of ks and kt. The relaxation
    lengths are ka/kl times the loads at rest. The input tau is the torque on the steering, the input drive that on the
    rear wheel; it keeps the speed of 30 m/s.

    The table has no Iyy, Ifxx, Ifyy, Ibyy, Ibzz and rho: these are typical. Ixz is the integral of x z with z upwards:
    only so is the rider, by whom the rows of the table with and without him differ, a body that is possible.

    >>> model = touring_motorcycle()
    >>> *model.system.states, len(model.system.constraints)
    (Yr, Mr, Yf, Mf, 4)
    """
    p = dict(zip(_NUMBERS, symbols(" ".join(_NUMBERS)), strict=True))
    coordinates = functions_of_time("x y z psi phi theta delta beta phir phif")
    x, _, _, _, phi, _, delta, beta, phir, _ = coordinates
    tau, drive = functions_of_time("tau drive")
    bodies = _bodies(p, coordinates)
    frame, steered, lower, rear_wheel = (bodies[name] for name in ("frame", "front", "fork", "rear wheel"))
    tyres = _tyres(p, rear_wheel, bodies["front wheel"], _heading(coordinates))
    loads = [
        motor(delta, tau, on=steered, reaction=frame, name="steering torque"),
        friction(delta, viscous=p["cd"], on=steered, reaction=frame, name="steering damper"),
        torsion_spring(beta, p["kb"], on=lower, reaction=steered, name="bending of the fork"),
        motor(phir, drive, on=rear_wheel, reaction=frame, name="drive"),
        air_force(
            Point(frame.frame, 0, 0, p["hA"] - p["h"]),
            on=frame,
            density=p["rho"],
            drag_area=p["CdA"],
            name="drag",
        ),
    ]
    system = system_on_tyres([*bodies.values()], loads, coordinates, tyres, p["g"], "Sport tourer")
    drag = 0.5 * _NUMBERS["rho"] * _NUMBERS["CdA"] * _SPEED**2
    return ClassicSystem(
        system,
        "Table 7.2, sport touring motorcycle, as transcribed in a public MATLAB file; the book is not named there,"
        " probably Tanelli, Corno & Savaresi, Modelling, Simulation and Control of Two-Wheeled Vehicles, Wiley 2014",
        {p[name]: value for name, value in _NUMBERS.items()},
        {time_derivative(x): _SPEED, time_derivative(phi): 0.05},
        {tau: 0.0, drive: drag * _NUMBERS["Rr"]},
    )


def _heading(coordinates: tuple[Expr, ...]) -> Frame:
    x, y, z, psi, *_ = coordinates
    return translate(x, y, z) * rotate("Z", psi)


def _bodies(p: dict[str, Expr], coordinates: tuple[Expr, ...]) -> dict[str, Body]:
    """Return the bodies by their names."""
    phi, theta, delta, beta, phir, phif = coordinates[4:]
    ce, se = cos(p["eps"]), sin(p["eps"])
    main = _heading(coordinates) * rotate("X", phi) * rotate("Y", theta)
    straight = main * translate(p["w"] + p["an"] * ce, 0, p["an"] * se) * rotate("Y", -p["eps"])
    fork = straight * rotate("Z", delta)
    bent = fork * translate(0, 0, p["lb"]) * rotate("X", beta) * translate(0, 0, -p["lb"])
    hub = translate(p["Rf"] * se - p["an"], 0, p["Rf"] * ce)
    front = p["ef"], 0, (p["hf"] - (p["an"] + p["ef"]) * se) / ce
    low = p["eb"], 0, (p["hb"] - (p["an"] + p["eb"]) * se) / ce
    of_fork, of_low = ((p[f"m{k}"], p[f"I{k}xx"], p[f"I{k}yy"], p[f"I{k}zz"]) for k in ("f", "b"))
    center = Point(main, p["b"], 0, p["h"])
    bodies = (
        Body(center, p["m"], p["Ixx"], p["Iyy"], p["Izz"], Cxz=p["Ixz"], name="frame"),
        Body(Point(straight, *front), *(-each for each in of_fork), name="front, taken away"),
        Body(Point(fork, *front), *of_fork, name="front"),
        Body(Point(fork, *low), *(-each for each in of_low), name="fork, taken away"),
        Body(Point(bent, *low), *of_low, name="fork"),
        Body(main * translate(0, 0, p["Rr"]) * rotate("Y", phir), 0, Iy=p["Iwr"], name="rear wheel"),
        Body(bent * hub * rotate("Y", phif), 0, Iy=p["Iwf"], name="front wheel"),
    )
    return {body.name: body for body in bodies}


def _tyres(p: dict[str, Expr], rear: Body, front: Body, heading: Frame) -> list[LaggingTyre]:
    Yr, Mr, Yf, Mf, Nr, Nf = functions_of_time("Yr Mr Yf Mf Nr Nf")
    rear_law, front_law = (
        TyreLaw(
            p[f"ka{k}"],
            p[f"kg{k}"],
            p[f"ka{k}"] * p["m"] * p["g"] * share / p[f"kl{k}"],
            N,
            -p[f"ks{k}"],
            p[f"kt{k}"],
        )
        for k, N, share in (("r", Nr, 1 - p["b"] / p["w"]), ("f", Nf, p["b"] / p["w"]))
    )
    on_rear = tire_kinematics(rear, p["Rr"], crown_radius=p["rhor"], carrier=heading)
    on_front = tire_kinematics(front, p["Rf"], crown_radius=p["rhof"])
    return [lagging_tyre(rear, on_rear, Yr, rear_law, Mr), lagging_tyre(front, on_front, Yf, front_law, Mf)]
