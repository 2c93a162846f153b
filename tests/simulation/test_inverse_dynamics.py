"""Inverse dynamics: against closed forms, virtual work, other tools' numbers and the simulations that it inverts."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.interpolate import make_interp_spline
from scipy.linalg import solve

from symbody import (
    Body,
    Expr,
    Force,
    System,
    Torque,
    Vector,
    cos,
    embedded,
    floating_frame,
    functions_of_time,
    ground,
    inverse_dynamics,
    log,
    newton_euler,
    pi,
    rotate,
    simulate,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ArgumentError, ConstraintError, ModelError, ParameterError, SimulationError
from symbody.view import animate, plot
from tests.reference.mechanisms.andrews import andrews
from tests.reference.robot import FIXED, motion_at, robot
from tests.repeated import repeated
from tests.simulation.linkages import double_pendulum, fourbar, hanging_box, pendulum_on_rail, slider_crank

w = symbols("w")
AHEAD = {"qB": 1.25, "qC": 0.67}
"""The assembly of the four-bar in which the reference has it."""


def drive(linkage, motion, instants, parameters=None, **more):
    """Inverse dynamics, with variables by their names."""
    motion = {linkage[name]: value for name, value in motion.items()}
    values = dict(linkage.parameters) | {linkage[name]: value for name, value in (parameters or {}).items()}
    if "guess" in more:
        more["guess"] = {linkage[name]: value for name, value in more["guess"].items()}
    if "unknowns" in more:
        more["unknowns"] = [linkage[name] for name in more["unknowns"]]
    if any(isinstance(value, Expr) and value.has(w) for value in motion.values()):
        values[w] = 7.0
    return inverse_dynamics(linkage.equations, motion, values, instants, **more)


def slope(function, x):
    """The derivative of an analytic function to rounding: its imaginary part a hair off the real axis."""
    return np.imag(function(np.asarray(x) + 1e-30j)) / 1e-30


# --- closed forms -----------------------------------------------------------------------------------------------------


def test_a_pendulum_takes_the_torque_of_the_textbook():
    m, l, g, a, theta = *symbols("m l g a"), functions_of_time("theta")
    bob = Body(rotate("Y", theta) * translate(0, 0, l), m)
    eqs = newton_euler(System([bob], coordinates=[theta], gravity=Vector(ground, 0, 0, g)))
    found = inverse_dynamics(eqs, {theta: a * sin(w * t)}, {m: 2, l: 0.7, g: 9.81, a: 0.4, w: 3}, [0, 2])
    angle = 0.4 * np.sin(3 * found.t)
    torque = 2 * 0.7**2 * -9 * angle + 2 * 9.81 * 0.7 * np.sin(angle)
    assert len(found) == 1001
    assert np.allclose(found.forces[theta], torque, rtol=1e-13, atol=1e-13)
    assert np.allclose(found[theta], angle, rtol=1e-15)
    assert np.allclose(found[time_derivative(theta, 2)], -9 * angle, rtol=1e-13)


def test_a_slider_crank_at_constant_speed():
    # The power of the torque is the rate of the kinetic energy I(phi) w^2 / 2, less the power of the slider's force;
    # the pin accelerates the slider.
    linkage, turning, push = slider_crank(), 7.0, -40.0
    r, l, m2, m3, I1, I2 = (linkage.parameters[linkage[name]] for name in ("r", "l", "m2", "m3", "I1", "I2"))

    def place(phi):
        return r * np.cos(phi) + np.sqrt(l**2 - r**2 * np.sin(phi) ** 2)

    def place_slope(phi):
        return -r * np.sin(phi) - r**2 * np.sin(phi) * np.cos(phi) / np.sqrt(l**2 - r**2 * np.sin(phi) ** 2)

    def inertia(phi):
        tilt = r * np.cos(phi) / np.sqrt(l**2 - r**2 * np.sin(phi) ** 2)
        x_slope, y_slope = (place_slope(phi) - r * np.sin(phi)) / 2, r * np.cos(phi) / 2
        return I1 + m2 * (x_slope**2 + y_slope**2) + I2 * tilt**2 + m3 * place_slope(phi) ** 2

    found = drive(linkage, {"phi": w * t}, [0, 2], {"F": push}, unknowns=["T"], guess={"s": 0.4})
    phi = turning * found.t
    torque = turning**2 * slope(inertia, phi) / 2 - push * place_slope(phi)
    assert np.allclose(found[linkage["s"]], place(phi), rtol=1e-13)
    assert np.allclose(found.forces[linkage["T"]], torque, rtol=1e-11, atol=1e-12)
    pin = m3 * turning**2 * slope(place_slope, phi) - push
    assert np.allclose(found[-linkage.equations.multipliers[0]], pin, rtol=1e-11, atol=1e-12)

    work = linkage["T"] * time_derivative(linkage["phi"]) + linkage["F"] * time_derivative(linkage["s"])
    energy = make_interp_spline(found.t, inertia(phi) * turning**2 / 2, k=5)
    assert np.allclose(found[work], energy(found.t, 1), atol=1e-6 * np.abs(torque).max() * turning)


def test_a_pendulum_that_leans_on_its_rail():
    # At a constant angle b it is accelerated as its pivot: 2 lambda y = m g, and f = m x'' - 2 lambda l sin(b).
    linkage, lean = pendulum_on_rail(), 0.5
    m, l, g, a, rate = (linkage.parameters[linkage[name]] for name in ("m", "l", "g", "a", "w"))
    motion = {"x": linkage["a"] * sin(linkage["w"] * t) + linkage["l"] * np.sin(lean)}
    found = inverse_dynamics(
        linkage.equations, {linkage["x"]: motion["x"]}, linkage.parameters, [0, 4], guess={linkage["y"]: -1.0}
    )
    multiplier = -m * g / (2 * l * np.cos(lean))
    force = -m * a * rate**2 * np.sin(rate * found.t) - 2 * multiplier * l * np.sin(lean)
    assert np.allclose(found[linkage["y"]], -l * np.cos(lean), rtol=1e-13)
    assert np.allclose(found.multipliers[:, 0], multiplier, rtol=1e-11)
    assert np.allclose(found.forces[linkage["x"]], force, rtol=1e-11)


def test_a_floating_body_is_carried_around():
    # It turns about z at the rate 3 on a circle of radius 2: m (a - g) towards the centre and up, and w x I w.
    m, g, Iz, Cyz, Cxz, *wrench = symbols("m g Iz Cyz Cxz Fx Fy Fz Mx My Mz")
    hull = floating_frame()
    body = Body(hull, m, 0.2, 0.25, Iz, Cyz, Cxz)
    carrier = [
        Force(hull, *wrench[:3], at=body.center_of_mass, on=body),
        Torque(hull, *wrench[3:], on=body),
    ]
    eqs = newton_euler(System([body], carrier, gravity=Vector(ground, 0, 0, -g)))
    x, y, z, e0, e1, e2, e3 = eqs.coordinates
    motion = {
        x: 2 * cos(w * t),
        y: 2 * sin(w * t),
        z: 0,
        e0: cos(w * t / 2),
        e1: 0,
        e2: 0,
        e3: sin(w * t / 2),
    }
    values = {m: 1.5, g: 9.81, Iz: 0.3, Cyz: 0.02, Cxz: -0.05, w: 3}
    found = inverse_dynamics(eqs, motion, values, [0, 2, 3], unknowns=wrench)
    expected = [-1.5 * 2 * 9, 0, 1.5 * 9.81, 0.02 * 9, 0.05 * 9, 0]
    assert np.allclose(np.array(list(found.forces.values())).T, expected, atol=1e-12)
    assert np.allclose(found[time_derivative(x)], -6 * np.sin(3 * found.t), atol=1e-12)
    with pytest.raises(SimulationError, match="the force along e0 is not determined: other values"):
        inverse_dynamics(eqs, motion, values | dict.fromkeys(wrench, 0), [0, 2, 3])


def test_a_floating_body_that_may_only_shift():
    # Its shift is prescribed, and constraints keep it from turning: forces along its coordinates.
    m, g, I = symbols("m g I")
    hull = floating_frame()
    system = System([Body(hull, m, I, I, I)], gravity=Vector(ground, 0, 0, -g))
    x, y, z, *turning = system.coordinates
    held = System(system.bodies, constraints=turning[1:], gravity=system.gravity)
    found = inverse_dynamics(newton_euler(held), {x: t**2, y: 0, z: 0}, {m: 2, g: 9.81, I: 1}, [0, 1, 2])
    assert np.allclose(found.forces[x], 4)
    assert np.allclose(found.forces[z], 2 * 9.81)
    assert np.allclose(found[x], found.t**2)


@pytest.mark.parametrize("name", [*FIXED[:-1], *repeated(FIXED[-1:])])
def test_robots_as_pinocchio_and_mujoco_have_them(name):
    # At t = 0 the motion q + v t + a t^2/2 is in the state where they computed the forces.
    eqs = newton_euler(robot(name).system)
    n = len(eqs.coordinates)
    given = np.array(symbols(" ".join(f"{kind}{k}" for kind in "qva" for k in range(n)))).reshape(3, n)
    motion = {x: q + v * t + a * t**2 / 2 for x, q, v, a in zip(eqs.coordinates, *given, strict=True)}
    for state in robot(name).states[:4]:
        values = np.array(motion_at(state))
        found = inverse_dynamics(eqs, motion, dict(zip(given.ravel(), values.ravel(), strict=True)), 0.0)
        forces = np.array(list(found.forces.values()))[:, 0]
        assert np.allclose(forces, state["inverse_dynamics"], rtol=0, atol=1e-12 * np.abs(forces).max())


# --- closed loops -----------------------------------------------------------------------------------------------------


def closed_fourbar(qA, LN, LA, LB, LC):
    """The angles of B and C, by the law of cosines, in the assembly ahead."""
    gap = np.stack([-LA * np.cos(qA), LN - LA * np.sin(qA)])
    d, direction = np.hypot(*gap), np.arctan2(gap[1], gap[0])
    qB = direction - np.arccos((LB**2 + d**2 - LC**2) / (2 * LB * d))
    qC = np.arctan2(LB * np.sin(qB) - gap[1], LB * np.cos(qB) - gap[0])
    return np.stack([qA, qB, qC], axis=-1)


def virtual_work(place, q, u, a, m, I, force):
    """``M u' - Q`` of bodies in the plane, with Jacobians by complex steps; the force acts at the last place."""

    def jacobian(q):
        return np.array([np.imag(place(q + 1e-30j * e)) / 1e-30 for e in np.eye(len(q))]).transpose(1, 2, 0)

    J = jacobian(q)
    change = (jacobian(q + 1e-5 * u) - jacobian(q - 1e-5 * u)) / 2e-5
    accelerations = J @ a + change @ u
    inertia = sum(m_k * J_k.T @ a_k for m_k, J_k, a_k in zip(m, J, accelerations, strict=False))
    weight = sum(m_k * 9.81 * J_k[0] for m_k, J_k in zip(m, J, strict=False))
    return inertia + I * a - weight - J[-1].T @ force


