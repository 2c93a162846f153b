"""Reactions of joints and of bodies that are cut off, against closed forms; in symbols and along motions."""

import numpy as np
import pytest

from symbody import (
    Body,
    Constraint,
    Force,
    Link,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    assemble,
    cos,
    equilibrium,
    fixed,
    free,
    functions_of_time,
    gear,
    ground,
    inverse_dynamics,
    newton_equations,
    newton_euler,
    prismatic,
    project,
    rack,
    reaction,
    revolute,
    rolling,
    screw,
    simulate,
    simulate_many,
    sin,
    spherical,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import SimulationError

m, l, g, a, b, h, r, I, J, T, F = symbols("m l g a b h r I J T F")
phi, q = functions_of_time("phi q")
weight = Vector(ground, 0, -g, 0)
values = {m: 1.3, l: 0.8, g: 9.81}


def pendulum(**options: object):
    bob = Link("bob", m, Iz=I, center=(0, -l, 0))
    pin = revolute("A", ground, bob, coordinate=phi)
    mechanism = assemble([pin])
    return mechanism, pin, newton_euler(mechanism.system(gravity=weight, **options))


def test_the_pin_of_a_pendulum_in_either_bodys_axes():
    mechanism, pin, equations = pendulum()
    rate, acceleration = time_derivative(phi), time_derivative(phi, 2)
    along = reaction(equations, pin, frame=mechanism.frame("bob"))
    assert along.force.components == (
        m * (l * acceleration + g * sin(phi)),
        m * (l * rate**2 + g * cos(phi)),
        0,
    )
    assert along.moment.components == (0, 0, 0)
    on_ground = reaction(equations, "A", on=ground)
    assert on_ground.force.components == tuple(-c for c in project(along.force, ground).components)
    assert (on_ground.on, along.on) == ("ground", "bob")
    assert str(along.at) == "A"
    assert repr(reaction(equations, pin)).startswith("Reaction(on bob: force ")


def test_along_motions_batches_and_drives():
    """The tension of a pendulum that is let go: m g (3 cos(phi) - 2 cos(phi0)), for a mass in a point."""
    mechanism, pin, equations = pendulum()
    pull = reaction(equations, pin, frame=mechanism.frame("bob")).force.components[1]
    exact = {"rtol": 1e-11, "atol": 1e-12}
    motion = simulate(equations, values | {I: 0.0}, {phi: 1.2}, (0, 3), outputs={"pull": pull}, **exact)
    expected = 1.3 * 9.81 * (3 * np.cos(motion[phi]) - 2 * np.cos(1.2))
    np.testing.assert_allclose(motion[pull], expected, rtol=1e-9)
    np.testing.assert_allclose(motion.outputs["pull"], expected, rtol=1e-9)
    runs = simulate_many(
        equations, values | {I: 0.0}, {phi: [1.2]}, t=(0, 3), outputs={"pull": pull}, **exact
    )
    np.testing.assert_allclose(runs.outputs["pull"][0], expected, rtol=1e-9)
    driven = inverse_dynamics(equations, {phi: sin(3 * t)}, values | {I: 0.1}, [0, 2])
    angle, rate = np.sin(3 * driven.t), 3 * np.cos(3 * driven.t)
    np.testing.assert_allclose(driven[pull], 1.3 * (9.81 * np.cos(angle) + 0.8 * rate**2), rtol=1e-12)


def test_a_cantilever_that_is_lifted():
    """The force and the moment at a cut at a distance x from the tip, of a beam that is accelerated upwards."""
    rho, x, lift = symbols("rho x lift")
    z = functions_of_time("z")
    left, right = Link("left", rho * (l - x)), Link("right", rho * x, center=(x / 2, 0, 0))
    joints = [
        prismatic("lift", ground, left, axis="Y", coordinate=z),
        fixed("cut", left, right, at=(l - x, 0, 0)),
    ]
    mechanism = assemble(joints)
    push = Force(ground, 0, lift, 0, at=Point(mechanism.frame(left), 0, 0, 0), on=mechanism.body(left))
    equations = newton_euler(mechanism.system([push], gravity=weight))
    cut = reaction(equations, "cut")
    up = g + time_derivative(z, 2)
    assert cut.force.components == (0, rho * x * up, 0)
    assert cut.moment.components == (0, 0, rho * x**2 / 2 * up)
    root = reaction(equations, "lift", about=Point(ground, 0, z, 0))
    assert root.force.components == (0, 0, 0)  # along the freedom, the lift is a load
    assert root.moment.components[2] == rho * up * x * (l - x / 2)
    part = reaction(equations, ["right"], about=cut.at)
    assert (part.force.components, part.moment.components) == (cut.force.components, cut.moment.components)
    whole = reaction(equations, mechanism.bodies)
    assert whole.force.components[1] == rho * l * up - lift


def test_a_motor_is_no_reaction_and_a_drive_is_one():
    """A load across the joint is subtracted; a constraint that moves the coordinate acts in the joint."""
    mechanism, pin, _ = pendulum()
    motor = Torque(ground, 0, 0, T, on=mechanism.body("bob"))
    moved = newton_euler(mechanism.system([motor], gravity=weight))
    assert reaction(moved, pin).moment.components == (0, 0, 0)
    held = newton_euler(
        mechanism.system(gravity=weight, constraints=[Constraint(phi - 3 * t, name="drive", multiplier=q)])
    )
    torque = reaction(held, pin).moment.components[2]
    assert torque == (I + m * l**2) * time_derivative(phi, 2) + m * g * l * sin(phi)
    motion = simulate(held, values | {I: 0.1}, {}, t=(0, 1))
    np.testing.assert_allclose(motion[torque], 1.3 * 9.81 * 0.8 * np.sin(3 * motion.t), atol=1e-9)
    np.testing.assert_allclose(motion[torque], motion[held.multipliers[0]], atol=1e-9)


def test_a_nut_turns_its_thread():
    """A nut that falls on its thread: the force along the axis times the pitch is the moment that turns it."""
    nut = Link("nut", m, Iz=I)
    thread = screw("S", ground, nut, pitch=h, coordinate=phi)
    equations = newton_euler(assemble([thread]).system(gravity=Vector(ground, 0, 0, -g)))
    found = reaction(equations, thread)
    force, moment = found.force.components[2], found.moment.components[2]
    assert force == m * (g + h * time_derivative(phi, 2))
    assert moment == -h * force


def test_the_force_of_gears():
    """A torque on a pinion, and a wheel that it accelerates: the force at the pitch point is J q''/b.

    The place of the wheel is h above that of the pinion, in whose plane the teeth touch.
    """
    A = revolute("A", ground, Link("pinion", Iz=I), coordinate=phi)
    B = revolute("B", ground, Link("wheel", Iz=J), at=(a + b, 0, h), coordinate=q)
    G = gear("G", A, B, a, b)
    mechanism = assemble([A, B, G])
    drive = Torque(ground, 0, 0, T, on=mechanism.body("pinion"))
    equations = newton_euler(mechanism.system([drive]))
    numbers = {I: 0.2, J: 0.5, a: 0.1, b: 0.3, h: 0.2, T: 4.0}
    motion = simulate(equations, numbers, {}, t=(0, 1))
    alpha = 4.0 / (0.2 + 0.5 / 9)  # of the pinion: I + J (a/b)^2
    tooth = motion.evaluate(reaction(equations, G, frame=ground).force.components)[:, 0]
    np.testing.assert_allclose(tooth, [0, 0.5 * alpha / 3 / 0.3, 0], rtol=1e-9)
    bearing = motion.evaluate(reaction(equations, B).force.components)[:, 0]
    np.testing.assert_allclose(bearing, -tooth, rtol=1e-9)
    moment = motion.evaluate(reaction(equations, B).moment.components)[:, 0]
    euler = moment + np.cross([-0.3, 0, -0.2], tooth)
    np.testing.assert_allclose(euler, [0, 0, -0.5 * alpha / 3], rtol=1e-9, atol=1e-12)
    assert reaction(equations, A).moment.components == (0, 0, 0)


@pytest.mark.parametrize("drive", [F * t**2, sin(F * t), F * t + F * t**2], ids=str)
def test_the_force_of_driven_gears_and_racks(drive):
    """A wheel that is driven by any expression of time drives a wheel and a bar: J q'' = b f, m s'' = f."""
    pinion = revolute("A", ground, Link("pinion", Iz=I), coordinate=drive)
    wheel = revolute("B", ground, Link("wheel", Iz=J), at=(a + b, 0, 0))
    bar = prismatic("C", ground, Link("bar", m), at=(0, -a, 0))
    mesh, teeth = gear("G", pinion, wheel, a, b), rack("R", pinion, bar, a)
    equations = newton_euler(assemble([pinion, wheel, bar, mesh, teeth]).system())
    alpha = time_derivative(drive, 2)
    on_wheel, on_bar = (reaction(equations, each, frame=ground).force.components for each in (mesh, teeth))
    moment = reaction(equations, pinion).moment.components[2]
    numbers = {I: 0.2, J: 0.5, m: 1.3, a: 0.1, b: 0.3, F: 2.0}
    motion = simulate(equations, numbers, {}, t=(0, 1))
    told = [on_wheel[1], on_bar[0], moment]
    expected = [J * a / b**2 * alpha, m * a * alpha, (I + J * (a / b) ** 2 + m * a**2) * alpha]
    found, wanted = motion.evaluate(told), motion.evaluate([subs(each, numbers) for each in expected])
    np.testing.assert_allclose(found, wanted, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("driven", ["sun", "planet", "carrier"])
def test_one_wheel_of_a_planetary_train_is_driven(driven):
    """Euler's equations of the wheels, whose teeth have one force, and of the whole train about its axis."""
    given = dict.fromkeys(("sun", "planet", "carrier"))
    given[driven] = sin(F * t)
    C = revolute("C", ground, Link("carrier", m, Iz=I), coordinate=given["carrier"])
    S = revolute("S", C.child, Link("sun", m, Iz=I), coordinate=given["sun"])
    P = revolute("P", C.child, Link("planet", m, Iz=J), at=(a + b, 0, 0), coordinate=given["planet"])
    mesh = gear("G", S, P, a, b)
    mechanism = assemble([C, S, P, mesh])
    twisting = Torque(ground, 0, 0, T, on=mechanism.body("sun"))
    equations = newton_euler(mechanism.system([twisting]))
    numbers = {I: 0.2, J: 0.5, m: 1.3, a: 0.1, b: 0.3, F: 2.0, T: 4.0}
    motion = simulate(equations, numbers, {}, t=(0, 1), rtol=1e-9, atol=1e-11)
    turned = [mechanism.joint(joint).freedom().value for joint in (C, S, P)]
    carried, sun, planet = (motion.evaluate([time_derivative(each, 2)])[0] for each in turned)
    drives = [motion.evaluate([reaction(equations, each).moment.components[2]])[0] for each in (C, S, P)]
    tooth = motion.evaluate(reaction(equations, mesh, frame=mechanism.frame("carrier")).force.components)[1]
    np.testing.assert_allclose(0.2 * (carried + sun), 4 + drives[1] - 0.1 * tooth, atol=1e-6)
    np.testing.assert_allclose(0.5 * (carried + planet), drives[2] - 0.3 * tooth, atol=1e-6)
    whole = 0.2 * (2 * carried + sun) + 0.5 * (carried + planet) + 1.3 * 0.4**2 * carried
    np.testing.assert_allclose(whole, 4 + drives[0], atol=1e-6)


def test_a_disc_needs_grip():
    """A disc on an incline: the friction is m g sin(alpha)/3, the normal force m g cos(alpha)."""
    alpha = symbols("alpha")
    disc = Link("disc", m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    wheel = rolling("K", ground, disc, radius=r)
    down = Vector(ground, g * sin(alpha), 0, -g * cos(alpha))
    equations = newton_euler(assemble([wheel]).system(gravity=down))
    found = reaction(equations, wheel)
    numbers = {m: 2.0, r: 0.3, g: 9.81, alpha: 0.2}
    motion = simulate(equations, numbers, {}, t=(0, 1))
    force = motion.evaluate(found.force.components)[:, -1]
    expected = 2 * 9.81 * np.array([-np.sin(0.2) / 3, 0, np.cos(0.2)])
    np.testing.assert_allclose(force, expected, atol=1e-9)
    at_contact = found.about(Point(ground, wheel.coordinates[0], wheel.coordinates[1], 0))
    np.testing.assert_allclose(motion.evaluate(at_contact.moment.components), 0, atol=1e-9)


def test_a_tree_that_is_built_towards_the_ground():
    """The parent beyond the child: the reaction on the child has the opposite sign of what is cut off."""
    bob = Link("bob", m, center=(0, -l, 0))
    pin = revolute("A", bob, ground, coordinate=phi)
    mechanism = assemble([pin])
    equations = newton_euler(mechanism.system(gravity=weight))
    on_bob = reaction(equations, pin, on=bob, frame=ground).force
    whole = newton_equations(mechanism.body(bob), gravity=weight)
    assert on_bob.components == whole.components
    assert reaction(equations, pin, frame=ground).force.components == (-whole).components


def test_bodies_of_any_system_can_be_cut_off():
    x, y = functions_of_time("x y")
    bead = Body(translate(x, y, 0), m, name="bead")
    wire = System([bead], coordinates=[x, y], constraints=[x**2 + y**2 - l**2], gravity=weight)
    equations = newton_euler(wire)
    motion = simulate(equations, values, {x: 0.8, y: 0.0}, t=(0, 1), rtol=1e-10)
    found = reaction(equations, bead)
    (multiplier,) = equations.multipliers
    np.testing.assert_allclose(
        motion.evaluate(found.force.components[:2]),
        motion.evaluate([2 * x * multiplier, 2 * y * multiplier]),
        atol=1e-7,
    )
    assert found.moment.components == (0, 0, 0)


def test_chosen_speeds_and_quaternions():
    """Reactions don't depend on the speeds; by Euler parameters too, a ball carries no moment, a free body nothing."""
    mechanism, pin, equations = pendulum(kinematics={q: l * time_derivative(phi)})
    found = reaction(equations, pin, frame=mechanism.frame("bob"))
    assert found.moment.components == (0, 0, 0)
    numbers = values | {I: 0.1}
    motion = simulate(equations, numbers, {phi: 0.5}, t=(0, 1), rtol=1e-11)
    pull = motion.evaluate(found.force.components)[1]
    rate = motion[time_derivative(phi)]
    np.testing.assert_allclose(pull, 1.3 * (0.8 * rate**2 + 9.81 * np.cos(motion[phi])), rtol=1e-9)

    top = Link("top", m, I, I, 2 * I, center=(0, 0, l))
    ball, afloat = spherical("O", ground, top, quaternion=True), free("F", ground, top, quaternion=True)
    of_ball, of_free = (
        newton_euler(assemble([joint]).system(gravity=Vector(ground, 0, 0, -g))) for joint in (ball, afloat)
    )
    held = reaction(of_ball, ball)
    assert held.moment.components == (0, 0, 0)
    assert (
        held.force.components
        == newton_equations(of_ball.system.bodies, gravity=of_ball.system.gravity).components
    )
    nothing = reaction(of_free, afloat)
    assert (*nothing.force.components, *nothing.moment.components) == (0,) * 6


def test_parameters_are_substituted_in_equations_with_reactions():
    mechanism, pin, equations = pendulum()
    (one, _, _) = reaction(
        subs(equations, {l: 2}), pin, frame=mechanism.frame("bob").subs({l: 2})
    ).force.components
    assert one == m * (2 * time_derivative(phi, 2) + g * sin(phi))
    found = subs(reaction(equations, "bob"), {l: 2})
    assert str(found.at) == "centre of bob"
    assert found.moment.components == (0, 0, I * time_derivative(phi, 2))


def test_an_equilibrium_evaluates_reactions():
    """A triangle of two bars under its weight: each pin carries half of it, and the thrust (m g / 2) cot(alpha)."""
    one, other = (Link(name, m, center=(l / 2, 0, 0)) for name in ("one", "other"))
    A, B = revolute("A", ground, one), revolute("B", one, other, at=(l, 0, 0))
    C = revolute("C", ground, other, at=(l, 0, 0), to=(l, 0, 0))
    mechanism = assemble([A, B, C])
    with pytest.warns(ModelNotice, match="leave no motion"):
        equations = newton_euler(mechanism.system(gravity=weight))
    found = equilibrium(equations, values, guess={A.coordinate: 1, B.coordinate: -2})
    load, alpha = 1.3 * 9.81, found[A.coordinate]
    assert alpha == pytest.approx(np.pi / 3)
    thrust = load / 2 / np.tan(alpha)
    left, right = (reaction(equations, pin, frame=ground).force for pin in (A, C))
    np.testing.assert_allclose(found.evaluate(left.components), [thrust, load, 0], rtol=1e-10)
    np.testing.assert_allclose(found.evaluate(right.components), [-thrust, load, 0], rtol=1e-10)
    assert found[right.components[1]] == pytest.approx(load)
    assert found[m * g * time_derivative(A.coordinate, 2)] == 0
    assert (right.components[1] in found, [*found]) == (False, [A.coordinate, B.coordinate])
    with pytest.raises(
        SimulationError, match=r"^equilibrium\[\.\.\.\]: no value of F; expected an expression of"
    ):
        found[F * l]
