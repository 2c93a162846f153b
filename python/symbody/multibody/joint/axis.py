"""Axes of joints: the principal ones of the frames in which they are given."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, TypeAlias

from symbody.errors import JointError
from symbody.symbolic.given.arguments import brief

from .closure import AXES

Axis: TypeAlias = Annotated[
    str, "'X', 'Y' or 'Z'; for another axis, turn the places: at=rotate(...), to=rotate(...)"
]

Axes: TypeAlias = Annotated[str, "a text of the letters X, Y and Z, such as 'ZYX'"]


def principal(axis: str, where: str) -> str:
    """Return the letter of an axis.

    Raises:
        JointError: it is another text.
    """
    if len(axis) != 1 or axis.upper() not in AXES:
        raise JointError(
            f"{where}: unknown axis {brief(repr(axis))}; expected 'X', 'Y' or 'Z'; for another axis, turn the places: "
            "at=rotate(...), to=rotate(...)"
        )
    return axis.upper()


def sequence(axes: str, where: str, count: int) -> str:
    """Return the letters of axes about which rotations follow each other.

    Raises:
        JointError: it is another text, or two neighbours are the same, which leaves a freedom out.
    """
    letters = axes.upper()
    neighbours = pairwise(letters)
    if len(letters) != count or not {*letters} <= {*AXES} or any(a == b for a, b in neighbours):
        example = {2: "'XY'", 3: "'ZYX' or 'ZXZ'"}[count]
        raise JointError(
            f"{where}: unknown axes {brief(repr(axes))}; expected {count} letters of which neighbours differ, such as "
            f"{example}"
        )
    return letters
