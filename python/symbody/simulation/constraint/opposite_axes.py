"""Opposite axes: joints whose conditions hold, but whose sides are turned by half a turn.

The conditions of a joint that closes a loop are products of axes, ``p . c = 0``, which are regular near every closed
position. They are also zero where an axis of the child is opposite to the one of the parent that it should be along, so
that the sign is checked wherever a position is found: ``p . c > 0``.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.errors import ConstraintError
from symbody.multibody import System
from symbody.simulation.given.given_input import substitute_inputs
from symbody.symbolic import Expr, free_symbols, t
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.wording import joined_by_and

from .kinematics import Kinematics

if TYPE_CHECKING:
    from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["are_turned", "check_senses", "turned_joint"]

Array = NDArray[np.float64]

_ALONG = 0.5
"""Products of axes are 1 where the joint is closed, and -1 or 0 elsewhere."""


def check_senses(kinematics: Kinematics, p: Array, time: float, q: Array, where: str) -> None:
    """Check that no joint is closed with opposite axes at a position that satisfies the constraints.

    Args:
        kinematics: the constraints.
        p: the values of their parameters.
        time: the time, in s.
        q: the coordinates, shape (n_q,).
        where: the function that the user called, for messages.

    Raises:
        ConstraintError: the sides of a joint are turned relative to each other.
    """
    fault = turned_joint(kinematics, p, time, q)
    if fault:
        raise ConstraintError(f"{where}: {fault}")


def turned_joint(kinematics: Kinematics, p: Array, time: float, q: Array) -> str:
    """Return which joint is closed with opposite axes at a position, and the way out; the empty text if none is."""
    found = _senses(kinematics)
    if found is None:
        return ""
    values = iter(found.products(q, time, p)[0])
    for joint, axes in found.axes.items():
        products = {axis: float(next(values)) for axis in axes}
        wrong = {axis: product for axis, product in products.items() if product < _ALONG}
        if wrong:
            return _turned(joint, wrong, time)
    return ""


def are_turned(kinematics: Kinematics, p: Array, time: float, q: Array) -> NDArray[np.bool_]:
    """Return at which of k positions, shape (k, n_q), a joint is closed with opposite axes, shape (k,)."""
    found = _senses(kinematics)
    if found is None:
        return np.zeros(len(q), dtype=bool)
    products = found.products.at_few_points(q.T, time, p.T)[0]
    return np.asarray((products < _ALONG).any(axis=0))


class _Senses(NamedTuple):
    """The joints that close loops, the axes that they keep parallel, and the function of their products."""

    axes: dict[PlacedJoint, tuple[str, ...]]
    products: CompiledFunction


@lru_cache(maxsize=64)
def _senses(kinematics: Kinematics) -> _Senses | None:
    """Return the products of axes that may be negative; None if there are none."""
    system = kinematics.system
    names = (*system.coordinates, t, *kinematics.parameters)
    axes: dict[PlacedJoint, tuple[str, ...]] = {}
    products: list[Expr] = []
    for joint in system.joints if isinstance(system, System) else ():
        senses = joint.senses
        values = substitute_inputs(system, kinematics.given, [*senses.values()])
        if any(value != 1 for value in values) and free_symbols(values) <= {*names}:
            axes[joint] = tuple(senses)
            products += values
    if not axes:
        return None
    return _Senses(axes, lambdify([list(system.coordinates), t, list(kinematics.parameters)], [products]))


def _turned(joint: PlacedJoint, wrong: Mapping[str, float], time: float) -> str:
    one, other = brief(joint.joint.parent), brief(joint.joint.child)
    how = "opposite to" if all(product < -_ALONG for product in wrong.values()) else "not along"
    which = f"axes {joined_by_and(sorted(wrong))} on {other} are {how} those" if len(wrong) > 1 else ""
    which = which or f"axis {next(iter(wrong))} on {other} is {how} that"
    return (
        f"at t = {time:g} s {joint} would close with the child turned over: its {which} on {one}; give a "
        "guess={coordinate: value} nearer to the position at which they have one direction, or turn the place `to` by "
        "half a turn if you mean this position"
    )
