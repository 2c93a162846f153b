"""The wrenches that a motion needs: ``m a`` and ``dH/dt`` of bodies, composites and particles, on their frames.

The force on a body at the centre of its rotations is the same in the frame before them, where the acceleration is known
without these rotations. It is kept there: for a body on ``translate(x, y, 0) * rotate("Z", th)`` it is ``m x''``.
"""

from __future__ import annotations

from collections.abc import Iterator

from symbody.dynamics.tree.anchored_action import anchor_of
from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.geometry.component.triple import NULL, is_null
from symbody.geometry.component.turning import Accelerated
from symbody.geometry.frame.acceleration_field import AccelerationField
from symbody.multibody import Body
from symbody.symbolic import add3, cross3, matvec3, scale3, sub3

from .base_inertia import BaseInertias, Particle
from .composite import Composite
from .spin_momentum import momentum_rate, second_moment_rate, spin_momentum_rate
from .wrench import Wrench


def inertia_wrenches(
    inertias: BaseInertias, tree: FrameTree, field: AccelerationField
) -> Iterator[tuple[int, Wrench]]:
    """Return the wrench of each inertia, by the place of its frame, parents first."""
    bearing = _with_forces(tree)
    for place, body in inertias.bodies:
        wrench = body_wrench(body, field(tree.frames[place]))
        centre = _place_of_centre(tree, place, bears=place in bearing)
        if centre != place:
            yield centre, Wrench(scale3(body.mass, field(tree.frames[centre]).linear), NULL)
            wrench = Wrench(NULL, wrench.moment)
        yield place, wrench
    for place, composite in sorted(inertias.composites.items()):
        yield place, composite_wrench(composite, field(tree.frames[place]))
    for place, particle in inertias.particles:
        yield place, particle_wrench(particle, field(tree.frames[place]))


def _with_forces(tree: FrameTree) -> set[int]:
    """Return the frames on which forces of other frames or of loads act."""
    return {
        *tree.parents[1:],
        *(tree.index(anchor_of(action).frame) for action in tree.actions if action.is_force),
    }


def _place_of_centre(tree: FrameTree, place: int, *, bears: bool) -> int:
    """Return the frame before the moving rotations about the origin of a frame; the frame itself if it gains nothing.

    If other forces act on the frame, which are carried through the rotations anyway, the frame before must slide.
    """
    centre, turns = place, False
    while centre > 0 and is_null(tree.motions[centre].displacement) and tree.motions[centre].twist is None:
        turns = turns or bool(tree.moved_by[centre])
        centre = tree.parents[centre]
    slides = tree.moved_by[centre] and not tree.motions[centre].rotates
    return centre if slides or (turns and not bears) else place


def body_wrench(body: Body, motion: Accelerated) -> Wrench:
    """Return ``m a`` and ``dH/dt`` of a body, whose frame is at its centre of mass."""
    return Wrench(scale3(body.mass, motion.linear), spin_momentum_rate(body, motion.turning))


def composite_wrench(body: Composite, motion: Accelerated) -> Wrench:
    """Return ``m a + F h`` and ``h x a + dH/dt``, by the field F of the accelerations about the frame's origin."""
    turning, a = motion
    xx, yy, zz, yz, xz, xy = body.inertia
    products = sub3(NULL, (yz, xz, xy))
    force, h = scale3(body.mass, a), body.moment
    if is_null(h) and is_null(products):
        return Wrench(force, momentum_rate((xx, yy, zz), NULL, turning))
    rate = second_moment_rate(body.second_moments, products, turning)
    return Wrench(add3(force, matvec3(turning.field, h)), add3(rate, cross3(h, a)))


def particle_wrench(particle: Particle, motion: Accelerated) -> Wrench:
    """Return ``m (a + F r)``, and its moment about the frame's origin."""
    turning, acceleration = motion
    mass, position = particle
    if not is_null(position):
        acceleration = add3(acceleration, matvec3(turning.field, position))
    force = scale3(mass, acceleration)
    return Wrench(force, cross3(position, force))
