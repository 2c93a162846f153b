"""The frames of a page."""

from __future__ import annotations

from symbody.geometry import Frame


class FrameTable:
    """The frames whose poses a page contains, each with its index."""

    def __init__(self) -> None:
        self._places: dict[Frame, int] = {}

    @property
    def frames(self) -> list[Frame]:
        """The frames, in the order in which they were added."""
        return list(self._places)

    def place(self, frame: Frame) -> int:
        """Return the index of a frame; a new frame is added."""
        return self._places.setdefault(frame, len(self._places))
