"""Newton's and Euler's equations are the rates of the momenta, for any set of bodies and about any point."""

from __future__ import annotations

import warnings

import pytest

from symbody import (
    Force,
    ModelNotice,
    Point,
    Vector,
    angular_momentum,
    cross,
    euler_equations,
    functions_of_time,
    ground,
    linear_momentum,
    newton_equations,
    symbols,
    translate,
    velocity,
)
from symbody.symbolic import time_derivatives
from tests.laws.random_system import random_system

SEEDS = range(12)
x, y = functions_of_time("x y")
FIXED = Point(ground, *symbols("Ax Ay Az"))
MOVING = Point(translate(x, 0, 0), 0, y, 0)


def rate(vector: Vector) -> tuple[object, ...]:
    return tuple(time_derivatives(vector.projected(ground).components))


@pytest.mark.parametrize("seed", SEEDS)
def test_newton_is_the_rate_of_the_linear_momentum(seed: int) -> None:
    bodies = random_system(seed).bodies
    assert newton_equations(bodies, ground).components == rate(linear_momentum(bodies))


@pytest.mark.parametrize("seed", SEEDS)
def test_euler_is_the_rate_of_the_angular_momentum(seed: int) -> None:
    bodies = random_system(seed).bodies
    assert euler_equations(bodies, FIXED, ground).components == rate(angular_momentum(bodies, FIXED))


@pytest.mark.parametrize("seed", SEEDS)
def test_euler_about_a_moving_point_has_the_transport_term(seed: int) -> None:
    bodies = random_system(seed).bodies
    transport = cross(velocity(MOVING), linear_momentum(bodies))
    momentum = angular_momentum(bodies, MOVING)
    expected = Vector(ground, *rate(momentum)) + transport
    assert euler_equations(bodies, MOVING, ground).components == expected.components


@pytest.mark.parametrize("seed", SEEDS)
def test_euler_about_two_points_differs_by_the_moment_of_newton(seed: int) -> None:
    system = random_system(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        newton = newton_equations(system, ground)
        one, two = (euler_equations(system, point, ground) for point in (FIXED, MOVING))
    assert (one - two).components == cross(MOVING - FIXED, newton).components


@pytest.mark.parametrize("seed", SEEDS)
def test_the_frame_of_the_result_is_a_projection(seed: int) -> None:
    system = random_system(seed)
    frame = system.bodies[0].frame
    for equations in (newton_equations, euler_equations):
        there = equations(system.bodies, frame=frame, gravity=system.gravity)
        assert there.frame == frame
        here = equations(system.bodies, frame=ground, gravity=system.gravity)
        assert there.projected(ground).components == here.components


@pytest.mark.parametrize("seed", SEEDS)
def test_internal_forces_cancel(seed: int) -> None:
    bodies = random_system(seed).bodies
    internal = Force(bodies[0].frame, *symbols("F1 F2 F3"), at=MOVING, on=bodies[0], reaction=bodies[1])
    for equations in (newton_equations, euler_equations):
        assert equations([*bodies, internal]).components == equations(bodies).components
