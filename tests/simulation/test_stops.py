"""Limits of joints: events that end a motion there, and notices of a motion that passes them."""

import numpy as np
import pytest

from symbody import (
    Force,
    Link,
    ModelNotice,
    Vector,
    assemble,
    consistent_state,
    cylindrical,
    equilibrium,
    free,
    ground,
    inverse_dynamics,
    motor,
    newton_euler,
    planar,
    point_on_curve,
    prismatic,
    revolute,
    rolling,
    simulate,
    simulate_many,
    sin,
    spherical,
    steady,
    stops,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    universal,
)
from symbody.errors import JointError, SimulationError

a = symbols("a")
LINK = Link("link", 1, 1, 1, 1)
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


def test_each_coordinate_of_a_joint_has_its_own_limits():
    shaft = Link("shaft", 2.0, 1, 1, 0.5)
    bush = cylindrical("A", ground, shaft, limits={"s": (None, 1), "phi": (-a, a)})
    made = assemble([bush])
    equations = newton_euler(made.system([motor(bush.coordinates[1], 1.0, on=made.body(shaft))]))
    names = [event.name for event in stops(equations)]
    assert names == ["A.s.upper", "A.phi.lower", "A.phi.upper"]
    motion = simulate(equations, {a: 4.0}, {}, t=(0, 5), events=stops(equations), rtol=1e-10)
    assert motion.events[0].event.name == "A.phi.upper"
    assert motion.events[0].t == pytest.approx(2, abs=1e-8)  # phi'' = 2
    with pytest.warns(ModelNotice, match=r"cylindrical A \(phi\) is beyond its limit by up to 5"):
        simulate(equations, {a: 4.0}, {}, t=(0, 3))


@pytest.mark.parametrize("quaternion", [False, True])
@pytest.mark.parametrize("loop", [False, True])
def test_the_cone_of_a_ball_joint(quaternion: bool, loop: bool):
    """A pendulum on a ball leaves its cone, of which the axis is turned, where its angle from the vertical is 0.8."""
    bob = Link("bob", 1.0, 0.1, 0.1, 0.1, center=(0, 0, -1))
    ball = spherical(
        "B", ground, bob, quaternion=quaternion and not loop, loop=loop, limits={"cone": (None, 0.8)}
    )
    joints = [ball, *([free("F", ground, bob, quaternion=quaternion)] if loop else [])]
    made = assemble(joints)
    push = Force(ground, 3, 4, 0, at=made.body(bob).center_of_mass, on=made.body(bob))
    equations = newton_euler(made.system([push], gravity=Vector(ground, 0, 0, -9.81)))
    motion = simulate(equations, {}, {}, t=(0, 5), events=stops(equations), rtol=1e-10, atol=1e-12)
    (end,) = motion.events
    assert end.event.name == "B.cone.upper"
    centre = made.body(bob).center_of_mass.projected(ground).coordinates
    x, y, z = (motion[each][-1] for each in centre)
    assert np.hypot(x, y) == pytest.approx(np.sin(0.8), abs=1e-7)
    assert z == pytest.approx(-np.cos(0.8), abs=1e-7)


@pytest.mark.parametrize(
    ("make", "name", "value"),
    [
        (lambda **given: universal("J", ground, LINK, **given), "theta", 0.4),
        (lambda **given: planar("J", ground, LINK, **given), "y", -0.2),
        (lambda **given: spherical("J", ground, LINK, axes="ZXZ", **given), "theta", 0.9),
        (lambda **given: free("J", ground, LINK, **given), "z", 0.1),
        (lambda **given: rolling("J", ground, LINK, radius=1, **given), "theta", 0.2),
        (
            lambda **given: point_on_curve("J", ground, LINK, curve=lambda s: (s, s**2, 0), **given),
            "s",
            0.3,
        ),
    ],
)
def test_limits_of_all_joints_are_those_of_their_coordinates(make, name, value):
    made = assemble([make(limits={name: (value, None)})])
    (event,) = stops(newton_euler(made.system()))
    assert event.name == f"J.{name}.lower"
    assert event.expression == value - made.joint("J").measured[name]


