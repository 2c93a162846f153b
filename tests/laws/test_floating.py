"""Systems that float, and what stands on moving master frames: speeds that are not rates of coordinates."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Frame,
    Matrix,
    ModelNotice,
    Point,
    System,
    Vector,
    acceleration,
    angular_momentum,
    angular_velocity,
    cross,
    dot,
    euler_equations,
    floating_frame,
    forward_dynamics,
    frozen_velocity,
    functions_of_time,
    gradient,
    gravitational_energy,
    ground,
    identity,
    jacobian,
    kinetic_energy,
    lambdify,
    linear_momentum,
    moving_frame,
    newton_equations,
    newton_euler,
    number,
    origin,
    power,
    project,
    rotate,
    substitute,
    symbols,
    time_derivative,
    translate,
    velocity,
)
from symbody.geometry.frame.frame_velocity import twist
from symbody.geometry.motion.floating import rate_by
from symbody.symbolic import derivation
from tests.laws.random_system import random_floating_system
from tests.laws.test_formalisms import check_same_nodes, is_scleronomic
from tests.page.classic import Classic
from tests.page.rolling import ROLLING
from tests.repeated import repeated

SEEDS = range(12)
FEW = 6
"""Seeds below this one are drawn in every run."""
BASES = (ground, translate(functions_of_time("s"), 0, symbols("c")) * rotate("Y", functions_of_time("phi")))
SYSTEMS = [
    pytest.param(seed, base, id=f"{seed}-{k}", marks=[pytest.mark.repeated] if seed >= FEW else [])
    for seed in SEEDS
    for k, base in enumerate(BASES)
]


@cache
def floating_system(seed: int, base: Frame) -> System:
    system = random_floating_system(seed, base=base)
    own = [q for q in functions_of_time("s phi") if base != ground]
    with warnings.catch_warnings(action="ignore", category=ModelNotice):  # random forces act at any places
        return System(system.bodies, system.loads, [*own, *system.coordinates], gravity=system.gravity)


UNDRIVEN = [
    pytest.param(seed, base, id=f"{seed}-{k}", marks=[pytest.mark.repeated] if seed >= FEW else [])
    for seed in SEEDS
    for k, base in enumerate(BASES)
    if is_scleronomic(floating_system(seed, base))
]


def rate(system: System, value: Expr) -> Expr:
    """Return the time derivative along a motion, by the speeds."""
    with derivation():
        return system.rate([value])[0]


def moving_along(equations: Equations) -> Expr:
    pairs = zip(equations.residuals, equations.speeds, strict=True)
    return sum((residual * speed for residual, speed in pairs), start=number(0))


@pytest.mark.parametrize(("seed", "base"), SYSTEMS)
def test_the_residuals_are_linear_in_the_accelerations(seed: int, base: Frame) -> None:
    system = floating_system(seed, base)
    equations = newton_euler(system)
    M = equations.mass_matrix
    assert M == M.T
    assert jacobian(equations.residuals, equations.accelerations) == M
    assert jacobian(gradient(kinetic_energy(system), equations.speeds), equations.speeds) == M
    at_rest = dict.fromkeys(equations.accelerations, 0)
    assert substitute(equations.residuals, at_rest) == equations.bias


@pytest.mark.parametrize(("seed", "base"), SYSTEMS)
def test_all_formalisms_give_the_same_nodes(seed: int, base: Frame) -> None:
    """Those of Boltzmann and Hamel are the second derivation, from the kinetic energy."""
    check_same_nodes(floating_system(seed, base))


@pytest.mark.parametrize("base", BASES)
def test_two_floating_frames(base: Frame) -> None:
    """One on the other, beside a moving frame whose pose follows a redundant set of velocities."""
    m, I, c, k, g = symbols("m I c k g")
    psi, q1 = functions_of_time("psi q1")
    first = base * floating_frame("first")
    second = first * rotate("X", q1) * floating_frame("second")
    v, r = functions_of_time("v r")
    cart = moving_frame(v, c * r, 0, 0, 0, r, pose=translate(*functions_of_time("x y"), 0) * rotate("Z", psi))
    frames = (first, second, cart * translate(0, k, 0))
    bodies = [Body(Point(frame, c, 0, k), m, I, 2 * I, 3 * I, k) for frame in frames]
    own = [q for q in functions_of_time("s phi") if base != ground]
    spring = Force(second, k, 0, q1, at=Point(second, 0, c, 0), on=bodies[1], reaction=bodies[0])
    gravity = Vector(ground, 0, g, -g)
    check_same_nodes(System(bodies, [spring], [*own, q1], gravity=gravity))


@pytest.mark.parametrize("base", ["given", "free"])
def test_moving_master_frames(base: str) -> None:
    """All velocities unknown, or some given; gravity in the axes of the frame, as its place is unknown."""
    u, v, w, p, q, r = speeds = functions_of_time("u v w p q r")
    moving = moving_frame(*speeds)
    g = Vector(moving, *symbols("gx gy"), 0)
    system = arm(moving, speeds=speeds if base == "free" else [v, p, r])
    given = [] if base == "free" else [u, w, q]
    parts = system.bodies, system.loads, system.coordinates
    check_same_nodes(System(*parts, gravity=g, speeds=system.quasi_velocities, inputs=given))


@pytest.mark.parametrize("classic", ROLLING, ids=lambda classic: classic.name)
def test_rolling_systems(classic: Classic) -> None:
    """Velocities that are linked: without the momenta of all six, Hamel's coefficients would miss terms."""
    check_same_nodes(classic.build())


