"""Drives: prescribed motions, in frames or in kinematics, whose work the equations don't contain.

The velocities of bodies and loads are ``v = V u + v_0``. The equations of motion balance power along ``V``, the virtual
velocities: then the energy changes by the work of the loads alone if, and only if, v is such a velocity too. So it is
where ``v_0`` is a combination of the columns of V, as after a shift of the speeds. If not, something is led by a force
that the equations don't contain: a frame that moves with time, a constant forward velocity, kinematics such as
``y' = V``, or an eliminated constraint that moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from symbody.geometry.component.triple import Rate
from symbody.geometry.frame.frame_velocity import origin_velocity, spin
from symbody.multibody import System
from symbody.multibody.load import action_velocity
from symbody.symbolic import Expr, Matrix, derivation, jacobian, number, substitute

__all__ = ["is_driven", "moves_at_rest"]


def moves_at_rest(system: System, speeds: Sequence[Expr], by_state: Rate) -> bool:
    """Return whether bodies or loads have velocities while all speeds are zero.

    Args:
        system: the system.
        speeds: u.
        by_state: writes expressions by time, coordinates and speeds.
    """
    with derivation():
        velocities = by_state(list(_velocities(system)))
        return not all(each.is_zero for each in substitute(velocities, dict.fromkeys(speeds, number(0))))


def is_driven(system: System, speeds: Sequence[Expr], by_state: Rate) -> bool:
    """Return whether something is led by a force whose work the equations don't contain.

    Args:
        system: the system.
        speeds: u.
        by_state: writes expressions by time, coordinates and speeds.
    """
    with derivation():
        velocities = by_state(list(_velocities(system)))
        drift = substitute(velocities, dict.fromkeys(speeds, number(0)))
        if all(each.is_zero for each in drift):
            return False
        partial = jacobian(velocities, speeds)
        both = Matrix([[*partial.row(k), each] for k, each in enumerate(drift)])
        return both.rank() > partial.rank()


def _velocities(system: System) -> Iterator[Expr]:
    """Yield the velocities on which masses and loads depend."""
    for body in system.bodies:
        yield from origin_velocity(body.frame).components
        if not body.is_particle:
            yield from spin(body.frame)
    for action in system.actions:
        yield from action_velocity(action).components
