"""Compared forms: the normal forms of the frames of a system of which one may give the shortest equations.

A mechanism can be modelled by other frames in the same coordinates: a pendulum of many links by one frame on another,
or by points of the ground. Forms are compared where angles cancel along a chain, positions hold the coordinates of
angles, something slides in turned axes, or parallel axes are displaced along themselves (`other_forms.py`), and for a
few bodies of which some are particles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias
from weakref import WeakKeyDictionary

from symbody.geometry import Frame
from symbody.multibody import System
from symbody.symbolic import derivation

from .anchored_action import anchor_of
from .frame_tree import frame_tree, targets
from .normal_frames import FEW_BODIES, NormalFrames, by_base, by_slides
from .orientation_path import placed
from .other_forms import have_other_forms

Forms: TypeAlias = dict[bytes, Frame]
"""The frames of bodies and forces in other forms, by their keys; none for those in the given form."""

_known: WeakKeyDictionary[System, tuple[Forms, ...]] = WeakKeyDictionary()
"""By system: the forms to be compared."""


def compared_forms(system: System) -> tuple[Forms, ...]:
    """Return the forms to be compared, the given one first, unless another one is known to be the shortest.

    They are made once per system.
    """
    if system not in _known:
        given = frame_tree(system)
        if have_other_forms(given.frames, given.parents) or _holds_few_particles(system):
            with derivation(fresh=True):
                _known[system] = tuple(_made(system))
        else:
            _known[system] = ({},)
    return _known[system]


def _made(system: System) -> Iterator[Forms]:
    """Return the forms to be compared, the given one first, which is no other form at all."""
    frames = targets(system)
    groups = [NormalFrames(places, _free(system)) for places in by_base(placed(frames))]
    if len(groups) == 1 and groups[0].are_many_points:
        yield groups[0].as_points()
        return
    compared: list[Forms] = [{frame.key: frame for frame in frames}]
    yield {}
    for form in _kinds(groups):
        forms = {key: frame for group in groups for key, frame in form(group).items()}
        if forms not in compared:
            compared.append(forms)
            yield forms


def _kinds(groups: Sequence[NormalFrames]) -> Iterator[Callable[[NormalFrames], Forms]]:
    """Return the kinds of normal forms of which one may be the shortest."""
    slide = any(frames.slide for frames in groups)
    if not all(frames.share_legs for frames in groups):
        yield NormalFrames.in_local_axes
    few = any(frames.hold_few_particles for frames in groups)
    if slide or few or any(frames.are_parallel for frames in groups):
        yield NormalFrames.in_axes_of_base
        yield NormalFrames.in_chains
        if few or not all(frames.are_free for frames in groups):
            yield NormalFrames.in_chains_turned_back
            yield NormalFrames.in_axes_of_bodies
    if slide:
        yield lambda frames: frames.in_local_axes(by_slides)
        yield lambda frames: frames.in_chains(by_slides)


def _holds_few_particles(system: System) -> bool:
    """Return whether a system holds particles, which can be carried in many ways, and is small enough to try all."""
    return len(system.bodies) <= FEW_BODIES and len(_free(system)) > 0


def _free(system: System) -> frozenset[bytes]:
    """Return the keys of the frames of particles alone on which no loads act."""
    held = {body.frame.key for body in system.bodies if not body.is_particle}
    held |= {anchor_of(action).frame.key for action in system.actions}
    return frozenset(body.frame.key for body in system.bodies if body.frame.key not in held)
