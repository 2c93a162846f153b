"""All frames of a model."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.geometry import Frame, Vector

from .body import Body
from .load import Load


def all_frames(bodies: Iterable[Body], loads: Iterable[Load], gravity: Vector | None) -> tuple[Frame, ...]:
    """Return the frames of bodies, loads and gravity, and their parents; parents come first."""
    frames = [body.frame for body in bodies]
    for action in (action for load in loads for action in load.actions):
        frames.append(action.vector.frame)
        if action.point is not None:
            frames.append(action.point.frame)
    if gravity is not None:
        frames.append(gravity.frame)
    found: dict[Frame, None] = {}
    for frame in frames:
        missing = []
        link: Frame | None = frame
        while link is not None and link not in found:
            missing.append(link)
            link = link.parent
        found |= dict.fromkeys(reversed(missing))
    return tuple(found)
