"""Joints that close a loop without effect, because other joints hold already what they hold: notices of them."""

from __future__ import annotations

from symbody.errors import notify
from symbody.multibody import System
from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["tell_idle"]


def tell_idle(system: System, placed: PlacedJoint) -> None:
    """Give a notice of a joint that closes a loop, and holds what other joints hold already: all, or a wheel's load."""
    if placed.closures and not placed.opens and not placed.active:
        notify(
            f"reaction: {placed} holds what other joints hold already, so that the forces of its loop are statically "
            f"indeterminate; it is taken to exert none{_way_out(system, placed)}"
        )
    elif not placed.opens and "contact" in {each.name for each in placed.closures} - {*placed.constraining}:
        notify(
            f"reaction: the contact of {placed} holds by itself, as other joints keep the height of the wheel, so that "
            "the wheel is taken to carry no load, and these joints carry it; to know the loads of wheels, leave the "
            "height and the attitude of what they carry free, as with a free joint"
        )


def _way_out(system: System, placed: PlacedJoint) -> str:
    """Return what to do about an idle joint, or which gear it serves, as that of the ring of a planetary gear does."""
    gears = [other for other in system.joints if placed.joint in other.joint.pair.coupled]
    if gears:
        return f", as if it only gave {gears[0]} its angle, and the other joints carry all"
    return "; leave it out, or put a bushing in its place to share them"
