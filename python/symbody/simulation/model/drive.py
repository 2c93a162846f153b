"""Drives: prescribed motions, in frames or in kinematics, whose work the equations don't contain.

The velocities of bodies and loads are ``v = V u + v_0``. The equations of motion balance power along ``V``, the virtual
velocities: then the energy changes by the work of the loads alone if, and only if, v is such a velocity too. So it is
where ``v_0 = V u_0``, as after a shift of the speeds, with ``A u_0 = 0``: else the forces of the constraints A u + b do
more work than the ``-lambda . b`` that is counted. If there is no such u_0, something is led by a force
that the equations don't contain: a frame that moves with time, a constant forward velocity, kinematics such as
``y' = V``, or an eliminated constraint that moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from symbody.geometry.component.triple import Rate
from symbody.geometry.frame.frame import links_of
from symbody.geometry.frame.frame_velocity import origin_velocity, spin
from symbody.multibody import System
from symbody.multibody.load import action_velocity
from symbody.symbolic import Expr, Matrix, derivation, jacobian, number, substitute

__all__ = ["does_uncounted_work", "moves_at_rest", "names_of_drives"]


def moves_at_rest(system: System, speeds: Sequence[Expr], by_state: Rate) -> bool:
    """Return whether bodies or loads have velocities while all speeds are zero.

    Args:
        system: the system.
        speeds: u.
        by_state: writes expressions by time, coordinates and speeds.
    """
    with derivation():
        return bool(_velocities_and_drift(system, speeds, by_state)[1])


def does_uncounted_work(
    system: System, speeds: Sequence[Expr], by_state: Rate, constraints: Sequence[Expr]
) -> bool:
    """Return whether something is led by a force whose work the equations don't contain.

    Args:
        system: the system.
        speeds: u.
        by_state: writes expressions by time, coordinates and speeds.
        constraints: A u + b, in time, coordinates and speeds.
    """
    with derivation():
        velocities, drift = _velocities_and_drift(system, speeds, by_state)
        if not drift:
            return False
        partial = jacobian([*velocities, *constraints], speeds)
        drifts = [*drift, *(number(0) for _ in constraints)]
        both = Matrix([[*partial.row(k), each] for k, each in enumerate(drifts)])
        return both.rank() > partial.rank()


def _velocities_and_drift(
    system: System, speeds: Sequence[Expr], by_state: Rate
) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
    """Return the velocities on which masses and loads depend, and their values at zero speeds unless all vanish."""
    velocities = by_state(list(_velocities(system)))
    drift = substitute(velocities, dict.fromkeys(speeds, number(0)))
    return velocities, () if all(each.is_zero for each in drift) else drift


def _velocities(system: System) -> Iterator[Expr]:
    """Yield the velocities on which masses and loads depend."""
    for body in system.bodies:
        yield from origin_velocity(body.frame).components
        if not body.is_particle:
            yield from spin(body.frame)
    for action in system.actions:
        yield from action_velocity(action).components


def names_of_drives(system: System) -> tuple[str, ...]:
    """Return the names of what moves bodies or gravity as given functions of time, for messages.

    A frame such as ``rotate("Z", W*t)`` moves without a coordinate, and so does one that an input moves, or a moving
    frame with a given velocity.
    """
    return tuple(sorted({*_of_frames(system), *_of_gravity(system)}))


def _of_frames(system: System) -> Iterator[str]:
    at_rest = dict.fromkeys(system.speeds, number(0))
    for frame in links_of(body.frame for body in system.bodies):
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
