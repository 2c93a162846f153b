"""Motions to look at that no integrator of ours has computed: prescribed, or by SciPy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    lagrange_equations,
    lambdify,
    rotate,
    symbols,
    time_derivative,
    translate,
)

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Prescribed:
    """Values of variables over time; whatever is written in them and their rates is evaluated by lambdify."""

    t: Array
    system: System
    variables: Mapping[Expr, Array]
    parameters: Mapping[Expr, float]

    def __getitem__(self, expression: Expr) -> Array:
        return self.evaluate([expression])[0]

    def evaluate(self, expressions: Sequence[Expr]) -> Array:
        rates = {
            time_derivative(q): np.gradient(row, self.t) if len(row) > 1 else row * 0
            for q, row in self.variables.items()
            if q.order == 0
        }
        values = {**rates, **self.variables, **self.parameters}
        rows = lambdify(list(values), list(expressions))(*values.values())
        return np.broadcast_to(rows.reshape(len(expressions), -1), (len(expressions), len(self.t)))


m, l, g, F, h = symbols("m l g F h")
q1, q2 = functions_of_time("q1 q2")
xA, yA, xB, yB = functions_of_time("xA yA xB yB")
x, y, z, phi, theta = functions_of_time("x y z phi theta")


def double_pendulum() -> System:
    """Two uniform rods in the plane x-y, with y up: joints about z, inertia about z alone."""
    upper = rotate("Z", q1)
    lower = upper * translate(l, 0, 0) * rotate("Z", q2)
    rods = [
        Body(Point(frame, l / 2, 0, 0), m, 0, 0, m * l**2 / 12, name=name)
        for frame, name in ((upper, "upper rod"), (lower, "lower rod"))
    ]
    push = Force(ground, F, 0, 0, at=Point(lower, l, 0, 0), on=rods[1], name="F")
    return System(
        rods, [push], coordinates=[q1, q2], gravity=Vector(ground, 0, -g, 0), name="Double pendulum"
    )


def swinging(duration: float = 4.0) -> Prescribed:
    system = double_pendulum()
    equations = lagrange_equations(system)
    parameters = {m: 1.0, l: 0.8, g: 9.81, F: 1.5}
    f = lambdify(
        [*system.coordinates, *system.speeds, *parameters], [equations.mass_matrix, equations.forcing]
    )

    def rates(_: float, state: Array) -> Array:
        mass, forcing = f(*state, *parameters.values())
        return np.concatenate([state[2:], np.linalg.solve(mass, np.ravel(forcing))])

    t = np.linspace(0, duration, 201)
    states = solve_ivp(rates, (0, duration), [0.4, 0.9, 0, 0], t_eval=t, rtol=1e-9, atol=1e-9).y
    variables = dict(zip((*system.coordinates, *system.speeds), states, strict=True))
    return Prescribed(t, system, variables, parameters)


def hanging_plate(swing: float = 0.3) -> Prescribed:
    """A bar AB in natural coordinates that swings on two threads of length h, parallel to itself; B0 is above B."""
    bar = Frame(
        [
            [(xB - xA) / l, -(yB - yA) / l, 0, xA],
            [(yB - yA) / l, (xB - xA) / l, 0, yA],
            [0, 0, 1, 0],
            [0, 0, 0, 1],
        ]
    )
    body = Body(Point(bar, l / 2, 0, 0), m, 0, 0, m * l**2 / 12, name="bar")
    length = (xB - xA) ** 2 + (yB - yA) ** 2 - l**2
    threads = [xA**2 + yA**2 - h**2, ((xB - l) ** 2 + yB**2 - h**2) / 2]
    system = System(
        [body], coordinates=[xA, yA, xB, yB], constraints=[length, *threads], gravity=Vector(ground, 0, -g, 0)
    )
    t = np.linspace(0, 2, 41)
    angle = swing * np.sin(3 * t)
    x, y = np.sin(angle), -np.cos(angle)
    multipliers = {system.multipliers[0]: 0 * t, system.multipliers[1]: -1 - t, system.multipliers[2]: -2 - t}
    variables = {xA: x, yA: y, xB: x + 0.5, yB: y, **multipliers}
    return Prescribed(t, system, variables, {m: 1.0, l: 0.5, h: 1.0, g: 9.81})


def tumbling() -> Prescribed:
    """A box that flies and turns about two axes, several times."""
    frame = translate(x, y, z) * rotate("Z", phi) * rotate("X", theta)
    box = Body(frame, m, m * 0.05 / 12, m * 0.1 / 12, m * 0.13 / 12, name="box")
    system = System([box], coordinates=[x, y, z, phi, theta], gravity=Vector(ground, 0, 0, -g))
    t = np.linspace(0, 2, 101)
    variables = {x: t, y: 0.3 * t, z: 4 * t - 2 * t**2, phi: 5 * t, theta: 9 * t}
    return Prescribed(t, system, variables, {m: 2.0, g: 4.0})
