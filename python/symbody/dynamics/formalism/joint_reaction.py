"""What a joint exerts on its child: by the equations of all beyond it, or by its multipliers where it closes a loop."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from symbody.errors import ModelError, notify
from symbody.geometry import Frame, Vector, dot
from symbody.multibody import Constraint, Link, System
from symbody.multibody.joint.closure import Closure
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import Expr, diff
from symbody.symbolic.given.arguments import brief

from .held import Reaction, on_part
from .held_teeth import meshes_of, without_freedom
from .part import cut_joints

__all__ = [
    "cut_loops",
    "intensities",
    "joint_reaction",
    "label",
    "multipliers_by_name",
    "part_name",
    "tell_couplings",
]


def label(placed: PlacedJoint, closure: Closure) -> str:
    """Return the name of a condition of a joint in a system."""
    return f"{placed.name}.{closure.name}"


def joint_reaction(system: System, placed: PlacedJoint, idle: Mapping[str, Expr]) -> Reaction:
    """Return what a joint exerts on its child, about its point.

    Args:
        system: the system.
        placed: the joint.
        idle: the intensities of conditions that hold by themselves, and have no multipliers, by name; others are zero.

    Raises:
        ModelError: the multipliers are eliminated, or a constraint acts on unknown parts.
    """
    return _of_tree(system, placed, idle) if placed.opens else _of_loop(system, placed, idle)


def _of_loop(system: System, placed: PlacedJoint, idle: Mapping[str, Expr]) -> Reaction:
    """Return ``sum(lambda f)`` and ``sum(lambda m)`` of the closures of a joint, less what it holds of teeth."""
    known = {**idle, **multipliers_by_name(system)}
    force, moment = _zero(placed.parent_side), _zero(placed.parent_side)
    for closure in placed.closures:
        intensity = known.get(label(placed, closure))
        if intensity is not None and not intensity.is_zero:
            force += intensity * closure.force
            moment += intensity * closure.moment_about(placed.point)
    for mesh, is_second in meshes_of(system, placed) if placed.active else ():
        teeth = _of_loop(system, mesh, idle).about(placed.point)
        teeth = teeth if is_second else -teeth
        push, turn = without_freedom(placed, teeth.force, teeth.moment)
        force, moment = force - push, moment - turn
    return Reaction(force, moment, placed.point, part_name(placed.joint.child))


def _of_tree(system: System, placed: PlacedJoint, idle: Mapping[str, Expr]) -> Reaction:
    """Return what a joint of the tree exerts on its child, from all that is beyond it."""
    driven = _driven(system)
    beyond = placed.outboard or ()
    bodies = [body for body in system.bodies if body.name in beyond]
    found = on_part(system, bodies, placed.point, placed.parent_side)
    force, moment = found.force, found.moment
    for other, is_child in cut_loops(system, placed):
        exerted = _of_loop(system, other, idle).about(placed.point)
        exerted = exerted if is_child else -exerted
        force, moment = force - exerted.force, moment - exerted.moment
    total = Reaction(force, moment, placed.point, part_name(placed.joint.child))
    total = total if placed.ends[1][0] in beyond else -total
    return _carried(total, placed) if _is_free(system, placed, driven) else total


def cut_loops(system: System, placed: PlacedJoint) -> Iterator[tuple[PlacedJoint, bool]]:
    """Yield the other joints with multipliers between what is beyond a joint of the tree and all else.

    Each comes with whether its child is beyond.
    """
    for other, is_child in cut_joints(system, placed.outboard or ()):
        if other is not placed and (other.active or not other.opens):
            yield other, is_child


def multipliers_by_name(system: System) -> dict[str, Expr]:
    """Return the multipliers by the names of their conditions.

    Raises:
        ModelError: they are eliminated.
    """
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
    return frozenset(q for _, held in _drives(system) for q in held)


def _drives(system: System) -> Iterator[tuple[Constraint, list[Expr]]]:
    """Yield the constraints beside those of joints, and the coordinates that each holds."""
    own = {label(joint, closure) for joint in system.joints for closure in joint.active}
    for constraint in (each for each in system.conditions if each.name not in own):
        held = _held(system, constraint)
        if len(held) > 1:
            _check_coupling(system, constraint, held)
        yield constraint, held


def tell_couplings(system: System) -> None:
    """Tell how constraints that couple coordinates of joints are taken.

    Raises:
        ModelError: one acts on unknown parts.
    """
    by_coordinate = _joints_by_coordinate(system)
    for constraint, held in _drives(system):
        if len(held) > 1:
            listed = brief(", ".join(map(str, held)))
            joints = brief(", ".join(by_coordinate[q].name for q in held))
            notify(
                f"reaction: the constraint {constraint} couples {listed}; its forces are taken to act along them in "
                f"the joints {joints}, as motors there do, and reactions hold them; what it exerts across, such as the "
                "pull of a belt on its bearings, is not known"
            )


def _joints_by_coordinate(system: System) -> dict[Expr, PlacedJoint]:
    return {joint.coordinates[0]: joint for joint in system.joints if len(joint.coordinates) == 1}


def _check_coupling(system: System, constraint: Constraint, held: Sequence[Expr]) -> None:
    """Check that a constraint is linear in coordinates, each of which is that of one joint.

    Raises:
        ModelError: it isn't.
    """
    slopes = [diff(constraint.condition, q) for q in held]
    listed = brief(", ".join(map(str, held)))
    by_coordinate = _joints_by_coordinate(system)
    if not all(q in by_coordinate for q in held) or any(slope.depends_on_time for slope in slopes):
        raise ModelError(
            f"reaction: the constraint {constraint} isn't one of a joint, and holds {listed}, so that "
            "it isn't known on which bodies it acts; close the loop by a joint, or take the reaction on a "
            "body: reaction(equations, body)"
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


def intensities(whole: Reaction, placed: PlacedJoint) -> dict[str, Expr]:
    """Return the intensities of the closures of a joint that exert a reaction, by their names in the joint."""
    found = dict[str, Expr]()
    moment = _zero(placed.parent_side)
    forces, couples = _by_kind(placed.closures)
    for closure in forces:
        found[closure.name] = dot(whole.force, closure.force) / dot(closure.force, closure.force)
        moment += found[closure.name] * closure.moment_about(placed.point)
    rest = whole.moment - moment
    for closure in couples:
        found[closure.name] = dot(rest, closure.moment) / dot(closure.moment, closure.moment)
    return found


def _carried(whole: Reaction, placed: PlacedJoint) -> Reaction:
    """Return a reaction without its components along the freedoms: what remains is along forces of the closures."""
    force, moment = _zero(placed.parent_side), _zero(placed.parent_side)
    found = intensities(whole, placed)
    for closure in placed.closures:
        force += found[closure.name] * closure.force
        moment += found[closure.name] * closure.moment_about(placed.point)
    return Reaction(force, moment, whole.at, whole.on)


def _by_kind(closures: Iterable[Closure]) -> tuple[list[Closure], list[Closure]]:
    """Return the closures that hold by a force, and those that hold by a couple alone."""
    forces, couples = list[Closure](), list[Closure]()
    for closure in closures:
        is_couple = all(component.is_zero for component in closure.force.components)
        (couples if is_couple else forces).append(closure)
    return forces, couples


def part_name(part: Link | Frame) -> str:
    """Return the name of a part that a joint connects."""
    return part.name if isinstance(part, Link) else brief(part)


def _zero(frame: Frame) -> Vector:
    return Vector(frame, 0, 0, 0)
