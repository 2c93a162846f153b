"""Chains of frames: their rigid segments from joint to joint, the guides along which they slide, and their joints."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from symbody.geometry import Frame, Point, origin
from symbody.geometry.component.triple import Triple, is_null
from symbody.multibody import Body


@dataclass(frozen=True)
class Segment:
    """A constant distance in a frame: from its origin to that of the next frame of the chain."""

    frame: Frame
    to: Triple


def segments(bodies: Sequence[Body]) -> dict[Segment, int]:
    """Return the segments of the chains that carry bodies, each with the index of the body that moves with it.

    A segment that moves with several bodies belongs to the first of them; one that moves with none has the index -1.

    >>> from symbody import rotate, symbols, functions_of_time, translate
    >>> bar = Body(rotate("Z", functions_of_time("q")) * translate(symbols("l"), 0, 0), 1)
    >>> [segment.to for segment in segments([bar])]
    [(l, 0, 0)]
    """
    owners: dict[Frame, int] = {}
    for number, body in enumerate(bodies):
        owners.setdefault(body.frame.last_moving, number)
    owners[bodies[0].frame.ancestor] = -1
    found: dict[Segment, int] = {}
    for frame in (frame for body in bodies for frame in body.frame.chain):
        motion, parent = frame.motion, frame.parent
        if motion is None or parent is None:
            continue
        to = motion.displacement
        if not is_null(to) and not any(x.depends_on_time for x in to):
            found[Segment(parent, to)] = owners.get(parent.last_moving, -1)
    return found


def carried_by_segments(bodies: Sequence[Body]) -> dict[int, set[int]]:
    """Return the indices of the bodies beyond each segment that moves with none, by its number among `segments`.

    >>> from symbody import rotate, functions_of_time, translate
    >>> p, q = functions_of_time("p q")
    >>> carried_by_segments([Body(rotate("Z", p) * translate(1, 0, 0) * rotate("Z", q), 1)])
    {0: {0}}
    """
    root, found = bodies[0].frame.ancestor, {}
    for number, (segment, owner) in enumerate(segments(bodies).items()):
        if owner < 0 and segment.frame.last_moving is not root:
            found[number] = {
                k
                for k, body in enumerate(bodies)
                if any(frame.parent is segment.frame for frame in body.frame.chain)
            }
    return found


@dataclass(frozen=True)
class Guide:
    """A straight line along which a frame slides, in its parent frame."""

    frame: Frame
    displacement: Triple


def guides(bodies: Iterable[Body]) -> list[Guide]:
    """Return the guides of the chains that carry bodies: translations along one axis by a function of time.

    >>> from symbody import rotate, functions_of_time, translate
    >>> s = functions_of_time("s")
    >>> [guide.displacement for guide in guides([Body(translate(0, 0, 1) * translate(s, 0, 0), 1)])]
    [(s, 0, 0)]
    """
    found: dict[Guide, None] = {}
    for body in bodies:
        for frame in body.frame.chain:
            motion, parent = frame.motion, frame.parent
            if motion is None or parent is None or motion.rotates:
                continue
            if sum(x.depends_on_time for x in motion.displacement) == 1:
                found[Guide(parent, motion.displacement)] = None
    return list(found)


def joint(body: Body) -> Point:
    """Return the place of the last moving joint in the chain of a body, with coordinates in the body's frame."""
    return origin(body.frame.last_moving).projected(body.frame)
