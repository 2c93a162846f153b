"""The spanning tree of a mechanism: which joints place the links, and which ones close loops."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import NamedTuple

from symbody.errors import JointError
from symbody.geometry import Frame
from symbody.symbolic.given.arguments import brief

from .joint import Joint
from .link import Link

__all__ = ["Branch", "spanning_tree"]


class Branch(NamedTuple):
    """A joint of the tree, and the link that it places."""

    joint: Joint
    placed: Link

    @property
    def is_reversed(self) -> bool:
        """Whether the joint's child is nearer to the root."""
        return self.placed is self.joint.parent


def spanning_tree(
    joints: Sequence[Joint], preferred: Collection[Joint] = ()
) -> tuple[tuple[Branch, ...], tuple[Joint, ...]]:
    """Return the joints that open the tree, each with the link that it places, and those that close loops.

    Joints enter the tree one by one, and one whose two sides are connected already closes a loop. Those that the user
    wants in the tree (``loop=False``) come first, then those whose coordinates are needed or given, then those that
    leave the fewest freedoms; among equals the order given decides. So a loop is closed where it takes the fewest
    conditions [Wittenburg 2008, sec. 5.6].

    Args:
        joints: all joints.
        preferred: those whose coordinates are needed.

    Raises:
        JointError: no tree reaches every link, or the joints with ``loop=False`` form a loop.
    """
    chosen = _chosen(joints, preferred)
    branches = tuple(_outwards([joint for joint in joints if joint in chosen]))
    _check_reach(joints, branches)
    return branches, tuple(joint for joint in joints if joint not in chosen)


def _chosen(joints: Sequence[Joint], preferred: Collection[Joint]) -> set[Joint]:
    groups: dict[object, object] = {}

    def group(part: object) -> object:
        while part in groups:
            part = groups[part]
        return part

    def rank(joint: Joint) -> tuple[bool, bool, int]:
        wanted = joint in preferred or joint.are_given
        return joint.mounting.loop is not False, not wanted, len(joint.coordinates)

    chosen = set()
    for joint in sorted((each for each in joints if each.mounting.loop is not True), key=rank):
        one, other = (group(_node(part)) for part in (joint.parent, joint.child))
        if one is not other:
            groups[other] = one
            chosen.add(joint)
        elif joint.mounting.loop is False:
            raise JointError(
                f"assemble: {joint} closes a loop of joints with loop=False; expected at least one joint that closes "
                "the loop: leave loop out for one of them"
            )
    return chosen


_ROOT = object()


def _node(part: Link | Frame) -> object:
    """Return what the tree connects: all frames are one, the root."""
    return _ROOT if isinstance(part, Frame) else part


def _outwards(joints: Sequence[Joint]) -> Iterator[Branch]:
    """Yield the joints of the tree so that each places a link on one that is placed already, or on the root."""
    placed: set[object] = {_ROOT}
    left = list(joints)
    while True:
        for joint in left:
            inside = [_node(part) in placed for part in (joint.parent, joint.child)]
            if any(inside):
                link = joint.child if inside[0] else joint.parent
                assert isinstance(link, Link)
                placed.add(link)
                left.remove(joint)
                yield Branch(joint, link)
                break
        else:
            return


def _check_reach(joints: Iterable[Joint], branches: Iterable[Branch]) -> None:
    reached = {branch.placed for branch in branches}
    links = (part for joint in joints for part in (joint.parent, joint.child) if isinstance(part, Link))
    lost = next((link for link in links if link not in reached), None)
    if lost is None:
        return
    cut = [str(joint) for joint in joints if joint.mounting.loop is True and not joint.pair.coupled]
    by_hand = f"; loop=True of {brief(', '.join(cut))} may be what cuts it off" if cut else ""
    raise JointError(
        f"assemble: no joints lead from a frame to the link {lost}{by_hand}; add one, such as "
        f"free('base', ground, {lost})"
    )
