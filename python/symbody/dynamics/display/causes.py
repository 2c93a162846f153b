"""Generalised forces by their causes: weight, loads that depend on the motion, and given forces.

The generalised force of a force F whose point has the velocity v is ``Q_i = F . dv/du_i``; a torque's likewise.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from symbody.geometry import Vector
from symbody.multibody import System
from symbody.multibody.load import Action, action_velocity
from symbody.symbolic import (
    ENERGY,
    MOTION,
    Expr,
    derivation,
    jacobian,
    number,
    scale3,
    truncated,
)

from .degree import without
from .given_load import split


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
    moving, given = list[Action](), list[Action]()
    for action in actions:
        parts = split(action.vector, system)
        given.append(Action(action.body, parts.given, action.point))
        moving.append(Action(action.body, parts.moving, action.point))
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
