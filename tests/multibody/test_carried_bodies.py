"""Bodies, loads, states and constraints of the user beside those of a mechanism."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    Link,
    Vector,
    assemble,
    cylindrical,
    fixed,
    functions_of_time,
    ground,
    lagrange_equations,
    motor,
    newton_euler,
    prismatic,
    reaction,
    revolute,
    rotate,
    simulate,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import JointError

m, g, l, a = symbols("m g l a")
s, x = functions_of_time("s x")
weight = Vector(ground, 0, -g, 0)
arm = Link("arm", 2, Iz=1, center=(1, 0, 0))
pin = revolute("A", ground, arm)


def test_a_body_on_a_link_is_beyond_its_joint() -> None:
    """The same as a link on a slide, by all formalisms, and with the same reactions."""
    made = assemble([pin])
    bead = Body(made.frame(arm) * translate(s, a, 0), m, name="bead")
    system = made.system(gravity=weight, bodies=[bead], coordinates=[s])
    equations = newton_euler(system)
    assert equations.residuals == lagrange_equations(system).residuals
    slide = prismatic("B", arm, Link("bead", m), at=(0, a, 0), coordinate=s)
    other = newton_euler(assemble([pin, slide]).system(gravity=weight))
    assert equations.residuals == other.residuals
    for found, expected in (
        (reaction(equations, pin), reaction(other, pin)),
        (reaction(equations, "bead"), reaction(other, "bead")),
    ):
        assert found.force.components == expected.force.components
        assert found.moment.components == expected.moment.components


def test_bodies_beside_the_mechanism_are_held_by_none_of_its_joints() -> None:
    made = assemble([pin])
    box = Body(translate(x, 0, 0), m, name="box")
    equations = newton_euler(made.system(gravity=weight, bodies=[box], coordinates=[x]))
    alone = newton_euler(made.system(gravity=weight))
    assert reaction(equations, pin).force.components == reaction(alone, pin).force.components
    assert equations.coordinates == (pin.coordinate, x)


def test_states_constraints_and_loads_beside_the_mechanism() -> None:
    """A winch: a motor with a current drives the arm, which lifts a box by a string over a drum of radius a."""
    i, (R, L, k, U) = functions_of_time("i"), symbols("R L k U")
    made = assemble([pin])
    box = Body(translate(3, x, 0), m, name="box")
    drive = motor(pin.coordinate, k * i, on=made.body(arm))
    system = made.system(
        [drive],
        bodies=[box],
        coordinates=[x],
        states={i: (U - R * i - k * drive["rate"]) / L},
        constraints=[x - a * pin.coordinate],
    )
    values = {R: 1, L: 1, k: 0.5, U: 2, m: 4, a: 0.3}
    motion = simulate(newton_euler(system), values, {}, t=(0, 150), method="bdf")
    np.testing.assert_allclose(motion[x], 0.3 * motion[pin.coordinate], atol=1e-7)
    assert motion[time_derivative(pin.coordinate)][-1] == pytest.approx(4, rel=1e-3)  # U = k w


def test_bodies_whose_carrier_is_not_known_are_refused() -> None:
    tip = Link("tip", 1)
    made = assemble([pin, fixed("W", arm, tip)])
    on_tip = Body(made.frame(tip) * translate(1, 0, 0), m, name="load")
    with pytest.raises(JointError, match=r"which of arm and tip carries the body load"):
        made.system(bodies=[on_tip])
    apart = assemble([pin, fixed("W", arm, tip, at=(2, 0, 0))])
    for link, beyond in ((tip, ("tip", "load")), (arm, ("tip",))):
        system = apart.system(bodies=[Body(apart.frame(link) * translate(1, 0, 0), m, name="load")])
        assert system.joints[1].outboard == beyond
        assert "load" in system.joints[0].outboard


def test_a_body_between_the_motions_of_a_joint_is_refused() -> None:
    shaft = Link("shaft", 1, 1, 1, 1)
    made = assemble([cylindrical("C", ground, shaft)])
    between = Body(translate(0, 0, made.coordinates[0]), 1, name="cross")
    with pytest.raises(
        JointError, match=r"^Mechanism.system: the body cross moves by s_C, and no link carries it"
    ):
        made.system(bodies=[between])
    same = Body(translate(0, 0, made.coordinates[0]) * rotate("Z", made.coordinates[1]), 1, name="rider")
    assert made.system(bodies=[same]).joints[0].outboard == ("shaft", "rider")
