"""Whether frames have other forms than the given ones, by which equations may be shorter."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.geometry import Frame
from symbody.symbolic import Expr

from .leg import angles_in
from .orientation_path import Turn, turn_of


def have_other_forms(frames: Sequence[Frame], parents: Sequence[int]) -> bool:
    """Return whether other forms may be shorter.

    So it is where angles cancel along the chains of frames, where displacements hold coordinates that turn frames or
    sines and cosines, where something slides in turned axes, and where a displacement between two parallel axes of
    rotation has a part along them.

    Args:
        frames: parents before their children.
        parents: the place of each frame's parent.
    """
    turning = frozenset[Expr]()
    turns: list[Turn | None] = []
    moving = frozenset[Expr]()
    shifted: list[bool] = []
    """For each frame: whether it is displaced along the axis of its last rotation."""
    for frame, parent in zip(frames, parents, strict=True):
        motion, before = frame.motion, turns[parent] if turns else None
        is_shifted = bool(shifted) and shifted[parent]
        turn = None if motion is None else turn_of(motion)
        if motion is not None and turn is not None:
            turning |= {leaf for leaf in motion.leaves if leaf.depends_on_time}
            if before is not None and before.axis == turn.axis:
                angle = before.angle + turn.angle
                if is_shifted or angle.free_symbols < before.angle.free_symbols | motion.leaves:
                    return True
                turn = Turn(turn.axis, angle)
            before, is_shifted = turn, False
        elif motion is not None and not motion.rotates:
            slides = {leaf for leaf in motion.leaves if leaf.depends_on_time}
            if slides and before is not None:
                return True
            moving |= slides
            for angle in angles_in(motion.displacement):
                turning |= {leaf for leaf in angle.free_symbols if leaf.depends_on_time}
            is_shifted |= before is not None and not motion.displacement[before.axis].is_zero
        if not turning.isdisjoint(moving):
            return True
        turns.append(before)
        shifted.append(is_shifted)
    return False
