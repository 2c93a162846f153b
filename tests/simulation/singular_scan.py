"""Scans of motions through singular positions: many initial speeds of each mechanism.

The branch is known in closed form, and the energy is constant: neither is what the integrator looks at.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cache

import numpy as np

from symbody import Expr, Motion, simulate, simulate_many
from symbody.errors import ModelNotice, SimulationError
from symbody.multibody import gravitational_energy, kinetic_energy

from .singular_mechanisms import Array, Mechanism, cranks, kite, slider_crank

SPEEDS = -np.linspace(0.5, 1.5, 300)
FAST = -np.linspace(3.0, 8.0, 60)


@cache
def mechanism(name: str) -> tuple[Mechanism, Array]:
    """Return a mechanism, and the speeds of its first crank."""
    return {
        "bar": lambda: (cranks(0), SPEEDS),
        "one": lambda: (cranks(1, relative=True), SPEEDS),
        "one_below": lambda: (cranks(1, above=False), SPEEDS),
        "two": lambda: (cranks(2, relative=True), SPEEDS),
        "two_absolute": lambda: (cranks(2), SPEEDS),
        "ten": lambda: (cranks(10), SPEEDS[::6]),
        "forty": lambda: (cranks(40), SPEEDS[::50]),
        "parallelogram": lambda: (cranks(1, coupler=1.7), SPEEDS[::3]),
        "kite": lambda: (kite(), FAST),
        "slider_crank": lambda: (slider_crank(), FAST),
    }[name]()


@dataclass(frozen=True, eq=False)
class Scan:
    """The motions of a scan, case by case.

    Attributes:
        drift: the energy lost, relative to the largest energy that moves.
        off: how far they are off their branch.
        failures: why they failed; nothing where they didn't.
    """

    drift: Array
    off: Array
    failures: list[str]


def scanned(name: str, speeds: Array, **options: object) -> Scan:
    """Return what became of the motions of a mechanism in ten seconds."""
    found, _ = mechanism(name)
    system = found.equations.system
    assert system.gravity is not None
    V = gravitational_energy(system.bodies, system.gravity)
    T = kinetic_energy(system.bodies)
    begins = [found.begin(speed) for speed in speeds]
    initial = {key: np.array([begin[key] for begin in begins]) for key in begins[0]}
    instants = np.linspace(0, 10, 201)
    coordinates = {str(q): q for q in found.equations.coordinates}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        runs = simulate_many(
            found.equations,
            found.parameters,
            initial,
            t=instants,
            outputs={"T": T, "V": V, **coordinates},
            progress=False,
            **options,  # type: ignore[arg-type]
        )
    T, V = runs.outputs["T"], runs.outputs["V"]
    moving = np.maximum(np.nanmax(T, axis=1), np.nanmax(np.abs(V - V[:, :1]), axis=1))
    drift = np.nanmax(np.abs(T + V - T[:, :1] - V[:, :1]), axis=1) / moving
    along = {q: runs.outputs[label] for label, q in coordinates.items()}
    return Scan(drift, np.nanmax(found.off(along), axis=1), list(runs.results.messages))


def moved(found: Mechanism, speed: float, **options: object) -> tuple[Motion, list[str]]:
    """Return a motion of ten seconds, and what was said of it."""
    failures: list[str] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            motion = simulate(
                found.equations, found.parameters, found.begin(speed), **{"t": (0, 10), **options}
            )  # type: ignore[arg-type]
        except SimulationError as error:
            motion, failures = error.motion, [str(error)]
    assert isinstance(motion, Motion)
    return motion, [*failures, *(str(notice.message) for notice in caught)]


def branch_of(found: Mechanism, motion: Motion) -> float:
    """Return how far a motion is off its branch."""
    along: dict[Expr, Array] = {q: motion[q] for q in found.equations.coordinates}
    return float(found.off(along).max())
