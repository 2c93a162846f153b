"""The balance of energy along a motion whose states are known, by the measure of the native integrator."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.options import Options
from symbody.simulation.model.model import Model

__all__ = ["imbalance_of"]

Array = NDArray[np.float64]

EACH, AT_ALL = 1.0, 3.0
"""How many times what an error of one tolerance explains is explained in each step, and besides: regular motions lose a
quarter of that in each step, or less."""
LOST, LOOSE = 0.1, 200.0
"""The part of the largest energy that moves whose loss nothing explains; for loose tolerances, how many of these it is:
regular motions of 100 s lose a sixth at 1e-3."""
ROUNDING = 1e-11
"""The part of energies that rounding takes."""
PLACES = 9
"""Instants at which errors of one tolerance are looked at."""


def imbalance_of(
    model: Model, parameters: Array, t: Array, states: Array, options: Options, steps: int
) -> tuple[float, float] | None:
    """Return since when, and by which part of the largest energy that moves, the energy isn't what it was.

    None where errors of one tolerance explain what is off, or where the energy isn't constant.

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

    def spread(tolerances: Array) -> float:
        """Return the most that errors in each entry of the state change the energy, at some instants."""
        here = np.repeat(states[some], states.shape[1], axis=0)
        errors = np.tile(np.eye(states.shape[1]), (PLACES, 1)) * np.repeat(
            tolerances, states.shape[1], axis=0
        )
        at = np.repeat(t[some], states.shape[1])
        changes = np.abs((energies(at, here + errors) - energies(at, here)).sum(axis=1))
        return float(changes.reshape(PLACES, -1).sum(axis=1).max())

    tolerances = options.atol + options.rtol * np.abs(states[some])
    once, step = spread(tolerances), (float(t[-1]) - float(t[0])) / max(steps, 1)
    each = spread(_of_steps(model, tolerances, step)) if options.method == "ida3" and step > 0 else once
    off = np.abs(kinetic + potential - kinetic[0] - potential[0])
    largest = float((np.abs(kinetic) + np.abs(potential)).max())
    moving = max(float(kinetic.max()), float(np.abs(potential - potential[0]).max()), np.finfo(float).tiny)
    most = max(LOST, LOOSE * options.rtol) * moving
    explained = min(AT_ALL * once + EACH * steps * each, max(most, AT_ALL * once))
    beyond = np.flatnonzero(off > explained + ROUNDING * largest)
    return (float(t[beyond[0]]), float(off.max()) / moving) if len(beyond) else None


def _of_steps(model: Model, tolerances: Array, step: float) -> Array:
    """Return errors of a step at index 3, where nobody looks at speeds: they err by the coordinates over its length."""
    errors, q = tolerances.copy(), len(model.coordinates)
    errors[:, q:] = np.maximum(errors[:, q:], errors[:, :q].max(axis=1, keepdims=True) / step)
    return errors
