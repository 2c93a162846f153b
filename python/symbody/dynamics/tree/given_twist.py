"""Frames that move by a given twist: floating and moving ones, and moving master frames."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from symbody.geometry import Frame
from symbody.geometry.component.twist import Twist
from symbody.multibody import System

Change: TypeAlias = Callable[[Frame, Twist], Twist]
"""What replaces the given twist of a frame."""


def given_twist(frame: Frame) -> Twist | None:
    """Return the twist of a frame in its parent, or in ground, if it is given by speeds."""
    return frame.carrier if frame.motion is None else frame.motion.twist


def with_twists(frame: Frame, change: Change) -> Frame:
    """Return a frame of the same pose that moves, with those before it, by other twists."""
    root, *links = frame.chain
    result = root if root.carrier is None else Frame.root(root.name, change(root, root.carrier))
    for link in links:
        motion, given = link.motion, given_twist(link)
        if motion is not None and given is not None:
            twist = change(link, given)
            motion = motion.rewritten((*motion.variables[:-6], *twist.angular, *twist.linear))
        result = result if motion is None else result.then(motion)
        result = result if result.name == link.name else result.named(link.name)
    return result


def by_speeds(frame: Frame, system: System) -> Frame:
    """Return a frame in whose twists the rates of coordinates are written by the speeds; itself if it holds none.

    Otherwise partial velocities would miss the speeds that such a rate holds, and its second rate would be unknown.
    """
    if not frame.moves_by_twist:
        return frame
    twists = (twist for link in frame.chain if (twist := given_twist(link)) is not None)
    values = [component for twist in twists for part in twist for component in part]
    if all(value.free_symbols.isdisjoint(system.known_rates) for value in values):
        return frame
    return with_twists(frame, lambda _, twist: _written(twist, system))


def _written(twist: Twist, system: System) -> Twist:
    p, q, r, u, v, w = system.by_speeds((*twist.angular, *twist.linear))
    return Twist((p, q, r), (u, v, w))
