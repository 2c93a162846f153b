"""Drives: what moves bodies from outside, by work that the equations of motion do not contain."""

from __future__ import annotations

from collections.abc import Iterator

from symbody.multibody import System
from symbody.symbolic import Expr, substitute

__all__ = ["drives"]


def drives(system: System) -> tuple[str, ...]:
    """Return the names of what moves bodies or gravity as given functions of time; the energy isn't constant then.

    A frame such as ``rotate("Z", W*t)`` moves without a coordinate, and so does one that an input moves, or a moving
    frame with a given velocity. Constraints that move are no drives: their work is known by their multipliers.
    """
    return tuple(sorted({*_of_frames(system), *_of_gravity(system)}))


def _of_frames(system: System) -> Iterator[str]:
    at_rest = dict.fromkeys(system.speeds, 0)
    for frame in dict.fromkeys(frame for body in system.bodies for frame in body.frame.chain):
        twist = frame.carrier if frame.motion is None else frame.motion.twist
        if twist is not None:
            velocities = substitute([*twist.angular, *twist.linear], at_rest)
            yield from (str(velocity) for velocity in velocities if not velocity.is_zero)
        elif frame.motion is not None:
            yield from _strange(frame.motion.leaves, system)


def _of_gravity(system: System) -> Iterator[str]:
    if system.gravity is None or system.root.carrier is not None:
        return
    for component in system.gravity.projected(system.root).components:
        yield from _strange(component.free_symbols, system)


def _strange(leaves: frozenset[Expr], system: System) -> Iterator[str]:
    """Return the names of what depends on time, and is neither a coordinate nor a speed."""
    known = {each.name for each in (*system.coordinates, *system.quasi_velocities)}
    return (leaf.name for leaf in leaves if leaf.depends_on_time and leaf.name not in known)
