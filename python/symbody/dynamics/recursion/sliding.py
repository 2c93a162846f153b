"""Translations in one parent: children that move alike share the sums of masses and forces.

Children c of one frame that slide in it, without turning, by the partial velocities ``v_ck`` of the speeds k give

    H_jk = sum_c m_c v_cj . v_ck        tau_k = sum_c v_ck . f_c

Where several children have the same partial velocity v, such as all points of a chain beyond its k-th bar, the products
are those of v with one sum of masses or forces, and the sums themselves are running sums. A chain of points given by
absolute angles is then as cheap as the same chain given joint by joint.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import add
from typing import NamedTuple

from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.geometry.component.triple import Triple
from symbody.symbolic import Expr, add3, dot3, number, scale3

from .subset_sum import SubsetSum


class Entry(NamedTuple):
    """A part of an entry of the mass matrix, in the row j and the column k."""

    j: int
    k: int
    value: Expr


class Share(NamedTuple):
    """A part of the force along the speed k."""

    k: int
    value: Expr


def slides(tree: FrameTree, place: int) -> bool:
    """Return whether speeds move a frame in its parent, and none of them turns it."""
    return bool(tree.moved_by[place]) and place > 0 and not tree.motions[place].rotates


def sliding_children(tree: FrameTree) -> list[list[int]]:
    """Return, for each frame of the tree, the children that slide in it."""
    children: list[list[int]] = [[] for _ in tree.frames]
    for place in range(len(tree.frames)):
        if slides(tree, place):
            children[tree.parents[place]].append(place)
    return children


def mass_entries(tree: FrameTree, children: Sequence[int], masses: Sequence[Expr]) -> Iterator[Entry]:
    """Return the entries of the mass matrix among the translations of some children.

    Args:
        tree: the frames of the system.
        children: places of frames that slide in one parent.
        masses: for each of these, the mass that it carries.
    """
    total, moved = SubsetSum(masses, add), _alike(tree, children)
    for k in moved:
        for j in moved:
            if j <= k:
                yield Entry(j, k, _overlap(moved[j], moved[k], total))


def force_shares(tree: FrameTree, children: Sequence[int], forces: Sequence[Triple]) -> Iterator[Share]:
    """Return the power of forces on the translations of some children, per unit of each speed.

    Args:
        tree: the frames of the system.
        children: places of frames that slide in one parent.
        forces: the force on each of these, in the axes of the parent.
    """
    total = SubsetSum(forces, add3)
    for k, drifts in _alike(tree, children).items():
        for drift, subset in drifts.items():
            yield Share(k, dot3(drift, total(subset)))


def _alike(tree: FrameTree, children: Sequence[int]) -> dict[int, dict[Triple, int]]:
    """Return, by speed and partial velocity, the subset of children that have this partial velocity."""
    result: dict[int, dict[Triple, int]] = {}
    for bit, child in enumerate(children):
        for k, twist in tree.partial_twists(child).items():
            subsets = result.setdefault(k, {})
            subsets[twist.drift] = subsets.get(twist.drift, 0) | (1 << bit)
    return result


def _overlap(first: dict[Triple, int], second: dict[Triple, int], total: SubsetSum[Expr]) -> Expr:
    """Return the sum of ``m v . w`` over the children, v and w being their partial velocities."""
    result = number(0)
    for v, these in first.items():
        for w, those in second.items():
            both = these & those
            if both:
                result += (
                    dot3(scale3(total(both), v), w) if both == these else dot3(v, scale3(total(both), w))
                )
    return result
