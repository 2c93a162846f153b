"""Small mechanisms with constraints, the numbers of their references, and their motions where they are known."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Point,
    System,
    Torque,
    Vector,
    cos,
    diff,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    sin,
    sqrt,
    symbols,
    time_derivative,
    translate,
)
from tests.reference import test_double_pendulum_natural as double_pendulum

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """A mechanism, where it begins, and where it is at some instants (coordinates first, as many as are known)."""

    equations: Equations
    parameters: Mapping[Expr, float]
    state: Array
    instants: Array
    known: Array


def read(name: str) -> dict[str, Any]:
    path = Path(__file__).parents[1] / "reference" / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8"))  # type: ignore[no-any-return]


def natural_double_pendulum() -> Case:
    rows = double_pendulum.ROWS
    return Case(
        newton_euler(double_pendulum.natural()),
        dict(zip(double_pendulum.PARAMETERS, double_pendulum.VALUES, strict=True)),
        np.array(rows[0]["xy"] + rows[0]["v"]),
        np.array([row["t"] for row in rows]),
        np.array([row["xy"] + row["v"] for row in rows]),
    )


def pendulum(loads: tuple[Force, ...] = ()) -> Case:
    """A point mass on a rod of length L, at (-1, 0) and at rest: IFToMM benchmark A01."""
    reference = read("simple_pendulum")
    x, y = functions_of_time("x y")
    m, L, g = symbols("m L g")
    body = Body(Point(ground, x, y, 0), m)
    system = System([body], loads, [x, y], [x**2 + y**2 - L**2], Vector(ground, 0, -g, 0))
    rows = np.array(reference["rows"])
    parameters = {m: 1.0, L: 1.0, g: 9.81}
    return Case(newton_euler(system), parameters, np.array([-1.0, 0, 0, 0]), rows[:, 0], rows[:, 1:3])


def slider_crank() -> Case:
    """The example idaSlCrank of SUNDIALS: kinetic energy J1 q'^2/2 + m2 x'^2/2 + J2 p'^2/2, spring, damper, force."""
    reference = read("slider_crank")
    a, J1, m2, J2, k, c, l0, F = symbols("a J1 m2 J2 k c l0 F")
    q, x, p = coordinates = functions_of_time("q x p")
    crank = Body(Point(rotate("Z", q), 0, 0, 0), 0, 0, 0, J1)
    block = Body(Point(ground, x, 0, 0), m2)
    rod = Body(Point(rotate("Z", p), 0, 0, 0), 0, 0, 0, J2)
    length = sqrt(x**2 - x * (cos(p) + a * cos(q)) + (1 + a**2) / 4 + a * cos(p - q) / 2)
    rate = sum(diff(length, each) * time_derivative(each) for each in coordinates)
    pull = -(k * (length - l0) + c * rate)
    loads = [
        Torque(ground, 0, 0, pull * diff(length, q), on=crank),
        Force(ground, pull * diff(length, x) + F, 0, 0, at=block.center_of_mass, on=block),
        Torque(ground, 0, 0, pull * diff(length, p) - F * sin(p), on=rod),
    ]
    constraints = [x - cos(p) - a * cos(q), -sin(p) - a * sin(q)]
    parameters = {each: reference["parameters"][str(each)] for each in (a, J1, m2, J2, k, c, l0, F)}
    angle = np.arcsin(-parameters[a])
    rows = np.array(reference["published_rows"])
    equations = newton_euler(System([crank, block, rod], loads, coordinates, constraints))
    return Case(
        equations, parameters, np.array([np.pi / 2, np.cos(angle), angle, 0, 0, 0]), rows[:, 0], rows[:, 1:]
    )


