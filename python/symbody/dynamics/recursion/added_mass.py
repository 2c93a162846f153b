"""Added mass: the share of loads that depend on accelerations in the mass matrix, as of a fluid that a body pushes."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.dynamics.tree.anchored_action import anchor_of, components_at_anchor
from symbody.errors import ModelError
from symbody.multibody import Action, System
from symbody.multibody.load import action_velocity
from symbody.symbolic import Expr, Matrix, dot3, jacobian, number
from symbody.symbolic.given.arguments import brief


def with_added_mass(mass_matrix: Matrix, system: System) -> Matrix:
    """Return ``M - dQ/du'``, where Q are the generalised forces of the loads; n x n for n speeds.

    The sum is symmetric only if ``dQ/du'`` is, which is up to the loads.
    """
    actions = [action for action in system.actions if _holds_acceleration(action, system)]
    return mass_matrix - _slopes(actions, system) if actions else mass_matrix


def has_added_mass(system: System) -> bool:
    """Return whether some load depends on accelerations."""
    return any(_holds_acceleration(action, system) for action in system.actions)


def check_loads(system: System, where: str) -> None:
    """Raise an error that names the first load, or the gravity, for which the equations can't be solved."""
    for load in system.loads:
        actions = [a for a in load.actions if a.body in system.bodies and _holds_acceleration(a, system)]
        if not actions:
            continue
        jerk = _rate(_leaves(actions), system, 3)
        if jerk is not None:
            raise ModelError(
                f"{where}: {brief(load)} holds {jerk}; expected coordinates, speeds and accelerations at most"
            )
        slopes = _slopes(actions, system)
        acceleration = _rate(_union(slopes.entries), system, 2)
        if acceleration is not None:
            raise ModelError(
                f"{where}: {brief(load)} isn't linear in the acceleration {acceleration}; give a function of time "
                "for the load, and its law as an additional equation"
            )
    if system.gravity is not None:
        acceleration = _rate(_union(system.gravity.components), system, 2)
        if acceleration is not None:
            raise ModelError(
                f"{where}: the gravity holds the acceleration {acceleration}; expected coordinates, speeds and time; "
                "model acceleration-dependent terms as forces"
            )


def _slopes(actions: Iterable[Action], system: System) -> Matrix:
    """Return ``dQ/du'``."""
    forces = [number(0)] * len(system.speeds)
    for action in actions:
        velocity, axes = action_velocity(action)
        partial = jacobian(system.by_speeds(velocity), system.speeds)
        x, y, z = system.by_speeds(action.components(axes))
        for k in range(len(forces)):
            forces[k] += dot3((x, y, z), (partial[0, k], partial[1, k], partial[2, k]))
    return jacobian(forces, system.accelerations)


def _holds_acceleration(action: Action, system: System) -> bool:
    return _rate(_leaves([action]), system, 2) is not None


def _leaves(actions: Iterable[Action]) -> frozenset[Expr]:
    """Return the symbols and functions of time in forces and torques, and in the places where they act."""
    return _union(
        value
        for action in actions
        for value in (*components_at_anchor(action), *anchor_of(action).coordinates)
    )


def _union(values: Iterable[Expr]) -> frozenset[Expr]:
    return frozenset().union(*(value.free_symbols for value in values))


def _rate(leaves: Iterable[Expr], system: System, order: int) -> Expr | None:
    """Return the first rate of a coordinate, by name, of at least a given order; a quasi-velocity is a first rate."""
    functions = [x for x in leaves if x.kind == "time_function" and x.order >= order - 1]
    if not functions:
        return None
    orders = {q.name: order for q in system.coordinates} | {
        u.name: order - 1 for u in system.quasi_velocities
    }
    rates = (x for x in functions if x.name in orders and x.order >= orders[x.name])
    return min(rates, key=lambda rate: (rate.name, rate.order), default=None)