@pytest.mark.parametrize(("seed", "base"), UNDRIVEN)
def test_power_of_the_loads_is_the_rate_of_the_energy(seed: int, base: Frame) -> None:
    """dE/dt - P = residuals . u, for quaternions of any length."""
    system = floating_system(seed, base)
    assert system.gravity is not None
    falls = (body.mass * dot(velocity(body.center_of_mass), system.gravity) for body in system.bodies)
    weight = sum(falls, start=number(0))
    loads = sum((power(load) for load in system.loads), start=number(0))
    (loads,) = substitute([loads], system.known_rates)
    assert rate(system, kinetic_energy(system)) - weight - loads == moving_along(newton_euler(system))
    assert rate(system, gravitational_energy(system)) == -weight


@pytest.mark.parametrize("seed", [*SEEDS[:FEW], *repeated(SEEDS[FEW:])])
def test_a_free_system_keeps_its_momentum(seed: int) -> None:
    """The residuals of the base are the rates of linear and angular momentum, in its axes."""
    whole = random_floating_system(seed, loads=0)
    base = next(frame for body in whole.bodies for frame in body.frame.chain if frame.coordinate_rates)
    bodies = [body for body in whole.bodies if base in body.frame.chain]
    leaves = {leaf for body in bodies for motion in body.frame.motions for leaf in motion.leaves}
    system = System(
        bodies, coordinates=[q for q in whole.coordinates if q in leaves and q not in whole.coordinate_rates]
    )
    residuals = newton_euler(system).residuals
    force, moment = Vector(base, *residuals[:3]), Vector(base, *residuals[3:6])
    p, H = linear_momentum(system), angular_momentum(system, Point(ground, 0, 0, 0))
    about_ground = project(moment, ground) + cross(origin(base) - origin(ground), project(force, ground))
    for momentum, cause in ((p, project(force, ground)), (H, about_ground)):
        for one, other in zip(project(momentum, ground).components, cause.components, strict=True):
            assert rate(system, one) == other


