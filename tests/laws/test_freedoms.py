"""Laws of freedoms, over random trees and loops: values place the child, rates are the power of the unit effort."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import Body, friction, motor, power, time_derivative, torsion_spring
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import number
from tests.laws.test_joints import Moving, moving
from tests.repeated import repeated

KINDS = (
    "revolute",
    "prismatic",
    "cylindrical",
    "universal",
    "planar",
    "spherical",
    "screw",
    "point_on_curve",
    "rolling",
)
FORMS = [(kind, form) for kind in KINDS for form in ("tree", "loop")]
CASES = [*((*form, 0) for form in FORMS), *repeated((*form, 1) for form in FORMS)]


def joint_of(case: Moving, form: str) -> PlacedJoint:
    name = "C" if form == "loop" else "J1"
    return case.mechanism.joint(name)


def ends(case: Moving, placed: PlacedJoint) -> tuple[Body, Body | None]:
    """Return the child and the parent; the ground as a child takes no load, so the parent does."""
    bodies = [case.mechanism.body(name) if name else None for name, _ in placed.ends]
    on, reaction = reversed(bodies)
    if on is None:
        on, reaction = reaction, None
    assert on is not None
    return on, reaction


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_the_values_of_freedoms_place_the_child(kind: str, form: str, seed: int) -> None:
    case = moving(kind, form, seed)
    placed = joint_of(case, form)
    assert placed.opens is (form == "tree")
    values = [placed.measured[name] for name in placed.joint.pair.names]
    place = placed.parent_side * placed.joint.pair.motion(list(map(number, case.numbers(values))))
    one, other = (case.numbers(frame.matrix.entries) for frame in (place, placed.child_side))
    np.testing.assert_allclose(one, other, atol=1e-12)


@pytest.mark.parametrize(("kind", "form", "seed"), CASES)
def test_the_power_along_a_freedom_is_the_effort_times_its_rate(kind: str, form: str, seed: int) -> None:
    case = moving(kind, form, seed)
    placed = joint_of(case, form)
    on, reaction = ends(case, placed)
    state = dict(case.state)
    if kind != "screw" and (kind, form) != (
        "point_on_curve",
        "loop",
    ):  # of which a constraint holds the coordinate to the displacement; the screw may not move at all
        state |= dict(
            zip(case.equations.speeds, np.random.default_rng(seed).uniform(-1, 2, 99), strict=False)
        )
    moves = []
    for name in placed.joint.pair.names:
        if kind == "rolling" and form == "loop" and name in "xy":
            continue  # of the lowest centre of a cross-section, which is no point of the wheel
        freedom = placed.freedom(name)
        drive = motor(freedom, 3, on=on, reaction=reaction)
        spring = torsion_spring(freedom, 2, free_angle=1, on=on, reaction=reaction)
        drag = friction(freedom, viscous=2, on=on, reaction=reaction)
        found = case._numbers(
            [
                power(drive),
                3 * drive["rate"],
                3 * time_derivative(freedom.value),
                power(spring),
                -time_derivative(spring.potential),
                power(drag),
            ],
            state,
        )
        np.testing.assert_allclose(found[1:3], found[0], atol=1e-9)
        np.testing.assert_allclose(found[3], found[4], atol=1e-9)
        np.testing.assert_allclose(found[5], -2 * found[2] ** 2 / 9, atol=1e-9)
        moves.append(abs(found[0]) > 1e-9)
    assert any(moves) or (kind, form) == ("screw", "loop") or not moves
