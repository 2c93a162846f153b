"""Reactions: what a parent exerts on a child in a joint, and what holds any part that is cut off."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias, final

from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.recursion.part_wrench import part_wrench
from symbody.errors import ModelError, notify
from symbody.geometry import Frame, Point, Vector, cross, dot, origin
from symbody.geometry.given.argument import checked
from symbody.multibody import Body, Constraint, Link, Load, System
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.multibody.joint.closure import Closure
from symbody.multibody.joint.joint import Joint
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import MOTION, Expr, cost, derivation, diff, simplify
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief, given_twice

from .euler import euler_equations
from .held_teeth import meshes_of, without_freedom
from .idle_joint import tell_idle
from .newton import newton_equations
from .part import body_of, cut_joints, things_of

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


@final
@dataclass(frozen=True, eq=False)
class Reaction(WithSheet):
    """A force and a moment on a body, by what holds it.

    Attributes:
        force: the force on the body.
        moment: the moment about the point, without that of the force.
        at: the point, which is that of the force.
        on: the name of the body or of the part on which they act.

    >>> from symbody import Link, Vector, assemble, fixed, ground, newton_euler, prismatic, reaction, symbols
    >>> m, g, l = symbols("m g l")
    >>> lift, arm = Link("lift", m), Link("arm", m, center=(l, 0, 0))
    >>> A, B = prismatic("A", ground, lift, axis="Z"), fixed("B", lift, arm)
    >>> equations = newton_euler(assemble([A, B]).system(gravity=Vector(ground, 0, 0, -g)))
    >>> weld = reaction(equations, B)
    >>> weld.force.components[2], weld.moment.components
    (m*(s_A'' + g), (0, -l*m*(s_A'' + g), 0))
    """

    force: Vector
    moment: Vector
    at: Point
    on: str

    @checked(ModelError)
    def about(self, point: Point) -> Reaction:
        """Return the same action, by the moment about another point and the force there."""
        return Reaction(self.force, self.moment + cross(self.at - point, self.force), point, self.on)

    def projected(self, frame: Frame) -> Reaction:
        """Return the same action in the axes of another frame."""
        return Reaction(self.force.projected(frame), self.moment.projected(frame), self.at, self.on)

    @property
    def sheet(self) -> DataSheet:
        """What is shown of it: its components, the point of the moment, and the axes."""
        components = zip(_COMPONENTS, (*self.force.components, *self.moment.components), strict=True)
        point, axes = brief(self.at), brief(self.force.frame)
        given = f"reaction on {self.on} about {point}, in the axes of {axes}"
        return DataSheet(given, tuple(Row(name, value) for name, value in components))

    def __neg__(self) -> Reaction:
        return Reaction(-self.force, -self.moment, self.at, self.on)

    def __repr__(self) -> str:
        force, moment = (", ".join(map(brief, v.components)) for v in (self.force, self.moment))
        place, axes = brief(self.at), brief(self.force.frame)
        return f"Reaction(on {self.on}: force {force}, moment {moment} about {place}, in the axes of {axes})"


_COMPONENTS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")

contains(
    Reaction,
    Container(
        parts=lambda each: (each.force, each.moment, each.at),
        rebuilt=lambda each, parts: Reaction(parts[0], parts[1], parts[2], each.on),
        advice="its force and its moment have one",
    ),
)


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
            return _readable(_on_part(system, bodies, about, frame))
        found = _of_tree(system, placed) if placed.opens else _of_loop(system, placed)
        found = found.about(placed.acting_point if about is None else about)
        found = found.projected(placed.parent_side if frame is None else frame)
        return _on_side(_readable(found), placed, on)


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


def _on_part(system: System, bodies: Sequence[Body], about: Point | None, frame: Frame | None) -> Reaction:
    """Return what holds bodies beside the loads and the weight: ``sum(m a) - sum(F) - sum(m g)``, and of moments."""
    at = about
    if at is None:
        at = _center(bodies[0]) if len(bodies) == 1 else origin(system.root)
    axes = system.root if frame is None else frame
    name = ", ".join(map(str, bodies))
    if all(body.frame.is_rigid for body in bodies):
        return Reaction(*part_wrench(system, bodies, at, axes), at, name)
    loads = [load for load in system.loads if any(action.body in bodies for action in load.actions)]
    members: list[Body | Load] = [*bodies, *loads]
    force = newton_equations(members, axes, gravity=system.gravity)
    moment = euler_equations(members, at, axes, gravity=system.gravity)
    return Reaction(force, moment, at, name)


def _center(body: Body) -> Point:
    return Point(body.frame, 0, 0, 0, name=f"centre of {body}")


def _of_loop(system: System, placed: PlacedJoint) -> Reaction:
    """Return ``sum(lambda f)`` and ``sum(lambda m)`` of the closures of a joint, less what it holds of teeth."""
    multipliers = _multipliers(system)
    force, moment = _zero(placed.parent_side), _zero(placed.parent_side)
    tell_idle(system, placed)
    for closure in placed.active:
        intensity = multipliers[f"{placed.name}.{closure.name}"]
        force += intensity * closure.force
        moment += intensity * closure.moment_about(placed.point)
    for mesh, is_second in meshes_of(system, placed) if placed.active else ():
        teeth = _of_loop(system, mesh).about(placed.point)
        teeth = teeth if is_second else -teeth
        push, turn = without_freedom(placed, teeth.force, teeth.moment)
        force, moment = force - push, moment - turn
    return Reaction(force, moment, placed.point, _name(placed.joint.child))


def _of_tree(system: System, placed: PlacedJoint) -> Reaction:
    """Return what a joint of the tree exerts on its child, from all that is beyond it."""
    driven = _driven(system)
    beyond = placed.outboard or ()
    bodies = [body for body in system.bodies if body.name in beyond]
    found = _on_part(system, bodies, placed.point, placed.parent_side)
    force, moment = found.force, found.moment
    for other, is_child in cut_joints(system, beyond):
        if other is not placed and (other.active or not other.opens):
            exerted = _of_loop(system, other).about(placed.point)
            exerted = exerted if is_child else -exerted
            force, moment = force - exerted.force, moment - exerted.moment
    total = Reaction(force, moment, placed.point, _name(placed.joint.child))
    total = total if placed.ends[1][0] in beyond else -total
    return _carried(total, placed) if _is_free(system, placed, driven) else total


def _multipliers(system: System) -> dict[str, Expr]:
    if system.eliminated:
        raise ModelError(
            "reaction: the multipliers of these equations are eliminated; expected the equations from which they were "
            "embedded, by which inverse_dynamics(equations, motion, unknowns=[]) evaluates reactions along a motion"
        )
    whole = system.whole if system.left_out else system  # redundant ones, in a simulation, have their share
    return {each.name: value for each, value in zip(whole.conditions, whole.multipliers, strict=True)}


def _driven(system: System) -> frozenset[Expr]:
    """Return the coordinates that constraints beside the joints' drive.

    One that couples coordinates of joints, as a chain or a belt does, drives each of them: its force along a coordinate
    is that of a motor in the joint.

    Raises:
        ModelError: another one holds several coordinates, so that it isn't known where it acts.
    """
    own = {f"{joint.name}.{closure.name}" for joint in system.joints for closure in joint.active}
    found: set[Expr] = set()
    for constraint in (each for each in system.conditions if each.name not in own):
        held = _held(system, constraint)
        if len(held) > 1:
            _check_coupling(system, constraint, held)
        found |= {*held}
    return frozenset(found)


def _check_coupling(system: System, constraint: Constraint, held: Sequence[Expr]) -> None:
    """Check that a constraint is linear in coordinates, each of which is that of one joint; tell how it is taken.

    Raises:
        ModelError: it isn't.
    """
    by_coordinate = {joint.coordinates[0]: joint for joint in system.joints if len(joint.coordinates) == 1}
    slopes = [diff(constraint.condition, q) for q in held]
    listed = brief(", ".join(map(str, held)))
    if not all(q in by_coordinate for q in held) or any(slope.depends_on_time for slope in slopes):
        raise ModelError(
            f"reaction: the constraint {constraint} isn't one of a joint, and holds {listed}, so that "
            "it isn't known on which bodies it acts; close the loop by a joint, or take the reaction on a "
            "body: reaction(equations, body)"
        )
    joints = brief(", ".join(by_coordinate[q].name for q in held))
    notify(
        f"reaction: the constraint {constraint} couples {listed}; its forces are taken to act along them in the joints "
        f"{joints}, as motors there do, and reactions hold them; what it exerts across, such as the pull of a belt on "
        "its bearings, is not known"
    )


def _held(system: System, constraint: Constraint) -> list[Expr]:
    names = {leaf.name for leaf in constraint.condition.free_symbols if leaf.kind == "time_function"}
    return [q for q in (*system.coordinates, *system.quasi_velocities) if q.name in names]


def _is_free(system: System, placed: PlacedJoint, driven: frozenset[Expr]) -> bool:
    """Whether the components of a reaction along the freedoms of a joint are left sides of equations of motion.

    They aren't where a coordinate is an expression, is driven, belongs to several joints, or has no speed of its own.
    """
    if system.eliminated or (system.chosen and len(system.speeds) < len(system.coordinates)):
        return False
    others = [q for joint in system.joints if joint is not placed for q in joint.coordinates]
    shared = {leaf for q in others for leaf in q.free_symbols}
    return all(q in system.coordinates and q not in driven and q not in shared for q in placed.coordinates)


def _carried(whole: Reaction, placed: PlacedJoint) -> Reaction:
    """Return a reaction without its components along the freedoms: what remains is along forces of the closures."""
    force, moment = _zero(placed.parent_side), _zero(placed.parent_side)
    forces, couples = _by_kind(placed.closures)
    for closure in forces:
        intensity = dot(whole.force, closure.force) / dot(closure.force, closure.force)
        force += intensity * closure.force
        moment += intensity * closure.moment_about(placed.point)
    rest = whole.moment - moment
    for closure in couples:
        moment += dot(rest, closure.moment) / dot(closure.moment, closure.moment) * closure.moment
    return Reaction(force, moment, whole.at, whole.on)


def _by_kind(closures: Iterable[Closure]) -> tuple[list[Closure], list[Closure]]:
    """Return the closures that hold by a force, and those that hold by a couple alone."""
    forces, couples = list[Closure](), list[Closure]()
    for closure in closures:
        is_couple = all(component.is_zero for component in closure.force.components)
        (couples if is_couple else forces).append(closure)
    return forces, couples


def _on_side(found: Reaction, placed: PlacedJoint, on: Any) -> Reaction:
    """Return a reaction on the child, or its opposite on the parent."""
    parent, child = placed.joint.parent, placed.joint.child
    if on is None or _is_part(on, child):
        return found
    if _is_part(on, parent):
        return Reaction(-found.force, -found.moment, found.at, _name(parent))
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
    return name == _name(part)


def _name(part: Link | Frame) -> str:
    return part.name if isinstance(part, Link) else brief(part)


def _zero(frame: Frame) -> Vector:
    return Vector(frame, 0, 0, 0)
