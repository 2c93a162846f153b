"""The tape: expressions as straight-line code, for the layers above."""

from symbody.symbolic._core import Tape

__all__ = ["Tape"]
