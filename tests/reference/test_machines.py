"""Machines and suspensions: laws that hold for each, and the closed forms of the textbooks."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import (
    Body,
    Equations,
    Expr,
    Mechanism,
    ModelNotice,
    Motion,
    Point,
    Vector,
    angular_momentum,
    angular_velocity,
    cross,
    dot,
    frozen_velocity,
    ground,
    lagrange_equations,
    linear_momentum,
    newton_euler,
    origin,
    project,
    reaction,
    simulate,
    time_derivative,
)
from tests.reference import machines
from tests.reference.machines import LARGE, LEGS, MACHINES, Machine
from tests.repeated import repeated

pytestmark = pytest.mark.filterwarnings("ignore:.*share them by minimum norm")

Array = NDArray[np.float64]
GRAVITY = Vector(ground, 0, 0, -9.81)


class Moved(NamedTuple):
    machine: Machine
    equations: Equations
    motion: Motion

    @property
    def made(self) -> Mechanism:
        return self.machine.mechanism

    def along(self, values: tuple[Expr, ...]) -> Array:
        """Return values at the instants of the motion, one row each."""
        found = self.motion.evaluate(values)
        return np.array([np.broadcast_to(each, np.shape(self.motion.t)) for each in found])

    def rate(self, values: tuple[Expr, ...]) -> Array:
        """Return the rates of values by differences of the fourth order, without two instants at each end."""
        p, h = self.along(values), self.motion.t[1] - self.motion.t[0]
        return (p[:, :-4] - 8 * p[:, 1:-3] + 8 * p[:, 3:-1] - p[:, 4:]) / (12 * h)

    def __getitem__(self, name: str) -> Array:
        names = {str(each): each for q in self.made.coordinates for each in (q, time_derivative(q))}
        return self.motion[names[name]]


@cache
def moved(make: Callable[[], Machine]) -> Moved:
    machine = make()
    names = {str(each): each for q in machine.mechanism.coordinates for each in (q, time_derivative(q))}
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*(overconstrained|follows from|depends on)", ModelNotice)
        equations = newton_euler(machine.mechanism.system(machine.loads, gravity=GRAVITY))
        start, guess = (
            {names[name]: float(value) for name, value in given.items() if name in names}
            for given in (machine.start, machine.guess)
        )
        motion = simulate(
            equations, {}, start, guess=guess, t=np.linspace(0, 0.4, 401), rtol=1e-10, atol=1e-11
        )
    return Moved(machine, equations, motion)


@pytest.mark.parametrize("make", [*MACHINES, *repeated(LARGE)], ids=lambda make: make.__name__)
def test_laws_of_machines(make: Callable[[], Machine]) -> None:
    """One test each, as all need the same motion: it takes most of the time."""
    found = moved(make)
    check_formalisms(found)
    assert found.motion.energy_drift < 1e-8
    check_balances(found)
    check_work(found)


def check_formalisms(found: Moved) -> None:
    """Lagrange's equations are the nodes of Newton's and Euler's."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*(overconstrained|follows from|depends on)", ModelNotice)
        assert lagrange_equations(found.equations.system).residuals == found.equations.residuals


def check_balances(found: Moved) -> None:
    """Rates of momenta of each body, by finite differences, are the sums of reactions of joints, loads and weight."""
    for body in found.made.bodies:
        force, moment = acting(found, body)
        momentum = linear_momentum([body]).projected(ground).components
        spin = angular_momentum([body], body.center_of_mass).projected(ground).components
        for rate, total in ((momentum, force), (spin, moment)):
            summed = found.along(total.projected(ground).components)[:, 2:-2]
            assert_allclose(found.rate(rate), summed, atol=3e-5 * max(1.0, float(np.abs(summed).max())))


def acting(found: Moved, body: Body) -> tuple[Vector, Vector]:
    """Return the force and the moment about its centre of mass of all that acts on a body."""
    center, system = body.center_of_mass, found.equations.system
    force, moment = (body.mass * GRAVITY), Vector(ground, 0, 0, 0)
    for joint in found.made.joints:
        for (name, _), sign in zip(joint.ends, (-1, 1), strict=True):
            if name == body.name:
                on_child = reaction(found.equations, joint.name)
                force += sign * on_child.force
                moment += sign * on_child.about(center).moment
    for action in system.actions:
        if action.body is body:
            point: Point | None = action.point
            force += Vector(ground, 0, 0, 0) if point is None else action.vector
            moment += action.vector if point is None else cross(point - center, action.vector)
    return force, moment


