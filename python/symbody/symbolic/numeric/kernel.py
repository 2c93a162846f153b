"""The kernel of linear systems: its address, workspace and source, and the deficient systems that it met."""

from typing import TypeAlias

from symbody.symbolic._core import kernel_address, kernel_source, kernel_workspace, take_deficiencies

__all__ = ["Noted", "kernel_address", "kernel_source", "kernel_workspace", "take_deficiencies"]

Noted: TypeAlias = tuple[int, int, list[int], list[tuple[int, list[int]]]]
"""A system: its index, its number of equations, the dependent ones, and the contradicting ones."""
