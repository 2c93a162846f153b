"""Stops: the instants at which joints reach their limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.dynamics import Equations
from symbody.errors import SimulationError
from symbody.geometry.given.argument import checked
from symbody.multibody import System
from symbody.symbolic.given.arguments import brief, with_known_names

from .event import Event

if TYPE_CHECKING:
    from symbody.multibody.joint.placed_joint import PlacedJoint

__all__ = ["stops"]


@checked(SimulationError)
@with_known_names
def stops(equations: Equations) -> list[Event]:
    """Return an event for each limit of a joint, which ends the motion there: ``simulate(..., events=stops(eqs))``.

    Limits are knowledge about a mechanism, and no forces: a motion without these events passes them, and a notice
    reports it. An event is called after its joint, ``A.lower`` or ``A.upper``; if the joint has several coordinates,
    after one of them as well, ``A.phi.lower``. Angles of joints that close loops count all turns in a plane mechanism;
    in space they are known up to whole turns, and are counted from the middle of the limits. A motion that begins at a
    limit or beyond it and moves outwards, or is accelerated there from rest, is refused: no event would end it. If a
    joint passes its limit by more than the tolerances, the motion ends, even if the joint returns within one step. A
    motion that begins beyond a limit and moves inwards ends where it leaves the range of the joint again.

    Args:
        equations: those of a system that `assemble` made.

    Raises:
        SimulationError: no joint has a limit.

    >>> from symbody import Link, Vector, assemble, ground, newton_euler, prismatic, simulate
    >>> lift = assemble([prismatic("A", ground, Link("lift", 1), axis="Z", limits=(-4.905, None))])
    >>> equations = newton_euler(lift.system(gravity=Vector(ground, 0, 0, -9.81)))
    >>> motion = simulate(equations, t=(0, 2), events=stops(equations))
    >>> motion.events[0].event.name, round(motion.events[0].t, 9)
    ('A.lower', 1.0)
    """
    system = equations.system
    joints: tuple[PlacedJoint, ...] = system.joints if isinstance(system, System) else ()
    found = [
        Event(excess, 1, terminal=True, name=f"{joint.label(limit)}.{side}")
        for joint in joints
        for limit in joint.limits
        for side, excess in limit.excesses.items()
    ]
    if not found:
        raise SimulationError(
            f"stops: no joint of {brief(system)} has a limit; give limits to joints, such as "
            "revolute('A', ground, crank, limits=(-1, 1)), and make the system by assemble([...]).system()"
        )
    return found
