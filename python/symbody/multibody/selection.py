"""The bodies and loads to which a function is applied, from a system, a set, a list or a single one."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from symbody.errors import ModelError, ModelNotice
from symbody.geometry import Frame, Vector
from symbody.symbolic.given.arguments import brief

from .body import Body
from .load import Action, Load
from .system import System

Objects: TypeAlias = Annotated[
    System | Body | Load | Iterable[Body | Load],
    "a system, a body, a load, or a set or list of bodies and loads",
]
"""A system, a body, a load, or a set or list of bodies and loads."""


@dataclass(frozen=True)
class Selection:
    """Bodies and loads in a fixed order, and the gravity that acts on them."""

    bodies: tuple[Body, ...]
    loads: tuple[Load, ...]
    gravity: Vector | None

    @property
    def root(self) -> Frame:
        """The frame to which all bodies are attached: ground, or a moving master frame."""
        return self.bodies[0].frame.ancestor

    def actions(self, where: str) -> list[Action]:
        """Return what the loads do to the bodies; loads on other bodies are left out, with a notice."""
        members = set(self.bodies)
        found = []
        for load in self.loads:
            inside = [action for action in load.actions if action.body in members]
            if not inside:
                bodies = " and ".join(brief(action.body) for action in load.actions)
                warnings.warn(
                    f"{where}: {brief(load)} is left out: it acts on {bodies}, not in the set",
                    ModelNotice,
                    stacklevel=3,
                )
            found += inside
        return found


def select(objects: Objects, where: str, gravity: Vector | None = None) -> Selection:
    """Return the bodies and loads of a system, a set or a list; sets are put in an order that runs don't change."""
    if isinstance(objects, System):
        return Selection(objects.bodies, objects.loads, objects.gravity if gravity is None else gravity)
    things: list[object] = [objects] if isinstance(objects, Body | Load) else list(objects)
    bodies = [thing for thing in things if isinstance(thing, Body)]
    loads = [thing for thing in things if isinstance(thing, Load)]
    strangers = [thing for thing in things if not isinstance(thing, Body | Load)]
    if strangers:
        raise ModelError(
            f"{where}: {brief(strangers[0])} is neither a body nor a load; give bodies, forces and torques"
        )
    if isinstance(objects, set | frozenset):
        bodies.sort(key=lambda body: body.key)
        loads.sort(key=lambda load: load.key)
    return Selection(tuple(bodies), tuple(loads), gravity)


def select_bodies(objects: Objects, where: str, gravity: Vector | None = None) -> Selection:
    """Return a selection of which at least one body is expected."""
    selection = select(objects, where, gravity)
    if not selection.bodies:
        raise ModelError(f"{where}: no body among the objects; give at least one")
    return selection
