"""Bodies beside the links of a mechanism: which link carries each, so that reactions know what is beyond a joint."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from symbody.errors import JointError
from symbody.geometry import Frame
from symbody.multibody.body import Body
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

from .link import Link

__all__ = ["carrying_links"]

_WHERE = "Mechanism.system"


def carrying_links(
    bodies: Sequence[Body], frames: Mapping[Link, Frame], coordinates: Collection[Expr]
) -> dict[str, str]:
    """Return the name of the link that carries each body, by the name of the body; "" where none does.

    Args:
        bodies: the bodies beside those of the links.
        frames: the frames of the links.
        coordinates: those of the joints.

    Raises:
        JointError: a body has no name of its own, or moves by a coordinate of a joint without a link that carries it.
    """
    _check_names([*(link.name for link in frames), *(body.name for body in bodies)])
    return {body.name: _carrier(body, frames, coordinates) for body in bodies}


def _check_names(names: Sequence[str]) -> None:
    twice = next((name for name in names if not name or names.count(name) > 1), None)
    if twice is not None:
        what = f"two bodies have the name {twice}" if twice else "a body has no name"
        raise JointError(
            f"{_WHERE}: {what}; expected a name of its own for each body, such as Body(frame, 1, name='rider'): "
            "reactions find bodies by their names"
        )


def _carrier(body: Body, frames: Mapping[Link, Frame], coordinates: Collection[Expr]) -> str:
    """Return the first link that is met from a body towards the root."""
    frame: Frame | None = body.frame
    while frame is not None:
        met = [link for link, place in frames.items() if place.last_moving == frame.last_moving]
        if frame.parent is not None and met:
            return met[0].name if len(met) == 1 else _of_welded(body, met, frames)
        held = set() if frame.motion is None else {*frame.motion.leaves} & {*coordinates}
        if held:
            raise JointError(
                f"{_WHERE}: the body {brief(body)} moves by {min(map(str, held))}, and no link carries it; expected a "
                f"frame that is built on that of a link, such as mechanism.frame({next(iter(frames))}) * rotate('X', 1)"
            )
        frame = frame.parent
    return ""


def _of_welded(body: Body, met: Sequence[Link], frames: Mapping[Link, Frame]) -> str:
    """Return the one of links that don't move against each other on whose frame a body is built."""
    chain = body.frame.chain
    within = [link for link in met if frames[link] in chain]
    depth = max((frames[link].depth for link in within), default=-1)
    last = [link for link in within if frames[link].depth == depth]
    if len(last) != 1:
        names = " and ".join(str(link) for link in last or met)
        raise JointError(
            f"{_WHERE}: it isn't known which of {names} carries the body {brief(body)}, as they don't move against "
            "each other; expected a frame that is built on that of one of them, or a Link on a fixed joint"
        )
    return last[0].name
