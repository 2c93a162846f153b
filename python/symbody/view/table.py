"""The frames of a page."""

from __future__ import annotations

from symbody.geometry import Frame


class FrameTable:
    """The frames whose poses a page carries, each with its place in the list."""

    def __init__(self) -> None:
        self._places: dict[Frame, int] = {}

    @property
    def frames(self) -> list[Frame]:
        """The frames, in the order in which they came."""
        return list(self._places)

    def place(self, frame: Frame) -> int:
        """Return the place of a frame, which is added if it is new."""
        return self._places.setdefault(frame, len(self._places))
