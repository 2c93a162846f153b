"""The tape, for the layers above: expressions lowered to straight-line code."""

from symbody.symbolic._core import Tape

__all__ = ["Tape"]
