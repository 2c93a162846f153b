"""Options of the integration: instants, tolerances, and how constraints are enforced."""

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
"""The enforcement of constraints: by projection after each step, by Baumgarte's stabilisation, or not at all."""


@dataclass(frozen=True)
class Options:
    """Options of the integration of a motion.

    Attributes:
        method: the name of the method.
        rtol: the tolerance of the error of a step, relative to the state.
        atol: the absolute tolerance of the error of a step.
        max_step: the longest step, in s.
    """

    method: str = "dop853"
    rtol: float = 1e-8
    atol: float = 1e-10
    max_step: float = inf


def instants_of(given: ArrayLike, where: str = "simulate") -> NDArray[np.float64]:
    """Return the instants of a simulation. A pair stands for 1001 evenly spaced instants.

    Raises:
        SimulationError: the instants are not finite, or do not increase.
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
    """Check that the tolerances and the longest step are positive numbers.

    Raises:
        SimulationError: one of them is not.
    """
    for name, value in {"rtol": rtol, "atol": atol, "max_step": max_step}.items():
        if not _is_positive(value) or (value == inf and name != "max_step"):
            raise SimulationError(f"{where}: {name}={value!r}; expected a positive number")


def _is_positive(value: object) -> bool:
    """Return whether a value is a positive number that a double can represent."""
    try:
        return not isinstance(value, bool) and isinstance(value, Real) and float(value) > 0
    except OverflowError:
        return False


def constraint_handling(constraints: object, where: str = "simulate") -> str | tuple[float, float]:
    """Return how constraints are enforced: a word, or the frequency and the damping ratio of Baumgarte's method.

    Raises:
        SimulationError: the argument is neither.
    """
    if isinstance(constraints, str) and constraints in KEPT:
        return constraints
    if isinstance(constraints, tuple | list) and len(constraints) == 2:
        omega, zeta = constraints
        if all(_is_positive(value) and value < inf for value in (omega, zeta)):
            return float(omega), float(zeta)
        raise SimulationError(
            f"{where}: constraints=({omega!r}, {zeta!r}); expected two positive numbers, omega in rad/s and zeta: "
            "violations would grow otherwise"
        )
    raise SimulationError(
        f"{where}: constraints={described(constraints)}; expected 'projection', 'baumgarte', 'free', or (omega, zeta) "
        "for Baumgarte's stabilisation"
    )
