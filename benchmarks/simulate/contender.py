"""Contenders: who integrates a problem, and at which tolerances."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .problem import Array


@dataclass(frozen=True)
class Contender:
    """One method of one tool on one problem, ready to run.

    Attributes:
        tool: whose it is.
        method: which one.
        tolerances: what it is tried at, relative and absolute alike.
        end: integrates at a tolerance over a duration, and returns the state at the last instant.
    """

    tool: str
    method: str
    tolerances: tuple[float, ...]
    end: Callable[[float, float], Array]

    @property
    def label(self) -> str:
        """What the report calls it."""
        return f"{self.tool}, {self.method}"


def decades(finest: int, loosest: int = 3) -> tuple[float, ...]:
    """Return tolerances from ``10**-loosest`` down to ``10**-finest``."""
    return tuple(float(f"1e-{k}") for k in range(loosest, finest + 1))