def test_a_driven_fourbar_by_virtual_work():
    linkage = fourbar()
    lengths = LN, LA, LB, LC = 1.0, 0.6, 2.0, 2.0
    m = [linkage.parameters[linkage[name]] for name in ("mA", "mB", "mC")]
    instants = np.linspace(0, 3, 400)
    found = drive(linkage, {"qA": w * t / 2 + sin(t)}, instants, {"LA": LA}, guess={"qB": 1.2, "qC": 0.6})
    expected = closed_fourbar(7 / 2 * instants + np.sin(instants), *lengths)
    assert np.allclose(np.exp(1j * found.coordinates), np.exp(1j * expected), atol=1e-12)
    spline = make_interp_spline(found.t, np.unwrap(expected, axis=0), k=7)
    assert np.allclose(found.speeds, spline(found.t, 1), atol=1e-6)
    assert np.allclose(found.accelerations[5:-5], spline(found.t, 2)[5:-5], atol=1e-5)

    def arm(length, angle):
        return length * np.array([np.cos(angle), np.sin(angle)])

    def places(q):
        pin = np.array([0, LN]) + arm(LC, q[2])
        mean = [arm(LA / 2, q[0]), arm(LA, q[0]) + arm(LB / 2, q[1]), np.array([0, LN]) + arm(LC / 2, q[2])]
        return np.array([*mean, pin])

    def gap(q):
        return arm(LA, q[0]) + arm(LB, q[1]) - np.array([0, LN]) - arm(LC, q[2])

    I = np.array(m) * np.square(lengths[1:]) / 12
    push = np.array([0, linkage.parameters[linkage["H"]]])
    for k in range(0, 400, 37):
        q, u, a = found.coordinates[k], found.speeds[k], found.accelerations[k]
        needed = virtual_work(places, q, u, a, m, I, push)
        phi_q = np.array([np.imag(gap(q + 1e-30j * e)) / 1e-30 for e in np.eye(3)]).T
        torque, *multipliers = solve(np.column_stack([np.eye(3)[0], phi_q.T]), needed)
        assert np.isclose(found.forces[linkage["qA"]][k], torque, rtol=1e-7, atol=1e-6)
        assert np.allclose(found.multipliers[k], multipliers, rtol=1e-7, atol=1e-6)


