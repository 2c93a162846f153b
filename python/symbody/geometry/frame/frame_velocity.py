"""Velocities of frames by recursion along their chains, in local axes.

With A the parent, B the child, d the displacement and w the child's spin in the parent, each motion takes a step
(`FrameMotion.child_twist`):

    w_NB = R_BA w_NA + w        v_NB = R_BA (v_NA + w_NA x d + d')

A frame beyond a bare matrix R (natural coordinates) is seen from its base, the last rigid frame of the chain. There the
matrix R itself is differentiated, which is right whether or not the constraints hold.
"""

from __future__ import annotations

from typing import NamedTuple

from symbody.geometry.component.triple import NULL, Rate, Triple, is_null, rates
from symbody.geometry.component.twist import Twist
from symbody.geometry.motion.placement import axial_rate, transposed
from symbody.symbolic import ENERGY, add3, cross3, derivation, matvec3, time_derivatives

from .frame import UNMOVED, Frame, Pose, frames_without_state, moved


class Seen(NamedTuple):
    """A vector by its components, and the frame in whose axes they are."""

    components: Triple
    axes: Frame


def twist(frame: Frame) -> Twist:
    """Return the twist of a rigid frame in its own axes."""
    with derivation(order=ENERGY) as current:
        memo: dict[bytes, Twist] = current.cache.setdefault("twist", {})
        for link in frames_without_state(frame, memo):
            if link.parent is None or link.motion is None:
                memo[link.key] = link.carrier or Twist(NULL, NULL)
            else:
                memo[link.key] = link.motion.child_twist(memo[link.parent.key])
        return memo[frame.key]


def pose_from(frame: Frame, base: Frame) -> Pose:
    """Return the pose of a frame as seen from one of its ancestors."""
    placing = UNMOVED
    with derivation(order=ENERGY):
        for link in frame.chain[base.depth + 1 :]:
            if link.motion is not None:
                placing = moved(link.motion, placing)
    return placing.pose


def spin(frame: Frame) -> Triple:
    """Return the angular velocity of a frame in its own axes; beyond a bare matrix R, the vector of ``R^T dR/dt``."""
    if frame.is_rigid:
        return twist(frame).angular
    with derivation(order=ENERGY):
        rows = pose_from(frame, frame.base).rows
        carried = turned(transposed(rows), twist(frame.base).angular)
        return add3(carried, axial_rate(rows, time_derivatives))


def origin_velocity(frame: Frame) -> Seen:
    """Return the velocity of a frame's origin."""
    return material_velocity(NULL, frame)


def material_velocity(p: Triple, frame: Frame) -> Seen:
    """Return the velocity of the point of a frame that is at p, as if p were fixed in the frame."""
    base = frame.base
    with derivation(order=ENERGY):
        angular, linear = twist(base)
        if frame is base:
            return Seen(add3(linear, cross3(angular, p)), base)
        pose = pose_from(frame, base)
        r = add3(pose.origin, turned(pose.rows, p))
        return Seen(
            add3(add3(linear, cross3(angular, r)), displacement_rate(pose, p, time_derivatives)), base
        )


def displacement_rate(pose: Pose, p: Triple, rate: Rate) -> Triple:
    """Return the rate of ``origin + R p`` for fixed p."""
    drift = rates(pose.origin, rate)
    if is_null(p):
        return drift
    x, y, z = pose.rows
    return add3(drift, turned((rates(x, rate), rates(y, rate), rates(z, rate)), p))


def turned(rows: tuple[Triple, Triple, Triple], v: Triple) -> Triple:
    """Return the product of a matrix, given by its rows, and a vector."""
    x, y, z = rows
    return matvec3((*x, *y, *z), v)
