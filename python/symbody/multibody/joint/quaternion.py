"""Pairs whose coordinates are Euler parameters, and whose speeds are velocities in the child's axes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from symbody.errors import JointError
from symbody.geometry import Frame, Scalar, floating_frame, ground
from symbody.geometry.component.triple import NULL
from symbody.geometry.component.twist import Twist
from symbody.geometry.motion.floating import Floating, quaternion_rates, rotation_rows
from symbody.geometry.motion.placement import Placement
from symbody.symbolic import Expr, functions_of_time
from symbody.symbolic.given.arguments import counted

from .closure import Closure, Sides, held_point
from .pair import Pair

_EULER = ("e0", "e1", "e2", "e3")


def check_own_coordinates(where: str, given: Sequence[Scalar] | None, axes: str | None) -> None:
    """Raise an error for coordinates, or axes of Euler angles, beside a quaternion."""
    if axes is not None:
        raise JointError(
            f"{where}: quaternion=True and axes={axes!r}; a quaternion has no axes of Euler angles: leave one of "
            "both out"
        )
    if given is not None:
        raise JointError(
            f"{where}: quaternion=True and {counted(len(given), 'coordinate')}; the Euler parameters have names of "
            "their own: leave coordinates out"
        )


@final
class Floater(Pair):
    """All six freedoms, as those of a floating frame."""

    def __init__(self, name: str) -> None:
        self.names = ("x", "y", "z", *_EULER)
        self._name = name

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        return floating_frame(self._name, position=coordinates[:3], quaternion=coordinates[3:])

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        del sides
        return ()


@final
class Ball(Pair):
    """The three freedoms of a rotation, with the angular velocity p, q, r in the child's axes."""

    def __init__(self, name: str) -> None:
        self.names = _EULER
        self._name = name

    def motion(self, coordinates: Sequence[Expr]) -> Frame:
        e0, e1, e2, e3 = coordinates
        quaternion = e0, e1, e2, e3
        p, q, r = functions_of_time([f"{each}_{self._name}" for each in "pqr"])
        rates = dict(zip(quaternion, quaternion_rates(quaternion, (p, q, r)), strict=True))
        pose = Placement(rotation_rows(quaternion), NULL)
        return ground.then(Floating(pose, Twist((p, q, r), NULL), rates, (p, q, r), quaternion))

    def closures(self, sides: Sides) -> tuple[Closure, ...]:
        return held_point(sides)
