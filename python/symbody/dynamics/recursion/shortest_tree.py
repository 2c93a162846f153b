"""The tree of frames by which the equations of a system are shortest.

A mechanism can be modelled by other frames in the same coordinates: a pendulum of many links by one frame on another,
or by points of the ground. Where angles cancel along a chain, positions hold the coordinates of angles, something
slides in turned axes, or parallel axes are displaced along themselves, equations are derived by the given frames and by
their normal forms (`tree/normal_frames.py`), and the tree of the fewest operations is kept; so they are for a few
bodies of which some are particles. For the residuals this may be another tree than for the mass matrix and the bias.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias
from weakref import WeakKeyDictionary

from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree, targets, tree_of_forms
from symbody.dynamics.tree.normal_frames import FEW_BODIES, NormalFrames, by_base, by_slides
from symbody.dynamics.tree.orientation_path import placed
from symbody.dynamics.tree.other_forms import have_other_forms
from symbody.geometry import Frame
from symbody.multibody import System
from symbody.symbolic import ENERGY, Expr, cost, derivation

from .articulated_body import is_applicable
from .mass_matrix import mass_matrix
from .recursive_newton_euler import bias

Derive: TypeAlias = Callable[[System, FrameTree], Sequence[Expr]]
"""What is derived from a tree."""

_Forms: TypeAlias = dict[bytes, Frame]
"""The frames of bodies and forces in other forms, by their keys."""

_known: WeakKeyDictionary[System, tuple[_Forms, ...]] = WeakKeyDictionary()
"""By system: the forms to be compared."""

_chosen: WeakKeyDictionary[System, dict[Derive, _Forms]] = WeakKeyDictionary()
"""By system and by what is derived: the forms of the fewest operations."""


def shortest_tree(system: System, derive: Derive) -> FrameTree:
    """Return the tree of a system by which a result has the fewest operations.

    Args:
        system: the system.
        derive: derives the result; a function of a module, since the choice is kept.
    """
    given = frame_tree(system)
    if not (have_other_forms(given.frames, given.parents) or _holds_few_particles(system)):
        return given
    chosen = _chosen.setdefault(system, {})
    if derive not in chosen:
        chosen[derive] = _shortest(system, _candidates(system), derive)
    return tree_of_forms(system, chosen[derive]) if chosen[derive] else given


def mass_matrix_and_bias(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the entries of the mass matrix, row by row, and those of the bias."""
    rest = bias(system, tree)
    return *mass_matrix(system, tree).entries, *rest


def articulated_tree(system: System) -> FrameTree:
    """Return the first tree to which the recursion of articulated bodies is applicable, or the given one."""
    given = frame_tree(system)
    if is_applicable(system, given) or not have_other_forms(given.frames, given.parents):
        return given
    trees = (tree_of_forms(system, forms) for forms in _candidates(system) if forms)
    return next((tree for tree in trees if is_applicable(system, tree)), given)


def _shortest(system: System, candidates: Sequence[_Forms], derive: Derive) -> _Forms:
    if len(candidates) == 1:
        return candidates[0]
    return min(candidates, key=lambda forms: _length(system, forms, derive))


def _length(system: System, forms: _Forms, derive: Derive) -> int:
    with derivation(fresh=True, order=ENERGY):
        return cost(derive(system, tree_of_forms(system, forms))).total


def _candidates(system: System) -> tuple[_Forms, ...]:
    """Return the forms to be compared; they are made once per system."""
    if system not in _known:
        with derivation(fresh=True):
            _known[system] = tuple(_made(system))
    return _known[system]


def _made(system: System) -> Iterator[_Forms]:
    """Return the forms to be compared, the given one first, which is no other form at all."""
    frames = targets(system)
    groups = [NormalFrames(places, _free(system)) for places in by_base(map(placed, frames))]
    if len(groups) == 1 and groups[0].are_many_points:
        yield groups[0].as_points()
        return
    compared: list[_Forms] = [{frame.key: frame for frame in frames}]
    yield {}
    for form in _kinds(groups):
        forms = {key: frame for group in groups for key, frame in form(group).items()}
        if forms not in compared:
            compared.append(forms)
            yield forms


def _kinds(groups: Sequence[NormalFrames]) -> Iterator[Callable[[NormalFrames], _Forms]]:
    """Return the kinds of normal forms of which one may be the shortest."""
    slide = any(frames.slide for frames in groups)
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
    return len(_free(system)) > 0 and len(system.bodies) <= FEW_BODIES


def _free(system: System) -> frozenset[bytes]:
    """Return the keys of the frames of particles alone on which no loads act."""
    held = {body.frame.key for body in system.bodies if not body.is_particle}
    held |= {action.anchor.frame.key for action in system.actions}
    return frozenset(body.frame.key for body in system.bodies if body.frame.key not in held)
