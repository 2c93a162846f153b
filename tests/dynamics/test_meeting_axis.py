"""Frames whose axes meet in a point at rest begin there, and no equation changes."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
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
    rotate,
    symbols,
    translate,
)
from symbody.dynamics.frame_tree import FrameTree, frame_tree
from symbody.symbolic import derivation, number
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
    return System(bodies, [push], SHOULDER, gravity=Vector(ground, 0, 0, -symbols("g")))


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
    L = kinetic_energy(system) - gravitational_energy(system)
    forces = generalized_force(system.loads, system.coordinates)
    by_hand = [lagrange(L, q) - Q for q, Q in zip(system.coordinates, forces, strict=True)]
    assert list(newton_euler(system).residuals) == by_hand


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
