"""Joints: two links, where they are joined, and the kinematic pair that they form."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, TypeAlias, final

from symbody.errors import JointError
from symbody.geometry import Frame, Scalar
from symbody.geometry.component.triple import expression
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.symbolic import Expr, functions_of_time
from symbody.symbolic.given.arguments import brief, counted

from .limit import Limit, given_limits
from .link import Link, Place, fixed_place, shown_place
from .pair import Pair

__all__ = ["Coordinates", "Joint", "Mounting", "Part", "joined"]

Part: TypeAlias = Annotated[
    Link | Frame, "a link, such as Link('rod', mass), or a frame that carries the mechanism, such as ground"
]
Coordinate: TypeAlias = Annotated[Scalar | None, "a function of time, such as functions_of_time('phi')"]
Coordinates: TypeAlias = Annotated[
    Sequence[Scalar] | None, "a list of functions of time, such as functions_of_time('psi theta phi')"
]
Loop: TypeAlias = Annotated[bool | None, "True, False or None"]


@dataclass(frozen=True, eq=False)
class Mounting:
    """What a joint connects, and where.

    Attributes:
        name: the name of the joint.
        parent: the link or frame that exerts the reaction.
        child: the link or frame on which the reaction acts.
        at: the axes of the joint on the parent, from the parent's.
        to: the axes of the joint on the child, from the child's.
        loop: whether the joint closes a loop (True), opens the tree (False), or whatever suits (None).
    """

    name: str
    parent: Link | Frame
    child: Link | Frame
    at: Frame
    to: Frame
    loop: bool | None

    @property
    def rows(self) -> list[Row]:
        """The rows of the data sheet about the parts that the joint connects."""
        found = [
            _part_row("parent", self.parent),
            Row("at", shown_place(self.at)),
            _part_row("child", self.child),
            Row("to", shown_place(self.to)),
        ]
        if self.loop is not None:
            found.append(Row("loop", "closes a loop" if self.loop else "opens the tree"))
        return found

    def coupling_rows(self, coupled: Sequence[object]) -> list[Row]:
        """Return these rows for a gear or a rack, which couples two joints."""
        ends = _part_row("parent", self.parent), _part_row("child", self.child)
        return [*ends, Row("couples", " and ".join(map(str, coupled)))]


def _part_row(label: str, part: Link | Frame) -> Row:
    return Row(label, part if isinstance(part, Frame) else part.name)


@final
@dataclass(frozen=True, eq=False)
class Joint(WithSheet):
    """A joint between a parent and a child, made by `revolute`, `prismatic` and the like.

    Where it opens a tree, it places the child by its coordinates. Where it closes a loop, it keeps conditions. Either
    way it has a `reaction`. Two joints are never equal.

    Attributes:
        kind: the word for it, such as "revolute".
        mounting: what it connects, and where.
        pair: how the child may move.
        coordinates: expressions of functions of time, one per freedom.
        are_given: whether the user chose the coordinates.
        limits: the least and the largest values of its coordinates.
    """

    kind: str
    mounting: Mounting
    pair: Pair
    coordinates: tuple[Expr, ...]
    are_given: bool = False
    limits: tuple[Limit, ...] = ()

    @property
    def name(self) -> str:
        """The name of the joint, which those of its coordinates and conditions contain."""
        return self.mounting.name

    @property
    def parent(self) -> Link | Frame:
        """The link or frame that exerts the reaction."""
        return self.mounting.parent

    @property
    def child(self) -> Link | Frame:
        """The link or frame on which the reaction acts."""
        return self.mounting.child

    @property
    def coordinate(self) -> Expr:
        """The coordinate of a joint that has one.

        Raises:
            JointError: it has another number of coordinates.
        """
        if len(self.coordinates) != 1:
            raise JointError(
                f"{self}: {counted(len(self.coordinates), 'coordinate')}, expected one; use coordinates"
            )
        return self.coordinates[0]

    @property
    def sheet(self) -> DataSheet:
        """The data sheet."""
        rows = [
            *(self.mounting.coupling_rows(self.pair.coupled) if self.pair.coupled else self.mounting.rows),
            *self.coordinate_rows(self.coordinates),
            *self._motion_rows,
            *(row for each in self.limits for row in each.rows),
            *(Row(size.name, size.value) for size in self.pair.sizes),
        ]
        return DataSheet(str(self), tuple(rows))

    @property
    def _motion_rows(self) -> list[Row]:
        """The row about the motion that the coordinates describe, which shows the axes; none if it is long."""
        if len(self.coordinates) != len(self.pair.names) or not self.coordinates:
            return []
        motion = self.pair.motion(self.coordinates)
        return [Row("motion", motion)] if len(str(motion)) <= _LONGEST_MOTION else []

    def coordinate_rows(self, coordinates: Sequence[Expr]) -> list[Row]:
        """Return a row for each coordinate of the joint."""
        names = self.pair.names
        named = zip(names, coordinates, strict=True) if len(names) == len(coordinates) else ()
        return [Row(f"coordinate {name}", value) for name, value in named]

    def __repr__(self) -> str:
        return f"{self.kind} {self.name}"


_LONGEST_MOTION = 110
"""The largest number of characters of a motion that is shown."""


def mounted(
    kind: str,
    name: str,
    parts: tuple[Link | Frame, Link | Frame],
    at: Place,
    to: Place,
    *,
    loop: bool | None = None,
) -> Mounting:
    """Return what a joint connects, with its places as frames.

    Args:
        kind: the word for the joint.
        name: its name.
        parts: parent and child.
        at: where it is on the parent.
        to: where it is on the child.
        loop: whether it closes a loop.

    Raises:
        JointError: the name is no identifier, a part is joined to itself, or a place moves.
    """
    if not name.isidentifier():
        raise JointError(
            f"{kind}: the name {brief(repr(name))}; expected letters, digits and underscores, such as 'A' or "
            "'front_axle': the names of coordinates and conditions contain it"
        )
    parent, child = parts
    if parent is child or (isinstance(parent, Frame) and isinstance(child, Frame)):
        raise JointError(
            f"{kind} {name}: joins {brief(parent)} to {brief(child)}; expected two links, or a frame and a link"
        )
    return Mounting(
        name,
        parent,
        child,
        fixed_place(f"{kind} {name}: at", at),
        fixed_place(f"{kind} {name}: to", to),
        loop,
    )


def joined(
    kind: str,
    mounting: Mounting,
    pair: Pair,
    coordinates: Sequence[Scalar] | Scalar | None = None,
    limits: Sequence[Scalar | None] | Mapping[str, Sequence[Scalar | None] | None] | None = None,
    *,
    limited: Sequence[str] | None = None,
) -> Joint:
    """Return a joint, with coordinates of its own unless they are given.

    Args:
        kind: the word for the joint.
        mounting: what it connects, and where.
        pair: how the child may move.
        coordinates: those that the user gave, or None.
        limits: of its one coordinate, or of several by their names.
        limited: what may have limits; the coordinates by default.

    Raises:
        JointError: there are too many or too few coordinates, one doesn't move, or the limits are no pair.
    """
    where = f"{kind} {mounting.name}"
    if coordinates is None:
        names = [f"{stem}_{mounting.name}" for stem in pair.names]
        found = tuple(functions_of_time(names)) if names else ()
    else:
        several = isinstance(coordinates, Sequence) and not isinstance(coordinates, str)
        found = tuple(map(expression, coordinates if several else [coordinates]))  # type: ignore[arg-type]
        _check_coordinates(where, found, pair.names)
    bounds = given_limits(where, limits, pair.names if limited is None else limited, pair.turning)
    return Joint(kind, mounting, pair, found, coordinates is not None, bounds)


def _check_coordinates(where: str, found: Sequence[Expr], names: Sequence[str]) -> None:
    if len(found) != len(names):
        raise JointError(
            f"{where}: {counted(len(found), 'coordinate')}; expected {len(names)}: {', '.join(names)}"
        )
    for each in found:
        if not each.depends_on_time:
            raise JointError(
                f"{where}: the coordinate {brief(each)} doesn't depend on time; expected a function of time, such as "
                f"functions_of_time('{names[0]}'); a joint that doesn't move is fixed"
            )
        rate = next(
            (
                leaf
                for leaf in sorted(each.free_symbols, key=str)
                if leaf.kind == "time_function" and leaf.order
            ),
            None,
        )
        if rate is not None:
            raise JointError(
                f"{where}: the coordinate {brief(each)} holds the rate {rate}; expected a function of time, such as "
                f"{functions_of_time(rate.name)}, or an expression of such functions"
            )
