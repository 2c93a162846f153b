"""Accelerations of rigid frames by recursion along their chains, in local axes.

With A the parent, B the child, d the displacement and w the child's spin in the parent, each motion takes a step
(`FrameMotion.child_acceleration`):

    al_NB = R_BA al_NA + w' + w_NB x w      a_NB = R_BA (a_NA + F_A d + 2 w_NA x d' + d'')

F is the field of accelerations (`turning.py`).
"""

from __future__ import annotations

from typing import final

from symbody.geometry.component.triple import NULL, Rate, Triple, rates
from symbody.geometry.component.turning import Accelerated, Turning
from symbody.symbolic import add3, cross3, time_derivatives

from .frame import Frame, frames_without_state


@final
class AccelerationField:
    """The accelerations of all frames of one root.

    Args:
        offset: an acceleration added to the root's, in its axes; minus gravity makes weight an inertia force.
        rate: the time derivative applied to velocities; one that drops the second derivatives of the coordinates
            gives the accelerations at zero coordinate accelerations.
    """

    def __init__(self, offset: Triple = NULL, rate: Rate = time_derivatives) -> None:
        self._offset = offset
        self._rate = rate
        self._memo: dict[bytes, Accelerated] = {}

    def __call__(self, frame: Frame) -> Accelerated:
        """Return the acceleration of a rigid frame, in its own axes."""
        for link in frames_without_state(frame, self._memo):
            if link.parent is None or link.motion is None:
                self._memo[link.key] = self._start(link)
            else:
                parent = self._memo[link.parent.key]
                self._memo[link.key] = link.motion.child_acceleration(parent, self._rate)
        return self._memo[frame.key]

    def _start(self, root: Frame) -> Accelerated:
        if root.carrier is None:
            return Accelerated(Turning(NULL, NULL), self._offset)
        angular, linear = root.carrier
        own = add3(rates(linear, self._rate), cross3(angular, linear))
        return Accelerated(Turning(angular, rates(angular, self._rate)), add3(own, self._offset))
