"""Reactions: what a parent exerts on a child in a joint, and what holds any part that is cut off."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Annotated, Any, TypeAlias

from symbody.dynamics.equations.equations import Equations
from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Vector
from symbody.geometry.given.argument import checked
from symbody.multibody import Body, Link, System
from symbody.multibody.joint.joint import Joint
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import MOTION, Expr, cost, derivation, simplify
from symbody.symbolic.given.arguments import brief, given_twice

from .held import Reaction, on_part
from .idle_joint import tell_shared, tell_unknown
from .joint_reaction import joint_reaction, multipliers_by_name, part_name, tell_couplings
from .part import body_of, cut_joints, things_of
from .self_stress import shares

__all__ = ["Reaction", "reaction", "reaction_in"]

Cut: TypeAlias = Annotated[
    Joint | PlacedJoint | Body | Link | str | Collection[Body | Link | str],
    "a joint, a body, a link, the name of one, or a list of bodies that are cut off together",
]
Moving: TypeAlias = Annotated[
    Equations | System,
    "equations of motion, such as newton_euler(system), or a system in which nothing moves",
]
Side: TypeAlias = Annotated[Body | Link | Frame | str | None, "one of the two parts that the joint connects"]


@checked(ModelError)
def reaction(
    equations: Moving,
    cut: Cut,
    *,
    on: Side = None,
    about: Point | None = None,
    frame: Frame | None = None,
) -> Reaction:
    """Return the force and the moment that the parent of a joint exerts on its child, or that hold a part cut off.

    Of a joint of the tree, they follow from Newton's and Euler's equations of all that is beyond the joint,
    ``F = sum(m a) - sum(F_loads) - sum(m g) - F_loops`` and likewise M, in which loops exert what their multipliers
    say. A joint that closes a loop exerts ``F = sum(lambda_k f_k)``. Components along the freedoms of a joint are left
    sides of its equations of motion, and therefore zero. Loads are no reactions, not even those between parent and
    child, such as a motor's.

    Of a body, or of several that are cut off together, it is the sum of all that joints and constraints exert on them
    from outside.

    Args:
        equations: those of a system that `assemble` made for a joint, and of any system with bodies for bodies; or the
            system itself, as of a structure that has no coordinates.
        cut: the joint; or a body, or several.
        on: which side of the joint the reaction acts on; the child by default. On the parent it has the other sign. The
            reaction of bodies acts on them, and needs none.
        about: the point of the moment; by default the origin of the child's axes in the joint, the contact of a wheel
            or of teeth, the centre of mass of a body, or the origin of the root for several.
        frame: the axes of the components; by default those of the joint on the parent, or the root.

    Raises:
        ModelError: the joint or body is none of the system, its multipliers are eliminated, or a constraint that
            isn't one of a joint acts on unknown parts.

    >>> from symbody import Link, Vector, assemble, ground, newton_euler, reaction, revolute, symbols
    >>> m, l, g = symbols("m l g")
    >>> bob = Link("bob", m, center=(0, -l, 0))
    >>> pin = revolute("A", ground, bob)
    >>> mechanism = assemble([pin])
    >>> equations = newton_euler(mechanism.system(gravity=Vector(ground, 0, -g, 0)))
    >>> reaction(equations, pin, frame=mechanism.frame(bob)).force.components[1]
    m*(l*phi_A'**2 + g*cos(phi_A))
    """
    return reaction_in(_system(equations), cut, on=on, about=about, frame=frame)


def reaction_in(
    system: System, cut: Any, *, on: Any = None, about: Point | None = None, frame: Frame | None = None
) -> Reaction:
    """Return the same from a system: reactions depend on it alone.

    Args:
        system: the system, with its joints and multipliers.
        cut: see `reaction`.
        on: see there.
        about: see there.
        frame: see there.
    """
    placed = _placed(system, cut)
    with derivation(order=MOTION):
        if placed is None:
            bodies = _bodies(system, cut)
            _check_side(system, bodies, on)
            return _readable(on_part(system, bodies, about, frame))
        if placed.opens:
            tell_couplings(system)
        found = joint_reaction(system, placed, _shares(system, placed))
        found = found.about(placed.acting_point if about is None else about)
        found = found.projected(placed.parent_side if frame is None else frame)
        return _on_side(_readable(found), placed, on)


def _shares(system: System, placed: PlacedJoint) -> Mapping[str, Expr]:
    """Return the intensities of conditions that hold by themselves, and tell of them."""
    multipliers_by_name(system)
    try:
        idle = shares(system, placed)
    except ModelError:  # of the reaction of a joint of the tree, it is an error
        tell_unknown(placed)
        return {}
    tell_shared(system, placed, idle)
    return idle


SHORT = 100
"""The most operations of a reaction that is simplified, as a reader expects it."""


def _readable(found: Reaction) -> Reaction:
    """Return a reaction in its shortest form, unless it is too long for a reader anyway."""
    vectors = found.force, found.moment
    if cost([component for vector in vectors for component in vector.components]).total > SHORT:
        return found
    force, moment = (Vector(v.frame, *map(simplify, v.components)) for v in vectors)
    return Reaction(force, moment, found.at, found.on)


def _system(equations: Equations | System) -> System:
    system = equations if isinstance(equations, System) else equations.system
    if not isinstance(system, System):
        raise ModelError(
            f"reaction: {brief(equations)} were given without bodies; expected the equations of a System"
        )
    return system


def _placed(system: System, cut: Any) -> PlacedJoint | None:
    """Return the joint that is cut; None for bodies."""
    joints: tuple[PlacedJoint, ...] = system.joints
    if isinstance(cut, str) and cut in {joint.name for joint in joints} & {
        body.name for body in system.bodies
    }:
        raise ModelError(
            f"reaction: {cut} is the name of a joint and of a body; expected the joint itself, or the body's link, or "
            "names of their own"
        )
    for placed in joints:
        if cut is placed.joint or cut == placed.name:
            return placed
    if isinstance(cut, PlacedJoint):
        return _placed(system, cut.joint)
    if isinstance(cut, Joint):
        names = brief(", ".join(joint.name for joint in joints))
        known = f"its joints are {names}" if joints else "it has none: make it by assemble([...]).system()"
        if any(joint.name == cut.name for joint in joints):
            known += (
                f"; this is another joint of that name: give the one that assemble was given, or {cut.name!r}"
            )
        raise ModelError(f"reaction: {cut} isn't a joint of {brief(system)}; {known}")
    return None


def _bodies(system: System, cut: Any) -> list[Body]:
    found = []
    for thing in things_of(cut):
        body = body_of(system, thing, "reaction")
        if body is None:
            joints = ", ".join(joint.name for joint in system.joints)
            kind = "a joint or a body" if joints and isinstance(thing, str) else "a body"
            others = f", its joints {brief(joints)}" if joints else ""
            raise ModelError(
                f"reaction: {_quoted(thing)} isn't {kind} of {brief(system)}; its bodies are "
                f"{brief(', '.join(map(str, system.bodies)))}{others}"
            )
        found.append(body)
    if not found:
        raise ModelError("reaction: no body is cut off; give at least one")
    if (twice := given_twice(found)) is not None:
        raise ModelError(f"reaction: the body {brief(twice)} is given twice; give it once")
    return found


def _check_side(system: System, bodies: Sequence[Body], on: Any) -> None:
    """Check that a reaction of a part is wanted on this part: what holds it may act on several others."""
    if on is None or (len(bodies) == 1 and _is_body(on, bodies[0])):
        return
    part = brief(", ".join(map(str, bodies)))
    joints = [joint.name for joint, _ in cut_joints(system, [body.name for body in bodies])]
    by_joint = f"that of a joint ({brief(', '.join(joints))})" if joints else "a joint, made by assemble"
    raise ModelError(
        f"reaction: on = {_quoted(on)}, but the reaction of bodies that are cut off acts on them, here on {part}, and "
        f"what holds them may act on several others; expected no on, {by_joint}, or -reaction(...) for its opposite"
    )


def _is_body(on: Any, body: Body) -> bool:
    if isinstance(on, Body):
        return on is body
    return (
        not isinstance(on, Frame)
        and body.name != ""
        and body.name == (on if isinstance(on, str) else on.name)
    )


def _on_side(found: Reaction, placed: PlacedJoint, on: Any) -> Reaction:
    """Return a reaction on the child, or its opposite on the parent."""
    parent, child = placed.joint.parent, placed.joint.child
    if on is None or _is_part(on, child):
        return found
    if _is_part(on, parent):
        return Reaction(-found.force, -found.moment, found.at, part_name(parent))
    raise ModelError(
        f"reaction: {placed} connects {brief(parent)} and {brief(child)}, not {_quoted(on)}; expected on=one of the "
        "two"
    )


def _quoted(thing: object) -> str:
    """Return a thing for a message; a text, which may be empty, in quotes."""
    return brief(repr(thing) if isinstance(thing, str) else thing)


def _is_part(on: Any, part: Link | Frame) -> bool:
    if isinstance(on, Frame):
        return isinstance(part, Frame) and on == part
    name = on if isinstance(on, str) else on.name
    return name == part_name(part)
