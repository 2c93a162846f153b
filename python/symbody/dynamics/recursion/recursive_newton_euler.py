"""Inverse dynamics by recursive Newton-Euler [Luh, Walker & Paul 1980; Featherstone 2008, sec. 5.3], in local axes.

Outwards the accelerations of the frames, with the acceleration -g of the root for weight; at each frame the wrench that
its bodies need beyond the loads; inwards the forces along the speeds:

    a_i = X a_p + S u' + S' u, with a_0 = -g      p is the parent of frame i        `AccelerationField`
    f_i = I_i a_i + w x H_i - f_i^load            Newton's and Euler's law          `inertia_wrenches`
    F_i = f_i + sum_c X* F_c, tau_k = S_k . F_i   c are the children of frame i     `forces_along_speeds`

The number of operations is proportional to the number of bodies.
"""

from __future__ import annotations

from collections.abc import Mapping

from symbody.dynamics.inertia.base_inertia import base_inertias
from symbody.dynamics.inertia.inertia_wrench import inertia_wrenches
from symbody.dynamics.inertia.wrench import Wrench, resultant
from symbody.dynamics.recursion.forces_along_speeds import forces_along_speeds
from symbody.dynamics.tree.anchored_action import anchor_of, components_at_anchor
from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.geometry.component.triple import NULL, Rate, Triple
from symbody.geometry.frame.acceleration_field import AccelerationField
from symbody.multibody import Action, System, Variables
from symbody.symbolic import Expr, ExprLike, cross3, sub3, substitute, time_derivatives


def recursive_newton_euler(
    system: System, tree: FrameTree, rest: Mapping[Expr, int] | None = None
) -> tuple[Expr, ...]:
    """Return the forces along the speeds that the motion needs beyond weight and loads: the residuals.

    Args:
        system: bodies, loads and gravity.
        tree: the frames of the system.
        rest: what replaces the accelerations, in the inertia and in the loads; nothing by default.
    """
    return forces_along_speeds(tree, needed_wrenches(system, tree, rest))


def bias(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the residuals at zero accelerations."""
    return recursive_newton_euler(system, tree, at_rest(system))


def at_rest(system: Variables) -> dict[Expr, int]:
    """Return the substitution that drops the accelerations."""
    return dict.fromkeys(system.accelerations, 0)


def needed_wrenches(system: System, tree: FrameTree, rest: Mapping[Expr, int] | None = None) -> list[Wrench]:
    """Return, frame by frame, the wrench that the motion needs beyond weight and loads."""
    known: dict[Expr, ExprLike] = {**system.known_rates, **(rest or {})}
    field = AccelerationField(_minus_gravity(system), _rate(known) if known else time_derivatives)
    wrenches = [Wrench(NULL, NULL)] * len(tree.frames)
    for place, wrench in inertia_wrenches(base_inertias(system, tree, particles=True), tree, field):
        wrenches[place] = wrenches[place].plus(wrench)
    central: dict[int, list[Wrench]] = {}
    for action in tree.actions:
        place, load = tree.index(anchor_of(action).frame), _load(system, action, rest or {})
        if load.is_central:
            central.setdefault(place, []).append(load)
        else:
            wrenches[place] = wrenches[place].minus(load)
    for place, loads in central.items():
        wrenches[place] = wrenches[place].minus(resultant(loads))
    return wrenches


def _rate(known: Mapping[Expr, ExprLike]) -> Rate:
    """Return the time derivative, with other values for accelerations and rates."""
    return lambda values: substitute(time_derivatives(values), known)


def _minus_gravity(system: System) -> Triple:
    if system.gravity is None:
        return NULL
    x, y, z = system.by_speeds(system.gravity.projected(system.root).components)
    return sub3(NULL, (x, y, z))


def _load(system: System, action: Action, rest: Mapping[Expr, int]) -> Wrench:
    by_speeds = system.by_speeds((*components_at_anchor(action), *anchor_of(action).coordinates))
    x, y, z, u, v, w = substitute(by_speeds, rest)
    force = (x, y, z)
    return Wrench(force, cross3((u, v, w), force)) if action.is_force else Wrench(NULL, force)
