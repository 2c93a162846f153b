"""Loops of rounded dimensions: conditions that would hold by themselves but for rounding."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import ceil, hypot, log10

from symbody.errors import notify
from symbody.geometry import origin

from .closure import NEARLY, Closure, largest_value, typical_value
from .placed_joint import PlacedJoint

__all__ = ["report_nearly_held", "within_tolerance"]


def within_tolerance(joint: PlacedJoint, tolerance: float) -> PlacedJoint:
    """Return a joint that closes a loop without its conditions that stay within a tolerance at all positions."""
    found = {closure.name: largest_value(closure.condition) for closure in joint.active}
    left = {name: value for name, value in found.items() if value <= tolerance}
    constraining = tuple(name for name in joint.constraining if name not in left)
    return replace(joint, constraining=constraining, residuals=left) if left else joint


def report_nearly_held(joints: Sequence[PlacedJoint]) -> None:
    """Tell of conditions that are small at all positions, so that rounding may decide whether anything moves."""
    for joint in joints:
        sizes = {
            closure.name: size
            for closure in joint.active
            if (size := largest_value(closure.condition)) <= NEARLY * _reach(joint, closure)
        }
        if sizes and not joint.joint.pair.rolls:
            largest = max(sizes.values())
            listed, stay = (
                ", ".join(f"{joint.name}.{name}" for name in sizes),
                "stays" if len(sizes) == 1 else "stay",
            )
            notify(
                f"assemble: {joint} closes its loop but for rounding: {listed} {stay} within {largest:.2g} at all "
                "positions, and as constraints they allow no motion, or contradict others; give exact dimensions, or "
                f"leave out what is so small by assemble(joints, tolerance={10.0 ** ceil(log10(largest)):.0e})"
            )


def _reach(joint: PlacedJoint, closure: Closure) -> float:
    """Return the size of what a condition compares: 1 for sines, the distance of the joint from the origin else."""
    if all(component.is_zero for component in closure.force.components):
        return 1.0
    at = (closure.at - origin(joint.parent_side.ancestor)).projected(joint.parent_side.ancestor)
    return hypot(*map(typical_value, at.components))
