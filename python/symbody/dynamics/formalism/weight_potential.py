"""The potential energy of weight, in a form whose length is linear."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree
from symbody.geometry.component.triple import NULL, Triple
from symbody.multibody import Body, System
from symbody.symbolic import Expr, add3, dot3, number, scale3

from .virtual_power import Held


def potential(system: System, held: Held) -> Expr:
    """Return ``-g . sum(m r_G)``; the sum is carried from the bodies down to the root, so its length is linear."""
    if system.gravity is None:
        return number(0)
    gravity = system.gravity.projected(system.root).components
    return -dot3(held.stand_ins(gravity), _mass_moment(frame_tree(system), system.bodies))


def _mass_moment(tree: FrameTree, bodies: Sequence[Body]) -> Triple:
    """Return ``sum(m r_G)`` in the axes of the root."""
    masses: list[Expr] = [number(0)] * len(tree.frames)
    moments: list[Triple] = [NULL] * len(tree.frames)
    for body in bodies:
        masses[tree.index(body.frame)] += body.mass
    for k in range(len(tree.frames) - 1, 0, -1):
        motion, parent = tree.motions[k], tree.parents[k]
        masses[parent] += masses[k]
        moved = add3(motion.to_parent(moments[k]), scale3(masses[k], motion.displacement))
        moments[parent] = add3(moments[parent], moved)
    return moments[0]
