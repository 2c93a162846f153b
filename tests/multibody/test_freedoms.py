"""Motors, friction and springs along the freedoms of joints: several in one joint, and of joints that close loops."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symbody import (
    Expr,
    Link,
    Mechanism,
    Vector,
    assemble,
    cos,
    cylindrical,
    equilibrium,
    free,
    friction,
    functions_of_time,
    generalized_force,
    ground,
    inverse_dynamics,
    lagrange_equations,
    motor,
    newton_euler,
    pi,
    planar,
    point_on_curve,
    power,
    prismatic,
    reaction,
    revolute,
    rolling,
    rotate,
    simulate,
    simulate_many,
    spherical,
    sqrt,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    translate,
    universal,
)
from symbody.errors import ArgumentError, JointError, LoadError, SimulationError

m, I, k, c, M, a = symbols("m I k c M a")


@pytest.mark.parametrize(
    "make",
    [
        lambda *parts, **places: cylindrical("J", *parts, axis="Y", **places),
        lambda *parts, **places: universal("J", *parts, axes="ZX", **places),
        lambda *parts, **places: planar("J", *parts, axis="X", **places),
        lambda *parts, **places: spherical("J", *parts, axes="ZXZ", **places),
        lambda *parts, **places: spherical("J", *parts, axes="YXZ", **places),
        lambda *parts, **places: free("J", *parts, axes="ZYX", **places),
    ],
)
@pytest.mark.parametrize("is_reversed", [False, True])
def test_each_coordinate_of_a_joint_has_its_own_motor(make: object, is_reversed: bool) -> None:
    """The power of a motor is its effort times the rate of its coordinate, whatever else the joint does."""
    base, link = Link("base", m), Link("link", m, I, I, I, center=(1, 2, 3))
    places = {"at": translate(1, 0, 2) * rotate("X", 1), "to": translate(0, 3, 1) * rotate("Y", 2)}
    parts = (link, base) if is_reversed else (base, link)
    made = assemble([revolute("base", ground, base), make(*parts, **places)])  # type: ignore[operator]
    on, reaction = made.body(link), made.body(base)
    joint = made.joint("J")
    for q in joint.coordinates:
        drive = motor(q, M, on=on, reaction=reaction)
        assert power(drive) == M * time_derivative(q)
        expected = [M if q == other else 0 for other in made.coordinates]
        assert generalized_force(drive, made.coordinates) == expected
        name = str(q).split("_")[0]
        assert power(motor(joint.freedom(name), M, on=on, reaction=reaction)) == M * time_derivative(q)
        spring = torsion_spring(q, k, free_angle=a, damping=c, on=on, reaction=reaction)
        assert power(spring) + time_derivative(spring.potential) == -c * time_derivative(q) ** 2


@pytest.mark.parametrize("crown", [0, a])
def test_each_coordinate_of_a_wheel_has_its_own_motor(crown: Expr | int) -> None:
    """Its spin, its heading and its lean turn about different places of the wheel."""
    wheel = Link("wheel", m, I, 2 * I, I)
    made = assemble([rolling("K", ground, wheel, radius=1 + a, crown=crown)])
    for q in made.joint("K").coordinates:
        freedom = made.joint("K").freedom(str(q).split("_")[0])
        drive = motor(freedom, M, on=made.body(wheel))
        assert generalized_force(drive, made.coordinates) == [
            M if q == each else 0 for each in made.coordinates
        ]
        assert power(friction(freedom, viscous=c, on=made.body(wheel))) == -c * time_derivative(q) ** 2


def test_elements_on_a_turntable_act_against_it() -> None:
    """Its motion is given: the effort along a hinge or a slide is that of the coordinate, and nothing else acts."""
    table = rotate("Z", 3 * t) * translate(a, 0, t)
    for kind in (revolute, prismatic):
        arm = Link("arm", m, I, I, I, center=(1, 0, 0))
        made = assemble([kind("A", table, arm, axis="Z")])
        freedom, on = made.joint("A").freedom(), made.body(arm)
        drive = motor(freedom, M, on=on)
        assert len(drive.actions) == 1
        assert generalized_force(drive, made.coordinates) == [M]
        assert friction(freedom, viscous=c, on=on)["effort"] == -c * time_derivative(freedom.value)
        with pytest.raises(LoadError, match="a joint on a frame that moves"):
            motor(made.coordinates[0], M, on=on)


@pytest.mark.parametrize("driven", [3 * t, functions_of_time("q") + 3 * t])
def test_friction_of_a_joint_that_is_driven(driven: Expr) -> None:
    """A given motion has a rate as well: the friction is a torque that the drive must overcome."""
    arm = Link("arm", m, I, I, I, center=(1, 0, 0))
    made = assemble([revolute("A", ground, arm, coordinate=driven)])
    drag = friction(made.joint("A").freedom(), viscous=c, on=made.body(arm))
    assert drag["effort"] == -c * time_derivative(driven)
    assert power(drag) == -c * time_derivative(driven) ** 2
    (action,) = drag.actions
    assert action.vector.projected(ground).components == (0, 0, drag["effort"])


def four_bar(closing: str) -> Mechanism:
    """A crank that turns all around: joints A, B, C, D, of which one closes the loop."""
    crank = Link("crank", 1.0, Iz=0.1, center=(0.15, 0, 0))
    rod = Link("rod", 2.0, Iz=0.3, center=(0.5, 0, 0))
    rocker = Link("rocker", 1.0, Iz=0.2, center=(0.4, 0, 0))
    joints = [
        revolute("A", ground, crank),
        revolute("B", crank, rod, at=(0.3, 0, 0), loop=closing == "B"),
        revolute("C", rod, rocker, at=(1, 0, 0), to=(0.8, 0, 0), loop=closing == "C"),
        revolute("D", ground, rocker, at=(1, 0, 0), loop=closing == "D"),
    ]
    return assemble(joints)


def test_elements_on_a_pin_that_closes_a_loop_act_as_on_one_that_does_not() -> None:
    """The same four-bar with another joint that closes the loop has the same motion, over several turns."""
    found = []
    for closing in "BCD":
        made = four_bar(closing)
        pins = {name: made.joint(name) for name in "ABCD"}
        rod = {"on": made.body("rod"), "reaction": made.body("crank")}
        rocker = {"on": made.body("rocker"), "reaction": made.body("rod")}
        loads = [
            motor(pins["B"].freedom(), -4, **rod),
            torsion_spring(pins["C"].freedom(), 1.5, free_angle=0.3, damping=0.1, **rocker),
            friction(pins["C"].freedom(), viscous=0.1, coulomb=0.2, creep_speed=0.5, **rocker),
        ]
        equations = newton_euler(made.system(loads, gravity=Vector(ground, 0, -9.81, 0)))
        near = {"phi_A": 0.5, "phi_B": 0.215, "phi_C": 0.83, "phi_D": 1.55}
        guess = {q: near[str(q)] for q in equations.coordinates}
        known = {q: guess.pop(q) for q in equations.coordinates if str(q) == "phi_A"}
        rates = {time_derivative(q): 8.0 for q in known}
        motion = simulate(
            equations, {}, known | rates, t=np.linspace(0, 3, 301), guess=guess, rtol=1e-11, atol=1e-13
        )
        assert motion.energy_drift < 1e-7
        found.append(motion.evaluate([pins[name].measured["phi"] for name in "ABCD"]))
    turned = np.ptp(found[0], axis=1)
    assert turned[1] > 4 * np.pi
    for other in found[1:]:
        np.testing.assert_allclose(other, found[0], atol=1e-5)


def test_a_spatial_pin_that_closes_a_loop_is_a_rotor() -> None:
    """A body with six coordinates and a pin: I phi'' = M - k phi - c phi', and over several turns I phi'' = M."""
    rotor = Link("rotor", 2.0, 1.0, 1.0, 0.5)
    base = free("F", ground, rotor, axes="ZXY")
    made = assemble([base, revolute("J", ground, rotor, loop=True)])
    J = made.joint("J").freedom()
    assert "atan2" in str(J.value)
    on = made.body(rotor)
    held = newton_euler(made.system([torsion_spring(J, 8.0, free_angle=3.0, on=on)]))
    motion = simulate(held, {}, {base.coordinates[3]: 2.5}, t=(0, 2), rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(np.unwrap(motion[J.value]), 3 - 0.5 * np.cos(4 * motion.t), atol=1e-6)
    assert motion.energy_drift < 1e-7
    driven = newton_euler(made.system([motor(J, 2.0, on=on)]))
    motion = simulate(driven, {}, {}, t=(0, 4), rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(motion[J], 2 * motion.t**2, atol=1e-6)
    assert np.ptp(motion[J.value]) < 2 * np.pi
    fast = simulate(driven, {}, {}, t=np.linspace(0, 40, 101), rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(fast[J], 2 * fast.t**2, rtol=1e-5)  # many turns between two instants
    braked = newton_euler(made.system([motor(J, 20 * cos(4 * t), on=on)]))
    start = {time_derivative(base.coordinates[3]): [0.0, -3.0]}
    many = simulate_many(driven, {}, start, t=motion.t, rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(
        many[J][:, 1:-1:7], (2 * motion.t**2 - [[0], [3]] * motion.t)[:, 1:-1:7], atol=1e-6
    )
    far = np.linspace(0, 20, 11)
    for found, place in (
        (simulate(braked, {}, {}, t=far), "motion[...]: phi of revolute J can't be followed "),
        (
            simulate_many(braked, {}, start, t=far),
            "runs[...]: phi of revolute J can't be followed in case 0 ",
        ),
    ):
        with pytest.raises(SimulationError) as caught:
            found[J]
        assert str(caught.value) == place + (
            "from t = 0 s to 2 s, between which it may make a turn more or less; expected instants that are closer "
            "together, t=np.linspace(...), or freedom.value, which is known from -pi to pi"
        )
    with pytest.raises(ArgumentError) as refused:
        motion.evaluate([J])
    assert str(refused.value) == (
        "motion.evaluate: phi of revolute J is a freedom; expected expressions in the list; motion[freedom] has its "
        "values, and freedom.value is an expression"
    )
    assert equilibrium(held, {}, guess={base.coordinates[3]: 2.5})[J] == pytest.approx(3.0)
    steady_turn = {base.coordinates[3]: 5 * t - 9}
    turned = inverse_dynamics(driven, steady_turn, {}, t=motion.t)
    np.testing.assert_allclose(turned[J] - turned[J][0], 5 * motion.t, atol=1e-9)
    dragged = newton_euler(made.system([friction(J, viscous=1.5, on=on)]))
    start = {time_derivative(base.coordinates[3]): 5.0}
    motion = simulate(dragged, {}, start, t=(0, 2), rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(
        motion[friction(J, viscous=1.5, on=on)["rate"]], 5 * np.exp(-3 * motion.t), atol=1e-6
    )


def test_a_motor_on_an_euler_angle_is_one_between_massless_gimbals() -> None:
    rotor = Link("rotor", 1, 1, 2, 3, center=(0, 0, 1))
    ball = spherical("S", ground, rotor, axes="XYZ")
    alone = assemble([ball])
    psi, theta, phi = ball.coordinates
    outer, inner = Link("outer"), Link("inner")
    gimbals = assemble(
        [
            revolute("O", ground, outer, axis="X", coordinate=psi),
            revolute("I", outer, inner, axis="Y", coordinate=theta),
            revolute("D", inner, rotor, coordinate=phi),
        ]
    )
    drive = motor(alone.joint(ball).freedom("theta"), M, on=alone.body(rotor))
    between = motor(theta, M, on=gimbals.body(inner), reaction=gimbals.body(outer))
    one, other = (newton_euler(each.system([load])) for each, load in ((alone, drive), (gimbals, between)))
    assert one.residuals == other.residuals


def test_a_drive_of_a_cylindrical_joint_that_closes_a_loop() -> None:
    """m s'' = F and I phi'' = M, each by the motor of its freedom."""
    shaft = Link("shaft", 2.0, 1.0, 1.0, 0.5)
    made = assemble([free("F", ground, shaft), cylindrical("J", ground, shaft, loop=True)])
    on, J = made.body(shaft), made.joint("J")
    loads = [motor(J.freedom("s"), 3.0, on=on), motor(J.freedom("phi"), 0.25, on=on)]
    motion = simulate(newton_euler(made.system(loads)), {}, {}, t=(0, 2), rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(motion[J.measured["s"]], 0.75 * motion.t**2, atol=1e-8)
    np.testing.assert_allclose(motion[J.measured["phi"]], 0.25 * motion.t**2, atol=1e-8)


def test_what_is_no_freedom_is_told() -> None:
    arm, cart = Link("arm", 1), Link("cart", 1)
    made = assemble([cylindrical("J", ground, arm), prismatic("S", arm, cart), revolute("E", ground, cart)])
    for on in (arm, cart):
        with pytest.raises(
            LoadError, match=r"reaction=None; expected what prismatic S connects, arm and cart$"
        ):
            motor(made.joint("S").freedom(), 1, on=made.body(on))
    apart = assemble(
        [
            revolute("J", ground, arm),
            prismatic("S", arm, cart, axis="Y"),
            revolute("E", ground, cart, loop=True),
        ]
    )
    other = assemble(
        [revolute("E", ground, cart), prismatic("S", arm, cart), revolute("J", ground, arm, loop=True)]
    )
    with pytest.raises(
        LoadError, match=r"^motor: phi of revolute E is at a place that moves in the body cart;"
    ):
        motor(apart.joint("E").freedom(), 1, on=other.body(cart))
    ball = assemble([spherical("Q", ground, arm, quaternion=True)])
    with pytest.raises(LoadError, match="at the rate of e1_Q"):
        motor(ball.joint("Q").freedom("e1"), 1, on=ball.body(arm))
    with pytest.raises(JointError, match=r"^prismatic S: no freedom 'phi'"):
        made.joint("S").freedom("phi")


def test_friction_in_a_curved_slot_that_closes_a_loop() -> None:
    """A crank pin in the slot x = b p^2, y = p of a sliding plate: one equation of motion by its angle."""
    I_, m_, r_, b_, c_, F_, width = 0.05, 2.0, 0.2, 1.5, 3.0, 1.2, 0.05
    crank, plate = Link("crank", 0, Iz=I_), Link("plate", m_)
    A, S = revolute("A", ground, crank), prismatic("S", ground, plate)
    slot = point_on_curve(
        "W", plate, crank, curve=lambda p: (b_ * p**2, p, 0), to=(r_, 0, 0), axes="Z", loop=True
    )
    made = assemble([A, S, slot])
    (p,) = made.joint(slot).coordinates
    stretch = sqrt(1 + (2 * b_ * p) ** 2)  # the length of the slot per unit of its parameter
    along = made.joint(slot).freedom("s")
    bodies = {"on": made.body(crank), "reaction": made.body(plate)}
    drag = friction(
        along, viscous=c_ * stretch**2, coulomb=F_ * stretch, creep_speed=width / stretch, **bodies
    )
    eqs = newton_euler(made.system([drag]))
    assert lagrange_equations(made.system([drag])).residuals == eqs.residuals

    def rate(_: float, state: np.ndarray) -> list[float]:
        """x = r cos(phi) - b (r sin(phi))^2 of the plate, and friction c v + F tanh(v/v0) along the slot."""
        phi, u = state
        x1 = -r_ * np.sin(phi) - b_ * r_**2 * np.sin(2 * phi)
        x2 = -r_ * np.cos(phi) - 2 * b_ * r_**2 * np.cos(2 * phi)
        slide = r_ * np.cos(phi) * np.sqrt(1 + (2 * b_ * r_ * np.sin(phi)) ** 2)
        force = c_ * slide * u + F_ * np.tanh(slide * u / width)
        return [u, (-m_ * x1 * x2 * u**2 - force * slide) / (I_ + m_ * x1**2)]

    t = np.linspace(0, 1, 51)
    start = {A.coordinate: 0.4, time_derivative(A.coordinate): 12.0}
    motion = simulate(eqs, {}, start, t=t, guess={p: 0.08, S.coordinate: 0.17}, rtol=1e-10, atol=1e-12)
    own = solve_ivp(rate, (0, 1), [0.4, 12.0], t_eval=t, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(motion[A.coordinate], own.y[0], rtol=1e-7)
    assert motion.energy_drift < 1e-8
    across = reaction(eqs, slot, frame=made.frame(plate)).force.components
    normal, tangential = motion.evaluate(
        [across[0] - 2 * b_ * p * across[1], 2 * b_ * p * across[0] + across[1]]
    )
    assert np.abs(normal).max() > 1
    np.testing.assert_allclose(tangential, 0, atol=1e-9)


def test_the_rate_of_a_freedom_of_a_spatial_loop_is_the_slope_of_its_angle() -> None:
    """By differences of the angle, which is followed over its jumps."""
    crank, rod, rocker = (
        Link(name, 1.0, 0.01, 0.02, 0.02, center=(length / 2, 0, 0))
        for name, length in (("crank", 0.2), ("rod", 0.55), ("rocker", 0.3))
    )
    tilted = translate(0.5, 0.1, 0) * rotate("X", pi / 2) * rotate("Y", 0.3)
    A, S = revolute("A", ground, crank), spherical("S", crank, rod, at=(0.2, 0, 0))
    B = revolute("B", ground, rocker, at=tilted)
    at, to = translate(0.55, 0, 0) * rotate("Y", 1.2), translate(0.3, 0, 0) * rotate("Z", 0.2)
    U = universal("U", rod, rocker, at=at, to=to, loop=True)
    mechanism = assemble([A, S, B, U])
    freedoms = [mechanism.joint(U).freedom(name) for name in ("phi", "theta")]
    turn = motor(freedoms[0], 0.3, on=mechanism.body(rocker), reaction=mechanism.body(rod))
    motion = simulate(
        newton_euler(mechanism.system([turn], gravity=Vector(ground, 0, 0, -9.81))),
        {},
        {A.coordinate: 0.3},
        t=np.linspace(0, 0.5, 2001),
        guess={B.coordinate: 0.8},
        rtol=1e-10,
        atol=1e-12,
    )
    for freedom in freedoms:
        rate, slope = (
            motion[freedom.rate],
            np.gradient(np.unwrap(motion[freedom.value]), motion.t, edge_order=2),
        )
        np.testing.assert_allclose(rate, slope, atol=2e-4 * np.abs(rate).max())
        assert np.abs(rate).max() > 0.04
    assert mechanism.joint(A).freedom().rate == time_derivative(A.coordinate)
