"""The wrench that holds a part of a system: recursive Newton-Euler of the bodies of the part alone.

    f_i = (m a - m g, dH/dt) - f_i^load         body by body, in its axes, by `AccelerationField`
    F_p = f_p + sum_c X* F_c                    inwards, to the frame on which the part hangs

The number of operations is proportional to the number of bodies, unlike those of Newton's and Euler's equations in the
axes of one frame.
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.inertia.inertia_wrench import body_wrench
from symbody.dynamics.inertia.wrench import Wrench
from symbody.geometry import Frame, Point, Vector, cross, origin
from symbody.geometry.component.triple import NULL, Triple
from symbody.geometry.frame.acceleration_field import AccelerationField
from symbody.multibody import Action, Body, System
from symbody.symbolic import cross3, sub3

__all__ = ["part_wrench"]


def part_wrench(system: System, bodies: Sequence[Body], about: Point, frame: Frame) -> tuple[Vector, Vector]:
    """Return the force and the moment about a point that bodies need beyond weight and loads.

    Args:
        system: the system, whose loads act on the bodies.
        bodies: those of the part, on rigid frames.
        about: the point.
        frame: the axes of the result.
    """
    field = AccelerationField(_minus_gravity(system), system.rate)
    wrenches: dict[Frame, Wrench] = {}
    for body in bodies:
        needed = body_wrench(body, field(body.frame))
        for action in (action for action in system.actions if action.body is body):
            needed = needed.minus(_of(action, body.frame))
        wrenches[body.frame] = wrenches.get(body.frame, _NONE).plus(needed)
    base = _base(list(wrenches), frame)
    force, moment = (Vector(base, *part).projected(frame) for part in _inwards(wrenches, base))
    return force, moment + cross((origin(base) - about).projected(frame), force)


_NONE = Wrench(NULL, NULL)


def _minus_gravity(system: System) -> Triple:
    if system.gravity is None:
        return NULL
    return sub3(NULL, system.gravity.projected(system.root).components)


def _of(action: Action, frame: Frame) -> Wrench:
    """Return an action as a wrench on the frame of its body."""
    vector = action.components(frame)
    if action.point is None:
        return Wrench(NULL, vector)
    return Wrench(vector, cross3(action.point.projected(frame).coordinates, vector))


def _base(frames: Sequence[Frame], other: Frame) -> Frame:
    """Return the last frame that lies in the chains of all frames."""
    chains = [frame.chain for frame in (other, *frames)]
    together: list[Frame] = [links[0] for links in zip(*chains, strict=False) if len({*links}) == 1]
    return together[-1]


def _inwards(wrenches: dict[Frame, Wrench], base: Frame) -> Wrench:
    """Return the sum of wrenches on frames beyond a frame, on this frame."""
    left = dict(wrenches)
    while True:
        frame = max(left, key=lambda each: each.depth)
        wrench = left.pop(frame)
        if frame == base:
            return wrench
        assert frame.parent is not None
        assert frame.motion is not None
        carried = wrench.to_parent(frame.motion)
        left[frame.parent] = left.get(frame.parent, _NONE).plus(carried)
