"""JAX: symbody's generated functions, mapped over all motions, compiled by XLA for the processor, in 64 bits."""

from __future__ import annotations

import importlib.util
import shutil
from collections.abc import Callable
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import numpy as np

from symbody import generate
from symbody.symbolic import Argument, Program, Result, Routine

from .problem import Array, Problem, instants

Many = Callable[[Array, float], Array]
"""Takes a row for each initial state and a setting; returns a row for each end."""


def missing() -> str:
    """Return what to install, nothing if all is there."""
    return "" if importlib.util.find_spec("jax") else "JAX (pip: jax)"


def rates(problem: Problem) -> Callable[[Any], Any]:
    """Return the rates of a state as a function of JAX, made by symbody's code target for it."""
    import jax.numpy as jnp  # noqa: PLC0415 - it is looked for first

    model, n = problem.model, problem.size
    arguments = (
        Argument("p", "parameters", model.parameters, "parameters"),
        Argument("q", "positions", model.coordinates, "positions"),
        Argument("u", "speeds", model.speeds, "velocities"),
    )
    result = Result("a", "accelerations", tuple(model.solution.accelerations), (n,))
    routine = Routine("accelerations", "accelerations", ("p", "q", "u"), (result,))
    module = _loaded(Program("motion", problem.name, arguments, (routine,)))
    constants = module.prepare(jnp.asarray(problem.values))

    def rate(y: Any) -> Any:
        q, u = y[:n], y[n:]
        return jnp.concatenate([u, module.accelerations(constants, q, u)])

    return rate


def _loaded(program: Program) -> Any:
    folder = Path(mkdtemp(prefix="simulate-"))
    try:
        generate(program, "jax", folder)
        spec = importlib.util.spec_from_file_location("generated_motion", folder / f"{program.name}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def by_odeint(problem: Problem) -> Many:
    """Return `jax.experimental.ode.odeint` (Dormand-Prince 5, adaptive) of all motions; the setting is a tolerance."""
    import jax  # noqa: PLC0415
    import jax.numpy as jnp  # noqa: PLC0415
    from jax.experimental.ode import odeint  # noqa: PLC0415

    rate, both = rates(problem), jnp.asarray(instants(problem.duration))

    def one(start: Any, tolerance: Any) -> Any:
        return odeint(lambda y, _t: rate(y), start, both, rtol=tolerance, atol=tolerance)[-1]

    compiled: dict[float, Any] = {}

    def many(starts: Array, tolerance: float) -> Array:
        if tolerance not in compiled:
            compiled[tolerance] = jax.jit(jax.vmap(lambda start: one(start, tolerance)))
        return np.asarray(compiled[tolerance](starts))

    return many


def by_runge_kutta(problem: Problem) -> Many:
    """Return the classical method of order 4 in `lax.scan` over equal steps; the setting is their number."""
    import jax  # noqa: PLC0415

    rate, duration = rates(problem), problem.duration

    def one(start: Any, steps: int) -> Any:
        h = duration / steps

        def step(y: Any, _: None) -> tuple[Any, None]:
            k1 = rate(y)
            k2 = rate(y + h / 2 * k1)
            k3 = rate(y + h / 2 * k2)
            k4 = rate(y + h * k3)
            return y + h / 6 * (k1 + 2 * (k2 + k3) + k4), None

        return jax.lax.scan(step, start, None, length=steps)[0]

    compiled: dict[int, Any] = {}

    def many(starts: Array, steps: float) -> Array:
        count = int(steps)
        if count not in compiled:
            compiled[count] = jax.jit(jax.vmap(lambda start: one(start, count)))
        return np.asarray(compiled[count](starts))

    return many
