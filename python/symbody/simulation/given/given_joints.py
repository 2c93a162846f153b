"""Checks of joints whose dimensions depend on parameters: radii and pitches that the given values make senseless."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import notify
from symbody.multibody import System, Variables
from symbody.multibody.joint.pair import Size
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import Expr, number

from .given_bodies import counted_cases
from .given_elements import size_in_cases

__all__ = ["warn_of_senseless_dimensions"]


def warn_of_senseless_dimensions(system: Variables, given: Mapping[Expr, ArrayLike], where: str) -> None:
    """Give a notice of each dimension of a joint that is out of bounds, such as a radius that is not positive.

    There is one also for limits of angles that look like degrees.
    Those that are numbers were checked when the joint was made.

    Args:
        system: the system.
        given: the values of the parameters: a number, or one value for each case.
        where: the function that the user called, for messages.
    """
    for placed in system.joints if isinstance(system, System) else ():
        for size in placed.joint.pair.sizes:
            if size.value.is_constant:
                continue
            values = size_in_cases(size.value, given)
            places = np.flatnonzero(_out_of_bounds(size, values))
            if len(places):
                which, found = counted_cases(places, len(values)), values[places[0]]
                notify(f"{where}: {which}{placed}: {size.name} = {found:.6g}; expected {_bounds(size)}")
        _warn_of_degrees(placed, given, where)


def _warn_of_degrees(placed: PlacedJoint, given: Mapping[Expr, ArrayLike], where: str) -> None:
    """Give a notice of limits of a joint whose values look like degrees."""
    for limit in placed.limits:
        for bound in (limit.low, limit.high):
            if bound is None or bound.is_constant or not bound.free_symbols <= given.keys():
                continue
            values = size_in_cases(bound, given)
            large = np.flatnonzero(np.abs(values) > np.pi)
            faults = {int(case): limit.in_degrees(number(float(values[case]))) for case in large}
            places = [case for case, fault in faults.items() if fault]
            if places:
                which = counted_cases(np.array(places), len(values))
                notify(f"{where}: {which}{placed}: limits: {bound} = {faults[places[0]]}")
                break


def _out_of_bounds(size: Size, values: NDArray[np.float64]) -> NDArray[np.bool_]:
    below = values < size.least if size.least is not None else np.zeros(len(values), dtype=bool)
    return below if size.may_vanish else below | (values == 0)


def _bounds(size: Size) -> str:
    if size.least is None:
        return "a constant that isn't zero"
    return "a constant that isn't negative" if size.may_vanish else "a positive constant"
