"""Roles of the parameters of loads: an effort stands alone; a stiffness multiplies a deflection, a damping its rate."""

from __future__ import annotations

from collections.abc import Iterator

from symbody.multibody.load import Force, Torque
from symbody.multibody.system import System
from symbody.symbolic import Expr, t

from .circular import without_circular_functions
from .coordinate_kind import is_pure, multiples, pure_multiples, units_of_coordinates

__all__ = ["deflections", "roles_in_loads"]

Role = tuple[str, str]

_EFFORT = {True: ("force", "N"), False: ("torque", "N m")}
"""The roles of what stands alone in a force, and in a torque."""
_FACTOR = {
    (True, "m"): ("stiffness", "N/m"),
    (True, "m/s"): ("damping", "N s/m"),
    (False, "rad"): ("stiffness", "N m/rad"),
    (False, "rad/s"): ("damping", "N m s/rad"),
}
"""The roles of what multiplies a coordinate or a rate in a force, and in a torque, by the unit of the latter."""


def roles_in_loads(system: System) -> Iterator[tuple[Expr, Role]]:
    """Yield the terms of forces and torques, such as F, and factors of coordinates, such as k and c in ``-k*x - c*x'``.

    Not so x0 in ``-100*(x - x0)``, where 100 has a unit.
    """
    unknowns = {*system.coordinates, *system.coordinate_rates, *system.speeds}
    for action in (action for load in system.loads for action in load.actions):
        for component in without_circular_functions(action.vector.components):
            squares = {leaf: component.diff(leaf) ** 2 for leaf in multiples([component])}
            of_unknowns = {square for leaf, square in squares.items() if leaf in unknowns}
            yield from (
                (leaf, _EFFORT[action.is_force])
                for leaf, square in squares.items()
                if is_pure(square) and square not in of_unknowns
            )
    yield from ((leaf, role) for leaf, role, _ in _factors(system))


def deflections(system: System) -> Iterator[Expr]:
    """Yield the lengths that stiffnesses multiply, as ``x - l`` in ``-k*(x - l)``."""
    yield from (deflection for _, role, deflection in _factors(system) if role == _FACTOR[True, "m"])


def _factors(system: System) -> Iterator[tuple[Expr, Role, Expr]]:
    """Yield the parameters of forces and torques that multiply coordinates or rates, their roles, and these.

    The arguments of other loads have their roles by the laws.
    """
    units = _units(system)
    for load in (load for load in system.loads if isinstance(load, Force | Torque)):
        for component in without_circular_functions(load.vector.components):
            for leaf in sorted(component.free_symbols - units.keys(), key=str):
                factor = component.diff(leaf)
                found = {units[each] for each in pure_multiples([factor]) if each in units}
                if len(found) == 1 and leaf not in factor.free_symbols:
                    role = _FACTOR.get((isinstance(load, Force), found.pop()))
                    yield from () if role is None else ((leaf, role, factor),)


def _units(system: System) -> dict[Expr, str]:
    """Return the units of coordinates, speeds and rates."""
    units = units_of_coordinates(system)
    return {each.diff(t): f"{unit}/s" for each, unit in units.items()} | units
