"""Added mass: the share of loads that depend on accelerations in the mass matrix, as of a fluid that a body pushes."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.dynamics.tree.anchored_action import anchor_of, components_at_anchor
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree
from symbody.errors import ModelError
from symbody.geometry import Frame
from symbody.multibody import Action, System
from symbody.multibody.load import action_velocity
from symbody.symbolic import Expr, Matrix, dot3, free_symbols, jacobian, number
from symbody.symbolic.given.arguments import brief


def with_added_mass(mass_matrix: Matrix, system: System) -> Matrix:
    """Return ``M - dQ/du'``, where Q are the generalised forces of the loads; n x n for n speeds.

    The sum is symmetric only if ``dQ/du'`` is, which is up to the loads.
    """
    actions = _accelerated(system)
    return mass_matrix - _slopes(actions, system) if actions else mass_matrix


def has_added_mass(system: System) -> bool:
    """Return whether some load depends on accelerations."""
    return bool(_accelerated(system))


def check_loads(system: System, where: str) -> None:
    """Raise an error that names the first load, or the gravity, for which the equations can't be solved."""
    accelerated = _accelerated(system)
    for load in system.loads if accelerated else ():
        actions = [action for action in accelerated if action in load.actions]
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
                f"{where}: {brief(load)} isn't linear in the acceleration {acceleration}; expected a load by "
                "positions, speeds and states: a state can follow the law with a short lag tau, as in "
                "System(..., states={F: (law - F)/tau})"
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


def _accelerated(system: System) -> list[Action]:
    """Return the actions that hold accelerations; few systems have any, which is seen before vectors are projected."""
    if not system.actions or _rate(_given_leaves(system), system, 2) is None:
        return []
    return [action for action in system.actions if _rate(_leaves([action]), system, 2) is not None]


def _given_leaves(system: System) -> frozenset[Expr]:
    """Return the symbols and functions of time in all actions as they are given, and in the frames of their axes."""
    values, frames = list[Expr](), dict[bytes, Frame]()
    for action in system.actions:
        values += action.vector.components
        frames[action.vector.frame.key] = action.vector.frame
        if action.point is not None:
            values += action.point.coordinates
            frames[action.point.frame.key] = action.point.frame
    return free_symbols(values) | _leaves_of_frames(frames.values(), frame_tree(system))


def _leaves_of_frames(frames: Iterable[Frame], tree: FrameTree) -> frozenset[Expr]:
    """Return the symbols and functions of time in the motions of frames and of those before them."""
    known, found = set[bytes](), set[Expr]()
    for frame in (*tree.frames, *frames):
        link: Frame | None = frame
        while link is not None and link.key not in known:
            known.add(link.key)
            if link.motion is not None:
                found |= link.motion.leaves
            link = link.parent
    return frozenset(found)


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