def test_a_mechanism_passes_where_its_pins_meet():
    # With LN = LA and qA = pi/2 - 2 e, the ends of B and C are 2 sin(e) apart, along pi - e: smooth through zero.
    found = drive(fourbar(), {"qA": pi / 3 + t}, np.linspace(0, 1, 100), guess=AHEAD)
    e = (np.pi / 2 - found.coordinates[:, 0]) / 2
    expected = np.pi - e - np.arccos(np.sin(e) / 2)
    assert np.allclose(found.coordinates[:, 1], expected, atol=1e-9)
    assert e[0] > 0 > e[-1]


def test_few_instants_lead_through_the_same_assembly():
    fine = drive(slider_crank(), {"phi": w * t}, np.linspace(0, 2, 201), guess={"s": 0.4})
    coarse = drive(slider_crank(), {"phi": w * t}, [0, 0.7, 2], guess={"s": 0.4})
    assert np.allclose(coarse.coordinates, fine.coordinates[[0, 70, 200]], atol=1e-12)
    assert np.allclose(coarse.multipliers, fine.multipliers[[0, 70, 200]], atol=1e-9)


def test_coordinates_that_follow_by_kinematics_alone() -> None:
    """A skate by its one speed: y isn't prescribed, and follows from ``y' = x' tan(theta)`` with ``theta = w t``."""
    x, y, theta, u, m, w = *functions_of_time("x y theta u"), *symbols("m w")
    skate = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=1)
    kinematics = {time_derivative(x): u * cos(theta), time_derivative(y): u * sin(theta)}
    eqs = newton_euler(System([skate], (), [x, y, theta], speeds=[u], kinematics=kinematics))
    result = inverse_dynamics(eqs, {x: t, theta: w * t}, {m: 2.0, w: 0.5}, (0, 1))
    assert_allclose(result[y], -np.log(np.cos(0.5 * result.t)) / 0.5, atol=1e-11)
    assert_allclose(result[u], 1 / np.cos(0.5 * result.t), atol=1e-11)


