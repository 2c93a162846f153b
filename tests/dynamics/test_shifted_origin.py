"""Displacements along axes of rotation go behind the rotations, and no equation changes."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Vector,
    functions_of_time,
    generalized_force,
    gravitational_energy,
    ground,
    kinetic_energy,
    lagrange,
    newton_euler,
    number,
    pi,
    rotate,
    symbols,
    translate,
)
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree
from symbody.symbolic import derivation
from tests.dynamics.models import general_body

SHOULDER = functions_of_time("a b c")
UPPER_ARM = rotate("Z", SHOULDER[0]) * rotate("X", SHOULDER[1])
LENGTH = symbols("l")


def arm(*, along: str = "Y", on_the_way: bool = False, base: Frame = ground) -> System:
    """Return an arm of two links, the second one turning about the first's length or across it."""
    elbow = base * UPPER_ARM * translate(0, LENGTH, 0)
    lower = (elbow * rotate("Z", number(0.3)) * rotate("Z", number(-0.3)) * rotate(along, SHOULDER[2])).named(
        "lower"
    )
    bodies = [general_body(base * UPPER_ARM, 1), general_body(lower, 2)]
    if on_the_way:
        bodies.append(Body(elbow, symbols("M")))
    push = Force(Vector(ground, *symbols("Fx Fy Fz")), at=Point(lower, *symbols("u v w")), on=bodies[1])
    given = [leaf for motion in base.motions for leaf in motion.leaves if leaf.kind == "time_function"]
    return System(bodies, [push], SHOULDER, gravity=Vector(ground, 0, 0, -symbols("g")), inputs=given)


def by_hand(system: System) -> list[Expr]:
    L = kinetic_energy(system) - gravitational_energy(system)
    forces = generalized_force(system.loads, system.coordinates)
    return [lagrange(L, q) - Q for q, Q in zip(system.coordinates, forces, strict=True)]


def tree_of(system: System) -> FrameTree:
    with derivation():
        return frame_tree(system)


@pytest.mark.parametrize("along", "XYZ")
@pytest.mark.parametrize("on_the_way", [False, True])
@pytest.mark.parametrize(
    "base", [ground, translate(*symbols("x y z")), translate(functions_of_time("s"), 0, 0)]
)
def test_equations_are_those_of_lagrange_by_hand(along: str, on_the_way: bool, base: Frame) -> None:
    system = arm(along=along, on_the_way=on_the_way, base=base)
    assert list(newton_euler(system).residuals) == by_hand(system)


def test_a_displacement_along_the_next_axis_goes_behind_it() -> None:
    system = arm()
    given = system.bodies[1].frame.parent
    assert given is not None
    tree = tree_of(system)
    lower = tree.frames[tree.index(given)]
    assert (lower.name, lower.pose) == ("lower", given.pose)
    assert lower.motion is not None
    assert lower.motion.displacement == (0, LENGTH, 0)


@pytest.mark.parametrize(
    "system",
    [arm(along="X"), arm(on_the_way=True), arm(base=translate(functions_of_time("s"), 0, 0))],
    ids=["across", "needed on the way", "the shoulder moves"],
)
def test_and_only_then(system: System) -> None:
    tree = tree_of(system)
    assert all(body.frame in tree.frames for body in system.bodies)


AXES = ("ZYYZ", "ZXXX", "XYZX", "YYZZ")


def wrist(axes: str, *, loaded: bool = False) -> System:
    """Return an arm of numbers; a load keeps the frame on which it acts."""
    frame, bodies, q = translate(0.1, 0.2, 0.3), list[Body](), functions_of_time("q0 q1 q2 q3")
    for k, axis in enumerate(axes):
        frame = frame * translate(0.25, 0.5 - k / 4, 0.125 * k) * rotate("X", number(k) * pi / 2)
        frame = frame * rotate(axis, q[k])
        bodies.append(Body(Point(frame, 0.1, 0.2 * k, -0.3), k + 1, 1, 2, 2.5, 0.1, 0.2, 0.3))
    push = Force(
        Vector(ground, 3, 4, 5), at=Point(bodies[2].frame, 1, 2, 3), on=bodies[2], reaction=bodies[1]
    )
    return System(bodies, [push] if loaded else [], q, gravity=Vector(ground, 0.5, 1, -9.81))


@pytest.mark.parametrize("loaded", [False, True])
@pytest.mark.parametrize("axes", AXES)
def test_arms_of_numbers(axes: str, loaded: bool) -> None:
    system = wrist(axes, loaded=loaded)
    assert list(newton_euler(system).residuals) == by_hand(system)


def test_displacements_along_parallel_axes_vanish() -> None:
    """Of three parallel axes the offsets along them are one, of the last body."""
    q = functions_of_time("a b c")
    frame, bodies = rotate("X", q[0]), list[Body]()
    for angle in q[1:]:
        frame = frame * translate(0, 0.5, 0.25) * rotate("Y", angle)
        bodies.append(Body(frame, 1, 1, 1, 1))
    tree = tree_of(System(bodies, coordinates=q))
    turning = [place for place in range(2, len(tree.frames)) if tree.motions[place].rotates]
    assert [tree.motions[tree.parents[place]].displacement for place in turning] == [(0, 0, 0.25)] * 2
    assert tree.motions[tree.index(frame)].displacement == (0, 1, 0)


def test_what_joins_nothing_stays() -> None:
    """Across the next axes a displacement costs the same before and behind."""
    q = functions_of_time("a b c")
    frame = rotate("X", q[0]) * translate(0.5, 0.25, 0) * rotate("Y", q[1]) * rotate("Z", q[2])
    tree = tree_of(System([Body(frame, 1, 1, 1, 1)], coordinates=q))
    assert frame in tree.frames
