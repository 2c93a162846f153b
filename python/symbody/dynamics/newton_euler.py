"""Newton-Euler: accelerations outwards along the frames, then forces inwards [Luh, Walker & Paul 1980]."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.errors import FrameError, ModelError
from symbody.geometry import Point
from symbody.geometry.acceleration_field import AccelerationField
from symbody.geometry.argument import checked
from symbody.geometry.triple import NULL, Rate, Triple
from symbody.multibody import Action, System
from symbody.symbolic import (
    Expr,
    ExprLike,
    cross3,
    derivation,
    sub3,
    substitute,
    time_derivatives,
)
from symbody.symbolic.given.arguments import brief

from .added_mass import with_added_mass
from .base_inertia import base_inertias
from .composite_rigid_body import mass_matrix
from .constraint import check_independent, with_multipliers
from .equations import Assembly, Equations
from .frame_tree import FrameTree, checked_tree, frame_tree
from .inertia_wrench import inertia_wrenches
from .wrench import Wrench, generalized_forces


@checked(ModelError)
def newton_euler(system: System) -> Equations:
    """Return the equations of motion by recursion over the tree of frames.

    Outwards go the accelerations of the frames, in their own axes, with weight as an acceleration of the root; inwards
    the wrenches that cause them. The equation of a speed is the power of the wrenches on the motions that it drives,
    per unit of it. The number of operations is proportional to the number of bodies.

    Raises:
        FrameError: where a frame isn't rigid by itself, as in natural coordinates.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> newton_euler(pendulum).mass_matrix[0, 0] == m * l**2
    True
    """
    check_independent(system)
    with derivation(fresh=True):
        tree = checked_tree(system, "newton_euler")
        _check_rigid(tree)
        residuals = with_multipliers(inverse_dynamics(system, tree), system)
    return Equations(system, residuals, _assemble)


def _assemble(system: System) -> Assembly:
    with derivation(fresh=True):
        tree = frame_tree(system)
        forces = bias(system, tree)
        return Assembly(with_added_mass(mass_matrix(system, tree), system), forces)


def inverse_dynamics(
    system: System, tree: FrameTree, rest: Mapping[Expr, int] | None = None
) -> tuple[Expr, ...]:
    """Return the forces along the speeds that the motion needs beyond weight and loads: the residuals.

    Args:
        system: bodies, loads and gravity.
        tree: the frames of the system.
        rest: what stands for accelerations, if not they themselves: in the inertia as in the loads.
    """
    return generalized_forces(tree, needed_wrenches(system, tree, rest))


def needed_wrenches(system: System, tree: FrameTree, rest: Mapping[Expr, int] | None = None) -> list[Wrench]:
    """Return, frame by frame, the wrench that the motion needs beyond weight and loads."""
    known: dict[Expr, ExprLike] = {**system.known_rates, **(rest or {})}
    field = AccelerationField(_minus_gravity(system), _rate(known) if known else time_derivatives)
    wrenches = [Wrench(NULL, NULL)] * len(tree.frames)
    for place, wrench in inertia_wrenches(base_inertias(system, tree, particles=True), tree, field):
        wrenches[place] = wrenches[place].plus(wrench)
    for action in tree.actions:
        anchor = action.anchor
        place = tree.index(anchor.frame)
        wrenches[place] = wrenches[place].minus(_load(action, anchor, known))
    return wrenches


def bias(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the residuals at zero accelerations."""
    return inverse_dynamics(system, tree, at_rest(system))


def _rate(known: Mapping[Expr, ExprLike]) -> Rate:
    """Return the time derivative, with other values for accelerations and rates."""
    return lambda values: substitute(time_derivatives(values), known)


def at_rest(system: System) -> dict[Expr, int]:
    """Return the substitution that drops the accelerations."""
    return dict.fromkeys(system.accelerations, 0)


def _check_rigid(tree: FrameTree) -> None:
    for frame in tree.frames:
        if not frame.is_rigid:
            raise FrameError(
                f"newton_euler: {brief(frame)} isn't rigid: the entries of its matrix make no rotation by "
                "themselves; if constraints make it one, use lagrange_equations, and correct the matrix if not"
            )


def _minus_gravity(system: System) -> Triple:
    if system.gravity is None:
        return NULL
    return sub3(NULL, system.gravity.projected(system.root).components)


def _load(action: Action, anchor: Point, known: Mapping[Expr, ExprLike]) -> Wrench:
    x, y, z, u, v, w = substitute((*action.components(anchor.frame), *anchor.coordinates), known)
    force = (x, y, z)
    return Wrench(force, cross3((u, v, w), force)) if action.is_force else Wrench(NULL, force)
