"""Limits of joints: events that end a motion there, and notices of a motion that passes them."""

import numpy as np
import pytest

from symbody import (
    Link,
    ModelNotice,
    Vector,
    assemble,
    ground,
    newton_euler,
    prismatic,
    revolute,
    simulate,
    simulate_many,
    stops,
    symbols,
    time_derivative,
)

a = symbols("a")
weight = Vector(ground, 0, -9.81, 0)


def pendulum(*limits: object):
    bob = Link("bob", 1, center=(0, -1, 0))
    pin = revolute("A", ground, bob, limits=limits)
    return newton_euler(assemble([pin]).system(gravity=weight)), pin.coordinate


def test_a_motion_ends_at_a_stop():
    """By the energy: w^2 = 2 g (cos(phi) - cos(phi0))."""
    equations, phi = pendulum(-0.5, 1.2)
    motion = simulate(equations, {}, {phi: 1.0}, t=(0, 5), events=stops(equations), rtol=1e-11, atol=1e-12)
    (end,) = motion.events
    assert end.event.name == "A.lower"
    assert end.state[phi] == pytest.approx(-0.5, abs=1e-9)
    speed = np.sqrt(2 * 9.81 * (np.cos(0.5) - np.cos(1.0)))
    assert end.state[time_derivative(phi)] == pytest.approx(-speed, rel=1e-8)


def test_a_motion_that_passes_a_limit_is_reported():
    equations, phi = pendulum(-0.5, None)
    with pytest.warns(ModelNotice) as caught:
        simulate(equations, {}, {phi: 1.0}, t=np.linspace(0, 1.2, 121))
    (message,) = (str(each.message) for each in caught)
    assert message.startswith("simulate: revolute A is beyond its limit by up to 0.5, first at t = 0.")
    assert message.endswith(
        " s: limits exert no forces; end the motion there with events=stops(equations), begin inside, or model the "
        "stop as a load"
    )


def test_a_start_outside_is_reported_for_one_and_many():
    equations, phi = pendulum(None, a)
    with pytest.warns(ModelNotice, match=r"revolute A is beyond its limit by up to 0\.1, first at t = 0 s"):
        simulate(equations, {a: 0.9}, {phi: 1.0}, t=(0, 0.1))
    with pytest.warns(
        ModelNotice, match=r"in 1 of 2 cases, first case 1: revolute A is beyond its limit by up to 0\.3"
    ):
        simulate_many(equations, {a: 0.9}, {phi: [0.5, 1.2]}, t=(0, 0.1))


def test_limits_without_a_value_are_reported():
    equations, phi = pendulum(-a, a)
    with pytest.warns(
        ModelNotice,
        match="the limits of revolute A hold a, which has no value, and were not checked; give it among the parameters",
    ):
        simulate(equations, {}, {phi: 1.0}, t=(0, 0.1))


def test_a_joint_that_closes_a_loop_stops_too():
    crank, rod, slider = Link("crank", 1), Link("rod", 1), Link("slider", 1)
    joints = [
        revolute("A", ground, crank),
        revolute("B", crank, rod, at=(1, 0, 0)),
        revolute("C", rod, slider, at=(3, 0, 0)),
        prismatic("D", ground, slider, axis="X", limits=(2.5, 3.5)),
    ]
    equations = newton_euler(assemble(joints).system())
    phi = joints[0].coordinate
    guess = {joints[1].coordinate: -1.8, joints[2].coordinate: 0.3}
    start = {phi: 1.0, time_derivative(phi): 1.0}
    motion = simulate(equations, {}, start, t=(0, 5), events=stops(equations), guess=guess)
    (end,) = motion.events
    assert end.event.name == "D.lower"
    angle = end.state[phi]
    assert np.cos(angle) + np.sqrt(9 - np.sin(angle) ** 2) == pytest.approx(2.5, abs=1e-8)
