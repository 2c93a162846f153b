"""The kernel of linear systems, for machine code: where it is, the room it needs, and the deficient systems it met."""

from symbody.symbolic._core import kernel_address, kernel_workspace, take_deficiencies

__all__ = ["kernel_address", "kernel_workspace", "take_deficiencies"]
