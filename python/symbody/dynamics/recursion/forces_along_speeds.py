"""Wrenches carried inwards, and the forces along the speeds that balance them [Featherstone 2008, sec. 5.3].

With ``X*`` the transform of wrenches from a frame to its parent, and ``S_k`` the partial twist of frame i in its parent
by the speed k:

    F_i = f_i + sum_c X* F_c        over the children c of frame i
    tau_k = sum_i S_k . F_i         over the frames that the speed k moves in their parents

Frames that slide in one parent share their sums (`sliding.py`).
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.inertia.wrench import Wrench
from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.symbolic import Expr, number

from .sliding import force_shares, slides, sliding_children


def forces_along_speeds(tree: FrameTree, wrenches: Sequence[Wrench]) -> tuple[Expr, ...]:
    """Return the power of wrenches, one per frame and in its axes, per unit of each speed."""
    F, tau = list(wrenches), [number(0)] * len(tree.system.speeds)
    sliding = sliding_children(tree)
    for i in range(len(tree.frames) - 1, -1, -1):
        if children := [child for child in sliding[i] if not F[child].is_null]:
            for k, share in force_shares(tree, children, [F[child].force for child in children]):
                tau[k] += share
        if F[i].is_null:
            continue
        if tree.moved_by[i] and not slides(tree, i):
            for k, S in tree.partial_twists(i).items():
                tau[k] += F[i].power(S)
        parent = tree.parents[i]
        if i > 0 and tree.carried[parent]:
            F[parent] = F[parent].plus(F[i].to_parent(tree.motions[i]))
    return tuple(tau)
