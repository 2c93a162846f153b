"""What a user says of when and how to integrate."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import SimulationError
from symbody.symbolic.arguments import described

from .ida import IDA_FORMS
from .integrator import EXPLICIT, IMPLICIT, Options

__all__ = ["KEPT", "instants_of", "kept_by", "options_of"]

KEPT = ("projection", "baumgarte", "free")
"""The ways to keep constraints: back onto them after each step; by damping what is off; not at all."""


def instants_of(given: ArrayLike) -> NDArray[np.float64]:
    """Return the instants of a simulation: a pair means 1001 of them, evenly spaced.

    Raises:
        SimulationError: they aren't finite numbers that increase.
    """
    instants = np.array(given, dtype=np.float64)
    if (
        instants.ndim != 1
        or len(instants) < 2
        or not np.isfinite(instants).all()
        or (np.diff(instants) <= 0).any()
    ):
        raise SimulationError(
            f"simulate: t={described(given)}; expected the first and the last instant, or all instants, increasing"
        )
    return np.linspace(instants[0], instants[1], 1001) if len(instants) == 2 else instants


def options_of(method: str, rtol: float, atol: float, max_step: float) -> Options:
    """Return how to integrate.

    Raises:
        SimulationError: a method that isn't known.
    """
    methods = (*EXPLICIT, *IMPLICIT, *IDA_FORMS)
    if method not in ("auto", *methods):
        raise SimulationError(f"simulate: method={method!r}; expected auto, {', '.join(methods)}")
    return Options("dop853" if method == "auto" else method, rtol, atol, max_step)


def kept_by(constraints: object) -> str | tuple[float, float]:
    """Return how constraints are kept: a word, or the frequency and the damping ratio of Baumgarte's stabilisation.

    Raises:
        SimulationError: neither.
    """
    if isinstance(constraints, str) and constraints in KEPT:
        return constraints
    if isinstance(constraints, tuple | list) and len(constraints) == 2:
        omega, zeta = map(float, constraints)
        return omega, zeta
    raise SimulationError(
        f"simulate: constraints={described(constraints)}; expected 'projection', 'baumgarte', 'free', or (omega, zeta) "
        "for Baumgarte's stabilisation"
    )
