"""Vectors in LLVM's intermediate representation: types and constants of some lanes; one lane is a plain double."""

from __future__ import annotations

import struct

__all__ = ["constant", "vector_type"]


def vector_type(lanes: int, element: str = "double") -> str:
    """Return the type of so many elements.

    >>> vector_type(4), vector_type(1, "i1")
    ('<4 x double>', 'i1')
    """
    return element if lanes == 1 else f"<{lanes} x {element}>"


def constant(value: float, lanes: int) -> str:
    """Return a double, exactly, in all lanes.

    >>> constant(0.1, 1)
    '0x3FB999999999999A'
    """
    (bits,) = struct.unpack("<Q", struct.pack("<d", value))
    text = f"0x{bits:016X}"
    return text if lanes == 1 else f"<{', '.join([f'double {text}'] * lanes)}>"
