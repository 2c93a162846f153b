"""The devices by name, and the tasks that they can run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

from symbody.errors import ProgramError, SimulationError
from symbody.simulation.integrate.methods import methods_that
from symbody.simulation.integrate.task import Task
from symbody.symbolic.given.wording import joined_by_and

from .cuda import cuda
from .device import Device
from .integrate import Prepared, method_on_device
from .kernel_text import kernel_of

__all__ = ["DEVICES", "on_device", "prepared"]

DEVICES: dict[str, Callable[[], Device]] = {"cuda": cuda}
"""The functions that return a device, or raise an error if it is not there."""


def on_device(task: Task, name: object, where: str) -> Task:
    """Return the task for a device, compiled for it.

    Args:
        task: the task.
        name: the name of the device; None for threads of this process.
        where: the function that the user called, for messages.

    Raises:
        SimulationError: there is no such device, or it can't do what the task needs.
    """
    if name is None:
        return task
    if not isinstance(name, str) or name not in DEVICES:
        known = ", ".join(map(repr, DEVICES))
        raise SimulationError(
            f"{where}: device={name!r}; expected {known}, or None for threads of this process"
        )
    _check_abilities(task, f"{where}: device={name!r}")
    found = replace(task, device=name, method=method_on_device(task.method, prepared))
    try:
        prepared(found)
    except SimulationError as error:
        raise SimulationError(f"{where}: {error}") from error
    except ProgramError as error:
        raise SimulationError(
            f"{where}: device={name!r} can't run the model: {error}; {_LEAVE_OUT}"
        ) from error
    return found


@lru_cache(maxsize=4)
def prepared(task: Task) -> Prepared:
    """Return the device of a task, and its kernel there."""
    assert task.device is not None, "the task is for a device"
    device, kernel = DEVICES[task.device](), kernel_of(task)
    return device, kernel, device.load(kernel.text)


_LEAVE_OUT = "or leave out device: threads of this process can do it"


def _check_abilities(task: Task, place: str) -> None:
    if not task.method.is_explicit:
        able = joined_by_and(methods_that(lambda method: method.is_explicit), most=9)
        raise SimulationError(
            f"{place} doesn't run method={task.options.method!r}; use an explicit method, {able}, {_LEAVE_OUT}"
        )
    if task.by:
        raise SimulationError(f"{place} doesn't integrate sensitivities; leave them out, {_LEAVE_OUT}")
    if task.model.constraints and not task.is_projected:
        raise SimulationError(
            f"{place} enforces constraints by projection alone, and constraints={task.constraints!r}; use "
            f"constraints='projection', {_LEAVE_OUT}"
        )
