"""Joints whose conditions would hold with the child turned over: found wherever a position is."""

from math import pi

import numpy as np
import pytest

from symbody import (
    Link,
    Vector,
    assemble,
    consistent_state,
    cylindrical,
    equilibrium,
    fixed,
    free,
    ground,
    inverse_dynamics,
    mobility,
    newton_euler,
    prismatic,
    revolute,
    rotate,
    screw,
    simulate,
    spherical,
    steady,
    t,
    universal,
)
from symbody.errors import ConstraintError

KINDS = [
    (fixed, {}, "its axes x and z on b are opposite to those on a"),
    (prismatic, {}, "its axes x and z on b are opposite to those on a"),
    (screw, {"pitch": 0.3}, "its axes x and z on b are opposite to those on a"),
    (cylindrical, {}, "its axis z on b is opposite to that on a"),
    (revolute, {}, "its axis z on b is opposite to that on a"),
]


def closed(make, psi: float, **options: object) -> float:
    """Return the angle at which a body on a crank is closed, from a guess of it."""
    a, b = Link("a", 1.0, Iz=1.0), Link("b", 1.0, 1.0, 1.0, 1.0)
    P, F = revolute("P", ground, a), free("F", ground, b)
    K = make("K", a, b, at=(1, 0, 0), loop=True, **options)
    equations = newton_euler(assemble([P, F, K]).system())
    x, theta = F.coordinates[0], F.coordinates[4]
    return consistent_state(equations, {}, {P.coordinate: 0}, guess={x: 1, theta: psi})[theta]


@pytest.mark.parametrize(("make", "options", "fault"), KINDS)
def test_a_body_that_is_turned_over_is_refused(make, options, fault):
    assert closed(make, 0.3, **options) == pytest.approx(0, abs=1e-12)
    with pytest.raises(
        ConstraintError, match=f"{make.__name__} K would close with the child turned over: {fault};"
    ):
        closed(make, 2.2, **options)


@pytest.mark.parametrize("make", [universal, spherical])
def test_joints_that_keep_no_axes_parallel_may_be_at_any_angle(make):
    assert closed(make, 2.2) == pytest.approx(2.2)


def test_a_place_that_is_turned_over_closes_there():
    assert closed(revolute, 2.2, to=rotate("Y", pi)) == pytest.approx(pi)


def test_a_rod_that_comes_to_its_slider_from_behind_is_refused_by_all_analyses():
    crank, rod = Link("crank", 1.0, Iz=0.1), Link("rod", 1.0, Iz=0.1, center=(0.15, 0, 0))
    slider = Link("slider", 2.0, Iz=1)
    A, B = revolute("A", ground, crank), revolute("B", crank, rod, at=(0.1, 0, 0))
    C, D = revolute("C", rod, slider, at=(0.3, 0, 0)), prismatic("D", ground, slider, axis="X", loop=True)
    system = assemble([A, B, C, D]).system(gravity=Vector(ground, 0, -9.81, 0))
    equations = newton_euler(system)
    start = {A.coordinate: 0.5}
    path, instants = {A.coordinate: 0.5 + t}, np.linspace(0, 0.1, 3)
    fault = "prismatic D would close with the child turned over: its axes x and y on slider are opposite to those on"
    for analysis in (
        lambda guess: simulate(equations, {}, start, t=(0, 0.1), guess=guess),
        lambda guess: inverse_dynamics(equations, path, {}, instants, guess=guess),
        lambda guess: mobility(system, {}, start | guess),
        lambda guess: equilibrium(equations, {}, guess=guess, fixed=start),
        lambda guess: steady(equations, {}, guess=guess, given=start, held=[A.coordinate]),
    ):
        analysis({C.coordinate: 0.0})
        with pytest.raises(ConstraintError, match=fault):
            analysis({C.coordinate: 3.0})
