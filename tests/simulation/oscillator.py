"""A damped oscillator with one mass, and its motion in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody import (
    Body,
    Force,
    Study,
    System,
    functions_of_time,
    ground,
    newton_euler,
    study,
    symbols,
    time_derivative,
    translate,
)

x, (m, k, c) = functions_of_time("x"), symbols("m k c")
u = time_derivative(x)
cart = Body(translate(x, 0, 0), m)
OSCILLATOR = newton_euler(
    System([cart], [Force(ground, -k * x - c * u, 0, 0, at=cart.center_of_mass, on=cart)], [x])
)

Array = NDArray[np.float64]


def displacement(stiffness: Any, damping: Any, start: Any, t: Any) -> Any:
    """The free motion of a unit mass from rest: ``x0 exp(-d t) (cos(w t) + d/w sin(w t))``."""
    d = damping / 2
    w = np.sqrt(stiffness - d**2)
    return start * np.exp(-d * t) * (np.cos(w * t) + d / w * np.sin(w * t))


def oscillators(cases: Any, t: Any = (0, 6), **options: Any) -> Study:
    """A study of oscillators with a unit mass, which begin at 0.1."""
    return study(OSCILLATOR, {m: 1.0}, {x: 0.1}, t, cases=cases, **options)