def andrews() -> Case:
    """The squeezing mechanism of seven bodies [Hairer & Wanner 1996, sec. VII.7]."""
    reference = read("andrews")
    given = {symbols(name): value for name, value in reference["parameters"].items()}
    s = {str(symbol): symbol for symbol in given}
    beta, Theta, gamma, Phi, delta, Omega, epsilon = angles = functions_of_time(reference["coordinates"])
    K1 = rotate("Z", beta)
    K2 = K1 * translate(s["rr"], 0, 0) * rotate("Z", Theta)
    K3 = translate(s["xb"], s["yb"], 0) * rotate("Z", gamma)
    K5 = translate(s["xa"], s["ya"], 0) * rotate("Z", delta)
    K4 = K5 * translate(s["zt"], 0, 0) * rotate("Z", Phi)
    K7 = translate(s["xa"], s["ya"], 0) * rotate("Z", epsilon)
    K6 = K7 * translate(0, -s["u"], 0) * rotate("Z", Omega)
    centers = [
        Point(K1, s["ra"], 0, 0),
        Point(K2, -s["da"], 0, 0),
        Point(K3, s["sb"], -s["sa"], 0),
        Point(K4, 0, s["ea"] - s["e"], 0),
        Point(K5, s["ta"], s["tb"], 0),
        Point(K6, s["zf"] - s["fa"], 0, 0),
        Point(K7, -s["ub"], -s["ua"], 0),
    ]
    bodies = [Body(G, s[f"m{k}"], 0, 0, s[f"i{k}"]) for k, G in enumerate(centers, start=1)]
    x, y = (s["rr"] * f(beta) - s["d"] * f(beta + Theta) for f in (cos, sin))
    constraints = [
        x - s["ss"] * sin(gamma) - s["xb"],
        y + s["ss"] * cos(gamma) - s["yb"],
        x - s["e"] * sin(Phi + delta) - s["zt"] * cos(delta) - s["xa"],
        y + s["e"] * cos(Phi + delta) - s["zt"] * sin(delta) - s["ya"],
        x - s["zf"] * cos(Omega + epsilon) - s["u"] * sin(epsilon) - s["xa"],
        y - s["zf"] * sin(Omega + epsilon) + s["u"] * cos(epsilon) - s["ya"],
    ]
    D = (
        s["xb"] + s["sc"] * sin(gamma) + s["sd"] * cos(gamma),
        s["yb"] - s["sc"] * cos(gamma) + s["sd"] * sin(gamma),
    )
    dx, dy = D[0] - s["xc"], D[1] - s["yc"]
    length = sqrt(dx**2 + dy**2)
    pull = -s["c0"] * (length - s["l0"]) / length
    spring = Force(ground, pull * dx, pull * dy, 0, at=Point(K3, s["sd"], -s["sc"], 0), on=bodies[2])
    drive = Torque(ground, 0, 0, s["mom"], on=bodies[0])
    return Case(
        newton_euler(System(bodies, [spring, drive], angles, constraints)),
        given,
        np.array(reference["initial_q"] + reference["initial_qd"]),
        np.array([0.0, 0.03]),
        np.array([reference["initial_q"], reference["published_solution_t003"]]),
    )


def chain(links: int) -> Case:
    """Point masses on rods, stretched out and at rest."""
    m, L, g = symbols("m L g")
    names = [f"{axis}{k}" for k in range(links) for axis in "xy"]
    coordinates = functions_of_time(names)
    points = [(0, 0), *zip(coordinates[::2], coordinates[1::2], strict=True)]
    bodies = [Body(Point(ground, x, y, 0), m) for x, y in points[1:]]
    constraints = [(x - a) ** 2 + (y - b) ** 2 - L**2 for (a, b), (x, y) in pairwise(points)]
    state = np.zeros(4 * links)
    state[: 2 * links : 2] = np.arange(1, links + 1)
    system = System(bodies, (), coordinates, constraints, Vector(ground, 0, -g, 0))
    instants = np.linspace(0, 0.5, 6)
    return Case(newton_euler(system), {m: 1.0, L: 1.0, g: 9.81}, state, instants, np.empty((6, 0)))
