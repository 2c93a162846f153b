"""Triples of expressions: the components of a vector in one frame, one call for each operation."""

from __future__ import annotations

from symbody.symbolic._core import (
    add3,
    cross3,
    dot3,
    matvec3,
    matvec3_transposed,
    rotate3,
    rotate_back3,
    scale3,
    sub3,
    sum_of,
)

__all__ = [
    "add3",
    "cross3",
    "dot3",
    "matvec3",
    "matvec3_transposed",
    "rotate3",
    "rotate_back3",
    "scale3",
    "sub3",
    "sum_of",
]
