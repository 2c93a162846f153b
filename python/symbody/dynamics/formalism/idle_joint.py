"""Joints of loops that hold what other joints hold already: notices of how they share it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from symbody.errors import notify
from symbody.multibody import System
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import Expr
from symbody.symbolic.given.wording import joined_by_and

from .joint_reaction import cut_loops, label

__all__ = ["tell_shared", "tell_unknown"]


def tell_shared(system: System, placed: PlacedJoint, idle: Mapping[str, Expr]) -> None:
    """Give notices of joints that hold what others hold already, on whose share the reaction of a joint depends.

    Args:
        system: the system.
        placed: the joint.
        idle: the intensities of conditions that hold by themselves, by name, if they aren't zero.
    """
    for closing in [placed] if not placed.opens else [other for other, _ in cut_loops(system, placed)]:
        text = _fault(closing, idle)
        if text:
            names = joined_by_and([closing.name, *_sharing(system, closing)])
            notify(f"reaction: {text}: {names} share them by minimum norm{_way_out(system, closing)}")


def _fault(closing: PlacedJoint, idle: Mapping[str, Expr]) -> str:
    """Return what a joint holds that others hold, too; nothing if it exerts nothing by that."""
    held = [each.name for each in closing.closures if label(closing, each) in idle]
    loads = "the forces of its loop are statically indeterminate"
    if _rests(closing):
        height = "other joints keep the height of the wheel"
        return f"the contact of {closing} holds by itself, as {height}, so that {loads}"
    if closing.closures and not closing.active:
        return f"{closing} holds what other joints hold already, so that {loads}"
    if held:
        names = joined_by_and([f"{closing.name}.{name}" for name in held])
        return f"{names} {'hold' if held[1:] else 'holds'} what other joints hold already, so that {loads}"
    return ""


def _rests(closing: PlacedJoint) -> bool:
    """Whether a wheel closes a loop on a plane from which other joints keep it."""
    return "contact" in {each.name for each in closing.closures} - {*closing.constraining}


def tell_unknown(placed: PlacedJoint) -> None:
    """Give a notice of what a joint that closes a loop holds beside others, if it isn't known how they share it."""
    held = [each.name for each in placed.closures if each.name not in placed.constraining]
    if not placed.opens and held:
        names = joined_by_and([f"{placed.name}.{name}" for name in held])
        notify(
            f"reaction: other joints hold already what {names} would hold, and a constraint that isn't one of a joint "
            f"acts on unknown parts, so that it isn't known what they share: {placed} is taken to exert none of it"
        )


def _sharing(system: System, closing: PlacedJoint) -> Iterator[str]:
    """Yield the names of the joints of the tree that are on the loop which a joint closes."""
    for joint in system.joints:
        if joint.opens and joint.closures and any(other is closing for other, _ in cut_loops(system, joint)):
            yield joint.name


def _way_out(system: System, closing: PlacedJoint) -> str:
    """Return what to do about it."""
    if _rests(closing):
        return (
            "; to know the loads of wheels, leave the height and the attitude of what they carry free, as with a free "
            "joint"
        )
    gears = [other for other in system.joints if closing.joint in other.joint.pair.coupled]
    if gears:
        return f"; {gears[0]} needs {closing.name} for its angle, and it counts as a bearing like the others"
    return "; leave out what bears nothing, or put bushings with the stiffnesses of the structure in their places"