def test_dependent_constraints_share_their_force():
    once, twice = pendulum_on_rail(), pendulum_on_rail(twice=True)
    motion, more = {"x": 0.5 * cos(t)}, {"guess": {"y": -1.0}}
    (one,), (first, second) = (drive(each, motion, [0, 1], **more).multipliers.T for each in (once, twice))
    assert np.allclose(second, 3 * first, rtol=1e-9)
    assert np.allclose(first + 3 * second, one, rtol=1e-9)


# --- there and back ---------------------------------------------------------------------------------------------------


def test_loads_of_a_simulated_mechanism_come_back():
    linkage = slider_crank()
    T, F, phi = linkage["T"], linkage["F"], linkage["phi"]
    values = {**linkage.parameters, T: 0.3, F: -0.5}
    motion = simulate(linkage.equations, values, {phi: 0.3}, (0, 0.5), rtol=1e-11, atol=1e-12)
    found = inverse_dynamics(linkage.equations, motion, unknowns=[T])
    assert np.allclose(found.forces[T], 0.3, atol=1e-10)
    assert np.allclose(found.multipliers, motion.multipliers, atol=1e-10)
    heavier = inverse_dynamics(linkage.equations, motion, {linkage["m3"]: 1.6}, unknowns=[F])
    assert np.allclose(heavier.forces[F] + 0.5, 0.8 * motion[time_derivative(linkage["s"], 2)], atol=1e-9)

    again = drive(
        linkage, {"phi": motion[phi]}, motion.t, {"F": -0.5}, unknowns=["T"], guess={"beta": 0.1, "s": 0.4}
    )
    assert np.allclose(again[linkage["s"]], motion[linkage["s"]], atol=1e-9)
    assert np.allclose(again.forces[T][5:-5], 0.3, atol=1e-5)


