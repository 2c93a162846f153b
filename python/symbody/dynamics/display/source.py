"""Where the terms of equations come from: gravity, springs and dampers, forces that are given."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from symbody.geometry import Frame
from symbody.multibody import Action, System, Variables
from symbody.symbolic import Expr, Matrix, free_symbols, t

from .given_load import split


@dataclass(frozen=True)
class Sources:
    """The symbols by which the terms of the equations are told apart.

    Attributes:
        gravity: those of the acceleration of gravity.
        loads: those that occur in loads alone, such as stiffnesses.
        given: those of loads that depend on no motion, such as a drive's torque: they stand on the right.
    """

    gravity: frozenset[Expr]
    loads: frozenset[Expr]
    given: frozenset[Expr]


def sources(system: Variables, mass_matrix: Matrix, actions: Iterable[Action]) -> Sources:
    """Return the symbols of gravity, loads and given forces; those of the mass matrix belong to the bodies."""
    motion = _names((*system.coordinates, *system.speeds, *system.eliminated))
    inertia = free_symbols(mass_matrix.entries)
    if not isinstance(system, System):
        return Sources(frozenset(), frozenset(), _inputs(system) - inertia)
    weight = frozenset[Expr]()
    if system.gravity is not None:
        weight = _symbols(system.gravity.components, motion) - inertia
    placing = _names(free_symbols([x for body in system.bodies for x in _variables(body.frame)]))
    loads, given, moving = set[Expr](), set[Expr](), set[Expr]()
    for action in actions:
        found = _leaves(action.vector.components)
        place = () if action.point is None else action.point.coordinates
        loads |= {*found, *_leaves(place)}
        parts = split(action.vector, system)
        given |= parts.symbols
        moving |= _leaves(parts.moving.components)
    return Sources(
        gravity=weight,
        loads=frozenset(leaf for leaf in loads if leaf.kind == "symbol") - inertia - weight,
        given=frozenset(leaf for leaf in given - moving - inertia if leaf.name not in placing),
    )


def _inputs(variables: Variables) -> frozenset[Expr]:
    """Return the functions of time that are given from outside: all that is known of the forces without loads."""
    unknown = _names((*variables.coordinates, *variables.speeds, *variables.multipliers))
    return frozenset(
        leaf for leaf in variables.leaves if leaf.kind == "time_function" and leaf.name not in unknown
    )


def _symbols(expressions: Iterable[Expr], motion: frozenset[str]) -> frozenset[Expr]:
    return frozenset(
        leaf
        for leaf in _leaves(expressions)
        if leaf.kind in {"symbol", "time_function"} and leaf.name not in motion
    )


def _leaves(expressions: Iterable[Expr]) -> frozenset[Expr]:
    """Return the symbols and functions of time but time itself, which all terms share."""
    return free_symbols(tuple(expressions)) - {t}


def _variables(frame: Frame) -> list[Expr]:
    return [variable for motion in frame.motions for variable in motion.variables]


def _names(functions: Iterable[Expr]) -> frozenset[str]:
    return frozenset(function.name for function in functions)
