"""The energy balance along a motion with known states, by the same measure as in the native integrator."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.options import Options
from symbody.simulation.model.model import Model

__all__ = ["imbalance_of"]

Array = NDArray[np.float64]

EACH, AT_ALL = 1.0, 3.0
"""The expected energy error of each step, and in addition, in units of that caused by an error of one tolerance.
Regular motions lose a quarter of this in each step, or less."""
LOST, LOOSE = 0.1, 200.0
"""The part of the largest varying energy whose loss nothing explains; for loose tolerances, in units of the tolerance.
Regular motions of 100 s lose a sixth of it at 1e-3."""
ROUNDING = 1e-11
"""The relative rounding error of energies."""
PLACES = 9
"""The number of instants at which the effect of an error of one tolerance is evaluated."""


def imbalance_of(
    model: Model,
    parameters: Array,
    t: Array,
    states: Array,
    options: Options,
    steps: int,
    *,
    are_speeds_tested: bool = True,
) -> tuple[float, float] | None:
    """Return since when the energy has been off, and by which part of the largest varying energy.

    Return None where errors of one tolerance explain the difference, or where the energy is not constant.

    Args:
        model: the model, without loads that do work.
        parameters: the values of its parameters, then those of Baumgarte's stabilisation if it is used.
        t: the instants, shape (N,), in s.
        states: coordinates and speeds, shape (N, n).
        options: the tolerances.
        steps: the number of steps that were taken.
        are_speeds_tested: whether the errors of speeds limit the steps.
    """
    code = model.energies_code
    if code is None or model.power is not None:
        return None

    def energies(at: Array, rows: Array) -> Array:
        return code.evaluate_rows(parameters, np.column_stack([at, rows]))

    kinetic, potential = energies(t, states).T
    some = np.linspace(0, len(t) - 1, PLACES).astype(int)

    def spread(tolerances: Array) -> float:
        """Return the largest change of the energy by errors in each entry of the state, at some instants."""
        here = np.repeat(states[some], states.shape[1], axis=0)
        errors = np.tile(np.eye(states.shape[1]), (PLACES, 1)) * np.repeat(
            tolerances, states.shape[1], axis=0
        )
        at = np.repeat(t[some], states.shape[1])
        changes = np.abs((energies(at, here + errors) - energies(at, here)).sum(axis=1))
        return float(changes.reshape(PLACES, -1).sum(axis=1).max())

    tolerances = options.atol + options.rtol * np.abs(states[some])
    once, step = spread(tolerances), (float(t[-1]) - float(t[0])) / max(steps, 1)
    each = once if are_speeds_tested or step <= 0 else spread(_of_steps(model, tolerances, step))
    off = np.abs(kinetic + potential - kinetic[0] - potential[0])
    largest = float((np.abs(kinetic) + np.abs(potential)).max())
    moving = max(float(kinetic.max()), float(np.abs(potential - potential[0]).max()), np.finfo(float).tiny)
    most = max(LOST, LOOSE * options.rtol) * moving
    explained = min(AT_ALL * once + EACH * steps * each, max(most, AT_ALL * once))
    beyond = np.flatnonzero(off > explained + ROUNDING * largest)
    return (float(t[beyond[0]]), float(off.max()) / moving) if len(beyond) else None


def _of_steps(model: Model, tolerances: Array, step: float) -> Array:
    """Return the errors of one step: untested speeds err by the coordinates over the step length."""
    errors, q = tolerances.copy(), len(model.coordinates)
    errors[:, q:] = np.maximum(errors[:, q:], errors[:, :q].max(axis=1, keepdims=True) / step)
    return errors
