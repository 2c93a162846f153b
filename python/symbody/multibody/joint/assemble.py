"""Assembly: from joints and links to bodies with frames, coordinates and constraints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, TypeAlias

from symbody.errors import JointError, notify
from symbody.geometry import Frame
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

from .closure import Closure, Sides, names_that_constrain
from .joint import Joint
from .link import Link
from .mechanism import Mechanism
from .placed_joint import PlacedJoint
from .rounded_loop import report_nearly_held, within_tolerance
from .spanning_tree import Branch, spanning_tree

__all__ = ["assemble"]

Joints: TypeAlias = Annotated[Sequence[Joint], "a list of joints, such as [revolute('A', ground, crank)]"]

Tolerance: TypeAlias = Annotated[float | int, "a number, such as 1e-6, in m and as the sine of an angle"]

_LARGEST_TOLERANCE = 0.1


@checked(JointError)
def assemble(joints: Joints, *, tolerance: Tolerance = 0.0) -> Mechanism:
    """Return the mechanism of joints and the links that they join.

    Joints place the links one after the other, as a tree from ground outwards, by their coordinates. A joint between
    links that are placed already closes a loop by constraints. In the tree come first the joints with ``loop=False``,
    then those whose coordinates you gave, then those with the fewest freedoms, then those earlier in the list. What was
    chosen is printed by ``show(mechanism)``.

    Conditions that hold at every position by themselves, such as those across the plane of a plane mechanism, make no
    constraints. What they exert cannot be known from rigid bodies: `reaction` gives what is of minimum norm. A notice
    tells of conditions that hold but for rounded dimensions.

    Args:
        joints: the joints of the mechanism.
        tolerance: a length in m, and the sine of an angle, up to which a condition of numbers holds by itself;
            ``show(mechanism)`` tells how much is left of it.

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
    if not 0 <= tolerance <= _LARGEST_TOLERANCE:
        raise JointError(
            f"assemble: tolerance = {tolerance}; expected a small number, such as 1e-6, or 0 for none"
        )
    _check_names(joints)
    _check_coupled(joints)
    branches, loops = spanning_tree(joints, [each for joint in joints for each in joint.pair.coupled])
    frames = dict[Link, Frame]()
    sides = dict[Joint, Sides]()
    for branch in branches:
        sides[branch.joint], frames[branch.placed] = _opened(branch, frames)
    for joint in loops:
        at, to = (_frame_of(part, frames) for part in (joint.parent, joint.child))
        sides[joint] = Sides(at * joint.mounting.at, to * joint.mounting.to)
    for joint in joints:
        if joint.pair.coupled:
            one, other = joint.pair.coupled
            sides[joint] = Sides(sides[one].child, sides[other].child)
    outboard = _outboard(branches)
    placed = tuple(PlacedJoint.of(joint, sides[joint], outboard.get(joint)) for joint in joints)
    values = _coupled_values(placed)
    placed = tuple(_with_closures(each, each.joint.pair.meshing(str(each), sides, values)) for each in placed)
    if tolerance:
        placed = tuple(each if each.opens else within_tolerance(each, tolerance) for each in placed)
    _check_loops(placed)
    report_nearly_held(placed)
    for joint in loops:
        _report_idle_coordinates(joint)
        _report_unknown(joint, sides[joint])
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


def _check_coupled(joints: Sequence[Joint]) -> None:
    for joint in joints:
        missing = next((each for each in joint.pair.coupled if each not in joints), None)
        if missing is not None:
            raise JointError(
                f"assemble: {joint} couples {missing}, which isn't in the list; add it to the joints"
            )


def _coupled_values(placed: Sequence[PlacedJoint]) -> dict[Joint, Expr]:
    """Return the coordinates of the joints that gears and racks couple, or what they would be where they close loops.

    Raises:
        JointError: one is an angle that is known up to whole turns only.
    """
    by_joint, found = {each.joint: each for each in placed}, dict[Joint, Expr]()
    for mesh in placed:
        for joint in mesh.joint.pair.coupled:
            freedom = by_joint[joint].freedom()
            if freedom.jumps:
                raise JointError(
                    f"assemble: {mesh} couples {joint}, which closes a loop in space, where its angle is known up to "
                    "whole turns; choose by loop=True another joint that closes it"
                )
            found[joint] = freedom.value
    return found


def _check_loops(placed: Sequence[PlacedJoint]) -> None:
    """Check that joints that close loops hold something, and that nothing which no motion can change is off."""
    idle = next((joint for joint in placed if not joint.opens and not joint.closures), None)
    if idle is not None:
        raise JointError(
            f"assemble: {idle} closes a loop, where it holds nothing; leave it out, or let another joint close the "
            "loop: loop=True"
        )
    for joint in placed:
        off = [closure for closure in joint.active if not closure.condition.depends_on_time]
        if off:
            listed = ", ".join(f"{joint.name}.{each.name} = {brief(each.condition)}" for each in off)
            raise JointError(
                f"assemble: {joint} doesn't close its loop at any position: {listed}; expected places at and to "
                f"at which {brief(joint.joint.parent)} and {brief(joint.joint.child)} can meet"
            )


def _with_closures(placed: PlacedJoint, more: tuple[Closure, ...]) -> PlacedJoint:
    """Return a joint with further conditions, as of a mesh, which needs the places of other joints."""
    if not more:
        return placed
    constraining = (*placed.constraining, *names_that_constrain(more))
    return replace(placed, closures=(*placed.closures, *more), constraining=constraining)


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
    leading = {branch.placed: branch for branch in branches}
    found: dict[Joint, list[str]] = {branch.joint: [] for branch in branches}
    for link in leading:
        inner: Link | Frame = link
        while isinstance(inner, Link):
            branch = leading[inner]
            found[branch.joint].append(link.name)
            inner = branch.joint.child if branch.is_reversed else branch.joint.parent
    return {joint: tuple(names) for joint, names in found.items()}


def _coordinates(joints: Sequence[PlacedJoint]) -> tuple[Expr, ...]:
    """Return the functions of time in the coordinates of the joints, in their order; those of one by name."""
    return tuple(
        dict.fromkeys(leaf for joint in joints for each in joint.coordinates for leaf in _functions_in(each))
    )


def _functions_in(coordinate: Expr) -> list[Expr]:
    """Return the functions of time in a coordinate, by name."""
    functions = (leaf for leaf in coordinate.free_symbols if leaf.kind == "time_function" and not leaf.order)
    return sorted(functions, key=lambda leaf: leaf.name)


def _report_idle_coordinates(joint: Joint) -> None:
    idle = [q for q in joint.coordinates if q not in joint.pair.keeps]
    if joint.are_given and idle:
        listed = ", ".join(map(str, idle))
        drives = [q for q in idle if q.depends_on_time and not _functions_in(q)]
        driven = ", which doesn't drive it" if drives else ""
        notify(
            f"assemble: {joint} closes a loop, so that its {listed} is no coordinate of the mechanism{driven}; leave "
            "the coordinates of one joint of each loop out, or choose by loop=True which joint closes it"
        )


def _report_unknown(joint: Joint, sides: Sides) -> None:
    """Tell what the conditions of a loop leave open, unless the user chose this joint to close it."""
    unknown = "" if joint.mounting.loop else joint.pair.unknown(sides)
    if unknown:
        notify(
            f"assemble: {joint} closes a loop in space, which determines {unknown}; the position that is found is the "
            "one nearest to the guess: let another joint close the loop by loop=True, or choose this one by loop=True "
            "and give a guess of its position"
        )