def check_work(found: Moved) -> None:
    """The power of both sides of each joint is zero in sum."""
    for joint in found.made.joints:
        on_child = reaction(found.equations, joint.name)
        (_, parent), (_, child) = joint.ends
        slide = frozen_velocity(on_child.at, child, axes=ground) - frozen_velocity(
            on_child.at, parent, axes=ground
        )
        turn = angular_velocity(child).projected(ground) - angular_velocity(parent).projected(ground)
        work = dot(on_child.force, slide) + dot(on_child.moment, turn)
        size = max(1.0, float(np.abs(found.along(on_child.force.projected(ground).components)).max()))
        assert np.abs(found.along((work,))).max() < 1e-7 * size, joint.name


def spin(found: Moved, link: str, axis: int) -> Array:
    frame = found.made.frame(link)
    unit = Vector(frame, *(int(k == axis) for k in range(3)))
    return found.along((dot(angular_velocity(frame), unit),))[0]


def position(found: Moved, link: str, place: tuple[float, float, float] = (0, 0, 0)) -> Array:
    return found.along(project(found.made.point(link, *place), ground).coordinates)


def test_a_differential_in_motion_shares_speed_and_a_universal_joint_drives_the_wheel() -> None:
    """``w_left + w_right = 2 w_case``; ``w_wheel = w cos(b)/(1 - sin(b)^2 cos(phi)^2)`` with phi of the yoke."""
    found = moved(machines.differential)
    case, left, right = found["phi_C'"], spin(found, "left", 2), spin(found, "right", 2)
    assert_allclose(left - right, 2 * case, rtol=1e-9)
    ratio = np.abs(spin(found, "wheel", 2) / left)
    turned = np.arccos(np.clip(np.sqrt(1 - math.cos(0.1) / ratio) / math.sin(0.1), -1, 1))
    assert np.all((ratio > math.cos(0.1) - 1e-9) & (ratio < 1 / math.cos(0.1) + 1e-9))
    assert np.ptp(turned) > 0.1


def test_ends_of_a_drive_shaft_turn_at_one_speed_and_the_middle_does_not() -> None:
    found = moved(machines.drive_shaft)
    assert_allclose(spin(found, "second", 0), spin(found, "first", 0), rtol=1e-9)
    assert np.ptp(spin(found, "middle", 0)) > 0.01


def test_a_follower_is_at_the_radius_of_its_cam() -> None:
    found = moved(machines.cam)
    assert_allclose(found["s_B"], 0.1 + 0.02 * np.cos(2 * found["phi_A"]), rtol=1e-8)


def test_a_worm_turns_its_wheel_by_its_lead() -> None:
    found = moved(machines.worm_gear)
    assert_allclose(np.abs(spin(found, "wheel", 2) / spin(found, "worm", 0)), 0.005 / 0.1, rtol=1e-9)


def test_a_scissor_lift_rises_by_the_sine_of_its_bars() -> None:
    found = moved(machines.scissor_lift)
    assert_allclose(position(found, "platform")[2], -np.sin(found["phi_A"]), atol=1e-8)
    assert np.ptp(position(found, "platform")[2]) > 0.01


def test_the_screw_of_a_jack_turns_by_the_travel_of_its_nut() -> None:
    found = moved(machines.screw_jack)
    travel = position(found, "bearing")[0] - position(found, "nut")[0]
    turned = found.along((found.made.joint("S").measured["phi"],))[0]
    assert_allclose(turned - turned[0], (travel - travel[0]) / 0.002, atol=1e-6)


def test_hoekens_coupler_draws_a_straight_line_during_half_a_turn() -> None:
    """The end of the coupler keeps the height 4 to 1/200 of its travel while the crank points away from the rocker."""
    found = moved(machines.hoeken)
    away = np.cos(found["phi_A"]) < 0
    x, _, z = position(found, "coupler", (5, 0, 0))
    assert np.ptp(x[away]) > 1
    assert_allclose(z[away], 4, atol=np.ptp(x[away]) / 200)


def test_links_of_a_suspension_keep_their_lengths() -> None:
    found = moved(machines.five_link_suspension)
    origins = [position(found, f"rod{k}") for k in range(5)]
    outer = [
        found.along(project(origin(found.made.joint(f"O{k}").child_side), ground).coordinates)
        for k in range(5)
    ]
    lengths = [np.linalg.norm(b - a, axis=0) for a, b in zip(origins, outer, strict=True)]
    assert max(float(np.ptp(each)) for each in lengths) < 1e-8
    assert np.ptp(position(found, "upright", (0, 0.72, 0))[2]) > 1e-3


