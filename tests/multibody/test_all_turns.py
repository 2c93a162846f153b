"""Angles of joints that close loops: those that count all turns, those that jump, and springs that are wound up."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Expr,
    Frame,
    Link,
    ModelNotice,
    Torque,
    assemble,
    atan2,
    cos,
    equilibrium,
    free,
    functions_of_time,
    ground,
    newton_euler,
    number,
    pi,
    power,
    revolute,
    rotate,
    simulate,
    sin,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    translate,
)

m, k, a = symbols("m k a")


def test_a_spring_that_is_wound_beyond_half_a_turn_is_told() -> None:
    rotor = Link("rotor", 2.0, 1.0, 1.0, 0.5)
    made = assemble([free("F", ground, rotor), revolute("J", ground, rotor, loop=True)])
    coil = torsion_spring(made.joint("J").freedom(), k, free_angle=1, on=made.body(rotor), name="coil")
    equations = newton_euler(made.system([coil]))
    spin = {time_derivative(equations.coordinates[3]): 2.0}
    with pytest.warns(ModelNotice) as notices:
        simulate(equations, {k: 1e-6}, spin, t=np.linspace(0, 3, 31))
    (notice,) = notices
    assert str(notice.message) == (
        "simulate: coil is turned by more than half a turn from its free angle, first at about t = 2.1 s, where its "
        "torque changes to the other side: its joint closes a loop, and its angle is known from -pi to pi only; make "
        "the spring with all_turns=True, or let another joint close the loop by loop=True"
    )


def test_a_spring_that_is_wound_up_counts_all_turns() -> None:
    """I phi'' = -k (phi - phi0) over four turns: phi = phi0 (1 - cos(sqrt(k/I) t))."""
    rotor = Link("rotor", 2.0, 1.0, 1.0, 0.5)
    made = assemble([free("F", ground, rotor, axes="ZXY"), revolute("J", ground, rotor, loop=True)])
    pin, on = made.joint("J").freedom(), made.body(rotor)
    coil = torsion_spring(pin, 8.0, free_angle=14, on=on, all_turns=True, name="coil")
    (state,) = coil.states
    assert str(state) == "angle_coil"
    rates = {time_derivative(state): coil.states[state]}
    assert power(coil) + time_derivative(coil.potential).subs(rates) == 0
    equations = newton_euler(made.system([coil]))
    motion = simulate(equations, {}, {}, t=(0, 2), rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(motion[coil["angle"]], -14 * np.cos(4 * motion.t), atol=1e-5)
    assert motion.energy_drift < 1e-7
    wound = simulate(equations, {}, {state: 14.0}, t=(0, 0.5), rtol=1e-10, atol=1e-12)
    near = 14 - 4 * np.pi  # two turns before, which the state tells, and the pin does not
    np.testing.assert_allclose(wound[coil["angle"]], -near * np.cos(4 * wound.t), atol=1e-5)


@pytest.mark.parametrize("near", [0.0, 5.0, 30.0])
def test_a_spring_that_is_wound_up_has_an_equilibrium(near: float) -> None:
    rotor = Link("rotor", 2.0, 1.0, 1.0, 0.5)
    made = assemble([free("F", ground, rotor, axes="ZXY"), revolute("J", ground, rotor, loop=True)])
    load = Torque(ground, 0, 0, 4.0, on=made.body(rotor))
    pin = made.joint("J").freedom()
    coil = torsion_spring(pin, 8.0, free_angle=14, on=made.body(rotor), all_turns=True, name="coil")
    (state,) = coil.states
    found = equilibrium(newton_euler(made.system([coil, load])), {}, guess={state: near})
    assert found[state] == pytest.approx(14.5)
    assert found[made.coordinates[3]] % (2 * np.pi) == pytest.approx(14.5 % (2 * np.pi))
    np.testing.assert_allclose(found.eigenvalues, [-4j, 4j, -1], atol=1e-9)


def test_all_turns_of_a_coordinate_need_no_state() -> None:
    rotor = Link("rotor", 2.0, 1.0, 1.0, 0.5)
    made = assemble([revolute("J", ground, rotor)])
    for angle in (made.joint("J").freedom(), made.coordinates[0]):
        coil = torsion_spring(angle, k, on=made.body(rotor), all_turns=True)
        assert (coil.states, coil["angle"]) == ({}, made.coordinates[0])


def test_free_angles_of_angles_that_jump_count_from_themselves() -> None:
    rotor = Link("rotor", 1, 1, 1, 1)
    made = assemble([free("F", ground, rotor), revolute("J", ground, rotor, loop=True)])
    spring = torsion_spring(made.joint("J").freedom(), k, free_angle=pi / 2, on=made.body(rotor))
    psi, theta, phi = functions_of_time("psi_F theta_F phi_F")
    for angle, expected in ((0, -np.pi / 2), (np.pi / 2, 0), (3.0, 3 - np.pi / 2), (-3.0, 1.5 * np.pi - 3)):
        assert spring["angle"].evaluate({psi: angle, theta: 0, phi: 0}) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("at", "to", "angle"),
    [
        (rotate("Z", 0.3), rotate("Z", 0.1), -0.2),
        (rotate("Z", -3), rotate("Z", 3), 6 - 2 * pi),
        (rotate("Z", 0.3) * rotate("X", pi), rotate("X", pi) * rotate("Z", 0.1), 0.4),
        (rotate("Z", pi / 7) * rotate("X", pi), rotate("Y", pi) * rotate("Z", a), None),
    ],
)
def test_an_angle_that_counts_all_turns_begins_with_a_sum_of_turns(
    at: Frame, to: Frame, angle: object
) -> None:
    """A parallel linkage, in which the turns of the places are all that is left where all coordinates are zero."""
    bars = [Link(name, m) for name in ("one", "bar", "other")]
    one, bar, other = bars
    joints = [
        revolute("A", ground, one),
        revolute("B", one, bar, at=(0, 1, 0)),
        revolute("D", ground, other, at=(1, 0, 0)),
        revolute("C", bar, other, at=translate(1, 0, 0) * at, to=translate(0, 1, 0) * to, loop=True),
    ]
    value = assemble(joints).joint("C").freedom().value
    constant = value.subs({joint.coordinate: 0 for joint in joints})
    if angle is None:
        assert constant == atan2(sin(pi + pi / 7 + a), cos(pi + pi / 7 + a))
    else:
        assert constant.same_form(number(1) * angle)


@pytest.mark.parametrize("drive", [a * t, 3 * t**2 + 1, sin(a * t)], ids=str)
def test_an_angle_that_counts_all_turns_holds_drives(drive: Expr) -> None:
    """The crank of a four-bar is driven: its angle is part of the one of the pin that closes the loop."""
    crank, rod, rocker = (Link(name, m) for name in ("crank", "rod", "rocker"))
    A = revolute("A", ground, crank, coordinate=drive)
    B = revolute("B", crank, rod, at=(0.2, 0, 0))
    D = revolute("D", ground, rocker, at=(0.6, 0, 0), to=translate(0.3, 0, 0) * rotate("Z", 0.1))
    C = revolute("C", rod, rocker, at=(0.5, 0, 0), loop=True)
    pin = assemble([A, B, D, C]).joint(C).freedom()
    assert pin.value == D.coordinate - B.coordinate - drive - number("0.1")
    assert not pin.jumps