def test_one_body() -> None:
    """Newton's and Euler's equations in the body's axes [Goldstein 1980, sec. 5-5]."""
    m, Ix, Iy, Iz, g = symbols("m Ix Iy Iz g")
    base = floating_frame()
    body, gravity = Body(base, m, Ix, Iy, Iz), Vector(ground, 0, 0, -g)
    equations = newton_euler(System([body], gravity=gravity))
    u, v, w, p, q, r = equations.speeds
    up = project(Vector(ground, 0, 0, g), base).components
    assert equations.residuals == (
        m * (time_derivative(u) + q * w - r * v + up[0]),
        m * (time_derivative(v) + r * u - p * w + up[1]),
        m * (time_derivative(w) + p * v - q * u + up[2]),
        Ix * time_derivative(p) + (Iz - Iy) * q * r,
        Iy * time_derivative(q) + (Ix - Iz) * r * p,
        Iz * time_derivative(r) + (Iy - Ix) * p * q,
    )
    force = newton_equations(body, base, gravity=gravity)
    moment = euler_equations(body, frame=base, gravity=gravity)
    assert equations.residuals == (*force.components, *moment.components)


@pytest.mark.parametrize("base", BASES)
def test_velocities_are_the_rates_of_what_is_seen_from_ground(base: Frame) -> None:
    """By the speeds in local axes, and by differentiation of coordinates and components in ground."""
    b, q1 = symbols("b"), functions_of_time("q1")
    frame = base * floating_frame("base") * translate(0, 0, b) * rotate("X", q1)
    rate = rate_by(frame.coordinate_rates)
    place, arrow = Point(frame, q1, 1, b), Vector(frame, 1, q1, b)
    for thing, seen in (
        (place, project(place, ground).coordinates),
        (arrow, project(arrow, ground).components),
    ):
        with derivation():
            first = rate(seen)
            assert velocity(thing).components == first
            assert acceleration(thing).components == rate(first)
    rows, columns = frame.pose.rows, [Vector(frame, *axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    for axis, spun in zip(columns, (cross(angular_velocity(frame), axis) for axis in columns), strict=True):
        assert velocity(axis).components == project(spun, ground).components
    assert Matrix(rows) @ Matrix(rows).T == identity(3)


@pytest.mark.parametrize("base", BASES)
def test_what_is_fixed_in_a_frame_is_at_rest_there(base: Frame) -> None:
    frame = base * floating_frame("base") * rotate("X", functions_of_time("q1"))
    assert all(component.is_zero for component in velocity(Point(frame, 1, 2, 3), frame).components)
    beside = Point(ground, 1, 2, 3)
    relative = velocity(beside, frame)
    assert project(relative, ground).components == (-frozen_velocity(beside, frame)).components


@pytest.mark.parametrize("base", BASES)
def test_an_inverse_frame_moves_back(base: Frame) -> None:
    frame = base * floating_frame("base") * rotate("X", functions_of_time("q1"))
    there_and_back = frame * frame.inverse()
    assert there_and_back.matrix == ground.matrix
    assert all(component.is_zero for part in twist(there_and_back) for component in part)


def arm(base: Frame, *, speeds: Sequence[Expr] = ()) -> System:
    """Return a body with two joints on it, and a force at its end."""
    a, b, c, m, M, I, C, F = symbols("a b c m M I C F")
    q1, q2 = functions_of_time("q1 q2")
    upper = base * translate(a, 0, b) * rotate("X", q1)
    lower = upper * translate(0, c, 0) * rotate("Z", q2)
    end = Body(Point(lower, a, b, 0), m, I, 2 * I, 3 * I, C)
    push = Force(lower, F, 0, F * q1, at=Point(lower, 0, 0, a), on=end)
    return System([Body(base, M, I, I, I), Body(upper, m, 0, I, 0), end], [push], [q1, q2], speeds=speeds)


@pytest.mark.parametrize("method", ["articulated_body", "ldl", "pivoted"])
def test_a_moving_master_frame_has_the_same_equations(method: str) -> None:
    """Nobody needs to know where it is; its speeds have the same equations as those of a floating frame."""
    speeds = functions_of_time("u v w p q r")
    one, two = newton_euler(arm(moving_frame(*speeds), speeds=speeds)), newton_euler(arm(floating_frame()))
    assert (one.residuals, one.bias, one.mass_matrix) == (two.residuals, two.bias, two.mass_matrix)
    assert (one.speeds, one.accelerations) == (two.speeds, two.accelerations)
    assert list(one.kinematics) == [time_derivative(q) for q in one.coordinates]
    shown = [*speeds, *two.coordinates, *one.speeds[6:], *sorted(one.parameters, key=str)]
    values = [[0.3 + 0.1 * k for k in range(len(shown))]]
    found = [
        lambdify([shown], list(forward_dynamics(e, method=method).accelerations))(*values) for e in (one, two)
    ]
    M, f = lambdify([shown], [one.mass_matrix, list(one.forcing)])(*values)
    assert np.allclose(found, np.linalg.solve(M, f), rtol=1e-12, atol=0)


def test_a_planar_vehicle() -> None:
    """The single-track model in the speeds u, v and r [Pacejka 2012, sec. 1.3]."""
    m, Iz, X, Yf, Yr, a, b = symbols("m I_z X Y_f Y_r a b")
    u, v, r = functions_of_time("u v r")
    frame = moving_frame(u, v, 0, 0, 0, r)
    car = Body(frame, m, Iz=Iz)
    front = Force(frame, X, Yf, 0, at=Point(frame, a, 0, 0), on=car)
    rear = Force(frame, 0, Yr, 0, at=Point(frame, -b, 0, 0), on=car)
    equations = newton_euler(System([car], [front, rear], speeds=[u, v, r]))
    assert equations.residuals == (
        m * (time_derivative(u) - v * r) - X,
        m * (time_derivative(v) + u * r) - Yf - Yr,
        Iz * time_derivative(r) - a * Yf + b * Yr,
    )
    assert equations.kinematics == {}
    forward = newton_euler(System([car], [front, rear], speeds=[v, r]))  # at a given speed u
    assert forward.residuals == equations.residuals[1:]
    assert forward.inputs == (X, Yf, Yr, u)[3:]


def test_a_submarine_moves_water_along() -> None:
    """Added mass in the axes of the hull, by the components of an acceleration seen from ground."""
    m, I, A = symbols("m I A")
    hull = floating_frame("hull")
    body, rest = Body(hull, m, I, I, I), Body(hull, A)
    a = acceleration(origin(hull))
    drag = Force(-A * a, at=origin(hull), on=body)
    equations, other = newton_euler(System([body], [drag])), newton_euler(System([body, rest]))
    assert equations.residuals == other.residuals
    assert (equations.mass_matrix, equations.bias) == (other.mass_matrix, other.bias)


def test_a_constraint_acts_as_the_force_of_its_multipliers() -> None:
    """A body whose point P is held: the reaction of the ground on it, in its axes."""
    m, I, l, g = symbols("m I l g")
    base, gravity = floating_frame("top"), Vector(ground, 0, 0, -g)
    body, held = Body(base, m, I, I, 2 * I), Point(base, 0, 0, -l)
    place = project(held, ground).coordinates
    reaction = functions_of_time("lambda1 lambda2 lambda3")
    held_by_force = System([body], [Force(ground, *reaction, at=held, on=body)], gravity=gravity)
    system = System([body], constraints=place, gravity=gravity)
    equations = newton_euler(system)
    assert equations.residuals == newton_euler(held_by_force).residuals
    assert equations.constraint_jacobian == jacobian(velocity(held).components, equations.speeds)
    assert equations.baumgarte(0, 0) == acceleration(held).components


def test_the_steady_precession_of_a_top() -> None:
    """``(I3 s + (I3 - I1) W cos(a)) W = m g l`` at a tilt a, I1 about the held point [Goldstein 1980, sec. 5-7]."""
    m, I1, I3, l, g, tilt, spin = 0.7, 0.011, 0.004, 0.2, 9.81, 0.6, 150.0
    base = floating_frame()
    top = Body(base, m, I1, I1, I3)
    held = project(Point(base, 0, 0, -l), ground).coordinates
    equations = newton_euler(System([top], constraints=held, gravity=Vector(ground, 0, 0, -g)))
    solution = forward_dynamics(equations)
    function = lambdify([equations.coordinates, equations.speeds], list(solution.accelerations))
    about = I1 + m * l * l
    slow = np.roots([(I3 - about) * np.cos(tilt), I3 * spin, -m * g * l])
    W = float(slow[np.argmin(np.abs(slow))])
    # body axes at the instant: y is the line of nodes, the angular velocity is W k + spin along the axis
    e = [np.cos(tilt / 2), 0, np.sin(tilt / 2), 0]
    w = np.array([-W * np.sin(tilt), 0, spin + W * np.cos(tilt)])
    v = np.cross(w, [0, 0, l])
    position = [l * np.sin(tilt), 0, l * np.cos(tilt)]
    rates = np.array(function([*position, *e], [*v, *w]))
    # the axis precesses at W: w turns in the body by -spin about its axis
    assert np.allclose(rates[3:], np.cross([0, 0, -spin], w), rtol=1e-9, atol=1e-9)


def test_the_pose_of_a_moving_frame_follows_its_speeds() -> None:
    """In a plane, and by angles in space: the equations are those without a pose, weight and kinematics are new."""
    m, I, c, g = symbols("m I c g")
    x, y, z, yaw, pitch, roll = functions_of_time("x y z yaw pitch roll")
    speeds = functions_of_time("u v w p q r")
    pose = translate(x, y, z) * rotate("Z", yaw) * rotate("Y", pitch) * rotate("X", roll)
    posed, free = (moving_frame(*speeds, pose=place) for place in (pose, None))
    bodies = [Body(Point(frame, c, 0, 0), m, I, 2 * I, 3 * I) for frame in (posed, free)]
    one, two = (newton_euler(System([body], speeds=speeds)) for body in bodies)
    assert (one.residuals, one.mass_matrix) == (two.residuals, two.mass_matrix)
    assert one.coordinates == (x, y, z, yaw, pitch, roll)
    known = dict(one.kinematics)
    assert angular_velocity(pose).subs(known).components == speeds[3:]
    assert project(velocity(origin(pose)), pose).subs(known).components == speeds[:3]
    system = System([Body(posed, m)], speeds=speeds, gravity=Vector(ground, 0, 0, -g))
    assert rate(system, gravitational_energy(system)) == m * g * known[time_derivative(z)]


def test_a_tumbling_body_keeps_momentum_and_quaternion() -> None:
    """Along a motion integrated from the right-hand side, about the unstable axis."""
    base = floating_frame()
    body = Body(Point(base, 0.1, -0.2, 0.3), 2, 0.1, 0.2, 0.3)
    equations = newton_euler(System([body]))
    solution = forward_dynamics(equations)
    state = [equations.coordinates, equations.speeds]
    rhs = lambdify(state, [*equations.kinematics.values(), *solution.accelerations])
    about = angular_momentum(body, Point(ground, 0, 0, 0))
    kept = [kinetic_energy(body), *linear_momentum(body).components, *project(about, ground).components]
    e = equations.coordinates[3:]
    invariants = lambdify(state, [*kept, sum((x * x for x in e), start=number(0))])
    start = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.3, -0.1, 0.2, 0.01, 3.0, 0.02]
    motion = solve_ivp(
        lambda _, y: rhs(y[:7], y[7:]), (0, 20), start, method="DOP853", rtol=1e-11, atol=1e-12
    )
    first, last = (invariants(y[:7], y[7:]) for y in (motion.y[:, 0], motion.y[:, -1]))
    assert np.abs(motion.y[8:, -1] - motion.y[8:, 0]).max() > 0.1
    assert np.allclose(last, first, rtol=1e-8, atol=1e-8)
