"""Measure many motions on a graphics processor: simulate_many(device="cuda") beside JAX on the same processor.

    python -m benchmarks.simulate.gpu [--side 1000] [--rounds 5]

It needs a graphics processor of NVIDIA, `pip install "symbody[cuda]"`, and `jax[cuda12]` and `diffrax` for the rivals.
It prints a table: side x side double pendulums of ten seconds, each contender with the loosest setting that keeps the
error.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from statistics import median
from time import perf_counter

import numpy as np

from symbody import simulate_many
from symbody.simulation.device import devices
from symbody.simulation.device.run_kernel import run_kernel
from symbody.simulation.integrate.task import Task
from symbody.simulation.integrate.task_of import task_of

from . import by_diffrax, by_jax
from .batches import ERROR, starts
from .double_pendulum import double_pendulum
from .problem import Array, Problem
from .throughput import Manner

SAMPLE = 2000
"""The motions whose ends are compared with those of small tolerances."""

AIM = 3.0
"""How many times the rate of JAX's best is aimed at."""

BLOCKS = (32, 64, 128, 256)
"""Threads of a block that are tried."""


def main() -> None:
    """Parse the command line, measure, print."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.simulate.gpu", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--side", type=int, default=1000, help="side x side motions (default 1000)")
    parser.add_argument("--rounds", type=int, default=5, help="trials of each contender (default 5)")
    arguments = parser.parse_args()
    problem = double_pendulum()
    print(f"{described()}\n")
    for line in [*lines(problem, [*ours(problem), *theirs(problem)], arguments.side, arguments.rounds)]:
        print(line, flush=True)


def described() -> str:
    """Return what is there: the processor, and where JAX computes."""
    import cupy  # noqa: PLC0415 - the processor is looked for first

    name = cupy.cuda.runtime.getDeviceProperties(0)["name"].decode()
    if by_jax.missing():
        return f"{name}; without its rivals: {by_jax.missing()} is not installed"
    import jax  # noqa: PLC0415

    lacking = by_diffrax.missing()
    return f"{name}; JAX {jax.__version__} on {jax.devices()[0]}{f'; without {lacking}' if lacking else ''}"


def ours(problem: Problem) -> list[Manner]:
    """Return symbody's manners: the whole call, and the kernel alone, with blocks of several sizes."""
    tolerances = tuple(float(f"{digit}e-{k}") for k in range(5, 13) for digit in (3, 1))
    methods = ("tsit5", "dop853")
    whole = [
        Manner(f"simulate_many, device, {method}", partial(_simulate_many, problem, method), tolerances)
        for method in methods
    ]
    kernels = [
        Manner(
            f"kernel alone, {method}, blocks of {block}", partial(_kernel, problem, method, block), tolerances
        )
        for method in methods
        for block in BLOCKS
    ]
    return [*whole, *kernels]


def theirs(problem: Problem) -> list[Manner]:
    """Return JAX's manners."""
    if by_jax.missing():
        return []
    steps = tuple(float(round(8 * problem.duration * 1.1**k) * 10) for k in range(12))
    tolerances = tuple(float(f"{digit}e-{k}") for k in range(7, 13) for digit in (3, 1))
    found = [
        Manner("JAX, vmap of RK4 in lax.scan", by_jax.by_runge_kutta(problem), steps, "steps"),
        Manner("JAX, vmap of odeint", by_jax.by_odeint(problem), tolerances),
    ]
    if not by_diffrax.missing():
        found.append(Manner("JAX, vmap of diffrax's Tsit5", by_diffrax.by_tsit5(problem), tolerances))
    return found


def lines(problem: Problem, manners: list[Manner], side: int, rounds: int) -> Iterator[str]:
    """Yield the rows of the table."""
    states = starts(side)
    some = np.random.default_rng(7).choice(len(states), min(SAMPLE, len(states)), replace=False)
    ends = _simulate_many(problem, "dop853", states[some], 1e-13, device=None)
    yield f"{len(states)} motions of {problem.duration:g} s, error at most {ERROR:g} rad"
    yield f"{'':<44} {'setting':>10} {'error':>9} {'first, s':>9} {'s':>8} {'motions/s':>11}"
    rates: dict[str, float] = {}
    for manner in manners:
        setting, error = _setting(manner, states[some], ends)
        begin = perf_counter()
        manner.many(states, setting)
        first, times = perf_counter() - begin, []
        for _ in range(rounds):
            begin = perf_counter()
            manner.many(states, setting)
            times.append(perf_counter() - begin)
        rate = rates[manner.label] = len(states) / median(times)
        yield f"{manner.label:<44} {setting:>10g} {error:>9.1e} {first:>9.2f} {median(times):>8.3f} {rate:>11.0f}"

    yield from verdict(rates)


def verdict(rates: dict[str, float]) -> Iterator[str]:
    """Yield the best rate beside the rivals' best, and what is aimed at."""
    own, rivals = (
        {label: rate for label, rate in rates.items() if label.startswith("JAX") == is_rival}
        for is_rival in (False, True)
    )
    if own and rivals:
        best, rival = max(own, key=own.__getitem__), max(rivals, key=rivals.__getitem__)
        ratio = own[best] / rivals[rival]
        yield f"{best}: {ratio:.2f} times the best of JAX ({rival}); aim: {AIM:g} times"


def _setting(manner: Manner, states: Array, ends: Array) -> tuple[float, float]:
    """Return the first setting of a manner that is accurate enough, and its error."""
    for setting in manner.settings:
        error = float(np.abs(manner.many(states, setting)[:, :2] - ends[:, :2]).max())
        if error <= ERROR:
            return setting, error
    raise RuntimeError(f"{manner.label}: no setting reaches an error of {ERROR}")


def _simulate_many(
    problem: Problem, method: str, states: Array, tolerance: float, device: str | None = "cuda"
) -> Array:
    runs = simulate_many(
        problem.equations,
        problem.parameters,
        dict(zip(problem.model.state, states.T, strict=True)),
        np.linspace(0, problem.duration, 3),
        method=method,
        rtol=tolerance,
        atol=tolerance,
        device=device,
        progress=False,
    )
    return np.asarray(runs.states[:, -1])


@cache
def _task(problem: Problem, method: str) -> Task:
    """Return a task that is compiled for the device once."""
    task = task_of(
        problem.equations,
        problem.parameters,
        np.linspace(0, problem.duration, 3),
        inputs=None,
        method=method,
        rtol=1e-6,
        atol=1e-6,
        outputs=None,
        events=None,
        constraints="projection",
        guess=None,
        max_step=np.inf,
    )
    return devices.on_device(task, "cuda", "benchmark")


def _kernel(problem: Problem, method: str, block: int, states: Array, tolerance: float) -> Array:
    """Integrate on the device, with the copies of states and results, but without what Python does for each batch."""
    task = _task(problem, method)
    device, kernel, loaded = devices.prepared(task)
    loaded.block = block
    rows = np.broadcast_to(problem.values, (len(states), len(problem.values)))
    options = replace(task.options, rtol=tolerance, atol=tolerance)
    wide = np.zeros((len(states), kernel.width))
    wide[:, : states.shape[1]] = states
    found = run_kernel(device, loaded, kernel, options, task.instants, rows, wide, lambda _: True)
    return found.states[:, -1]


if __name__ == "__main__":
    main()
