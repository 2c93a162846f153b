"""Torsion springs, motors and friction along the coordinates of joints, against closed forms."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    ModelNotice,
    System,
    diff,
    floating_frame,
    functions_of_time,
    generalized_force,
    ground,
    motor,
    moving_frame,
    newton_euler,
    power,
    rotate,
    saturated,
    simulate,
    sin,
    sqrt,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody import friction as friction_in
from symbody.errors import LoadError

q1, q2, x = functions_of_time("q1 q2 x")
m, I, k, c, l, M, Fc, Fs, vs, v0, F, e = symbols("m I k c l M Fc Fs vs v0 F e")
d1, d2, dx = time_derivative(q1), time_derivative(q2), time_derivative(x)
upper = Body(rotate("Z", q1), m, Iz=I, name="upper")
fore = Body(upper.frame * translate(l, 0, 0) * rotate("Z", q2), m, Iz=I, name="fore")
absolute = Body(translate(l, 0, 0) * rotate("Z", q2), m, Iz=I, name="absolute")
cart = Body(translate(x, 0, 0), m, name="cart")


def test_a_hinge_takes_a_torque_about_its_axis() -> None:
    tilted = rotate("Y", e) * rotate("X", q1)
    rotor = Body(tilted, m, Ix=I)
    (action,) = motor(q1, M, on=rotor).actions
    assert not action.is_force
    assert (action.vector.frame, action.vector.components) == (tilted, (M, 0, 0))


def test_a_slide_takes_a_force_along_it() -> None:
    (action,) = motor(x, M, on=cart).actions
    assert action.is_force
    assert action.vector.components == (M, 0, 0)


def test_an_effort_along_an_expression_of_the_coordinates_of_a_joint() -> None:
    """A rope to a puck, and a product: the generalised forces are the effort times the partial derivatives."""
    a, b = functions_of_time("a b")
    puck = Body(translate(a, b, 0), m, name="puck")
    for driven in (sqrt(a**2 + b**2), a * b):
        pull = motor(driven, M, on=puck)
        assert power(pull) == M * time_derivative(driven)
        assert generalized_force(pull, [a, b]) == [M * diff(driven, a), M * diff(driven, b)]


def test_the_motor_of_an_elbow_does_its_power_alone() -> None:
    elbow = motor(q2, M, on=fore, reaction=upper)
    assert power(elbow) == elbow["power"] == M * d2
    assert generalized_force(elbow, [q1, q2]) == [0, M]


def test_absolute_angles_are_known_by_their_difference() -> None:
    first = Body(rotate("Z", q1), m, Iz=I)
    between = motor(q2 - q1, M, on=absolute, reaction=first)
    assert generalized_force(between, [q1, q2]) == [-M, M]
    assert power(between) == M * (d2 - d1)


def test_a_screw_is_driven_by_a_torque() -> None:
    nut = Body(rotate("Z", q1) * translate(0, 0, l * q1), m, Iz=I)
    assert generalized_force(motor(q1, M, on=nut), q1) == M


def test_a_geared_coordinate_has_the_power_of_its_rate() -> None:
    """The angle is three times the coordinate: so is the torque of the drive one third."""
    shaft = Body(rotate("Z", 3 * q1), m, Iz=I)
    drive = motor(q1, M, on=shaft)
    assert power(drive) == M * d1
    assert drive.actions[0].vector.components == (0, 0, M / 3)


def test_joints_on_moving_frames() -> None:
    car = moving_frame(*functions_of_time("u v"), 0, 0, 0, functions_of_time("r"), name="car")
    chassis, wheel = Body(car, m, Iz=I), Body(car * translate(l, 0, 0) * rotate("Y", q1), m, Iy=I)
    assert power(motor(q1, M, on=wheel, reaction=chassis)) == M * d1
    free = floating_frame("base")
    base, arm = Body(free, m, I, I, I), Body(free * rotate("Y", q1), m, I, I, I)
    assert power(motor(q1, M, on=arm, reaction=base)) == M * d1


def test_limits_cut_an_effort_off() -> None:
    drive = motor(q1, M, on=upper, limit=2)
    for asked, given in ((5, 2), (-5, -2), (1.5, 1.5)):
        assert drive["effort"].evaluate({M: asked}) == given
    assert saturated(M, 2) == drive["effort"]


def test_the_two_limits_of_a_drive() -> None:
    low, high = symbols("low high")
    for limit in ((-1, 2), (low, high), [low, 2]):
        drive = motor(q1, M, on=upper, limit=limit)
        for asked, given in ((5, 2), (-5, -1), (1.5, 1.5)):
            assert drive["effort"].subs({low: -1, high: 2}).evaluate({M: asked}) == given
    assert motor(q1, M, on=upper, limit=(0, None))["effort"].evaluate({M: -3}) == 0
    assert motor(q1, M, on=upper, limit=(None, 2))["effort"].evaluate({M: -3}) == -3
    crossed = newton_euler(System([upper], [motor(q1, 1, on=upper, limit=(low, high))], [q1]))
    with pytest.warns(ModelNotice, match=r"high - low of limit = -1; expected a number that isn't negative"):
        simulate(crossed, {I: 1, low: 2, high: 1}, {}, t=(0, 0.1))


def test_a_limited_motor_accelerates_at_its_limit() -> None:
    drive = motor(q1, 100 * (1 - q1), on=upper, limit=2)
    equations = newton_euler(System([upper], [drive], [q1]))
    motion = simulate(equations, {I: 4}, {}, t=(0, 1), rtol=1e-9)
    np.testing.assert_allclose(motion[q1], motion.t**2 / 4, atol=1e-8)


def test_a_torsion_spring_is_that_of_the_textbook() -> None:
    spring = torsion_spring(q2, k, free_angle=e, damping=c, on=fore, reaction=upper)
    assert generalized_force(spring, [q1, q2]) == [0, -k * (q2 - e) - c * d2]
    assert power(spring) + time_derivative(spring.potential) == -c * d2**2
    assert spring["torque"] == -k * (q2 - e) - c * d2
    slide = torsion_spring(x, k, on=cart)
    assert generalized_force(slide, x) == -k * x


def test_friction_is_that_of_stribeck() -> None:
    drag = friction_in(x, on=cart, viscous=c, coulomb=Fc, static=Fs, stribeck_speed=vs, creep_speed=v0)[
        "effort"
    ]
    numbers = {c: 0.3, Fc: 2.0, Fs: 3.0, vs: 0.1, v0: 1e-4}
    for v in (-2.0, -0.05, 0.01, 0.3, 5.0):
        expected = -(2 + np.exp(-((v / 0.1) ** 2))) * np.tanh(v / 1e-4) - 0.3 * v
        assert drag.evaluate({**numbers, dx: v}) == pytest.approx(expected, rel=1e-12)


def test_viscous_friction_alone_needs_no_creep_speed() -> None:
    assert friction_in(x, on=cart, viscous=c)["effort"] == -c * dx


def sliding(load: float, **start: float) -> object:
    drag = friction_in(x, on=cart, coulomb=Fc, creep_speed=v0)
    pull = motor(x, F, on=cart)
    equations = newton_euler(System([cart], [drag, pull], [x]))
    values = {m: 1, F: load, Fc: 2, v0: 1e-4}
    return simulate(
        equations, values, {dx: start.get("speed", 0)}, t=(0, 4), method="bdf", rtol=1e-8, atol=1e-12
    )


def test_a_sticking_joint_creeps_at_the_speed_that_the_law_says() -> None:
    motion = sliding(1.5)
    assert motion[dx][-1] == pytest.approx(1e-4 * np.arctanh(1.5 / 2), rel=1e-6)
    assert motion[x][-1] < 4 * 1e-4


def test_a_joint_slides_with_more_and_comes_to_rest_without_a_load() -> None:
    assert sliding(3.0)[x][-1] == pytest.approx(4**2 / 2, rel=1e-3)  # (3 - 2) N on 1 kg
    stopping = sliding(0.0, speed=1.0)
    assert stopping[x][-1] == pytest.approx(1 / (2 * 2), rel=1e-3)  # v^2/(2 mu g)
    assert abs(stopping[dx][-1]) < 1e-9
    assert stopping.energy_drift < 1e-5


def test_stick_and_slip_on_a_belt() -> None:
    """A belt pulls a mass on a spring by friction: it sticks until the spring breaks it loose at k x = Fs."""
    belt = functions_of_time("belt")
    mover = Body(translate(belt, 0, 0), 0, name="belt")
    drag = friction_in(
        x - belt, on=cart, reaction=mover, coulomb=1, static=2, stribeck_speed=0.05, creep_speed=1e-4
    )
    held = torsion_spring(x, k, on=cart)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        system = System([cart, mover], [drag, held], [x], inputs=[belt])
    motion = simulate(
        newton_euler(system),
        {m: 1, k: 10},
        {dx: 0.1},
        t=(0, 4),
        inputs={belt: 0.1 * t},
        method="bdf",
        rtol=1e-8,
        atol=1e-10,
    )
    speed, pull = motion[dx], 10 * motion[x]
    sticks = motion.t < 1.9
    np.testing.assert_allclose(speed[sticks], 0.1, atol=5e-4)
    assert 2 < pull.max() < 2 + 0.1 * np.sqrt(10)  # it overshoots by its speed
    assert speed[~sticks].min() < -0.1


@pytest.mark.parametrize(
    "mistake",
    [
        lambda: motor(q1, M, on=fore),
        lambda: motor(x, M, on=upper),
        lambda: motor(q1 * q2, M, on=fore, reaction=upper),
        lambda: motor(q1, M, on=Body(rotate("X", q1) * translate(l, 0, 0) * rotate("Y", q2), m)),
        lambda: motor(q1, M, on=Body(rotate("X", q1) * rotate("X", q2), m)),
        lambda: motor(x, M, on=Body(rotate("Z", q1) * translate(l, 0, 0) * translate(x, 0, 0), m)),
    ],
)
def test_what_is_no_joint_coordinate_is_refused(mistake: object) -> None:
    assert callable(mistake)
    with pytest.raises(LoadError, match=r"doesn't move against .* about or along one axis at the rate of"):
        mistake()


def test_a_massless_body_between_two_hinges_opens_the_way() -> None:
    cross = Body(rotate("X", q1), 0, name="cross")
    arm = Body(cross.frame * rotate("Y", q2), m, I, I, I)
    efforts = [motor(q1, M, on=cross), motor(q2, F * sin(t), on=arm, reaction=cross)]
    equations = newton_euler(System([cross, arm], efforts, [q1, q2]))
    assert generalized_force(efforts, [q1, q2]) == [M, F * sin(t)]
    assert len(equations.residuals) == 2
    assert ground is cross.frame.ancestor