def test_the_parameter_of_a_curve_has_limits_where_it_closes_a_loop():
    """A pin in a parabolic slot, from rest: by the energy, it comes as far on the other side, and stops before."""
    pin = Link("pin", 1.0, Iz=0.1)
    slot = point_on_curve(
        "W", ground, pin, curve=lambda s: (s, s**2, 0), axes="Z", loop=True, limits={"s": (-0.4, None)}
    )
    equations = newton_euler(assemble([planar("F", ground, pin), slot]).system(gravity=weight))
    start = {slot.coordinates[0]: 0.5}
    motion = simulate(equations, {}, start, t=(0, 5), events=stops(equations), rtol=1e-9)
    assert motion.events[0].event.name == "W.s.lower"
    x, y = motion[equations.coordinates[0]][-1], motion[equations.coordinates[1]][-1]
    assert (x, y) == (pytest.approx(-0.4, abs=1e-8), pytest.approx(0.16, abs=1e-8))


def test_the_limit_of_a_pin_that_closes_a_plane_loop_counts_turns():
    crank, slider = Link("crank", 1, Iz=1), Link("slider", 1)
    joints = [
        prismatic("D", ground, slider, axis="X"),
        revolute("B", slider, crank, at=(0, 0, 0)),
        revolute("A", ground, crank, loop=True, limits=(None, 10)),
    ]
    made = assemble(joints)
    equations = newton_euler(made.system())
    spin = {time_derivative(made.joint("B").joint.coordinate): 2.0}
    motion = simulate(equations, {}, spin, t=(0, 9), events=stops(equations))
    assert motion.events[0].t == pytest.approx(5)


def spatial_pin(*limits: object):
    """A body that a pin alone leads, and that closes a loop in space: its angle is known up to whole turns."""
    rotor = Link("rotor", 2.0, 1.0, 1.0, 0.5)
    body = free("F", ground, rotor)
    made = assemble([body, revolute("J", ground, rotor, loop=True, limits=limits)])
    return newton_euler(made.system()), body.coordinates[3]


@pytest.mark.parametrize(("speed", "name", "time"), [(2.0, "upper", 2.0), (-2.0, "lower", 0.5)])
def test_a_pin_that_closes_a_loop_in_space_stops_beyond_half_a_turn(speed: float, name: str, time: float):
    equations, angle = spatial_pin(-1, 4)
    motion = simulate(equations, {}, {time_derivative(angle): speed}, t=(0, 4), events=stops(equations))
    (end,) = motion.events
    assert (end.event.name, end.t) == (f"J.{name}", pytest.approx(time))


def test_a_pin_that_closes_a_loop_in_space_is_followed_beyond_its_limits():
    equations, angle = spatial_pin(-1, 4)
    with pytest.warns(ModelNotice, match=r"revolute J is beyond its limit by up to 5, first at t = 2\.1 s"):
        simulate(equations, {}, {time_derivative(angle): 2.0}, t=np.linspace(0, 4.5, 46))


@pytest.mark.parametrize("limits", [(None, 4), (-1, None), (-3, 4)])
def test_limits_that_a_pin_in_space_cannot_tell_are_refused(limits):
    with pytest.raises(JointError) as caught:
        spatial_pin(*limits)
    low, high = limits
    assert str(caught.value) == (
        f"assemble: revolute J closes a loop in space, where its phi is known up to whole turns, and has the limits "
        f"{low} and {high}; expected two limits less than a turn apart; or let another joint close the loop by "
        "loop=True"
    )


def test_limits_with_symbols_that_turn_out_too_wide_are_reported():
    equations, _ = spatial_pin(-a, a)
    with pytest.warns(
        ModelNotice, match="the limits of revolute J are a turn apart or more, and can't be checked: it"
    ):
        simulate(equations, {a: 3.5}, {}, t=(0, 0.1))


def test_limits_that_turn_out_reversed_are_reported():
    equations, phi = pendulum(a, -a)
    with pytest.warns(ModelNotice) as caught:
        simulate(equations, {a: 0.5}, {phi: 1.0}, t=(0, 0.1))
    (message,) = (str(each.message) for each in caught)
    assert message == (
        "simulate: the limits of revolute A have the least value above the largest one, so that no position is within "
        "them"
    )


