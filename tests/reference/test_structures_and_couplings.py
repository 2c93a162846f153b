"""Structures that hold themselves by prestress, and overconstrained couplings, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Constraint,
    Link,
    ModelNotice,
    Point,
    Vector,
    assemble,
    equilibrium,
    friction,
    ground,
    motor,
    newton_euler,
    planar,
    prismatic,
    reaction,
    revolute,
    rotate,
    simulate,
    spring,
    time_derivative,
    translate,
)

WEIGHT = Vector(ground, 0, 0, -9.81)


def test_a_tensegrity_of_two_struts_and_four_cables_is_stiff_by_its_tension() -> None:
    """Struts cross in a square of side L = 1, whose sides are cables of the tension T = k (L - l0).

    Turned by d, the cables have the lengths ``sqrt(2) sin(pi/4 +- d/2)``, and their energy the second derivative
    ``k - T``, so that struts of the inertia I turn against each other with ``k - T = I/2 w^2``. Struts of the mass m
    move against each other with ``2 k + 2 T/L = m/2 w^2``.
    """
    k, free_length, m, inertia = 1000.0, 0.9, 1.0, 0.1
    tension = k * (1 - free_length)
    struts = [Link(name, m, Iz=inertia) for name in ("one", "other")]
    joints = [planar(link.name, ground, link) for link in struts]
    made = assemble(joints)
    half, (one, other) = math.sqrt(0.5), struts
    corners = [(one, -half), (other, -half), (one, half), (other, half)]
    cables = []
    for (start, x), (end, y) in zip(corners, [*corners[1:], corners[0]], strict=True):
        ends = made.point(start, x, 0, 0), made.point(end, y, 0, 0)
        cables.append(spring(*ends, k, free_length=free_length, on=made.body(start), reaction=made.body(end)))
    (x, y, phi), (xs, _, angle) = (joint.coordinates for joint in joints)
    held = {x: 0.0, y: 0.0, phi: math.pi / 4}
    found = equilibrium(
        newton_euler(made.system(cables)), {}, fixed=held, guess={angle: 3 * math.pi / 4 - 0.1, xs: 0.02}
    )
    assert_allclose(found[angle], 3 * math.pi / 4, rtol=1e-9)
    turning, moving = (k - tension) * 2 / inertia, (2 * k + 2 * tension) * 2 / m
    stiff = sorted(-((found.eigenvalues**2).real))[-6:]
    assert_allclose(stiff, [moving] * 4 + [turning] * 2, rtol=1e-6)


def test_a_coupling_of_pins_in_radial_slots_turns_both_shafts_alike() -> None:
    """As a Hirth coupling does: three pins where one and a half would do, of which two conditions are redundant."""
    shafts = [Link(name, 1.0, Iz=inertia) for name, inertia in (("a", 0.1), ("b", 0.3))]
    A, B = (revolute(name, ground, shaft) for name, shaft in zip("AB", shafts, strict=True))
    joints = [A, B]
    for k in range(3):
        place, pin = rotate("Z", 2 * math.pi * k / 3) * translate(0.1, 0, 0), Link(f"pin {k}")
        joints += [prismatic(f"S{k}", shafts[0], pin, at=place, axis="X")]
        joints += [revolute(f"P{k}", shafts[1], pin, at=place, loop=True)]
    made = assemble(joints)
    drive = motor(A.coordinate, 0.8, on=made.body(shafts[0]))
    system = made.system([drive])
    with pytest.warns(ModelNotice, match="2 of them redundant"):
        equations = newton_euler(system)
    with pytest.warns(ModelNotice, match=r"follow from 1, 2, 4 and 6 wherever it moves"):
        motion = simulate(equations, {}, {A.coordinate: 0.1}, t=(0, 1))
    mobility = system.mobility()
    assert (mobility.freedom, mobility.redundant) == (1, 2)
    assert_allclose(motion[A.coordinate], motion[B.coordinate], atol=1e-12)
    assert_allclose(motion[A.coordinate][-1], 0.1 + 0.8 / 0.4 / 2, rtol=1e-7)


def test_the_carriage_of_a_mast_with_a_chain_goes_twice_as_far() -> None:
    """``(M + 4 m) s'' = F - (M + 2 m) g``; the chain carries the carriage, and its rollers hold it upright."""
    M, m, F, g = 200.0, 300.0, 9000.0, 9.81
    mast, carriage = Link("mast", M), Link("carriage", m, center=(0.5, 0, 0.2))
    outer = prismatic("outer", ground, mast, axis="Z")
    inner = prismatic("inner", mast, carriage, axis="Z")
    made, s, c = assemble([outer, inner]), outer.coordinate, inner.coordinate
    lift = motor(s, F, on=made.body(mast))
    equations = newton_euler(made.system([lift], gravity=WEIGHT, constraints=[Constraint(c - s, "chain")]))
    motion = simulate(equations, {}, {}, t=(0, 1))
    rate = (F - (M + 2 * m) * g) / (M + 4 * m)
    assert_allclose(motion[s][-1], rate / 2, rtol=1e-9)
    with pytest.warns(ModelNotice, match="couples s_outer, s_inner"):
        held = reaction(equations, inner)
    carried = m * (g + 2 * rate)
    forces = [motion[each][-1] for each in (*held.force.components, *held.moment.components)]
    assert_allclose(forces, [0, 0, carried, 0, -0.5 * carried, 0], atol=1e-6)


def test_a_gyroscope_steadies_a_ship() -> None:
    """Its precession is damped, and takes the energy of the roll; without spin, the ship rolls on."""
    hull = Link("hull", 1e4, 5e4, 5e4, 5e4, center=(0, 0, -0.5))
    gimbal, rotor = Link("gimbal", 50.0, 5.0, 5.0, 5.0), Link("rotor", 200.0, 20.0, 20.0, 40.0)
    roll, pitch = revolute("roll", ground, hull, axis="X"), revolute("pitch", hull, gimbal, axis="Y")
    spin = revolute("spin", gimbal, rotor)
    made = assemble([roll, pitch, spin])
    ends = {"on": made.body(gimbal), "reaction": made.body(hull)}
    equations = newton_euler(made.system([friction(pitch.coordinate, viscous=2e4, **ends)], gravity=WEIGHT))
    largest = {}
    for speed in (0.0, 400.0):
        start = {roll.coordinate: 0.2, time_derivative(spin.coordinate): speed}
        motion = simulate(equations, {}, start, t=(0, 30), method="bdf")
        largest[speed] = np.abs(motion[roll.coordinate][-len(motion.t) // 5 :]).max()
    assert largest[0.0] == pytest.approx(0.2, abs=1e-3)
    assert largest[400.0] < 0.01


def test_what_rests_has_no_drift_of_energy() -> None:
    """Errors of the integration move it a little; its kinetic energy is far below the rounding of the potential one."""
    block = Link("block", 7.3)
    guide = prismatic("guide", ground, block, axis="Z")
    made = assemble([guide])
    band = spring(made.point(block, 0, 0, 0), Point(ground, 0, 0, 0.9), 431.7, on=made.body(block))
    equations = newton_euler(made.system([band], gravity=WEIGHT))
    motion = simulate(equations, {}, {guide.coordinate: 0.9 - 7.3 * 9.81 / 431.7}, t=(0, 2))
    assert 0 < np.ptp(motion[guide.coordinate]) < 1e-8
    assert motion.energy_drift == 0.0
    assert 0.0 < simulate(equations, {}, {guide.coordinate: 0.1}, t=(0, 2)).energy_drift < 1e-6