def test_wheels_of_a_swing_axle_camber_with_their_travel() -> None:
    """A hub at 0.6 from its pivot: ``sin(camber) = dz/0.6``, and the half track becomes ``0.2 + sqrt(0.36 - dz^2)``."""
    found = moved(machines.swing_axle)
    axle = Vector(found.made.frame("left_wheel"), 0, 1, 0).projected(ground).components
    _, across, up = found.along(axle)
    _, y, z = position(found, "left_wheel")
    dz = z - position(found, "body")[2]
    assert np.ptp(dz) > 1e-3
    assert_allclose(np.arctan2(up, across), np.arcsin(dz / 0.6), atol=1e-9)
    assert_allclose(y, 0.2 + np.sqrt(0.36 - dz**2), rtol=1e-9)


def test_cylinders_of_an_excavator_are_as_long_as_the_law_of_cosines_says() -> None:
    """Pins of the boom at sqrt(0.5) and sqrt(3.4) from A, those of the stick at sqrt(4.36) and sqrt(0.45) from B."""
    found = moved(machines.excavator)

    def side(length: str, a: float, b: float, angle: Array) -> None:
        assert_allclose(found[length] ** 2, a + b - 2 * np.sqrt(a * b) * np.cos(angle), rtol=1e-9)

    foot, eye = math.atan2(0.5, 0.5), math.atan2(0.4, 1.8)  # below and above the axis of the boom
    side("s_K2", 0.5, 3.4, foot + eye - found["phi_A"])
    seat, lug = math.atan2(0.6, -2.0), math.atan2(0.3, -0.6)
    side("s_M2", 4.36, 0.45, seat - lug + found["phi_B"])


def test_a_tripod_turns_as_its_housing_while_its_centre_goes_round_three_times() -> None:
    """``u = -R (1 - cos b)/2 cos 3a``, ``v = -R (1 - cos b)/(2 cos b) sin 3a``, along the tilt b and across it.

    a is the angle of the housing from the direction of the tilt, R the radius of the grooves: of each trunnion, which
    turns as the housing does, the projection meets its groove.
    """
    found = moved(machines.tripod_coupling)
    axis = found.along(Vector(found.made.frame("shaft"), 0, 0, 1).projected(ground).components)
    tilt, way = np.arccos(axis[2]), np.exp(1j * np.arctan2(axis[1], axis[0]))
    x, y, _ = position(found, "shaft")
    center, turned = (x + 1j * y) / way, 3 * (found["phi_A"] - np.angle(way))
    assert np.ptp(turned) > 3
    lean = 0.05 * (1 - np.cos(tilt)) / 2
    assert_allclose(center.real, -lean * np.cos(turned), atol=1e-11)
    assert_allclose(center.imag, -lean / np.cos(tilt) * np.sin(turned), atol=1e-11)


@pytest.mark.repeated
def test_arms_of_a_delta_robot_are_where_its_inverse_kinematics_says() -> None:
    """``(r - R - a cos q)^2 + s^2 + (z + a sin q)^2 = L^2`` in the plane of each arm [Clavel 1991], solved for q."""
    found = moved(machines.delta_robot)
    x, y, z = position(found, "platform")
    assert np.ptp(z) > 1e-3
    for k in range(3):
        way = np.exp(2j * math.pi * k / 3)
        along, across = ((x + 1j * y) / way).real + 0.05 - 0.2, ((x + 1j * y) / way).imag
        e, f = -2 * 0.3 * along, 2 * 0.3 * z
        g = along**2 + across**2 + z**2 + 0.3**2 - 0.8**2
        half = np.arctan2(f, e)
        both = [half + sign * np.arccos(-g / np.hypot(e, f)) for sign in (1, -1)]  # elbow in or out
        error = [np.abs(np.exp(1j * q) - np.exp(1j * found[f"phi_A{k}"])) for q in both]
        assert np.minimum(*error).max() < 1e-6


@pytest.mark.repeated
def test_legs_of_a_hexapod_are_as_long_as_its_inverse_kinematics_says() -> None:
    found = moved(machines.hexapod)
    for k, (low, high) in enumerate(LEGS):
        length = np.linalg.norm(position(found, "top", high) - np.array(low)[:, None], axis=0)
        assert_allclose(found[f"s_C{k}"], length, rtol=1e-9)


@pytest.mark.repeated
def test_discs_of_a_schmidt_coupling_turn_at_one_speed() -> None:
    found = moved(machines.schmidt_coupling)
    for disc in ("disc1", "disc2"):
        assert_allclose(spin(found, disc, 2), found["phi_I'"], rtol=1e-8)