@pytest.mark.parametrize(("crown", "falls"), [(0, True), (0.1, True), (0.3, False)])
def test_a_wheel_that_rolls_stops_where_it_lies_flat(crown: float, falls: bool):
    """A ball leans as far as it likes."""
    wheel = rolling("K", ground, LINK, radius=0.3, crown=crown)
    equations = newton_euler(assemble([wheel]).system(gravity=Vector(ground, 0, 0, -9.81)))
    lean = wheel.coordinates[3]
    start = {lean: 1.4, time_derivative(lean): 2.0}
    if not falls:
        simulate(equations, {}, start, t=(0, 0.3))
        return
    with pytest.warns(ModelNotice, match=r"rolling K \(theta\) is beyond its limit by up to"):
        simulate(equations, {}, start, t=(0, 0.3))
    (end,) = simulate(equations, {}, start, t=(0, 0.3), events=stops(equations)).events
    assert (end.event.name, end.state[lean]) == ("K.theta.upper", pytest.approx(np.pi / 2))


def test_positions_beyond_limits_are_told_wherever_they_are_found() -> None:
    slide = prismatic("p", ground, LINK, axis="Z", limits=(-0.1, 0.1))
    mechanism, s = assemble([slide]), slide.coordinate
    spring = torsion_spring(s, a, on=mechanism.body(LINK))
    equations = newton_euler(mechanism.system([spring], gravity=Vector(ground, 0, 0, -10)))
    beyond = "prismatic p is beyond its limit by up to {}: limits exert no forces; expected positions within it, such "
    beyond += "as those near another guess, or a load that models the stop"
    instants = np.linspace(0, np.pi, 5)
    for found, size in (
        (lambda: equilibrium(equations, {a: 10.0}), 0.9),
        (lambda: steady(equations, {a: 10.0}, given={}), 0.9),
        (lambda: consistent_state(equations, {}, {s: 0.3}), 0.2),
        (
            lambda: inverse_dynamics(equations, {s: sin(t)}, parameters={a: 10.0}, t=instants),
            0.9,
        ),
    ):
        with pytest.warns(ModelNotice) as told:
            found()
        assert [str(each.message).partition(": ")[2] for each in told] == [beyond.format(f"{size:.3g}")]
    equilibrium(equations, {a: 200.0})  # within the limits, and no notice: it would be an error here
    consistent_state(equations, {}, {s: 0.1})


def test_limits_of_one_coordinate_are_given_by_its_name_or_without():
    by_name = revolute("A", ground, LINK, limits={"phi": (-0.5, None)}).limits
    assert [(each.name, each.low, each.high) for each in by_name] == [("phi", -0.5, None)]


def sliding_cart():
    """A cart of 2 kg on a rail from -1 to 1, pushed by the force a."""
    cart = Link("cart", 2.0)
    rail = prismatic("rail", ground, cart, limits=(-1, 1))
    mechanism = assemble([rail])
    push = Force(ground, a, 0, 0, at=mechanism.point(cart, 0, 0, 0), on=mechanism.body(cart))
    return newton_euler(mechanism.system([push])), rail.coordinate


@pytest.mark.parametrize(
    ("s0", "v0", "force", "place", "course"),
    [
        (1, 0.5, 0, "at", "moves outwards at 0.5 per s"),
        (1, 0.5, -9, "at", "moves outwards at 0.5 per s"),  # a short excursion
        (1.5, 0.5, 0, "0.5 beyond", "moves outwards at 0.5 per s"),
        (1, 0, 4, "at", "is at rest, but accelerated outwards at 2 per s^2"),
        (1.25, 0, 4, "0.25 beyond", "is at rest, but accelerated outwards at 2 per s^2"),
    ],
)
def test_a_start_at_a_limit_that_moves_outwards_is_refused(s0, v0, force, place, course):
    equations, s = sliding_cart()
    start = {s: s0, time_derivative(s): v0}
    with pytest.raises(SimulationError) as caught:
        simulate(equations, {a: force}, start, t=(0, 1), events=stops(equations))
    message = (
        f"simulate, events: prismatic rail begins {place} its limit at t = 0 s, and {course}, so that the stop "
        "rail.upper never ends the motion; expected a start within the limits, or a velocity inwards; to model what "
        "happens at a stop, use a load"
    )
    assert str(caught.value) == message
    for forces, s0s in (([0.0, force], [0.0, s0]), ([force], [s0])):
        with pytest.warns(ModelNotice, match=r"1 of . motions failed"):
            runs = simulate_many(
                equations, {a: forces}, {s: s0s, time_derivative(s): v0}, t=(0, 1), events=stops(equations)
            )
        assert [each.message for each in runs.failures] == [message]


