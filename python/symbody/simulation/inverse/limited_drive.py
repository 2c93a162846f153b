"""Motors with limits in inverse dynamics: the effort that a motion needs, and the effort that they can deliver."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.errors import notify
from symbody.multibody import Element, Variables
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic.given.arguments import brief

__all__ = ["LimitedDrive", "limited_drives", "tell_passed_efforts"]

Array = NDArray[np.float64]

_ROUNDED = 1e-9
"""The relative excess of an effort over a limit that counts as rounding: efforts are solutions of linear equations."""


class LimitedDrive(NamedTuple):
    """A motor with limits whose effort is solved for.

    Attributes:
        name: its name in messages.
        asked: the effort without limits.
        given: the effort that it delivers, clipped at the limits.
        limits: the name of each limit, its value, and by how much the effort exceeds it.
    """

    name: str
    asked: Expr
    given: Expr
    limits: tuple[tuple[str, Expr, Expr], ...]


def limited_drives(system: Variables, loads: Collection[Expr]) -> tuple[LimitedDrive, ...]:
    """Return the motors with limits whose efforts contain some of the loads that are solved for."""
    motors = (
        each for each in getattr(system, "loads", ()) if isinstance(each, Element) and "effort" in each.law
    )
    unknown = {*loads}
    return tuple(
        LimitedDrive(brief(motor), motor.law["effort"], motor["effort"], limits)
        for motor in motors
        if (limits := _limits(motor)) and not free_symbols([motor.law["effort"]]).isdisjoint(unknown)
    )


def _limits(motor: Element) -> tuple[tuple[str, Expr, Expr], ...]:
    """Return the limits of a motor: their names and values, and by how much the effort exceeds them."""
    law = motor.law
    asked, low, high = law["effort"], law.get("least_effort"), law.get("largest_effort")
    if "limit" in law:
        low, high = -law["limit"], law["limit"]
    least = () if low is None else (("least", low, low - asked),)
    largest = () if high is None else (("largest", high, asked - high),)
    return *least, *largest


def tell_passed_efforts(
    drives: Sequence[LimitedDrive],
    instants: Array,
    evaluate: Callable[[Sequence[ExprLike]], Array],
    where: str,
) -> None:
    """Give a notice of each limit that the effort of a motor exceeds.

    Args:
        drives: the motors.
        instants: those of the motion, in s.
        evaluate: gives expressions along the motion, a row for each.
        where: the function that the user called, for messages.
    """
    for drive in drives:
        for name, limit, beyond in drive.limits:
            asked, bound, excess = evaluate([drive.asked, limit, beyond])
            passed = excess > _ROUNDED * (1 + np.abs(bound))
            if passed.any():
                most, first = int(np.argmax(excess)), int(np.argmax(passed))
                notify(
                    f"{where}: the motion needs an effort of {asked[most]:.4g} from {drive.name}, whose {name} effort "
                    f"is {bound[most]:.4g}, first exceeded at t = {instants[first]:.6g} s; the loads are computed "
                    "without limits; expected a slower motion or a stronger motor"
                )
