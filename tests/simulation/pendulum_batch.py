"""Six motions of a double pendulum, which tests of many motions compare in every bit.

Their processes import this file, and nothing that takes long.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    lagrange_equations,
    rotate,
    symbols,
    translate,
)
from symbody.simulation.batch.grid import grid
from symbody.simulation.batch.many import simulate_many
from symbody.simulation.batch.runs import Runs

m, l, g = symbols("m l g")
q1, q2 = functions_of_time("q1 q2")
T = (0.0, 0.7)


def double_pendulum() -> Equations:
    upper = rotate("Z", q1)
    lower = upper * translate(l, 0, 0) * rotate("Z", q2)
    bobs = [Body(Point(frame, l, 0, 0), m) for frame in (upper, lower)]
    return lagrange_equations(System(bobs, coordinates=[q1, q2], gravity=Vector(ground, g, 0, 0)))


PENDULUM = double_pendulum()
CASES = grid({l: [0.4, 0.8, 1.1], q1: [0.3, -0.7]})
"""Six cases."""


def six(**options: Any) -> Runs:
    given: dict[str, Any] = {"cases": CASES, "outputs": {"height": l * cos(q1)}}
    return simulate_many(PENDULUM, {m: 1.3, g: 9.81}, {q2: 0.2}, T, **(given | options))


def thirty(path: Path | str | None) -> Runs:
    return six(cases={l: np.linspace(0.5, 1, 30), q1: np.ones(30)}, path=path, threads=1)


def same(a: Runs, b: Runs) -> bool:
    """Whether two runs agree in every bit."""
    pairs = [(a.results.arrays()[name], array) for name, array in b.results.arrays().items()]
    return all(one.tobytes() == other.tobytes() for one, other in pairs)