def test_a_start_at_a_limit_that_moves_inwards_or_rests_goes_on():
    """The cart crosses the rail of 2 m: at 1 m/s in 2 s, by -1 m/s^2 from rest in 2 s; without a force it stays."""
    equations, s = sliding_cart()
    across, pushed, resting = (
        simulate(
            equations,
            {a: force},
            {s: 1, time_derivative(s): v0},
            t=(0, 3),
            events=stops(equations),
            rtol=1e-10,
        )
        for v0, force in ((-1, 0), (0, -2), (0, 0))
    )
    assert [each.event.name for each in (*across.events, *pushed.events)] == ["rail.lower"] * 2
    assert across.events[0].t == pytest.approx(2, rel=1e-9)
    assert pushed.events[0].t == pytest.approx(2, rel=1e-9)
    assert not resting.events
    again = dict(across.events[0].state) | {time_derivative(s): 0.5}
    assert simulate(equations, {a: 0}, again, t=(0, 1), events=stops(equations)).t[-1] == 1


@pytest.mark.filterwarnings("ignore:.* is beyond its limit by up to 0.01, first at t = 0 s")
@pytest.mark.parametrize("beyond", [0, 1e-12, 0.01])
def test_a_start_at_a_limit_or_beyond_it_that_is_turned_back_at_once_is_stopped(beyond):
    """The cart is within its limits for a part of the first step, under 9 m/s^2: ``s = s0 - v t + 4.5 t^2``."""
    equations, s = sliding_cart()
    start = {s: 1 + beyond, time_derivative(s): -0.5}
    motion = simulate(equations, {a: 18.0}, start, t=(0, 3), events=stops(equations))
    (end,) = motion.events
    assert end.event.name == "rail.upper"
    assert end.t == pytest.approx((0.5 + np.sqrt(0.25 - 18 * beyond)) / 9, rel=1e-9)


def test_a_ball_in_a_socket_does_not_begin_beyond_its_cone():
    """The cone is an angle between axes; its acceleration is that of the equations of motion."""
    bob = Link("bob", 1, 0.1, 0.1, 0.1, center=(0, 0, -1))
    socket = spherical("J", ground, bob, axes="XYZ", limits={"cone": (None, 0.3)})
    equations = newton_euler(assemble([socket]).system(gravity=Vector(ground, 0, 0, 9.81)))
    with pytest.raises(
        SimulationError, match=r"J.* begins 0\.1 beyond its limit .* is at rest, but accelerated outwards"
    ):
        simulate(equations, {}, {socket.coordinates[0]: 0.4}, t=(0, 1), events=stops(equations))


@pytest.mark.parametrize(("method", "over"), [("dop853", 1e-2), ("dop853", 1e-5), ("ida", 1e-3)])
def test_a_short_excursion_beyond_a_limit_is_stopped(method, over):
    """A cart that is braked at -1 m/s^2 turns round at 1 m, beyond its limit, within a part of one step."""
    cart = Link("cart", 1.0)
    rail = prismatic("rail", ground, cart, limits=(-5, 1 - over))
    mechanism = assemble([rail])
    equations = newton_euler(mechanism.system([motor(rail.coordinate, -1.0, on=mechanism.body(cart))]))
    start = {time_derivative(rail.coordinate): np.sqrt(2)}
    motion = simulate(equations, {}, start, t=(0, 3), events=stops(equations), method=method)
    (end,) = motion.events
    assert end.event.name == "rail.upper"
    assert end.t == pytest.approx(np.sqrt(2) - np.sqrt(2 * over), rel=1e-6 if method == "ida" else 1e-9)
