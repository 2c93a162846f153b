"""Limits of joints at positions that were found: which ones these are beyond."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import lambdify
from symbody.errors import notify
from symbody.multibody import Variables
from symbody.symbolic import Expr, free_symbols

from .given_input import substitute_inputs

if TYPE_CHECKING:
    from symbody.multibody.joint.limit import Limit
    from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["LIMIT", "WatchedLimit", "tell_passed_limits", "watched_limits"]

LIMIT = 1e-6
"""How far beyond its limit a joint is reported, relative to the largest coordinate; events are located more closely."""


class WatchedLimit(NamedTuple):
    """A joint with limits.

    Attributes:
        joint: the joint, with the coordinate if it has several.
        limit: the limits.
        excess: what is positive beyond them, with inputs.
    """

    joint: str
    limit: Limit
    excess: tuple[Expr, ...]

    def excesses(self, values: Mapping[Expr, ArrayLike]) -> list[NDArray[np.float64]]:
        """Return how far the joint is beyond its limits; an angle is followed over its jumps along instants."""
        names = [*values]
        found = np.broadcast_arrays(*lambdify(names, [*self.excess])(*values.values()), *values.values())
        several = [np.atleast_1d(value) for value in found[: len(self.excess)]]
        return [np.unwrap(value) for value in several] if self.limit.is_within_a_turn else several


def watched_limits(
    system: Variables, with_inputs: Callable[[Sequence[Expr]], Sequence[Expr]]
) -> Iterator[WatchedLimit]:
    """Yield each joint with limits.

    Args:
        system: the system.
        with_inputs: replaces input functions of time by what was given for them.
    """
    joints: tuple[PlacedJoint, ...] = getattr(system, "joints", ())
    for joint in joints:
        for limit in joint.limits:
            of = "" if joint.label(limit) == joint.name else f" ({limit.name})"
            yield WatchedLimit(f"{joint}{of}", limit, tuple(with_inputs((*limit.excesses.values(),))))


def tell_passed_limits(
    system: Variables, values: Mapping[Expr, ArrayLike], inputs: Mapping[Expr, Expr], where: str
) -> None:
    """Give a notice of each joint that is beyond a limit at positions that were found without a motion.

    Limits that hold symbols without a value are left out.

    Args:
        system: the system.
        values: those of coordinates, parameters and the time: numbers, or arrays along instants.
        inputs: the expressions that replace input functions of time.
        where: the function that the user called, for messages.
    """
    for watched in watched_limits(
        system, lambda given: substitute_inputs(system, tuple(inputs.items()), given)
    ):
        names = free_symbols(list(watched.excess))
        if not watched.excess or not names <= values.keys():
            continue
        most = float(np.max(watched.excesses({name: values[name] for name in sorted(names, key=str)})))
        largest = max(
            (float(np.max(np.abs(values[q]))) for q in system.coordinates if q in values), default=0.0
        )
        if most > LIMIT * (1 + largest):
            notify(
                f"{where}: {watched.joint} is beyond its limit by up to {most:.3g}: limits exert no forces; expected "
                "positions within it, such as those near another guess, or a load that models the stop"
            )