def test_the_motor_of_andrews_mechanism_comes_back():
    # Seven bodies in three loops; the published motor has 0.033 N m.
    problem = andrews()
    (motor,) = (name for name in problem.equations.parameters if name.name == "mom")
    beta = problem.equations.coordinates[0]
    motion = simulate(problem.equations, problem.parameters, problem.initial, np.linspace(0, 0.03, 301))
    found = inverse_dynamics(problem.equations, motion, unknowns=[motor])
    assert np.allclose(found.forces[motor], 0.033, rtol=1e-9)
    near = {name: value for name, value in problem.initial.items() if name in problem.equations.coordinates}
    driven = {beta: motion[beta]}
    again = inverse_dynamics(problem.equations, driven, problem.parameters, motion.t, guess=near)
    assert np.allclose(again.coordinates, motion.states[:, :7], atol=1e-12)
    assert np.allclose(again.forces[beta][5:-5], 0, atol=0.033 * 1e-2)


def test_loads_of_a_floating_body_come_back():
    # The ball joint's forces are the multipliers; nothing more acts along the speeds.
    linkage = hanging_box()
    start = {linkage["e1"]: 0.3, linkage["phi"]: 0.0}
    values = {**linkage.parameters, linkage["T"]: 0.1}
    motion = simulate(linkage.equations, values, start, (0, 1), guess={linkage["z"]: -0.5})
    found = inverse_dynamics(linkage.equations, motion, unknowns=[linkage["T"]])
    assert np.allclose(found.forces[linkage["T"]], 0.1, atol=1e-12)
    assert np.allclose(found.multipliers, motion.multipliers, atol=1e-10)
    height = found[time_derivative(linkage["z"])]
    spline = make_interp_spline(motion.t, motion[linkage["z"]], k=7)
    assert np.allclose(height[5:-5], spline(motion.t, 1)[5:-5], atol=1e-8)


def test_a_simulated_motion_takes_its_loads_along_with_it():
    linkage = double_pendulum(driven=True)
    T1, T2, q1 = linkage["T1"], linkage["T2"], linkage["theta1"]
    torques = {T1: 3 * sin(t), T2: -2 * q1}
    motion = simulate(linkage.equations, linkage.parameters, {q1: 0.5}, (0, 2), inputs=torques)
    rest = inverse_dynamics(linkage.equations, motion)
    assert np.allclose(list(rest.forces.values()), 0, atol=1e-10)
    assert np.allclose(rest[T2], -2 * motion[q1], atol=1e-12)
    bare = inverse_dynamics(linkage.equations, motion, inputs={T1: 0, T2: 0})
    assert np.allclose(bare.forces[q1], motion[T1 - T2], atol=1e-10)
    found = inverse_dynamics(linkage.equations, motion, unknowns=[T2])
    assert np.allclose(found.forces[T2], -2 * motion[q1], atol=1e-10)


