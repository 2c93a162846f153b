"""Mechanisms that move by their special dimensions alone, and others that begin in a singular position."""

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ConstraintError, ModelNotice

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


def clutch() -> Equations:
    """Two wheels, one of which is driven, and a constraint that a factor switches off."""
    driven = Body(rotate("Z", b), 0, 0, 0, m)
    wheels = [Body(rotate("Z", a), 0, 0, 0, m), driven]
    return newton_euler(System(wheels, [Torque(ground, 0, 0, g, on=driven)], [a, b], [d * (a - b)]))


@pytest.mark.parametrize("constraints", ["projection", "free", (10.0, 1.0)])
@pytest.mark.parametrize("method", ["dop853", "bdf"])
def test_a_parameter_that_takes_a_constraint_away(constraints, method) -> None:
    """By value the accelerations are one expression, whatever the factor is."""
    settings = {"t": (0, 1), "constraints": constraints, "method": method}
    closed = simulate(clutch(), {m: 1, g: 1, d: 0.5}, {a: 0.0, time_derivative(a): 0.15}, **settings)
    np.testing.assert_allclose(closed.states[-1], [0.4, 0.4, 0.65, 0.65], atol=1e-6)
    with pytest.raises(ConstraintError) as told:
        simulate(clutch(), {m: 1, g: 1, d: 0.0}, {a: 0.0}, **settings)
    assert str(told.value) == (
        "simulate: with d = 0 fewer constraints are independent, and the equations were derived for other values; "
        "leave out of the system what follows from the others then: d*(a - b)"
    )


def test_of_many_cases_only_that_one_fails() -> None:
    numbers = {m: 1, g: 1, d: [0.5, 0.0, 2.0]}
    with pytest.warns(ModelNotice, match="1 of 3 motions failed; the first is case 1 .* with d = 0 fewer"):
        runs = simulate_many(clutch(), numbers, {a: 0.0}, t=(0, 1), progress=False)
    assert [failure.index for failure in runs.failures] == [1]
    np.testing.assert_allclose(runs.states[[0, 2], -1], [[0.25, 0.25, 0.5, 0.5]] * 2, atol=1e-6)


def test_zeros_that_take_nothing_away() -> None:
    """A crank of no length, whose constraints stay independent."""
    crank_frame, rod_frame = rotate("Z", a), translate(x, 0, 0) * rotate("Z", b)
    gap = project(Point(crank_frame, d, 0, 0) - Point(rod_frame, l, 0, 0), ground)
    bodies = [Body(crank_frame, 0, 0, 0, m), Body(rod_frame, m, 0, 0, m)]
    equations = newton_euler(System(bodies, [], [a, x, b], gap.components[:2]))
    initial = {a: 0.3, b: 0.0, time_derivative(a): 1.0}
    motion = simulate(equations, {m: 1, l: 0.5, d: 0.0}, initial, guess={x: -0.5}, t=(0, 1))
    np.testing.assert_allclose(motion[a][-1], 1.3, atol=1e-6)
    np.testing.assert_allclose(motion[x], -0.5, atol=1e-9)
