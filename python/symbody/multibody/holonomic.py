"""Holonomic constraints: conditions on coordinates and time. Conditions on velocities are reported with a way out."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, functions_of_time, gradient, number, substitute, t
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.namesake import namesake_note

from .coordinate import rate_of_any

__all__ = ["fault_of"]

_EXPECTED = "expected coordinates and time, as constraints on velocities aren't supported"
_INTEGRATE = (
    "if it is the rate of a condition on coordinates, give that condition; if not, as for rolling, choose speeds "
    "that keep it: moving_frame(..., pose=...) and System(speeds=[...])"
)


def fault_of(constraint: Expr, coordinates: Sequence[Expr], speeds: Sequence[Expr]) -> str:
    """Return what is wrong with a constraint, and the way out; the empty text if nothing is.

    Args:
        constraint: the expression that is to be zero.
        coordinates: the coordinates of the system.
        speeds: its quasi-velocities.
    """
    if constraint.is_zero:
        return "is not a condition; leave it out"
    leaves = constraint.free_symbols
    rate = rate_of_any(coordinates, leaves)
    if rate is not None:
        kind = "rate" if rate.order == 1 else "acceleration"
        return f"holds the {kind} {rate}; {_EXPECTED}; {_way_out(constraint)}"
    names = {leaf.name for leaf in leaves if leaf.depends_on_time}
    speed = next((u for u in speeds if u.name in names), None)
    if speed is not None:
        return f"holds the speed {speed}; {_EXPECTED}; {_INTEGRATE}"
    if leaves & {*coordinates}:
        return ""
    return _without_coordinates(leaves) + namesake_note(
        coordinates, leaves, ("among the coordinates", "in the constraint")
    )


def _without_coordinates(leaves: frozenset[Expr]) -> str:
    if not leaves:
        return "is never true; correct it, or leave it out"
    functions = sorted((leaf for leaf in leaves if leaf.kind == "time_function"), key=str)
    if functions:
        return (
            f"holds none of the coordinates, and {functions[0]}, a function of time; add {functions[0].name} to "
            "coordinates=[...], or correct the constraint"
        )
    return "holds none of the coordinates; leave it out, or correct it"


def _way_out(constraint: Expr) -> str:
    integral = _integral(constraint)
    if integral is None:
        return _INTEGRATE
    return f"give its integral, {brief(integral)}, minus its initial value"


def _integral(constraint: Expr) -> Expr | None:
    """Return the integral of a sum of rates times constants; None for others."""
    rates = sorted((leaf for leaf in constraint.free_symbols if leaf.kind == "time_function"), key=str)
    if any(rate.order != 1 for rate in rates):
        return None
    slopes = gradient(constraint, rates)
    (rest,) = substitute([constraint], dict.fromkeys(rates, number(0)))
    if any(part.depends_on_time for part in (*slopes, rest)):
        return None
    return sum((k * functions_of_time(r.name) for k, r in zip(slopes, rates, strict=True)), start=rest * t)
