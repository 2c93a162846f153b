"""Generalised forces of loads."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import partial
from typing import Annotated, TypeAlias, overload

from symbody.dynamics.tree.partial_motion import slope
from symbody.errors import ModelError
from symbody.geometry.frame.frame_velocity import displacement_rate, pose_from
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.placement import axial_rate
from symbody.multibody import Action, Load
from symbody.symbolic import ENERGY, MOTION, Expr, derivation, dot3, number, truncated

Loads: TypeAlias = Annotated[Load | Collection[Load], "a force, a torque, or a list of them"]
Coordinates: TypeAlias = Annotated[Expr | Sequence[Expr], "a coordinate, or a list of them"]


@overload
def generalized_force(loads: Loads, q: Expr) -> Expr: ...
@overload
def generalized_force(loads: Loads, q: Sequence[Expr]) -> list[Expr]: ...
@checked(ModelError)
def generalized_force(loads: Loads, q: Coordinates) -> Expr | list[Expr]:
    """Return the virtual work of loads per unit change of coordinates, ``F . dr_P/dq + M . w_q``.

    P is the material point of the body on which the force acts, and ``w_q`` the vector of ``R^T dR/dq``. A coordinate
    may be any variable, not only a function of time.

    Args:
        loads: a load, or several.
        q: a coordinate, or a list of them.

    Returns:
        One expression, or a list with one expression per coordinate.

    >>> from symbody import Body, Force, functions_of_time, ground, symbols, translate
    >>> x, z, F = *functions_of_time("x z"), symbols("F")
    >>> body = Body(translate(x, 0, z), 1)
    >>> generalized_force(Force(ground, 0, 0, F, at=body.center_of_mass, on=body), [x, z])
    [0, F]
    """
    coordinates = [q] if isinstance(q, Expr) else list(q)
    several = [loads] if isinstance(loads, Load) else sorted(loads, key=lambda load: load.key)
    with derivation(order=ENERGY):
        forces = [number(0)] * len(coordinates)
        for action in (action for load in several for action in load.actions):
            for k, coordinate in enumerate(coordinates):
                forces[k] += virtual_work(action, coordinate)
        forces = [*truncated(forces, MOTION)]
    return forces[0] if isinstance(q, Expr) else forces


def virtual_work(action: Action, coordinate: Expr) -> Expr:
    """Return the virtual work of one action per unit change of a coordinate."""
    rate = partial(slope, coordinate)
    anchor = action.anchor if action.is_force else action.body.center_of_mass
    root = anchor.frame.ancestor
    pose = pose_from(anchor.frame, root)
    if not action.is_force:
        return dot3(action.components(anchor.frame), axial_rate(pose.rows, rate))
    return dot3(action.components(root), displacement_rate(pose, anchor.coordinates, rate))
