"""Mechanisms of the textbooks, built of joints, against their closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import (
    Link,
    Mechanism,
    Motion,
    Vector,
    angular_velocity,
    assemble,
    cos,
    cylindrical,
    dot,
    ground,
    newton_euler,
    point_on_curve,
    prismatic,
    project,
    revolute,
    rolling,
    rotate,
    screw,
    simulate,
    sin,
    time_derivative,
    translate,
    universal,
)
from symbody.multibody.joint.joint import Joint

GRAVITY = Vector(ground, 0, 0, -9.81)


def links(names: str) -> list[Link]:
    return [Link(name, 1.0, 0.1, 0.1, 0.1) for name in names.split()]


def spin(motion: Motion, made: Mechanism, link: Link) -> NDArray[np.float64]:
    """Return the angular velocity of a shaft about its own axis x."""
    frame = made.frame(link)
    return motion[dot(angular_velocity(frame), Vector(frame, 1, 0, 0))]


def driven(made: Mechanism, crank: Joint, **guess: float) -> Motion:
    """Return the motion of a shaft that begins to turn at 2 rad/s, without loads."""
    start = {crank.coordinate: 0.0, time_derivative(crank.coordinate): 2.0}
    near = {q: guess[str(q)] for q in made.coordinates if str(q) in guess}
    return simulate(newton_euler(made.system()), {}, start, (0, 2), guess=near)


def test_universal_joint() -> None:
    """``w2 = w1 cos(b)/(1 - sin(b)^2 cos(phi)^2)``, phi from where the yoke of the first shaft is in both."""
    first, second = links("first second")
    A, U = revolute("A", ground, first, axis="X"), universal("U", first, second, axes="YZ")
    B = cylindrical("B", ground, second, at=rotate("Z", 0.5), axis="X")
    made = assemble([A, U, B])
    motion = driven(made, A, theta_U=0.5)
    w, phi = motion[time_derivative(A.coordinate)], motion[A.coordinate]
    assert_allclose(
        spin(motion, made, second), w * math.cos(0.5) / (1 - (math.sin(0.5) * np.cos(phi)) ** 2), rtol=1e-9
    )
    assert np.ptp(spin(motion, made, second) / w) > 0.2


def test_two_universal_joints_in_a_row_turn_parallel_shafts_at_one_speed() -> None:
    first, middle, second = links("first middle second")
    A = revolute("A", ground, first, axis="X")
    U, V = universal("U", first, middle, axes="YZ"), universal("V", middle, second, at=(1, 0, 0), axes="ZY")
    B = cylindrical("B", ground, second, at=translate(math.cos(0.4), math.sin(0.4), 0), axis="X")
    made = assemble([A, U, V, B])
    motion = driven(made, A, theta_U=0.4, phi_V=-0.4)
    assert_allclose(spin(motion, made, second), motion[time_derivative(A.coordinate)], rtol=1e-9)


def test_peaucelliers_linkage_draws_a_straight_line() -> None:
    """``x = (L^2 - s^2)/(2 a)`` for the arms L, the sides s of the rhombus and the crank a."""
    L, s, a, angle = 3.0, 1.0, 1.2, 0.3
    crank, one, other, *rhombus = links("crank one other near1 near2 far1 far2")
    near1, near2, far1, far2 = rhombus
    joints = [
        revolute("C", ground, crank, at=(a, 0, 0)),
        revolute("O1", ground, one),
        revolute("O2", ground, other),
        revolute("A1", one, near1, at=(L, 0, 0)),
        revolute("D1", near1, crank, at=(s, 0, 0), to=(a, 0, 0)),
        revolute("B1", other, near2, at=(L, 0, 0)),
        revolute("D2", near2, crank, at=(s, 0, 0), to=(a, 0, 0)),
        revolute("A2", one, far1, at=(L, 0, 0)),
        revolute("B2", other, far2, at=(L, 0, 0)),
        revolute("P", far1, far2, at=(s, 0, 0), to=(s, 0, 0)),
    ]
    made = assemble(joints)
    C, O1, O2, A1, B1, A2, B2 = made.coordinates
    D = a + a * np.exp(1j * angle)
    half = math.acos((L**2 + abs(D) ** 2 - s**2) / (2 * L * abs(D)))
    A, B = (L * D / abs(D) * np.exp(sign * half * 1j) for sign in (1, -1))
    P = A + B - D
    guess = {O1: np.angle(A), O2: np.angle(B), A1: np.angle((D - A) / A), B1: np.angle((D - B) / B)}
    guess |= {A2: np.angle((P - A) / A), B2: np.angle((P - B) / B)}
    start = {C: angle, time_derivative(C): 0.5}
    motion = simulate(newton_euler(made.system()), {}, start, (0, 1), guess=guess)
    x, y, _ = project(made.point(far1, s, 0, 0), ground).coordinates
    assert_allclose(motion[x], (L**2 - s**2) / (2 * a), rtol=1e-9)
    assert np.ptp(motion[y]) > 0.5


@pytest.mark.parametrize("slope", [0.3, 1.0])
def test_bodies_roll_down_an_incline(slope: float) -> None:
    """``x'' = g sin(slope)/(1 + I/(m R^2))``: 5/7 for a ball, 2/3 for a disc."""
    m, R = 2.0, 0.1
    ball = Link("ball", m, *[0.4 * m * R**2] * 3)
    disc = Link("disc", m, m * R**2 / 4, m * R**2 / 2, m * R**2 / 4)
    for link, part in ((ball, 5 / 7), (disc, 2 / 3)):
        made = assemble([rolling("K", rotate("Y", slope), link, radius=R)])
        motion = simulate(newton_euler(made.system(gravity=GRAVITY)), {}, {}, (0, 1))
        assert motion[made.coordinates[0]][-1] == pytest.approx(part * 9.81 * math.sin(slope) / 2, rel=1e-9)


def test_bead_on_a_helix() -> None:
    """``s'' = g h/(r^2 + h^2)`` for the wire ``(r cos s, r sin s, -h s)``."""
    r, h = 0.3, 0.1
    (bead,) = links("bead")
    wire = point_on_curve("W", ground, bead, curve=lambda s: (r * cos(s), r * sin(s), -h * s), axes="")
    made = assemble([wire])
    motion = simulate(newton_euler(made.system(gravity=GRAVITY)), {}, {}, (0, 2))
    assert motion[made.coordinates[0]][-1] == pytest.approx(2 * 9.81 * h / (r**2 + h**2), rel=1e-9)


def test_screw_that_closes_a_loop() -> None:
    """A nut falls on a spindle: ``z'' = -m g/(m + I/h^2)``."""
    spindle, nut = links("spindle nut")
    A, B = revolute("A", ground, spindle), prismatic("B", ground, nut, axis="Z")
    made = assemble([A, B, screw("S", spindle, nut, pitch=0.01)])
    motion = simulate(newton_euler(made.system(gravity=GRAVITY)), {}, {}, (0, 1))
    fallen = -9.81 / (1 + 0.1 / 0.01**2) / 2
    assert_allclose([motion[B.coordinate][-1], motion[A.coordinate][-1]], [fallen, -fallen / 0.01], rtol=1e-9)


@pytest.mark.filterwarnings("ignore:System", "ignore:simulate")
def test_center_of_a_two_disc_roller_stays_at_its_height() -> None:
    """Two discs in perpendicular planes, ``sqrt(2) R`` apart [Stewart, American J. Physics 34 (1966), p. 166]."""
    apart = math.sqrt(2)
    roller = Link("roller", 2.0, 0.5, 0.6, 0.7, center=(apart / 2, 0, 0))
    far = translate(apart, 0, 0) * rotate("X", math.pi / 2)
    made = assemble([rolling("K", ground, roller, radius=1), rolling("L", ground, roller, radius=1, to=far)])
    _, _, psi, theta, phi = made.coordinates
    start = {psi: 0.2, phi: 0.3, time_derivative(phi): 0.5}
    motion = simulate(newton_euler(made.system(gravity=GRAVITY)), {}, start, (0, 2), guess={theta: 0.5})
    height = motion[project(made.bodies[0].center_of_mass, ground).coordinates[2]]
    assert_allclose(height, height[0], rtol=1e-9)
    assert np.ptp(motion[phi]) > 0.5
    assert motion.energy_drift < 1e-7
