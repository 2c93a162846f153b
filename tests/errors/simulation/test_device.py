"""Mistakes with devices: their whole messages."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from symbody import errors, models, newton_euler, simulate_many
from symbody.simulation.device import devices

FREE, LOOP = models.n_pendulum(1), models.four_bar()


def message(model: models.ClassicSystem = FREE, **options: Any) -> str:
    """The message of a batch that is refused."""
    with pytest.raises(errors.SimulationError) as caught:
        simulate_many(
            newton_euler(model.system), model.parameters, model.initial, **{"device": "cuda", **options}
        )
    return str(caught.value)


def without(name: str) -> None:
    raise AssertionError(f"{name} is not asked for")


@pytest.fixture
def never(monkeypatch: pytest.MonkeyPatch) -> None:
    """A device that no call gets as far as asking for."""
    monkeypatch.setitem(devices.DEVICES, "cuda", lambda: without("the device"))


@pytest.mark.usefixtures("never")
def test_what_a_device_cannot_do() -> None:
    assert message(device="gpu") == (
        "simulate_many: device='gpu'; expected 'cuda', or None for threads of this process"
    )
    assert message(method="bdf") == (
        "simulate_many: device='cuda' doesn't run method='bdf'; use an explicit method, 'dop853' and 'tsit5', or leave "
        "out device: threads of this process can do it"
    )
    assert message(sensitivities=[FREE["m1"]]) == (
        "simulate_many: device='cuda' doesn't integrate sensitivities; leave them out, or leave out device: threads of "
        "this process can do it"
    )
    assert message(LOOP, constraints="baumgarte", guess=LOOP.guess) == (
        "simulate_many: device='cuda' enforces constraints by projection alone, and constraints='baumgarte'; use "
        "constraints='projection', or leave out device: threads of this process can do it"
    )
    with ThreadPoolExecutor(1) as pool:
        assert message(executor=pool) == (
            "simulate_many: device='cuda' and an executor; give one of them: the device is fed by this process"
        )


def test_cupy_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cupy", None)
    assert message() == (
        "simulate_many: device='cuda' needs the package CuPy, which is not installed here: pip install "
        '"symbody[cuda]"; or leave out device: threads of this process integrate the motions'
    )


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (
            RuntimeError("cudaErrorInsufficientDriver: the driver is too old"),
            "cudaErrorInsufficientDriver: the driver is too old",
        ),
        (0, "there is none"),
    ],
)
def test_there_is_no_graphics_processor(
    answer: RuntimeError | int, reason: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def count() -> int:
        if isinstance(answer, RuntimeError):
            raise answer
        return answer

    cupy = ModuleType("cupy")
    cupy.cuda = SimpleNamespace(runtime=SimpleNamespace(getDeviceCount=count))  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "cupy", cupy)
    assert message() == (
        "simulate_many: device='cuda' needs a graphics processor of NVIDIA and its driver, which CuPy doesn't find "
        f"({reason}); check it by nvidia-smi, or leave out device: threads of this process integrate the motions"
    )
