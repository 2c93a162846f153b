"""Rigid groups: frames of a tree that are fixed in each other by numbers, so that they move as one link."""

from __future__ import annotations

from collections.abc import Iterator
from typing import final

from symbody.geometry.component.triple import is_null

from .frame_tree import FrameTree


@final
class RigidGroups:
    """The rigid groups of a tree.

    Attributes:
        home: by frame, the first frame of its group.
        travels: by frame, whether its origin moves with coordinates.
    """

    def __init__(self, tree: FrameTree) -> None:
        self._tree = tree
        self.home, self.travels = [0], [tree.carried[0]]
        self._bears = [False] * len(tree.frames)
        for place in range(1, len(tree.frames)):
            motion, parent = tree.motions[place], tree.parents[place]
            fixed = all(variable.is_constant for variable in motion.variables)
            self.home.append(self.home[parent] if fixed else place)
            displaced = tree.carried[place] and not is_null(motion.displacement)
            self.travels.append(self.travels[parent] or displaced)
        for place in range(len(tree.frames) - 1, 0, -1):
            if self._bears[place] or self.home[place] == place:
                self._bears[tree.parents[place]] = True

    def before(self, place: int) -> int:
        """Return the first frame of the group that carries a group."""
        return self.home[self._tree.parents[place]]

    def branches(self, home: int) -> Iterator[int]:
        """Return the frames fixed in the first one of a group, at another origin, that bear other groups."""
        for place in range(home + 1, len(self.home)):
            joined = self._tree.parents[place] == home and self.home[place] == home
            if joined and self._bears[place] and not is_null(self._tree.motions[place].displacement):
                yield place
