"""The work of loads and of moving constraints is as accurate as the motion, also where the motion is simple."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    Link,
    Point,
    System,
    Vector,
    assemble,
    dot,
    functions_of_time,
    ground,
    kinetic_energy,
    lagrange_equations,
    newton_euler,
    origin,
    project,
    reaction,
    revolute,
    rotate,
    simulate,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ModelError
from tests.reference.mechanisms.n_fourbar import bar_of
from tests.repeated import repeated

m, l, g, w, k, c = symbols("m l g w k c")


@pytest.fixture(autouse=True)
def no_notice() -> object:
    """Nothing here is to be reported."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


@pytest.mark.parametrize("rtol", [1e-4, 1e-8])
@pytest.mark.parametrize("method", ["dop853", "tsit5", "bdf", "esdirk34", "tr_bdf2"])
def test_what_turns_a_bob_at_constant_speed_lifts_it(method: str, rtol: float) -> None:
    """The state is a straight line, for which steps grow without end; the weight's energy swings."""
    theta = functions_of_time("theta")
    bob = Body(Point(rotate("Z", theta), l, 0, 0), m)
    driven = newton_euler(System([bob], (), [theta], [theta - w * t], Vector(ground, 0, -g, 0)))
    motion = simulate(driven, {m: 1, l: 1, g: 9.81, w: 5}, {}, t=(0, 10), method=method, rtol=rtol)
    exact = 9.81 * np.sin(5 * motion.t)
    assert np.abs(motion.work - exact).max() < 1e3 * rtol * 9.81
    assert motion.energy_drift < 1e3 * rtol


@pytest.mark.parametrize("method", ["bdf", "esdirk34", "tr_bdf2"])
def test_what_a_damper_takes_is_work(method: str) -> None:
    """Overdamped: the slow motion hardly has kinetic energy, and implicit methods take long steps."""
    x = functions_of_time("x")
    body = Body(translate(x, 0, 0), m)
    spring = Force(ground, -k * x - c * time_derivative(x), 0, 0, at=origin(body.frame), on=body)
    motion = simulate(
        lagrange_equations(System([body], [spring], [x])),
        {m: 1, k: 1, c: 100},
        {x: 1.0},
        t=(0, 10),
        method=method,
        rtol=1e-6,
    )
    slow, fast = -50 + np.sqrt(50**2 - 1), -50 - np.sqrt(50**2 - 1)
    speed = slow * fast / (fast - slow) * (np.exp(slow * motion.t) - np.exp(fast * motion.t))
    assert np.abs(motion.work - speed**2 / 2).max() < 1e-6


@pytest.mark.parametrize(
    ("speed", "rtol"),
    [(5.0, 1e-6), (10.0, 1e-4), *repeated([(5.0, 1e-4), (5.0, 1e-5), (10.0, 1e-5), (10.0, 1e-6)])],
)
def test_projection_does_not_take_errors_of_bdf_for_leaps(speed: float, rtol: float) -> None:
    """A four-bar linkage whose crank turns around and around, and whose constraint is regular everywhere."""
    alpha, beta = functions_of_time("alpha beta")
    r, d, b = symbols("r d b")
    crank, rocker = rotate("Z", alpha), translate(d, 0, 0) * rotate("Z", beta)
    bodies = [bar_of(crank, m, r), bar_of(rocker, m, b)]
    gap = project(Point(crank, r, 0, 0) - Point(rocker, b, 0, 0), ground)
    drive = Force(crank, 0, c * (w - time_derivative(alpha)), 0, at=Point(crank, r, 0, 0), on=bodies[0])
    system = System(bodies, [drive], [alpha, beta], [dot(gap, gap) - k**2], Vector(ground, 0, -g, 0))
    parameters = {m: 1, r: 0.3, b: 0.6, d: 1, k: 0.9, c: 50, w: speed, g: 9.81}
    motion = simulate(
        lagrange_equations(system),
        parameters,
        {alpha: 0.5},
        guess={beta: 1.8},
        t=(0, 5),
        method="bdf",
        rtol=rtol,
    )
    assert motion.completed


def test_the_drive_of_a_turntable_works_through_a_pin_that_closes_a_loop() -> None:
    """Its torque W is that of both pins about the axis; the pin of the tree is there, so the other one does it all."""
    table, arms = rotate("Z", 2 * t), [Link(name, 1, Iz=0.02, center=(0.1, 0, 0)) for name in "abc"]
    joints = [
        revolute("A", table, arms[0]),
        revolute("B", arms[0], arms[1], at=(0.3, 0, 0)),
        revolute("C", arms[1], arms[2], at=(0.9, 0, 0)),
        revolute("D", table, arms[2], at=(0.8, 0, 0), to=(0.5, 0, 0), loop=True),
    ]
    equations = newton_euler(assemble(joints).system())
    A, B, C = equations.coordinates
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = simulate(equations, {}, {A: 1.2, B.diff(t): 1}, t=(0, 1), guess={B: -1, C: -2}, rtol=1e-10)
    with pytest.raises(ModelError, match="frames move by t, a prescribed motion"):
        motion.energy_drift  # noqa: B018
    energy = motion[kinetic_energy(equations.system)]
    power = 2 * motion[reaction(equations, "D", frame=ground).about(origin(ground)).moment.components[2]]
    work = np.concatenate([[0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(motion.t))])
    assert np.ptp(energy) > 0.1
    np.testing.assert_allclose(energy - energy[0], work, atol=1e-4)
