"""Reaction forces along motions: multipliers, and what bodies need beyond their loads, against closed forms."""

import numpy as np
from scipy.interpolate import make_interp_spline

from symbody import (
    Body,
    Event,
    System,
    Vector,
    euler_equations,
    functions_of_time,
    ground,
    inverse_dynamics,
    lagrange_equations,
    newton_equations,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from tests.simulation.linkages import double_pendulum, hanging_box, slider_crank

m, l, g = symbols("m l g")
values = {m: 1.3, l: 0.8, g: 9.81}
weight = Vector(ground, 0, 0, g)


def in_natural_coordinates():
    """A bob at (x, z), z down, on a rod; the tension of the rod by its multiplier: the force is lambda phi_q."""
    x, z = functions_of_time("x z")
    system = System([Body(translate(x, 0, z), m)], (), [x, z], [x**2 + z**2 - l**2], weight)
    return lagrange_equations(system), x, z, -2 * l * system.multipliers[0]


def in_an_angle():
    """The same by the angle; the tension by what Newton's equation of the bob leaves."""
    theta = functions_of_time("theta")
    rod = rotate("Y", theta)
    bob = Body(rod * translate(0, 0, l), m)
    eqs = newton_euler(System([bob], (), [theta], gravity=weight))
    return eqs, theta, -project(newton_equations(bob, gravity=weight), rod).components[2]


def test_the_tension_of_a_pendulum_that_is_let_go():
    # m g cos + m l w^2 is, by the energy, m g (3 cos(theta) - 2 cos(theta0)).
    start = 1.2
    eqs, x, z, tension = in_natural_coordinates()
    place = {x: 0.8 * np.sin(start), z: 0.8 * np.cos(start)}
    exact = {"rtol": 1e-11, "atol": 1e-12}
    motion = simulate(eqs, values, place, (0, 3), outputs={"tension": tension}, **exact)
    cosine = motion[z] / 0.8
    expected = 1.3 * 9.81 * (3 * cosine - 2 * np.cos(start))
    assert np.allclose(motion.outputs["tension"], expected, rtol=1e-9)
    assert np.array_equal(motion[tension], motion.outputs["tension"])
    assert np.allclose(motion.multipliers[:, 0], -expected / 1.6, rtol=1e-9)
    runs = simulate_many(eqs, values, place, t=(0, 3), outputs={"tension": tension}, **exact)
    assert np.allclose(runs.outputs["tension"][0], expected, rtol=1e-9)

    eqs, theta, tension = in_an_angle()
    motion = simulate(eqs, values, {theta: start}, (0, 3), **exact)
    assert np.allclose(
        motion[tension], 1.3 * 9.81 * (3 * np.cos(motion[theta]) - 2 * np.cos(start)), rtol=1e-9
    )


def test_the_tension_of_a_pendulum_that_is_driven():
    eqs, theta, tension = in_an_angle()
    found = inverse_dynamics(eqs, {theta: sin(3 * t)}, values, [0, 2])
    angle, turning = np.sin(3 * found.t), 3 * np.cos(3 * found.t)
    expected = 1.3 * 9.81 * np.cos(angle) + 1.3 * 0.8 * turning**2
    assert np.allclose(found[tension], expected, rtol=1e-13)

    eqs, x, z, tension = in_natural_coordinates()
    found = inverse_dynamics(eqs, {x: l * sin(sin(3 * t))}, values, [0, 2], guess={z: 0.8})
    # The force along x makes the torque as well, and part of what the rod would pull.
    across = 1.3 * 0.8 * -9 * angle + 1.3 * 9.81 * np.sin(angle)
    assert np.allclose(found.forces[x] * np.cos(angle), across, atol=1e-9)
    assert np.allclose(found[tension], expected + across * np.tan(angle), rtol=1e-9)


def test_a_string_goes_slack():
    # With the speed v at the bottom, where cos(theta) = (2 g l - v^2)/(3 g l).
    eqs, x, z, tension = in_natural_coordinates()
    speed = np.sqrt(3.5 * 9.81 * 0.8)
    slack = Event(tension, direction=-1, terminal=True, name="slack")
    motion = simulate(
        eqs, values, {x: 0, z: 0.8, time_derivative(x): speed}, (0, 3), events=[slack], rtol=1e-11, atol=1e-12
    )
    (end,) = motion.events
    assert np.isclose(end.state[z] / 0.8, -0.5, rtol=1e-8)


def test_hinges_of_a_double_pendulum():
    # Forces against m (a - g) of positions by splines; the moment about the elbow is the torque there.
    linkage = double_pendulum(driven=True)
    q1, q2, T1, T2 = (linkage[name] for name in ("theta1", "theta2", "T1", "T2"))
    upper, lower = linkage.equations.system.bodies
    gravity = linkage.equations.system.gravity
    torques = {T1: 2 * sin(5 * t), T2: -0.4 * time_derivative(q2)}
    motion = simulate(
        linkage.equations, linkage.parameters, {q1: 0.9}, (0, 2), inputs=torques, rtol=1e-11, atol=1e-12
    )
    angles = motion.states[:, :2]
    first = 1.1 * np.stack([np.sin(angles[:, 0]), np.cos(angles[:, 0])])
    second = first + 0.6 * np.stack([np.sin(angles[:, 1]), np.cos(angles[:, 1])])
    up = np.array([[0], [-9.81]])
    a1, a2 = (make_interp_spline(motion.t, place, k=7, axis=1)(motion.t, 2) for place in (first, second))
    elbow = 0.7 * (a2 + up)
    pivot = elbow + 1.5 * (a1 + up)
    for bodies, expected in (([lower], elbow), ([upper, lower], pivot)):
        x, _, z = newton_equations(bodies, gravity=gravity).components
        assert np.allclose(motion.evaluate([x, z])[:, 9:-9], expected[:, 9:-9], atol=1e-5)
    moment = euler_equations([lower], upper.center_of_mass, gravity=gravity).components[1]
    assert np.allclose(motion[moment], -0.4 * motion[time_derivative(q2)], atol=1e-9)
    assert np.allclose(
        inverse_dynamics(linkage.equations, motion, unknowns=[T1, T2])[moment], motion[T2], atol=1e-9
    )


def test_the_bearings_of_an_unbalanced_rotor():
    # Around a fixed axis: m e (-w^2, w'), and the moments (Cyz w^2 - Cxz w', -Cxz w^2 - Cyz w') in the rotor's axes.
    Iz, Cyz, Cxz, e = symbols("Iz Cyz Cxz e")
    phi = functions_of_time("phi")
    shaft = rotate("Z", phi)
    rotor = Body(shaft * translate(e, 0, 0), m, 0.15, 0.12, Iz, Cyz, Cxz)
    eqs = newton_euler(System([rotor], (), [phi]))
    numbers = {m: 3.0, Iz: 0.2, Cyz: 0.01, Cxz: -0.03, e: 0.002}
    found = inverse_dynamics(eqs, {phi: 20 * t**2}, numbers, np.linspace(0, 4, 9))
    force, moment = newton_equations(rotor, shaft), euler_equations(rotor, frame=shaft)
    w, alpha = 40 * found.t, 40.0
    values = found.evaluate([*force.components, *moment.components])
    expected = [
        -3 * 0.002 * w**2,
        3 * 0.002 * alpha + 0 * w,
        0 * w,
        0.01 * w**2 + 0.03 * alpha,
        0.03 * w**2 - 0.01 * alpha,
        0.2 * alpha + 0 * w,
    ]
    assert np.allclose(values, expected, rtol=1e-13, atol=1e-13)
    assert np.allclose(found.forces[phi], (0.2 + 3 * 0.002**2) * alpha, rtol=1e-13)


def test_the_pin_of_a_slider_is_a_multiplier():
    # What accelerates the slider beside the push: the opposite of the multiplier of the gap along x.
    linkage = slider_crank()
    s, F = linkage["s"], linkage["F"]
    motion = simulate(
        linkage.equations,
        {**linkage.parameters, F: -5.0},
        {linkage["phi"]: 0.4},
        (0, 0.4),
        rtol=1e-11,
        atol=1e-12,
    )
    slider = linkage.equations.system.bodies[2]
    needed = newton_equations([slider, linkage.equations.system.loads[1]]).components[0]
    assert np.allclose(motion[needed], -motion.multipliers[:, 0], atol=1e-10)
    a = make_interp_spline(motion.t, motion[s], k=7)(motion.t, 2)
    assert np.allclose((0.8 * a + 5)[9:-9], -motion.multipliers[9:-9, 0], atol=1e-4)


def test_a_ball_joint_holds_a_floating_body():
    # Its force is m (a - g) of the centre of mass, by the positions; the multipliers of the gap are its components.
    linkage = hanging_box()
    system, (x, y, z) = linkage.equations.system, (linkage[name] for name in "xyz")
    start = {linkage["e1"]: 0.3, linkage["phi"]: 0.0}
    motion = simulate(
        linkage.equations, linkage.parameters, start, guess={z: -0.5}, t=(0, 1), rtol=1e-11, atol=1e-12
    )
    force = newton_equations(system.bodies, ground, gravity=system.gravity).components
    place = make_interp_spline(motion.t, motion.evaluate([x, y, z]), k=7, axis=1)
    expected = 2.0 * (place(motion.t, 2) + np.array([[0], [0], [9.81]]))
    assert np.allclose(motion.evaluate(force)[:, 9:-9], expected[:, 9:-9], atol=1e-5)
    assert np.allclose(motion.evaluate(force), motion.multipliers.T, atol=1e-10)
