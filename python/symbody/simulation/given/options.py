"""What a user says of when and how to integrate."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import SimulationError
from symbody.symbolic.given.arguments import described

__all__ = ["KEPT", "Options", "check_options", "constraint_handling", "instants_of"]

KEPT = ("projection", "baumgarte", "free")
"""The ways to keep constraints: back onto them after each step; by damping what is off; not at all."""


@dataclass(frozen=True)
class Options:
    """How to integrate.

    Attributes:
        method: the name of the method.
        rtol: the error of a step relative to the state.
        atol: the error of a step where the state is small.
        max_step: the longest step, in s.
    """

    method: str = "dop853"
    rtol: float = 1e-8
    atol: float = 1e-10
    max_step: float = inf


def instants_of(given: ArrayLike, where: str = "simulate") -> NDArray[np.float64]:
    """Return the instants of a simulation: a pair means 1001 of them, evenly spaced.

    Raises:
        SimulationError: they aren't finite numbers that increase.
    """
    try:
        instants = np.array(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        instants = np.empty(0)
    is_row = instants.ndim == 1 and len(instants) >= 2
    if not is_row or not np.isfinite(instants).all() or (np.diff(instants) <= 0).any():
        shown = (
            np.array2string(np.asarray(given), threshold=6, separator=", ") if is_row else described(given)
        )
        raise SimulationError(
            f"{where}: t={shown}; expected the first and the last instant, or all instants, increasing"
        )
    return np.linspace(instants[0], instants[1], 1001) if len(instants) == 2 else instants


def check_options(rtol: object, atol: object, max_step: object, where: str = "simulate") -> None:
    """See that tolerances and the longest step are positive numbers.

    Raises:
        SimulationError: one isn't.
    """
    for name, value in {"rtol": rtol, "atol": atol, "max_step": max_step}.items():
        if not _is_positive(value) or (value == inf and name != "max_step"):
            raise SimulationError(f"{where}: {name}={value!r}; expected a positive number")


def _is_positive(value: object) -> bool:
    """Whether something is a positive number that a double can hold."""
    try:
        return not isinstance(value, bool) and isinstance(value, Real) and float(value) > 0
    except OverflowError:
        return False


def constraint_handling(constraints: object, where: str = "simulate") -> str | tuple[float, float]:
    """Return how constraints are kept: a word, or the frequency and the damping ratio of Baumgarte's stabilisation.

    Raises:
        SimulationError: neither.
    """
    if isinstance(constraints, str) and constraints in KEPT:
        return constraints
    if isinstance(constraints, tuple | list) and len(constraints) == 2:
        omega, zeta = constraints
        if all(_is_positive(value) and value < inf for value in (omega, zeta)):
            return float(omega), float(zeta)
        raise SimulationError(
            f"{where}: constraints=({omega!r}, {zeta!r}); expected two positive numbers, omega in rad/s and zeta: "
            "what is off would grow otherwise"
        )
    raise SimulationError(
        f"{where}: constraints={described(constraints)}; expected 'projection', 'baumgarte', 'free', or (omega, zeta) "
        "for Baumgarte's stabilisation"
    )
