"""Faults of constraints: what can't be a condition on positions or velocities, and the way out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from symbody.geometry.component.triple import Rate
from symbody.symbolic import Expr, gradient
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.namesake import namesake_note

__all__ = ["Unknowns", "fault_of", "is_on_velocity"]


class Unknowns(NamedTuple):
    """What constraints may hold: coordinates, quasi-velocities, all speeds; and what writes rates by the speeds.

    The rates of coordinates that were given tell which functions of time may be forgotten speeds.
    """

    coordinates: Sequence[Expr]
    quasi_velocities: Sequence[Expr]
    speeds: Sequence[Expr]
    by_speeds: Rate
    rates: Sequence[Expr] = ()


def is_on_velocity(condition: Expr, unknowns: Unknowns) -> bool:
    """Return whether a condition holds speeds or rates of coordinates."""
    return any(order > 0 for _, order in _motions(condition, unknowns))


def fault_of(condition: Expr, unknowns: Unknowns) -> str:
    """Return what is wrong with a constraint, and the way out; the empty text if nothing is.

    Zero is a condition that always holds, as of a spatial joint across a mechanism in the plane.

    Args:
        condition: the expression that is to be zero.
        unknowns: the coordinates and speeds of the system.
    """
    if condition.is_zero:
        return ""
    motions = _motions(condition, unknowns)
    if not motions:
        leaves = condition.free_symbols
        return _without_unknowns(leaves, unknowns) + namesake_note(
            unknowns.coordinates, leaves, ("among the coordinates", "in the constraint")
        )
    highest = max(motions, key=lambda motion: motion[1])
    if highest[1] > 1:
        return (
            f"holds the acceleration {highest[0]}; expected a condition on coordinates, or one on rates and speeds, "
            "as accelerations follow from forces and constraints; give its integral"
        )
    return _fault_of_speeds(condition, unknowns) if highest[1] else ""


def _motions(condition: Expr, unknowns: Unknowns) -> list[tuple[Expr, int]]:
    """Return the coordinates and speeds in a condition, by name, each as a rate of the position of some order."""
    base = {q.name: 0 for q in unknowns.coordinates} | {u.name: 1 for u in unknowns.quasi_velocities}
    functions = (leaf for leaf in condition.free_symbols if leaf.kind == "time_function")
    found = [(leaf, base[leaf.name] + leaf.order) for leaf in functions if leaf.name in base]
    return sorted(found, key=lambda motion: (motion[0].name, motion[1]))


def _fault_of_speeds(condition: Expr, unknowns: Unknowns) -> str:
    (by_speeds,) = unknowns.by_speeds([condition])
    slopes = gradient(by_speeds, unknowns.speeds)
    for slope in slopes:
        curved = sorted((u for u in unknowns.speeds if u in slope.free_symbols), key=str)
        if curved:
            return (
                f"isn't linear in the speed {curved[0]}; expected A(q, t) u + b(q, t), as d'Alembert's principle gives "
                "no force for other conditions on velocities: factor it into linear conditions, or replace it by a "
                "load that keeps it"
            )
    if all(slope.is_zero for slope in slopes):
        return f"holds rates that cancel: by the speeds it is {brief(by_speeds)} = 0; leave it out, or correct it"
    return ""


def _without_unknowns(leaves: frozenset[Expr], unknowns: Unknowns) -> str:
    if not leaves:
        return "is never true; correct it, or leave it out"
    functions = sorted((leaf for leaf in leaves if leaf.kind == "time_function"), key=str)
    in_rates = frozenset[Expr]().union(*(rate.free_symbols for rate in unknowns.rates))
    speeds = [each for each in functions if each in in_rates]
    if speeds:
        return (
            f"holds none of the coordinates and speeds, and {speeds[0]}, which the kinematics holds; list it, "
            f"speeds=[{speeds[0]}], or correct the constraint"
        )
    if functions:
        return (
            f"holds none of the coordinates, and {functions[0]}, a function of time; add {functions[0].name} to "
            "coordinates=[...], or correct the constraint"
        )
    return "holds none of the coordinates; leave it out, or correct it"
