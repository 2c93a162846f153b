"""Mechanisms that move by their special dimensions alone, and others that begin in a singular position."""

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    project,
    rotate,
    simulate,
    symbols,
    translate,
)
from symbody.errors import ConstraintError

m, l, g, d = symbols("m l g d")
a, b, c, x, y, theta, s = functions_of_time("a b c x y theta s")
VALUES = {m: 1, l: 0.5, g: 9.81, d: 0.4}


def parallel_cranks(*, drops: int) -> Equations:
    """Three cranks of one length that carry a coupler, and a pendulum on it; the last constraints are left out."""
    plate = translate(x, y, 0) * rotate("Z", theta)
    bodies, constraints = [Body(plate, m, 0, 0, m * d**2 / 3)], []
    for angle, place in ((a, -d), (b, 0), (c, d)):
        crank = translate(place, 0, 0) * rotate("Z", angle)
        bodies.append(Body(Point(crank, 0, -l / 2, 0), m, 0, 0, m * l**2 / 12))
        gap = project(Point(crank, 0, -l, 0) - Point(plate, place, 0, 0), ground)
        constraints += gap.components[:2]
    bodies.append(Body(plate * rotate("Z", s) * translate(0, -l, 0), m))
    kept = constraints[: len(constraints) - drops]
    return newton_euler(
        System(
            bodies,
            coordinates=[a, b, c, x, y, theta, s],
            constraints=kept,
            gravity=Vector(ground, 0, -g, 0),
        )
    )


START = {a: 0.8}
GUESS = {b: 0.8, c: 0.8, x: 0.35, y: -0.35}


@pytest.mark.parametrize("constraints", ["projection", "free", "baumgarte"])
def test_special_dimensions_are_told(constraints: str) -> None:
    with pytest.raises(ConstraintError) as told:
        simulate(parallel_cranks(drops=0), VALUES, START, t=(0, 1), guess=GUESS, constraints=constraints)
    assert str(told.value) == (
        "simulate: the constraints let a', b', c', x', y' be other than zero at this position, but at almost no other "
        "one: constraints 1, 2, 3, 4, 5, 6 depend on each other here. If they do so wherever the mechanism moves, by "
        "its special dimensions, leave out as many of them as follow from the others; if they don't, begin at another "
        "position"
    )


def test_without_what_follows_from_the_others_it_moves() -> None:
    motion = simulate(parallel_cranks(drops=1), VALUES, START, t=(0, 2), guess=GUESS, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(motion[b], motion[a], atol=1e-9)
    np.testing.assert_allclose(motion[c], motion[a], atol=1e-9)
    assert np.abs(motion[a] - 0.8).max() > 1
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-12
