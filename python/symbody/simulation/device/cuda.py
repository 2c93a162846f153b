"""NVIDIA's graphics processors, through CuPy: NVRTC compiles a text for the processor that is there."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from symbody.errors import SimulationError
from symbody.symbolic.given.arguments import brief

__all__ = ["BLOCK", "Cuda", "cuda"]

BLOCK = 64
"""The threads of a block: two warps, so that few registers of a multiprocessor are left over."""

OPTIONS = ("--std=c++17", "--fmad=true", "--diag-suppress=177")
"""Products and sums are fused where the compiler likes; functions that a model doesn't need are no warning."""

_WAY_OUT = "leave out device: threads of this process integrate the motions"


def cuda() -> Cuda:
    """Return the graphics processor that CuPy has chosen.

    Raises:
        SimulationError: CuPy is not installed, or finds no processor; the place is added by `on_device`.
    """
    try:
        cupy = import_module("cupy")
    except ImportError as error:
        state = (
            "is not installed here"
            if isinstance(error, ModuleNotFoundError)
            else f"can't be loaded here ({brief(error)})"
        )
        raise SimulationError(
            f"device='cuda' needs the package CuPy, which {state}: pip install \"symbody[cuda]\"; or "
            f"{_WAY_OUT}"
        ) from error
    try:
        count = cupy.cuda.runtime.getDeviceCount()
    except RuntimeError as error:
        raise _no_processor(brief(error)) from error
    if not count:
        raise _no_processor("there is none")
    return Cuda(cupy)


def _no_processor(reason: str) -> SimulationError:
    return SimulationError(
        f"device='cuda' needs a graphics processor of NVIDIA and its driver, which CuPy doesn't find "
        f"({reason}); check it by nvidia-smi, or {_WAY_OUT}"
    )


class Cuda:
    """The graphics processor that CuPy has chosen."""

    def __init__(self, cupy: Any) -> None:
        self._cupy = cupy

    def load(self, text: str) -> LoadedModule:
        """Compile a text, and load it; CuPy keeps what it has compiled on disk."""
        return LoadedModule(self._cupy, self._cupy.RawModule(code=text, options=OPTIONS, backend="nvrtc"))

    def put(self, values: NDArray[Any]) -> Any:
        """Return an array of the processor with these values."""
        return self._cupy.asarray(values)

    def empty(self, shape: tuple[int, ...], kind: DTypeLike) -> Any:
        """Return an array of the processor without values."""
        return self._cupy.empty(shape, dtype=kind)

    def get(self, array: Any) -> NDArray[Any]:
        """Return the values of an array of the processor."""
        values: NDArray[Any] = np.asarray(self._cupy.asnumpy(array))
        return values


class LoadedModule:
    """A compiled text on the processor."""

    def __init__(self, cupy: Any, module: Any) -> None:
        self._cupy, self._module = cupy, module
        self.block = BLOCK

    def threads(self, name: str) -> int:
        """Return how many threads run a function at a time: as many as registers allow on all multiprocessors."""
        function = self._module.get_function(name)
        limits = self._cupy.cuda.Device().attributes
        registers = limits["MaxRegistersPerMultiprocessor"] // (self.block * max(int(function.num_regs), 1))
        blocks = min(
            registers,
            limits["MaxThreadsPerMultiProcessor"] // self.block,
            limits["MaxBlocksPerMultiprocessor"],
        )
        return int(self.block * max(blocks, 1) * limits["MultiProcessorCount"])

    def launch(self, name: str, threads: int, *given: Any) -> None:
        """Call a function in so many threads, and wait for its end."""
        function = self._module.get_function(name)
        function((threads // self.block,), (self.block,), given)
        self._cupy.cuda.get_current_stream().synchronize()
