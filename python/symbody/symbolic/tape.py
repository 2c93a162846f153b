"""The tape, for the layers above: expressions lowered to straight-line code, and the kernel that solves its systems."""

from symbody.symbolic._core import Tape, kernel_address, kernel_workspace, take_deficiencies

__all__ = ["Tape", "kernel_address", "kernel_workspace", "take_deficiencies"]
