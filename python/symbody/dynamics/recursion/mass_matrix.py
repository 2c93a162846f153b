"""The mass matrix by composite rigid bodies [Walker & Orin 1982; Featherstone 2008, sec. 6.2], in local axes.

With ``X*`` the transform of wrenches from a frame to its parent, and ``S_k`` the partial twist of frame i in its parent
by the speed k:

    I_i^c = I_i + sum_c X* I_c^c X        composite inertia: the tree beyond frame i, frozen; c are the children of i
    F_k = I_i^c S_k                       the wrench for a unit acceleration of the speed k, carried inwards by X*
    H_jk = S_j . F_k                      for each speed j of frame i, and of the frames on the way inwards

A speed may move several frames. F_k is then the sum of the wrenches that its motions need, and where it meets another
motion by the speed k, ``S_k . F_k`` counts twice: once for each order of the two motions. Frames that slide in one
parent share their sums of masses (`sliding.py`).
"""

from __future__ import annotations

from typing import final

from symbody.dynamics.inertia.base_inertia import base_inertias
from symbody.dynamics.inertia.composite import Composite
from symbody.dynamics.inertia.wrench import Wrench
from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, are_small, derivation, number

from .sliding import mass_entries, slides, sliding_children


def mass_matrix(system: System, tree: FrameTree) -> Matrix:
    """Return the mass matrix H of a tree of rigid frames, n x n for n speeds.

    If all speeds are small, so are the accelerations, and H is that of the position at which small variables vanish.
    """
    is_small = all(are_small([u]) for u in system.speeds) and not system.has_quasi_velocities
    with derivation(order=0 if is_small else None):
        return _CompositeRigidBodies(system, tree).matrix()


@final
class _CompositeRigidBodies:
    """The recursion from the leaves to the root."""

    def __init__(self, system: System, tree: FrameTree) -> None:
        self._tree = tree
        n = len(system.speeds)
        self._H = [[number(0)] * n for _ in range(n)]
        self._I: list[Composite | None] = [None] * len(tree.frames)
        self._F: list[dict[int, Wrench]] = [{} for _ in tree.frames]
        """By frame: the wrenches that have been carried to it, by the place of their speed."""
        for i, body in base_inertias(system, tree).all():
            self._add_inertia(i, body)

    def matrix(self) -> Matrix:
        sliding = sliding_children(self._tree)
        for i in range(len(self._tree.frames) - 1, -1, -1):
            self._add_entries_among(sliding[i])
            composite = self._I[i]
            if composite is not None:
                self._add_entries_beyond(i)
                self._add_own_entries(i, composite)
                self._carry_inwards(i, composite)
        return Matrix(self._H)

    def _add_entries_beyond(self, i: int) -> None:
        """Add ``S_j . F_k`` for the speeds j that move a frame and the speeds k that move those beyond it."""
        twists = self._tree.partial_twists(i)
        for k, F in self._F[i].items():
            for j, S in twists.items():
                self._add(k, j, F.power(S) * (2 if j == k else 1))

    def _add_own_entries(self, i: int, composite: Composite) -> None:
        """Add ``S_j . I^c S_k`` for the speeds that move one frame; those of sliding frames follow at the parent."""
        if slides(self._tree, i):
            return
        twists = self._tree.partial_twists(i)
        own = {k: composite.wrench(S.spin, S.drift) for k, S in twists.items()}
        for k, F in own.items():
            for j, S in twists.items():
                if k >= j:
                    self._add(k, j, F.power(S))
        for k, F in own.items():
            self._add_wrench(i, k, F)

    def _carry_inwards(self, i: int, composite: Composite) -> None:
        """Add the composite inertia of a frame, and the wrenches at it, to those of its parent."""
        parent = self._tree.parents[i]
        if i == 0 or not self._tree.carried[parent]:
            return
        if slides(self._tree, i):
            for k, S in self._tree.partial_twists(i).items():
                self._add_wrench(i, k, composite.wrench(S.spin, S.drift))
        motion = self._tree.motions[i]
        self._add_inertia(parent, composite.to_parent(motion))
        for k, F in self._F[i].items():
            self._add_wrench(parent, k, F.to_parent(motion))

    def _add_entries_among(self, children: list[int]) -> None:
        """Add the entries among the speeds of children that slide in one parent."""
        bodies = {child: composite for child in children if (composite := self._I[child]) is not None}
        for j, k, value in mass_entries(self._tree, [*bodies], [body.mass for body in bodies.values()]):
            self._add(j, k, value)

    def _add_inertia(self, i: int, body: Composite) -> None:
        other = self._I[i]
        self._I[i] = body if other is None else other.plus(body)

    def _add_wrench(self, i: int, k: int, wrench: Wrench) -> None:
        wrenches = self._F[i]
        wrenches[k] = wrenches[k].plus(wrench) if k in wrenches else wrench

    def _add(self, j: int, k: int, value: Expr) -> None:
        self._H[j][k] = self._H[k][j] = self._H[j][k] + value
