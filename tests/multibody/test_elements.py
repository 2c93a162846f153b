"""Bushings, forces of the air and contacts, against closed forms."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from symbody import (
    Body,
    Event,
    Matrix,
    ModelNotice,
    Point,
    System,
    Vector,
    air_force,
    bushing,
    contact,
    dot,
    functions_of_time,
    generalized_force,
    gradient,
    ground,
    newton_euler,
    number,
    power,
    project,
    rotate,
    simulate,
    simulate_many,
    sin,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import LoadError

x, y, z, a1, a2, a3 = functions_of_time("x y z a1 a2 a3")
m, I, R, k, d, mu, v0, g, rho, A, L = symbols("m I R k d mu v0 g rho A L")
block = Body(
    translate(x, y, z) * rotate("X", a1) * rotate("Y", a2) * rotate("Z", a3), m, I, I, I, name="block"
)
COORDINATES = [x, y, z, a1, a2, a3]
K = symbols("K1:7")


def test_a_bushing_at_small_rotations_is_six_springs() -> None:
    forces = generalized_force(bushing(block.frame, ground, K, on=block), COORDINATES)
    at = dict.fromkeys(COORDINATES, 1e-6)
    small = [force.evaluate({**at, **dict.fromkeys(K, 1.0)}) for force in forces]
    np.testing.assert_allclose(small, [-1e-6] * 6, rtol=3e-6)


def test_a_bushing_has_a_potential_at_any_rotation() -> None:
    coupled = Matrix([[symbols(f"c{min(i, j)}{max(i, j)}") for j in range(6)] for i in range(6)])
    b = functions_of_time("b")
    other = Body(rotate("Y", b), m, I, I, I)
    rubber = bushing(block.frame * translate(R, 0, 0), other.frame, coupled, on=block, reaction=other)
    every = [*COORDINATES, b]
    forces = generalized_force(rubber, every)
    slopes = gradient(rubber.potential, every)
    random = np.random.default_rng(2)
    leaves = sorted({leaf for each in (*forces, *slopes) for leaf in each.free_symbols}, key=str)
    at = {leaf: random.uniform(-1.2, 1.2) for leaf in leaves}
    for force, slope in zip(forces, slopes, strict=True):
        assert force.evaluate(at) == pytest.approx(-slope.evaluate(at), rel=1e-10, abs=1e-12)


def test_the_angle_of_a_bushing_is_the_sine_about_any_axis() -> None:
    axis = (number("3/5"), 0, number("4/5"))
    turned = Body(rotate(axis, a1), m, I, I, I)
    rubber = bushing(turned.frame, ground, [0, 0, 0, k, k, k], on=turned)
    assert rubber["rotation x"] == sin(a1) * axis[0]
    assert generalized_force(rubber, a1) == -k * sin(2 * a1) / 2


def test_damping_of_a_bushing_is_along_the_rates() -> None:
    rubber = bushing(block.frame, ground, [0] * 6, damping=[d, 0, 0, 0, 0, 0], on=block)
    assert power(rubber) == -d * time_derivative(x) ** 2
    assert rubber.potential == 0


def test_drag_goes_with_the_square_of_the_speed_against_the_wind() -> None:
    car = Body(translate(x, y, 0), m)
    u = time_derivative(x)
    gust = Vector(ground, -symbols("w"), 0, 0)
    drag = air_force(car.center_of_mass, on=car, density=rho, drag_area=A, wind=gust)
    numbers = {rho: 1.2, A: 0.6, u: 10.0, time_derivative(y): 3.0, symbols("w"): 5.0}
    vx, vy = 15.0, 3.0
    speed = np.hypot(vx, vy)
    expected = [-0.5 * 1.2 * 0.6 * speed * vx, -0.5 * 1.2 * 0.6 * speed * vy]
    found = [each.evaluate(numbers) for each in generalized_force(drag, [x, y])]
    np.testing.assert_allclose(found, expected, rtol=1e-14)
    assert drag["speed"].evaluate(numbers) == pytest.approx(speed)


def test_lift_is_across_the_velocity_and_the_span() -> None:
    wing = Body(translate(x, 0, z), m)
    span = Vector(ground, 0, 1, 0)
    lift = air_force(wing.center_of_mass, on=wing, density=rho, lift_area=L, span=span)
    assert power(lift) == 0
    forward = {time_derivative(z): 0}
    _, up = (each.subs(forward) for each in generalized_force(lift, [x, z]))
    assert up.evaluate({rho: 1.2, L: 3.0, time_derivative(x): 20.0}) == pytest.approx(0.5 * 1.2 * 3 * 400)
    assert lift["lift"].evaluate({rho: 1.2, L: 3.0, time_derivative(x): 20.0, time_derivative(z): 0}) == (
        pytest.approx(0.5 * 1.2 * 3 * 400)
    )


@pytest.mark.parametrize("method", ["dop853", "bdf"])
def test_a_fall_from_rest_reaches_its_last_speed(method: str) -> None:
    """v = vt tanh(g t/vt) with vt = sqrt(2 m g/(rho A)); implicit methods need the derivatives of drag at rest."""
    drop = Body(translate(x, y, z), m)
    drag = air_force(drop.center_of_mass, on=drop, density=rho, drag_area=A)
    system = System([drop], [drag], [x, y, z], gravity=Vector(ground, 0, 0, -g))
    values = {m: 2, g: 9.81, rho: 1.2, A: 0.5}
    motion = simulate(newton_euler(system), values, {}, t=(0, 5), method=method, rtol=1e-8, atol=1e-10)
    last = np.sqrt(2 * 2 * 9.81 / (1.2 * 0.5))
    np.testing.assert_allclose(motion[time_derivative(z)], -last * np.tanh(9.81 * motion.t / last), atol=1e-5)
    assert motion.energy_drift < 1e-5


ball = Body(translate(x, 0, z), m, 2 * m * R**2 / 5, 2 * m * R**2 / 5, 2 * m * R**2 / 5, name="ball")


def test_a_contact_pushes_by_the_law_of_hertz_and_opens() -> None:
    touch = contact(ball.center_of_mass, R, k, on=ball)
    normal = touch["normal"]
    assert normal.evaluate({k: 100, R: 0.5, z: 0.46}) == pytest.approx(100 * 0.04**1.5)
    assert normal.evaluate({k: 100, R: 0.5, z: 0.6}) == 0
    assert touch["gap"] == z - R
    numbers = {k: 100, R: 0.5, z: 0.46}
    (force,) = generalized_force([touch], [z])
    assert force.evaluate(numbers) == pytest.approx(-touch.potential.diff(z).evaluate(numbers))


def test_a_contact_never_pulls() -> None:
    sticky = contact(ball.center_of_mass, R, k, on=ball, damping=d)["normal"]
    random = np.random.default_rng(0)
    for _ in range(200):
        at = {k: 1e4, R: 0.5, d: 2.0, z: random.uniform(0.4, 0.6), time_derivative(z): random.uniform(-3, 3)}
        assert sticky.evaluate(at) >= 0
    leaving = {k: 1e4, R: 0.5, d: 2.0, z: 0.45, time_derivative(z): 1.0}
    assert sticky.evaluate(leaving) == 0
    coming = leaving | {time_derivative(z): -0.3}
    assert sticky.evaluate(coming) == pytest.approx(1e4 * 0.05**1.5 * 1.6)


def dropped(**options: object) -> object:
    touch = contact(ball.center_of_mass, R, k, on=ball, **options)
    system = System([ball], [touch], [x, z], gravity=Vector(ground, 0, 0, -g))
    values = {m: 1.0, g: 9.81, R: 0.1, k: 1e6} | ({d: 0.1} if "damping" in options else {})
    return simulate(
        newton_euler(system),
        values,
        {z: 1.1},
        t=np.linspace(0, 2.2, 23),
        rtol=1e-9,
        atol=1e-12,
        max_step=1e-3,
        events=[Event(time_derivative(z), name="top", direction=-1)],
    )


def tops(motion: object) -> list[float]:
    return [float(each.state[z]) for each in motion.events]  # type: ignore[attr-defined]


def test_a_ball_without_damping_comes_back_to_its_height() -> None:
    motion = dropped()
    assert motion.energy_drift < 1e-6
    assert abs(motion.work).max() < 1e-6
    np.testing.assert_allclose(tops(motion), 1.1, atol=2e-6)


def test_restitution_is_that_of_hunt_and_crossley() -> None:
    """The speeds before and after an impact, from dv/d(delta) = -k delta^n (1 + d v)/(m v), without weight."""
    speed = np.sqrt(2 * 9.81 * 1.0)
    motion = dropped(damping=d)
    height = tops(motion)[0] - 0.1
    e = np.sqrt(height / 1.0)
    assert np.log((1 + 0.1 * speed) / (1 - 0.1 * e * speed)) == pytest.approx(0.1 * speed * (1 + e), abs=2e-3)
    assert motion.work[-1] < -1
    assert motion.energy_drift < 1e-6


def test_a_ball_that_slides_begins_to_roll() -> None:
    """From sliding at v, it rolls at 5/7 v, whatever the friction [Routh 1905]."""
    disc = Body(translate(x, 0, z) * rotate("Y", a1), m, Iy=2 * m * R**2 / 5, name="ball")
    touch = contact(disc.center_of_mass, R, k, on=disc, friction=mu, creep_speed=v0, exponent=1, damping=d)
    system = System([disc], [touch], [x, z, a1], gravity=Vector(ground, 0, 0, -g))
    values = {m: 1.0, g: 9.81, R: 0.1, k: 1e5, mu: 0.3, v0: 1e-3, d: 1.0}
    start = {z: 0.1 - 9.81 / 1e5, time_derivative(x): 2.0}
    motion = simulate(newton_euler(system), values, start, t=(0, 1), method="bdf", rtol=1e-8, atol=1e-10)
    sunk = 0.1 - 9.81 / 1e5
    speed, spin = motion[time_derivative(x)][-1], motion[time_derivative(a1)][-1]
    assert speed == pytest.approx(2 * 5 / 7, rel=2e-3)
    assert spin * sunk == pytest.approx(speed, rel=1e-3)


def test_a_plane_on_a_body_takes_the_reaction() -> None:
    plank = Body(rotate("Y", a2), m, Iy=I, name="plank")
    touch = contact(
        ball.center_of_mass, R, k, on=ball, plane=plank.frame, reaction=plank, friction=mu, creep_speed=v0
    )
    assert [action.body for action in touch.actions] == [ball, plank]
    n = Vector(plank.frame, 0, 0, 1)
    offset = project(ball.center_of_mass, plank.frame).coordinates[2]
    assert touch["gap"] == offset - R
    assert dot(touch.actions[0].vector, n) == touch["normal"]


@pytest.mark.parametrize("bad", [[1, 2, 3], [[1, 0], [0, 1]]])
def test_a_bushing_needs_six_coefficients(bad: object) -> None:
    with pytest.raises(LoadError, match="expected six numbers"):
        bushing(block.frame, ground, bad, on=block)  # type: ignore[arg-type]


def test_a_contact_that_no_step_felt_is_reported() -> None:
    """A rotor without drive takes a few long steps; short ones feel its spike touch the ground at each turn."""
    rotor = Body(translate(0, 0, z) * rotate("Y", a1), 1, Iy=1, name="rotor")
    spike = contact(Point(rotor.frame, 0, 0, -1), 0.01, k, on=rotor, name="spike")
    equations = newton_euler(System([rotor], [spike], coordinates=[a1], inputs=[z]))
    numbers, start = {k: 1e6}, {a1: 1.0, time_derivative(a1): 10.0}
    instants = np.linspace(0, 3, 301)
    with pytest.warns(ModelNotice) as caught:
        passed = simulate(equations, numbers, start, t=instants, inputs={z: 0.9999})
    (notice,) = caught
    assert str(notice.message) == (
        "simulate: spike is passed without its force at about t = 1.785 s, by up to 0.0101 m: the contact begins and "
        "ends within a step; give max_step, a fraction of the duration of the contact"
    )
    assert passed[a1][-1] == pytest.approx(31, abs=1e-9)
    start[time_derivative(a1)] = [0.0, 10.0, 10.0]
    with pytest.warns(ModelNotice) as caught:
        simulate_many(equations, numbers, start, t=instants, inputs={z: 0.9999})
    (of_all,) = caught
    assert str(of_all.message) == str(notice.message).replace(
        "simulate: ", "simulate_many: in 2 of 3 cases, first case 1: "
    )
    start[time_derivative(a1)] = 10.0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        felt = simulate(equations, numbers, start, t=instants, inputs={z: 0.9999}, max_step=1e-3)
    assert felt[a1][-1] == pytest.approx(30.976, abs=1e-3)
    assert felt.energy_drift < 1e-5
