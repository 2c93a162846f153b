"""Checks of a system before its equations are derived: frames, loads, and the use of its coordinates."""

from __future__ import annotations

from symbody.dynamics.recursion.added_mass import check_loads
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree
from symbody.dynamics.tree.given_twist import given_twist
from symbody.errors import FrameError, ModelError
from symbody.geometry import Frame
from symbody.multibody import System
from symbody.multibody.coordinate import rate_of_any
from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.given.arguments import brief


def checked_tree(system: System, where: str) -> FrameTree:
    """Return the tree of a system.

    Args:
        system: the system.
        where: the formalism, for messages.

    Raises:
        ModelError: the system has no equations of motion in its coordinates.
    """
    if system.momenta:
        raise ModelError(
            f"{where}: the speeds of the system are momenta, {brief(', '.join(map(str, system.momenta)))}; derive the "
            "equations of the system in its own speeds, system.whole"
        )
    if system.eliminated:
        raise ModelError(
            f"{where}: the system is embedded: its frames still move by {next(iter(system.eliminated))}, which was "
            "eliminated; derive the equations of the whole system, system.whole, and embed them"
        )
    tree = frame_tree(system)
    for place, frame in enumerate(tree.frames):
        if given_twist(frame) is None:
            _check_motion(frame, system, where)
        else:
            _check_twist(tree, place, where)
    _check_used(tree, where)
    check_loads(system, where)
    return tree


def check_rigid(tree: FrameTree, where: str) -> None:
    """Raise an error that names the first frame whose matrix isn't a rotation by itself."""
    for frame in tree.frames:
        if not frame.is_rigid:
            raise FrameError(
                f"{where}: {brief(frame)} isn't rigid: its matrix isn't a rotation by itself; if "
                "constraints make it one, use lagrange_equations, and correct the matrix if not"
            )


def _check_motion(frame: Frame, system: System, where: str) -> None:
    leaves = frozenset[Expr]() if frame.motion is None else frame.motion.leaves
    rate = rate_of_any(system.coordinates, leaves)
    if rate is not None:
        raise ModelError(
            f"{where}: {brief(frame)} holds the rate {rate}; expected frames of coordinates and time alone"
        )
    speed = min((u.name for u in system.quasi_velocities if u in leaves), default=None)
    if speed is not None:
        raise ModelError(
            f"{where}: {brief(frame)} is moved by {speed}, a speed; expected coordinates of its own"
        )


def _check_twist(tree: FrameTree, place: int, where: str) -> None:
    for twist in tree.partial_twists(place).values():
        for slope in (*twist.spin, *twist.drift):
            speed = next((u for u in tree.system.speeds if u in slope.free_symbols), None)
            if speed is not None:
                raise ModelError(
                    f"{where}: the velocities of {brief(tree.frames[place])} aren't linear in the speed {speed}; "
                    "expected velocities that are linear in all speeds"
                )


def _check_used(tree: FrameTree, where: str) -> None:
    system = tree.system
    used = {system.driving[k].name for moving in tree.moved_by for k in moving}
    used.update(
        leaf.name for leaf in free_symbols(system.by_speeds(system.constraints)) if leaf.depends_on_time
    )
    for unknown in system.driving:
        if unknown.name in used:
            continue
        if unknown in system.quasi_velocities:
            raise ModelError(
                f"{where}: the speed {unknown} moves no frame of a body; leave it out of the speeds, or build a moving "
                "frame with it"
            )
        raise ModelError(
            f"{where}: the coordinate {unknown} appears in no frame of a body and in no constraint; "
            "leave it out of the coordinates, or build a frame with it"
        )
