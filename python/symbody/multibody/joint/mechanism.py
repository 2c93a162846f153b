"""Mechanisms: links and joints, assembled to bodies with frames, coordinates and constraints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Annotated, Any, TypeAlias, final

from symbody.errors import JointError, notify
from symbody.geometry import Frame, Point, Scalar, Vector
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.multibody.constraint import Condition, Constraint
from symbody.multibody.system import Loads, System
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted

from .closure import Closure, Sides, names_that_constrain
from .joint import Joint
from .link import Link
from .mesh import Mesh
from .placed_joint import PlacedJoint
from .spanning_tree import Branch, spanning_tree

__all__ = ["Mechanism", "assemble"]

Joints: TypeAlias = Annotated[Sequence[Joint], "a list of joints, such as [revolute('A', ground, crank)]"]
WhichLink: TypeAlias = Annotated[Link | str, "a link of the mechanism, or its name"]
WhichJoint: TypeAlias = Annotated[Joint | str, "a joint of the mechanism, or its name"]


@final
@dataclass(frozen=True, eq=False)
class Mechanism:
    """Links that are placed by joints: bodies with frames, coordinates, and the constraints of the loops.

    `assemble` makes it.

    Attributes:
        joints: the joints where they are placed, in the order given.
        places: the links with their frames.
        bodies: the bodies of the links, in the order in which the joints name them.
        coordinates: those of the joints that open the tree, in the order of the joints.

    >>> from symbody import Link, Vector, ground, newton_euler, revolute, symbols
    >>> m, l, g = symbols("m l g")
    >>> bob = Link("bob", m, center=(0, -l, 0))
    >>> pendulum = assemble([revolute("A", ground, bob)])
    >>> newton_euler(pendulum.system(gravity=Vector(ground, 0, -g, 0))).residuals
    (l*m*(l*phi_A'' + g*sin(phi_A)),)
    """

    joints: tuple[PlacedJoint, ...]
    places: tuple[tuple[Link, Frame], ...]
    bodies: tuple[Body, ...]
    coordinates: tuple[Expr, ...]

    @property
    def frames(self) -> dict[Link, Frame]:
        """The frames of the links, by link."""
        return dict(self.places)

    @cached_property
    def constraints(self) -> tuple[Constraint, ...]:
        """The conditions of the joints, by names such as ``A.x``; those that hold by themselves are left out."""
        bodies = {body.name: body for body in self.bodies}
        return tuple(
            Constraint(
                closure.condition,
                f"{joint.name}.{closure.name}",
                on=[bodies.get(name, frame) for name, frame in joint.ends],
            )
            for joint in self.joints
            for closure in joint.active
        )

    @checked(JointError)
    def frame(self, link: WhichLink) -> Frame:
        """Return the frame of a link."""
        return self.frames[self._link(link)]

    @checked(JointError)
    def body(self, link: WhichLink) -> Body:
        """Return the body of a link."""
        name = self._link(link).name
        return next(body for body in self.bodies if body.name == name)

    @checked(JointError)
    def point(self, link: WhichLink, x: Scalar, y: Scalar, z: Scalar, *, name: str = "") -> Point:
        """Return a point by its coordinates in the axes of a link.

        Args:
            link: the link, or its name.
            x: along the x axis of the link.
            y: along y.
            z: along z.
            name: what the point is called where it is shown.
        """
        return Point(self.frame(link), x, y, z, name=name)

    @checked(JointError)
    def joint(self, joint: WhichJoint) -> PlacedJoint:
        """Return a joint where it is placed."""
        for placed in self.joints:
            if joint is placed.joint or joint == placed.name:
                return placed
        raise JointError(
            f"Mechanism: no joint {brief(joint)}; expected one of {brief(', '.join(j.name for j in self.joints))}"
        )

    def _link(self, link: Link | str) -> Link:
        for placed in self.frames:
            if link is placed or link == placed.name:
                return placed
        raise JointError(
            f"Mechanism: no link {brief(link)}; expected one of {brief(', '.join(map(str, self.frames)))}"
        )

    @checked(JointError)
    def system(
        self,
        loads: Loads = (),
        *,
        gravity: Vector | None = None,
        constraints: Sequence[Condition] = (),
        inputs: Sequence[Expr] = (),
        states: Mapping[Expr, object] | None = None,
        kinematics: Mapping[Expr, Scalar] = MappingProxyType({}),
        name: str = "",
    ) -> System:
        """Return the system of the mechanism.

        Args:
            loads: the forces and torques on its bodies.
            gravity: the acceleration of weight.
            constraints: conditions beside those of the joints, such as drives.
            inputs: functions of time that are given from outside; those of joints are no coordinates then.
            states: functions of time beside the mechanics and their rates.
            kinematics: rates by speeds, or definitions of speeds; see `System`.
            name: what the system is called.
        """
        return System(
            self.bodies,
            loads,
            [q for q in self.coordinates if q not in inputs],
            [*self.constraints, *constraints],
            gravity,
            kinematics=kinematics,
            inputs=inputs,
            states=states,
            joints=self.joints,
            name=name,
        )

    def _repr_html_(self) -> str:
        """Return a table of the joints: what they join, their coordinates and their conditions."""
        rows = [
            [
                each,
                *(brief(part) for part in (each.joint.parent, each.joint.child)),
                ", ".join(map(str, each.coordinates)),
                ", ".join(f"{each.name}.{closure.name}" for closure in each.active),
            ]
            for each in self.joints
        ]
        return html_table(str(self), ["joint", "parent", "child", "coordinates", "constraints"], rows)

    def description(self) -> str:
        """Return what `show` prints: one line per joint, with its part in the spanning tree."""
        return "\n".join([str(self), *(joint.description() for joint in self.joints)])

    def __repr__(self) -> str:
        parts = [
            counted(len(self.bodies), "body"),
            counted(len(self.joints), "joint"),
            counted(len(self.coordinates), "coordinate"),
            counted(len(self.constraints), "constraint"),
        ]
        return f"Mechanism({', '.join(parts)})"


@checked(JointError)
def assemble(joints: Joints) -> Mechanism:
    """Return the mechanism of joints and the links that they join.

    Joints place the links one after the other, as a tree from ground outwards, by their coordinates. A joint between
    links that are placed already closes a loop by constraints. In the tree come first the joints with ``loop=False``,
    then those whose coordinates you gave, then those with the fewest freedoms, then those earlier in the list. What was
    chosen is printed by ``show(mechanism)``.

    Conditions that hold at every position by themselves, such as those across the plane of a plane mechanism, make no
    constraints. What they would exert cannot be known from rigid bodies, and `reaction` takes it for zero.

    Args:
        joints: the joints of the mechanism.

    Raises:
        JointError: no joints lead from a frame to a link, or two things have one name.

    >>> from symbody import Link, ground, prismatic, revolute, show, symbols
    >>> r, l, m = symbols("r l m")
    >>> crank, rod, slider = (Link(name, m) for name in ("crank", "rod", "slider"))
    >>> A, B = revolute("A", ground, crank), revolute("B", crank, rod, at=(r, 0, 0))
    >>> C, D = revolute("C", rod, slider, at=(l, 0, 0)), prismatic("D", ground, slider)
    >>> show(assemble([A, B, D, C]))
    Mechanism(3 bodies, 4 joints, 3 coordinates, 2 constraints)
    revolute A: ground -> crank, by phi_A
    revolute B: crank -> rod, by phi_B
    prismatic D: ground -> slider, by s_D
    revolute C: rod -> slider closes a loop by C.x, C.y; by themselves hold C.z, C.about x, C.about y
    """
    _check_names(joints)
    meshes = [(joint, joint.pair) for joint in joints if isinstance(joint.pair, Mesh)]
    needed = [each for _, mesh in meshes for each in (mesh.first, mesh.second)]
    _check_meshes(joints, meshes)
    branches, loops = spanning_tree(joints, needed)
    _check_loops(loops, meshes)
    frames = dict[Link, Frame]()
    sides = dict[Joint, Sides]()
    for branch in branches:
        sides[branch.joint], frames[branch.placed] = _opened(branch, frames)
    for joint in loops:
        at, to = (_frame_of(part, frames) for part in (joint.parent, joint.child))
        sides[joint] = Sides(at * joint.mounting.at, to * joint.mounting.to)
    for joint, mesh in meshes:
        sides[joint] = Sides(sides[mesh.first].child, sides[mesh.second].child)
    outboard = _outboard(branches)
    placed = tuple(PlacedJoint.of(joint, sides[joint], outboard.get(joint)) for joint in joints)
    placed = _with_meshes(placed, sides)
    for joint in loops:
        _report_idle_coordinates(joint)
    links = dict.fromkeys(
        part for joint in joints for part in (joint.parent, joint.child) if isinstance(part, Link)
    )
    return Mechanism(
        placed,
        tuple((link, frames[link]) for link in links),
        tuple(link.body(frames[link]) for link in links),
        _coordinates(placed),
    )


def _check_names(joints: Sequence[Joint]) -> None:
    if not joints:
        raise JointError("assemble: no joints; expected at least one, such as revolute('A', ground, crank)")
    parts = [part for joint in joints for part in (joint.parent, joint.child) if isinstance(part, Link)]
    for kind, things in (("joints", joints), ("links", dict.fromkeys(parts))):
        names = [thing.name for thing in things]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise JointError(
                f"assemble: two {kind} have the name {twice}; expected a name of its own for each"
            )


def _check_meshes(joints: Sequence[Joint], meshes: Sequence[tuple[Joint, Mesh]]) -> None:
    for joint, mesh in meshes:
        missing = next((each for each in (mesh.first, mesh.second) if each not in joints), None)
        if missing is not None:
            raise JointError(
                f"assemble: {joint} couples {missing}, which isn't in the list; add it to the joints"
            )


def _check_loops(loops: Sequence[Joint], meshes: Sequence[tuple[Joint, Mesh]]) -> None:
    """Check that joints that close loops hold something, and that none of them is needed for its coordinate."""
    for joint, mesh in meshes:
        closing = next((each for each in (mesh.first, mesh.second) if each in loops), None)
        if closing is not None:
            raise JointError(
                f"assemble: {joint} couples {closing}, which closes a loop and has no coordinate; choose by loop=True "
                "another joint that closes it"
            )
    idle = next((joint for joint in loops if joint.kind == "free"), None)
    if idle is not None:
        raise JointError(
            f"assemble: {idle} closes a loop, where it holds nothing; leave it out, or let another joint close the "
            "loop: loop=True"
        )


def _with_meshes(placed: Sequence[PlacedJoint], sides: Mapping[Joint, Sides]) -> tuple[PlacedJoint, ...]:
    """Return the joints with the closures of meshes, which need the places of other joints."""
    return tuple(
        _with_closures(each, each.joint.pair.meshing(str(each.joint), sides))
        if isinstance(each.joint.pair, Mesh)
        else each
        for each in placed
    )


def _with_closures(placed: PlacedJoint, closures: tuple[Closure, ...]) -> PlacedJoint:
    return replace(placed, closures=closures, constraining=names_that_constrain(closures))


def _frame_of(part: Link | Frame, frames: Mapping[Link, Frame]) -> Frame:
    return part if isinstance(part, Frame) else frames[part]


def _opened(branch: Branch, frames: Mapping[Link, Frame]) -> tuple[Sides, Frame]:
    """Return the sides of a joint of the tree, and the frame of the link that it places."""
    joint, name = branch.joint, branch.placed.name
    at, to = joint.mounting.at, joint.mounting.to
    motion = joint.pair.motion(joint.coordinates)
    if not branch.is_reversed:
        one = _frame_of(joint.parent, frames) * at
        other = one * motion
        return Sides(one, other), (other * to.inverse()).named(name)
    other = _frame_of(joint.child, frames) * to
    one = other * motion.inverse()
    return Sides(one, other), (one * at.inverse()).named(name)


def _outboard(branches: Sequence[Branch]) -> dict[Joint, tuple[str, ...]]:
    """Return the names of the links beyond each joint of the tree, the one that it places first."""
    inner = {
        branch.placed: branch.joint.child if branch.is_reversed else branch.joint.parent
        for branch in branches
    }
    found: dict[Joint, tuple[str, ...]] = {}
    for branch in branches:
        beyond = [branch.placed]
        beyond += [link for link in inner if link is not branch.placed and _leads(link, branch.placed, inner)]
        found[branch.joint] = tuple(link.name for link in beyond)
    return found


def _leads(link: Link | Frame, to: Link, inner: Mapping[Any, Link | Frame]) -> bool:
    while isinstance(link, Link):
        link = inner[link]
        if link is to:
            return True
    return False


def _coordinates(joints: Sequence[PlacedJoint]) -> tuple[Expr, ...]:
    """Return the functions of time in the coordinates of the joints, in their order; those of one by name."""
    found: dict[Expr, None] = {}
    for joint in joints:
        for each in joint.coordinates:
            functions = (
                leaf for leaf in each.free_symbols if leaf.kind == "time_function" and not leaf.order
            )
            found |= dict.fromkeys(sorted(functions, key=lambda leaf: leaf.name))
    return tuple(found)


def _report_idle_coordinates(joint: Joint) -> None:
    if joint.are_given:
        listed = ", ".join(map(str, joint.coordinates))
        notify(
            f"assemble: {joint} closes a loop, so that its {listed} is no coordinate of the mechanism; leave the "
            "coordinates of one joint of each loop out, or choose by loop=True which joint closes it"
        )
