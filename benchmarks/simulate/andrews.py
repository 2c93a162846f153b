"""Andrews' squeezing mechanism: seven bodies in the plane, a motor, a spring, three closed loops.

The crank K1 turns about O, K2 hangs on its end; its other end P is held by the triangle K3 about B (on which the
spring C-D pulls), by the pair K5-K4 about A and by the pair K7-K6 about A [Hairer & Wanner 1996, sec. VII.7].
"""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

from symbody import (
    Body,
    Force,
    Frame,
    Point,
    System,
    Torque,
    dot,
    functions_of_time,
    ground,
    newton_euler,
    origin,
    project,
    rotate,
    sqrt,
    symbols,
    translate,
)

from .problem import Problem

REFERENCE = Path(__file__).resolve().parents[2] / "tests" / "reference" / "andrews.json"
"""Dimensions, initial state and the published end, by the names of the literature."""


def andrews() -> Problem:
    """Return it over the 0.03 s of the literature, in which the crank turns two and a half times."""
    numbers = json.loads(REFERENCE.read_text(encoding="utf-8"))
    symbol = {name: symbols(name) for name in numbers["parameters"]}
    p = SimpleNamespace(**symbol)
    q = SimpleNamespace(**{name: functions_of_time(name) for name in numbers["coordinates"]})
    K = _frames(p, q)
    centers = _centers(p, K)
    bodies = [Body(G, symbol[f"m{k}"], 0, 0, symbol[f"i{k}"], name=f"K{k}") for k, G in centers.items()]
    P = Point(K[2], -p.d, 0, 0)
    held_at = [Point(K[3], 0, -p.ss, 0), Point(K[4], 0, -p.e, 0), Point(K[6], p.zf, 0, 0)]
    gaps = [gap for end in held_at for gap in project(P - end, ground).components[:2]]
    motor = Torque(ground, 0, 0, p.mom, on=bodies[0], name="motor")
    equations = newton_euler(
        System(bodies, [_spring(p, K[3], bodies[2]), motor], list(vars(q).values()), gaps)
    )
    state = [float(x) for x in numbers["initial_q"] + numbers["initial_qd"]]
    return Problem(
        "Andrews' squeezing mechanism",
        equations,
        {symbol[name]: float(value) for name, value in numbers["parameters"].items()},
        dict(zip((*equations.coordinates, *equations.speeds), state, strict=True)),
        0.03,
        tuple(numbers["published_solution_t003"]),
    )


def _frames(p: SimpleNamespace, q: SimpleNamespace) -> dict[int, Frame]:
    A, B = translate(p.xa, p.ya, 0), translate(p.xb, p.yb, 0)
    K1, K3 = rotate("Z", q.beta), B * rotate("Z", q.gamma)
    K2 = K1 * translate(p.rr, 0, 0) * rotate("Z", q.Theta)
    K5, K7 = A * rotate("Z", q.delta), A * rotate("Z", q.epsilon)
    K4 = K5 * translate(p.zt, 0, 0) * rotate("Z", q.Phi)
    K6 = K7 * translate(0, -p.u, 0) * rotate("Z", q.Omega)
    return dict(enumerate((K1, K2, K3, K4, K5, K6, K7), start=1))


def _centers(p: SimpleNamespace, K: dict[int, Frame]) -> dict[int, Point]:
    places = {
        1: (p.ra, 0),
        2: (-p.da, 0),
        3: (p.sb, -p.sa),
        4: (0, p.ea - p.e),
        5: (p.ta, p.tb),
        6: (p.zf - p.fa, 0),
        7: (-p.ub, -p.ua),
    }
    return {k: Point(K[k], x, y, 0) for k, (x, y) in places.items()}


def _spring(p: SimpleNamespace, triangle: Frame, body: Body) -> Force:
    D = Point(triangle, p.sd, -p.sc, 0)
    stretch = project(D - origin(translate(p.xc, p.yc, 0)), ground)
    length = sqrt(dot(stretch, stretch))
    return Force(-p.c0 * (length - p.l0) / length * stretch, at=D, on=body, name="spring")
