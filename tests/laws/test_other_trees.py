"""The law of spanning trees: whichever joint closes the loop, elements, accelerations and reactions are the same."""

from __future__ import annotations

import warnings
from dataclasses import replace
from random import Random

import numpy as np
import pytest

from symbody import (
    Element,
    Expr,
    Mechanism,
    ModelNotice,
    Point,
    Vector,
    acceleration,
    assemble,
    bushing,
    friction,
    ground,
    motor,
    newton_euler,
    origin,
    project,
    reaction,
    spring,
    time_derivative,
    torsion_spring,
)
from symbody.multibody.joint.placed_joint import PlacedJoint
from tests.laws.random_mechanism import random_mechanism
from tests.laws.test_joints import Moving
from tests.repeated import repeated

Values = dict[Expr, float]
KINDS = [
    "revolute",
    "universal",
    "screw",
    "point_on_curve",
    *repeated(["prismatic", "cylindrical", "spherical", "planar"]),
]


def along(placed: PlacedJoint, made: Mechanism) -> list[Element]:
    """Return a spring, a motor and friction along each freedom of a joint, with a body as its child or parent."""
    child, parent = (made.body(name) if name else None for name, _ in reversed(placed.ends))
    on, other = (child, parent) if child is not None else (parent, None)
    assert on is not None
    found = []
    for name in placed.joint.pair.names:
        if (placed.joint.kind, name) == ("point_on_curve", "s"):
            continue  # no freedom where it closes a loop
        freedom = placed.freedom(name)
        found += [
            torsion_spring(freedom, 3, free_angle=0.2, damping=0.1, on=on, reaction=other),
            motor(freedom, 2, on=on, reaction=other),
            friction(freedom, viscous=0.2, coulomb=0.3, creep_speed=0.5, on=on, reaction=other),
        ]
    return found


def loads_of(made: Mechanism) -> list[Element]:
    first, last = made.body("L0"), made.body("L3")
    place = made.frame("L3")
    return [
        *(element for placed in made.joints for element in along(placed, made)),
        bushing(made.frame("L0"), place, [1, 2, 3, 4, 5, 6], damping=[0.1] * 6, on=first, reaction=last),
        spring(first.center_of_mass, Point(ground, 3, 3, 3), 5, free_length=1, damping=0.2, on=first),
    ]


def found(made: Mechanism, position: Values, rates: Values) -> dict[str, np.ndarray]:
    """Return the accelerations of all bodies and the reactions of all joints, by name."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        eqs = newton_euler(made.system(loads_of(made), gravity=Vector(ground, 0, 1, -9.81)))
    values = {**position, **{time_derivative(q): rate for q, rate in rates.items()}}
    n, m, number = len(eqs.speeds), len(eqs.constraints), Moving._numbers
    assert np.abs(number(eqs.constraints, values)).max(initial=0) < 1e-12
    A = number([*eqs.constraint_jacobian.entries], values).reshape(m, n)
    assert np.abs(A @ number(eqs.speeds, values)).max(initial=0) < 1e-10
    M = number([*eqs.mass_matrix.entries], values).reshape(n, n)
    whole = np.block([[M, -A.T], [A, np.zeros((m, m))]])
    right = np.concatenate([number(eqs.forcing, values), -number(eqs.constraint_bias(), values)])
    values |= dict(zip((*eqs.accelerations, *eqs.multipliers), np.linalg.solve(whole, right), strict=True))
    moved = {
        body.name: number(project(acceleration(body.center_of_mass), ground).components, values)
        for body in made.bodies
    }
    for placed in made.joints:
        held = reaction(eqs, placed, about=origin(ground), frame=ground)
        moved[placed.name] = number([*held.force.components, *held.moment.components], values)
    return moved


def with_rates(made: Mechanism, position: Values, seed: int) -> Values:
    """Return rates of the coordinates that keep the loops closed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        eqs = newton_euler(made.system())
    A = Moving._numbers([*eqs.constraint_jacobian.entries], position).reshape(-1, len(eqs.speeds))
    u = np.random.default_rng(seed).uniform(-1, 1, len(eqs.speeds))
    return dict(zip(eqs.coordinates, u - np.linalg.pinv(A) @ (A @ u), strict=True))


def seen_by(other: Mechanism, made: Mechanism, position: Values, rates: Values) -> tuple[Values, Values]:
    """Return position and rates in the coordinates of another tree, as the joints of the first one measure them."""
    state = position | {time_derivative(q): rate for q, rate in rates.items()}
    values, speeds = Values(), Values()
    for placed in other.joints:
        measured = made.joint(placed.name).measured
        for q, name in zip(placed.joint.coordinates, placed.joint.pair.names, strict=True):
            if q in other.coordinates:
                values[q] = float(Moving._numbers([measured[name]], state)[0])
                speeds[q] = float(Moving._numbers([time_derivative(measured[name])], state)[0])
    return values, speeds


@pytest.mark.parametrize("kind", KINDS)
def test_whichever_joint_closes_the_loop_the_motion_and_the_reactions_are_the_same(kind: str) -> None:
    drawn = random_mechanism(22, closing=kind)
    made, position, draw = drawn.mechanism, drawn.position, Random(22)
    rates = with_rates(made, position, 22)
    joints = [placed.joint for placed in made.joints]
    movable = [each for each in joints if made.joint(each).opens and each.kind != "point_on_curve"]
    closing = draw.choice(movable)
    again = [
        replace(each, mounting=replace(each.mounting, loop=True if each is closing else None))
        for each in joints
    ]
    draw.shuffle(again)
    other = assemble(again)
    assert not other.joint(closing.name).opens
    one, two = found(made, position, rates), found(other, *seen_by(other, made, position, rates))
    size = max(np.abs(each).max() for each in one.values())
    for name, values in one.items():
        np.testing.assert_allclose(two[name], values, atol=1e-11 * size, err_msg=name)
