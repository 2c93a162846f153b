"""Diffrax: Tsitouras' method with its own control of steps, mapped over all motions by JAX."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from typing import Any

import numpy as np

from . import by_jax
from .problem import Array, Problem

Many = Callable[[Array, float], Array]

MOST = 100_000
"""The most steps of a motion."""


def missing() -> str:
    """Return what to install, nothing if all is there."""
    return by_jax.missing() or ("" if importlib.util.find_spec("diffrax") else "diffrax (pip: diffrax)")


def by_tsit5(problem: Problem) -> Many:
    """Return `diffrax.diffeqsolve` with `Tsit5` of all motions; the setting is a tolerance."""
    import diffrax  # noqa: PLC0415 - it is looked for first
    import jax  # noqa: PLC0415

    rate, duration = by_jax.rates(problem), problem.duration
    term = diffrax.ODETerm(lambda _t, y, _args: rate(y))

    def one(start: Any, tolerance: float) -> Any:
        control = diffrax.PIDController(rtol=tolerance, atol=tolerance)
        found = diffrax.diffeqsolve(
            term,
            diffrax.Tsit5(),
            0.0,
            duration,
            None,
            start,
            stepsize_controller=control,
            max_steps=MOST,
            adjoint=diffrax.ForwardMode(),
        )
        assert found.ys is not None
        return found.ys[-1]

    compiled: dict[float, Any] = {}

    def many(starts: Array, tolerance: float) -> Array:
        if tolerance not in compiled:
            compiled[tolerance] = jax.jit(jax.vmap(lambda start: one(start, tolerance)))
        return np.asarray(compiled[tolerance](starts))

    return many
