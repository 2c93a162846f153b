"""Wrenches: a force and a moment on a frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from symbody.dynamics.tree.partial_motion import PartialTwist
from symbody.geometry.component.triple import Triple, is_null
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.symbolic import Expr, add3, cross3, dot3, scale3, sub3, sum_of


class Wrench(NamedTuple):
    """A force and the moment about the origin of a frame, in its axes."""

    force: Triple
    moment: Triple

    def plus(self, other: Wrench) -> Wrench:
        """Return the sum of two wrenches on one frame."""
        return Wrench(add3(self.force, other.force), add3(self.moment, other.moment))

    def minus(self, other: Wrench) -> Wrench:
        """Return the difference of two wrenches on one frame."""
        return Wrench(sub3(self.force, other.force), sub3(self.moment, other.moment))

    def scaled(self, factor: Expr) -> Wrench:
        """Return the wrench times a factor."""
        return Wrench(scale3(factor, self.force), scale3(factor, self.moment))

    def to_parent(self, motion: FrameMotion) -> Wrench:
        """Return the same wrench on the parent."""
        force, moment = motion.to_parent(self.force), motion.to_parent(self.moment)
        if is_null(motion.displacement):
            return Wrench(force, moment)
        return Wrench(force, add3(moment, cross3(motion.displacement, force)))

    def power(self, twist: PartialTwist) -> Expr:
        """Return ``S . F``, the power of the wrench on a partial twist S of the same frame."""
        return dot3(twist.spin, self.moment) + dot3(twist.drift, self.force)

    @property
    def is_central(self) -> bool:
        """Whether there is only a force, whose line passes through the origin."""
        return is_null(self.moment)

    @property
    def is_null(self) -> bool:
        """Whether there is neither force nor moment."""
        return is_null(self.force) and is_null(self.moment)


def resultant(wrenches: Sequence[Wrench]) -> Wrench:
    """Return the sum of wrenches on one frame, added up at once, so that factors which several have stand once."""
    forces, moments = zip(*wrenches, strict=True)
    return Wrench(_sum(forces), _sum(moments))


def _sum(triples: Sequence[Triple]) -> Triple:
    x, y, z = map(sum_of, zip(*triples, strict=True))
    return x, y, z
