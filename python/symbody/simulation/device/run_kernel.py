"""Runs a kernel until all motions of a batch have ended."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.options import Options

from .device import Device, Loaded
from .endings import Column, Endings
from .kernel_text import Kernel

__all__ = ["MOST_EVENTS", "bytes_of_case", "run_kernel"]

Array = NDArray[np.float64]

MOST_EVENTS = 64
"""The most events of a motion on a device; a motion with more of them is integrated by the host."""

TURNS = 64
"""The number of steps that each thread tries in the first launch."""

LAUNCH = 0.05
"""The aim for the duration of a launch, in s: between two of them, the host looks for Ctrl-C."""


def bytes_of_case(kernel: Kernel, instants: int) -> int:
    """Return the memory that a motion takes on a device and in what comes back from it, in bytes."""
    events = MOST_EVENTS if kernel.has_events else 0
    numbers = kernel.width * (instants + 1) + len(kernel.parameters) + events * (2 + kernel.width)
    return 8 * (numbers + 1 + len(Column))


def run_kernel(
    device: Device,
    loaded: Loaded,
    kernel: Kernel,
    options: Options,
    instants: Array,
    parameters: Array,
    states: Array,
    keep_going: Callable[[float], bool],
) -> Endings:
    """Integrate motions on a device; those that had not ended when `keep_going` returned False are still running.

    Args:
        device: the device.
        loaded: the kernel on the device.
        kernel: the kernel.
        options: the tolerances and the longest step.
        instants: the instants of the results, shape (N,), in s.
        parameters: the values of the parameters, shape (k, parameters).
        states: the initial states, shape (k, width).
        keep_going: called between launches with the number of motions that have ended.
    """
    cases, most = len(states), MOST_EVENTS if kernel.has_events else 0
    threads = min(loaded.threads("advance"), -(-cases // loaded.block) * loaded.block)
    size = device.put(np.zeros(1, dtype=np.int64))
    loaded.launch("measure", loaded.block, size)
    lanes = device.empty((threads * int(device.get(size)[0]),), np.uint8)
    loaded.launch("clear", threads, lanes)
    results = (
        device.empty((cases, len(instants), kernel.width), np.float64),
        device.put(np.full(cases, np.nan)),
        device.empty((cases, most, 2 + kernel.width), np.float64),
        device.put(np.zeros((cases, len(Column)), dtype=np.int64)),
    )
    queue = device.put(np.zeros(2, dtype=np.uint64))
    given: list[Any] = [*map(np.int64, (cases, len(instants), most))]
    given += map(np.float64, (options.rtol, options.atol, options.max_step))
    given += [device.put(np.ascontiguousarray(each, float)) for each in (instants, states, parameters)]
    turns = TURNS
    while True:
        begin = monotonic()
        loaded.launch("advance", threads, lanes, np.int64(turns), *given, *results, queue)
        done = int(device.get(queue)[1])
        if done == cases or not keep_going(done):
            break
        turns = int(np.clip(turns * LAUNCH / max(monotonic() - begin, 1e-6), max(turns // 2, 1), 4 * turns))
    along, ends, events, counts = map(device.get, results)
    return Endings(counts, ends, along, events)
