"""Generalised forces by their causes: weight, loads that depend on the motion, and given forces.

The generalised force of a force F whose point has the velocity v is ``Q_i = F . dv/du_i``; a torque's likewise.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from symbody.geometry import Vector
from symbody.multibody import System
from symbody.multibody.load import Action, action_velocity
from symbody.symbolic import (
    ENERGY,
    MOTION,
    Expr,
    derivation,
    free_symbols,
    jacobian,
    number,
    scale3,
    t,
    truncated,
)

from .degree import without


@dataclass(frozen=True)
class GeneralizedForces:
    """The generalised forces, one of each for each speed, at zero accelerations.

    Attributes:
        weight: of the weight of the bodies.
        moving: of forces and torques that depend on coordinates or speeds, such as springs and dampers.
        given: of the others, such as drives.
    """

    weight: tuple[Expr, ...]
    moving: tuple[Expr, ...]
    given: tuple[Expr, ...]


def generalized_forces(system: System, actions: Iterable[Action]) -> GeneralizedForces:
    """Return the generalised forces of a system by their causes; actions are those of its loads."""
    unknown = frozenset(each.name for each in (*system.coordinates, *system.speeds, *system.eliminated))
    moving, given = list[Action](), list[Action]()
    for action in actions:
        free, rest = _split(action.vector, unknown)
        given.append(Action(action.body, free, action.point))
        moving.append(Action(action.body, rest, action.point))
    return GeneralizedForces(*(_forces(system, actions) for actions in (_weights(system), moving, given)))


def _weights(system: System) -> list[Action]:
    gravity = system.gravity
    if gravity is None:
        return []
    return [
        Action(body, Vector(gravity.frame, *scale3(body.mass, gravity.components)), body.center_of_mass)
        for body in system.bodies
    ]


def _forces(system: System, actions: Iterable[Action]) -> tuple[Expr, ...]:
    total = [number(0) for _ in system.speeds]
    with derivation(order=ENERGY):
        for action in actions:
            velocity, axes = action_velocity(action)
            force = system.by_speeds(action.components(axes))
            slopes = jacobian(system.by_speeds(velocity), system.speeds)
            for k, column in enumerate(zip(*slopes.tolist(), strict=True)):
                total[k] += sum((a * b for a, b in zip(force, column, strict=True)), start=number(0))
        return truncated([without(each, system.accelerations) for each in total], MOTION)


def _split(vector: Vector, unknown: frozenset[str]) -> tuple[Vector, Vector]:
    """Return the part of a force that doesn't depend on the motion, and the rest: F and -b*x' of ``F - b*x'``.

    The parts share no symbol, so that a spring's ``k*(x - l)`` stays whole.
    """
    motion = [leaf for leaf in free_symbols(vector.components) if leaf.name in unknown]
    free = tuple(without(component, motion) for component in vector.components)
    rest = tuple(whole - part for whole, part in zip(vector.components, free, strict=True))
    if _names(free) & (_names(rest) | unknown):
        free, rest = tuple(number(0) for _ in free), vector.components
    return Vector(vector.frame, *free), Vector(vector.frame, *rest)


def _names(expressions: Sequence[Expr]) -> frozenset[str]:
    return frozenset(leaf.name for leaf in free_symbols(tuple(expressions)) - {t})
