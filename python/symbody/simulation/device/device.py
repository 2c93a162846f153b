"""What runs kernels: its memory, and calls of the functions of a text."""

from __future__ import annotations

from typing import Any, Protocol

from numpy.typing import DTypeLike, NDArray

__all__ = ["Device", "Loaded"]


class Device(Protocol):
    """A processor for kernels."""

    def load(self, text: str) -> Loaded:
        """Compile a text, and load it."""
        ...

    def put(self, values: NDArray[Any]) -> Any:
        """Return an array of the device with these values."""
        ...

    def empty(self, shape: tuple[int, ...], kind: DTypeLike) -> Any:
        """Return an array of the device without values."""
        ...

    def get(self, array: Any) -> NDArray[Any]:
        """Return the values of an array of the device."""
        ...


class Loaded(Protocol):
    """A compiled text on its device.

    Attributes:
        block: the number of threads that start and end together; a launch has whole blocks.
    """

    block: int

    def threads(self, name: str) -> int:
        """Return how many threads run a function at a time: whole blocks."""
        ...

    def launch(self, name: str, threads: int, *given: Any) -> None:
        """Call a function in so many threads, and wait for its end.

        Args:
            name: the function.
            threads: their number, in whole blocks.
            given: its arguments: arrays of the device, ``np.int64`` and ``np.float64``.
        """
        ...
