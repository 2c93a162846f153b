"""Coordinates of joints that close loops: they have none, so that loads and constraints can't be written by them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from symbody.errors import JointError
from symbody.multibody.constraint import Condition, as_constraint
from symbody.multibody.load import Load
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.arguments import brief

from .placed_joint import PlacedJoint

__all__ = ["check_idle_coordinates"]


def check_idle_coordinates(
    joints: Sequence[PlacedJoint],
    loads: Iterable[Load],
    constraints: Iterable[Condition],
    known: Collection[Expr],
) -> None:
    """Raise an error for a load or a constraint by the coordinate of a joint that closes a loop.

    Args:
        joints: the joints of the mechanism.
        loads: its loads.
        constraints: conditions beside those of the joints.
        known: coordinates, inputs and other functions of time of the system.
    """
    idle = {
        q.name: joint
        for joint in joints
        if not joint.opens
        for given in joint.joint.coordinates
        for q in sorted(free_symbols([given]), key=str)
        if q.kind == "time_function" and q not in known
    }
    if not idle:
        return
    held: list[tuple[object, list[Expr]]] = [(each, [as_constraint(each).condition]) for each in constraints]
    for load in loads:
        vectors = [component for action in load.actions for component in action.vector.components]
        held.append((load, [*vectors, *(() if load.potential is None else (load.potential,))]))
    for holder, expressions in held:
        names = sorted(leaf.name for leaf in free_symbols(expressions) if leaf.kind == "time_function")
        name = next((name for name in names if name in idle), "")
        if name:
            raise JointError(
                f"Mechanism.system: {brief(holder)} holds {name}, and {idle[name]} closes a loop, where it has no "
                f"coordinate; expected mechanism.joint({idle[name].name!r}).freedom(...).value in its place, or the "
                "joint with loop=False"
            )
