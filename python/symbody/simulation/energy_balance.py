"""The balance of energy along a motion whose states are known, by the measure of the native integrator."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .integrator import Options
from .model import Model

__all__ = ["imbalance_of"]

Array = NDArray[np.float64]

MARGIN, ROUNDING = 10.0, 1e-11
"""How many times what errors of the steps explain is still explained, and the part of energies that rounding takes."""
PLACES = 9
"""Instants at which errors of one tolerance are looked at."""


def imbalance_of(
    model: Model, parameters: Array, t: Array, states: Array, options: Options, steps: int
) -> tuple[float, float] | None:
    """Return since when, and by which part of the largest energy that moves, the energy isn't what it was.

    None where errors of one tolerance in each step explain what is off, or where the energy isn't constant.

    Args:
        model: what moves, without loads that do work.
        parameters: the values of its parameters.
        t: the instants, N of them, in s.
        states: coordinates and speeds, a row for each.
        options: the tolerances.
        steps: how many steps it took.
    """
    code = model.energies_code
    if code is None or model.power is not None:
        return None

    def energies(at: Array, rows: Array) -> Array:
        return code.evaluate_rows(parameters, np.column_stack([at, rows]))

    kinetic, potential = energies(t, states).T
    some = np.linspace(0, len(t) - 1, PLACES).astype(int)
    here = np.repeat(states[some], states.shape[1], axis=0)
    near = here + np.tile(np.eye(states.shape[1]), (PLACES, 1)) * (options.atol + options.rtol * np.abs(here))
    at = np.repeat(t[some], states.shape[1])
    changes = np.abs((energies(at, near) - energies(at, here)).sum(axis=1)).reshape(PLACES, -1)
    off = np.abs(kinetic + potential - kinetic[0] - potential[0])
    largest = float((np.abs(kinetic) + np.abs(potential)).max())
    explained = MARGIN * (1 + steps) * float(changes.sum(axis=1).max()) + ROUNDING * largest
    moving = max(float(kinetic.max()), float(np.abs(potential - potential[0]).max()), np.finfo(float).tiny)
    beyond = np.flatnonzero(off > explained)
    return (float(t[beyond[0]]), float(off.max()) / moving) if len(beyond) else None