def test_what_was_found_makes_the_motion():
    # The torques at Chebyshev points become polynomials of time, which drive the arm from its first state.
    linkage, end, degree = double_pendulum(driven=True), 2.0, 40
    T1, T2, q1, q2 = (linkage[name] for name in ("T1", "T2", "theta1", "theta2"))
    motion = {q1: sin(2 * t), q2: 1 + cos(t) / 2}
    points = end / 2 * (1 - np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1)))
    found = inverse_dynamics(linkage.equations, motion, linkage.parameters, points, unknowns=[T1, T2])
    torques = {name: series(points, values, end) for name, values in found.forces.items()}
    start = {q1: 0, q2: 1.5, time_derivative(q1): 2, time_derivative(q2): 0}
    moved = simulate(
        linkage.equations, linkage.parameters, start, (0, end), inputs=torques, rtol=1e-11, atol=1e-12
    )
    assert np.allclose(moved[q1], np.sin(2 * moved.t), atol=1e-9)
    assert np.allclose(moved[q2], 1 + np.cos(moved.t) / 2, atol=1e-9)


def series(points, values, end):
    """The Chebyshev series through values, as an expression of time, by Clenshaw's recursion."""
    x, after, last = 2 * t / end - 1, 0, 0
    coefficients = np.polynomial.chebyshev.chebfit(2 * points / end - 1, values, len(points) - 1)
    for c in coefficients[:0:-1]:
        after, last = float(c) + 2 * x * after - last, after
    return float(coefficients[0]) + x * after - last


def test_samples_do_what_their_formula_does():
    instants = np.linspace(0, 2, 201)
    formula = drive(fourbar(), {"qA": 0.35 + sin(t)}, instants, guess=AHEAD)
    samples = drive(fourbar(), {"qA": 0.35 + np.sin(instants)}, instants, guess=AHEAD)
    (one,), (two,) = formula.forces.values(), samples.forces.values()
    assert np.allclose(one[5:-5], two[5:-5], rtol=1e-5)
    assert not np.array_equal(one, two)


def test_what_was_found_can_be_seen(tmp_path):
    linkage = slider_crank()
    found = drive(linkage, {"phi": w * t}, np.linspace(0, 1, 20), unknowns=["T"], guess={"s": 0.4})
    figure = plot(found, linkage["T"])
    curve = figure.axes[0].get_lines()[0]
    assert np.allclose(curve.get_ydata(), found.forces[linkage["T"]])
    assert animate(found, tmp_path / "crank.html").stat().st_size > 1000
    assert repr(found) == "InverseDynamics of T: 20 instants from 0 to 1 s"


# --- what can't be ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "motion", "more", "error", "message"),
    [
        (
            slider_crank,
            {"s": 0.3 + t / 10},
            {"guess": {"phi": 1.2, "beta": 0.3}},
            ConstraintError,
            (
                r": the constraints don't allow the prescribed motion beyond t = (1|0\.99\d*) s, where phi = .*; it "
                "may be a dead centre, or beyond reach: prescribe another motion"
            ),
        ),
        (
            fourbar,
            {"qA": t, "qB": 0.5 + t},
            {},
            ConstraintError,
            ": no coordinates were found with qA = 0, qB = 0.5 that satisfy the constraints at t = 0 s",
        ),
        (
            double_pendulum,
            {"theta1": sin(t)},
            {},
            SimulationError,
            (
                ": at t = 0 s the speed theta2' isn't determined by the constraints and the prescribed theta1; "
                "prescribe as many coordinates as the system has degrees of freedom"
            ),
        ),
        (
            slider_crank,
            {"phi": 0.3 + t / 10},
            {"unknowns": ["T", "F"], "guess": {"s": 0.4}},
            SimulationError,
            (
                ": at t = 0 s T, F are not determined: other values cause the same motion; give as many "
                r"unknowns=\[...\] as the motion has degrees of freedom, and none that is at a dead centre"
            ),
        ),
        (
            slider_crank,
            {"phi": w * t},
            {"unknowns": ["F"], "guess": {"s": 0.4}},
            SimulationError,
            ": at t = 0 s F is not determined",
        ),
        (
            double_pendulum,
            {"theta1": sin(t), "theta2": cos(t)},
            {"unknowns": ["T2"]},
            SimulationError,
            (
                ": at t = 0 s no T2 balance the equation of motion of theta2: .* is left; expected loads that act on "
                "every degree of freedom of the motion"
            ),
        ),
        (
            slider_crank,
            {"phi": t},
            {"unknowns": ["r"], "guess": {"s": 0.4}},
            ModelError,
            ", unknowns: r occurs in the prescribed motion, the constraints or the kinematics; expected",
        ),
        (
            double_pendulum,
            {"theta1": w * t, "theta2": cos(t)},
            {"unknowns": ["theta1"]},
            ModelError,
            (
                ", unknowns: theta1 isn't in the equations of motion; expected symbols or functions of time in the "
                "loads: T1, T2, g, l1, l2, m1, m2"
            ),
        ),
        (
            double_pendulum,
            {"theta1": sin(t), "theta2": cos(t)},
            {"unknowns": ["l1"]},
            ModelError,
            ", unknowns: the equations of motion aren't linear in l1; expected loads in which they ",
        ),
        (
            double_pendulum,
            {"theta1": log(t), "theta2": 0},
            {},
            SimulationError,
            ", motion: theta1, or a rate of it, isn't finite at t = 0 s; prescribe a motion",
        ),
        (
            double_pendulum,
            {"theta1": [0, 1, 2, 3, 4], "theta2": 0},
            {},
            SimulationError,
            r", motion: theta1 has samples of shape \(5,\); expected one for each of the 11 instants",
        ),
        (
            double_pendulum,
            {"theta1": sin(t), "g": 0},
            {},
            ParameterError,
            ", motion: g is not a coordinate of this system; expected one of theta1, theta2",
        ),
        (
            double_pendulum,
            {},
            {},
            ArgumentError,
            r", motion: \{\} is a dict; expected \{coordinate: expression of time\}, or a simulated motion",
        ),
    ],
)
def test_what_cannot_be_is_told(make, motion, more, error, message):
    with pytest.raises(error, match=f"inverse_dynamics{message}"):
        drive(make(), motion, np.linspace(0, 4, 11), **more)


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        ({"phi": t, "s": 0.4 + t}, "no speeds satisfy constraint 1, .* = 0, together with the other"),
        (
            {"phi": t, "s": 0.4 + t**3},
            "no accelerations satisfy constraint 1, .* = 0, together with the other",
        ),
    ],
)
def test_rates_that_contradict_the_constraints_are_told(motion, message):
    with pytest.raises(ConstraintError, match=f"inverse_dynamics: at t = 0 s {message}"):
        drive(slider_crank(), motion, 0.0)


def test_mistakes_are_told():
    m, F, x, y, f = *symbols("m F"), *functions_of_time("x y f")
    body = Body(translate(x, 0, 0), m)
    at = {"at": body.center_of_mass, "on": body}
    eqs = newton_euler(System([body], [Force(ground, f + F * time_derivative(f), 0, 0, **at)], [x]))
    values, instants, follow = {m: 1, F: 0}, [0, 1, 2], {x: t}
    with pytest.raises(
        ModelError, match="unknowns: the equations of motion contain the rate f'; expected loads"
    ):
        inverse_dynamics(eqs, follow, values, instants, unknowns=[f])
    with pytest.raises(
        ModelError, match="inverse_dynamics: the equations contain the functions of time f, which"
    ):
        inverse_dynamics(eqs, follow, values, instants)
    given = {"inputs": {f: 2 * t}}
    with pytest.raises(ParameterError, match="inverse_dynamics: no value for m; give parameters="):
        inverse_dynamics(eqs, follow, {F: 0}, instants, **given)
    with pytest.raises(
        ModelError, match="motion: x is prescribed by f; expected an expression of the time t"
    ):
        inverse_dynamics(eqs, {x: f}, values, instants, **given)
    for wrong in (None, "now", [0, 0, 1], [], [[0, 1]], np.nan):
        with pytest.raises(SimulationError, match=r"inverse_dynamics: t=.*; expected the first and the last"):
            inverse_dynamics(eqs, follow, values, wrong, **given)
    with pytest.raises(ArgumentError, match="inverse_dynamics, motion: 3 is an int; expected"):
        inverse_dynamics(eqs, 3, values, instants, **given)
    with pytest.raises(ArgumentError, match="inverse_dynamics, unknowns: f is an Expr; expected a list of"):
        inverse_dynamics(eqs, follow, values, instants, unknowns=f)
    with pytest.raises(
        ArgumentError, match="inverse_dynamics, parameters: 3 is an int; expected a dictionary"
    ):
        inverse_dynamics(eqs, follow, 3, instants, **given)
    with pytest.raises(SimulationError, match="motion: x has 3 samples; expected at least six finite ones"):
        inverse_dynamics(eqs, {x: [0, 1, 2]}, values, instants, **given)
    found = inverse_dynamics(eqs, follow, values | {F: 3}, instants, **given)
    assert np.allclose(found.forces[x], [-6, -8, -10])
    assert np.allclose(found[f + time_derivative(f)], [2, 4, 6])
    with pytest.raises(
        SimulationError, match="inverse_dynamics: no values of y; this motion has values of time, the"
    ):
        found[y + x]


def test_a_simulated_motion_brings_its_own():
    linkage = pendulum_on_rail()
    start = {linkage["x"]: 0.5}
    motion = simulate(linkage.equations, linkage.parameters, start, (0, 1), guess={linkage["y"]: -1})
    with pytest.raises(
        ArgumentError, match="inverse_dynamics: t, and a simulated motion, which has its own; leave"
    ):
        inverse_dynamics(linkage.equations, motion, t=[0, 1])
    with pytest.raises(
        ConstraintError, match=r"parameters: l = 3 is in the constraints .* has l = 2; simulate"
    ):
        inverse_dynamics(linkage.equations, motion, {linkage["l"]: 3})
    with pytest.raises(SimulationError, match="the forces along x, y are not determined: other values cause"):
        inverse_dynamics(linkage.equations, motion)
    other = double_pendulum()
    with pytest.raises(SimulationError, match=r"motion: no values of theta1"):
        inverse_dynamics(other.equations, motion, other.parameters)


def test_a_force_at_a_distance_of_zero():
    k, m, x = *symbols("k m"), functions_of_time("x")
    body = Body(translate(x, 0, 0), m)
    eqs = newton_euler(System([body], [Force(ground, k / x, 0, 0, at=body.center_of_mass, on=body)], [x]))
    with pytest.raises(
        SimulationError, match="at t = 1 s the equation of motion of x isn't finite; a function"
    ):
        inverse_dynamics(eqs, {x: t - 1}, {m: 1, k: 1}, [0, 1, 2])


def test_multipliers_along_a_motion_of_embedded_equations():
    """They are those of the equations that were embedded; where loads have to help, a message says so."""
    linkage = slider_crank()
    values = {**linkage.parameters, linkage["T"]: 0.3, linkage["F"]: -0.5}
    whole, short = (
        simulate(eqs, values, {linkage["phi"]: 0.3}, (0, 0.2), rtol=1e-11, atol=1e-12)
        for eqs in (linkage.equations, embedded(linkage.equations))
    )
    multiplier = linkage.equations.multipliers[0]
    with pytest.raises(
        SimulationError, match=r"constraints were eliminated: simulate the equations with multipl"
    ):
        short[multiplier]
    found = inverse_dynamics(linkage.equations, short, unknowns=[])
    assert np.allclose(found[multiplier], whole[multiplier], rtol=1e-7, atol=1e-9)
    assert repr(found) == "InverseDynamics of multipliers: 1001 instants from 0 to 0.2 s"
    with pytest.raises(SimulationError, match="no multipliers alone balance the equation of motion of"):
        inverse_dynamics(linkage.equations, short, values | {linkage["T"]: 0.4}, unknowns=[])
