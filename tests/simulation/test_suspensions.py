"""Spatial loops: a double wishbone and a MacPherson strut through their travel, and their wheel rates.

The positions are checked against nonlinear equations of the points alone, without frames or angles, and the wheel rate
dF/dz of a spring against the second difference of its energy over the height of the wheel at these positions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import least_squares

from symbody import (
    Equations,
    Expr,
    Force,
    Link,
    Mechanism,
    assemble,
    consistent_state,
    cylindrical,
    equilibrium,
    ground,
    newton_euler,
    project,
    reaction,
    revolute,
    rotate,
    spherical,
    sqrt,
    symbols,
    translate,
    universal,
)

Array = NDArray[np.float64]
F = symbols("F")
STIFFNESS = 30e3
LENGTHS = {"double wishbone": 0.57, "MacPherson": 0.73}
"""Of the springs without load, in m: the force of the tyre leaves the suspensions near the middle of their travel."""

# x forward, y left, z up, in m: pivots on the chassis, joints on the upright, the contact, and the ends of the spring.
LOWER, UPPER, RACK = (0.0, 0.35, 0.2), (0.0, 0.40, 0.45), (-0.12, 0.36, 0.26)
LOWER_BALL, UPPER_BALL, ROD_BALL = (0.01, 0.70, 0.19), (-0.01, 0.66, 0.47), (-0.12, 0.68, 0.25)
CONTACT, SPRING_TOP = (0.0, 0.76, 0.0), (0.0, 0.42, 0.60)
STRUT_TOP = (-0.02, 0.55, 0.80)


def away(a: Sequence[float], b: Sequence[float]) -> tuple[float, ...]:
    return tuple(round(x - y, 12) for x, y in zip(a, b, strict=True))


@dataclass(frozen=True)
class Suspension:
    """A suspension: its mechanism, equations with a vertical force F at the contact, and what the spring is."""

    mechanism: Mechanism
    equations: Equations
    length: Expr
    contact: tuple[Expr, ...]
    travel: Expr
    """The coordinate of the lower arm."""


def upright_and_rod() -> tuple[Link, Link, Link]:
    upright = Link("upright", 20.0, 0.3, 0.3, 0.2, center=away((0, 0.7, 0.3), LOWER_BALL))
    rod = Link("tie_rod", 1.0, 0.01, 0.001, 0.01, center=(0, 0.16, 0))
    arm = Link("lower_arm", 4.0, 0.05, 0.02, 0.06, center=(0, 0.2, 0))
    return upright, rod, arm


def steering(upright: Link, rod: Link) -> list:
    return [
        universal("rack", ground, rod, at=RACK, axes="XZ"),
        spherical("rod_end", upright, rod, at=away(ROD_BALL, LOWER_BALL), to=away(ROD_BALL, RACK), loop=True),
    ]


def sprung(kind: str, mechanism: Mechanism, top: tuple, on: str, at: tuple) -> Suspension:
    """Return the suspension with a spring between a point of a body and the chassis, without weight."""
    end = mechanism.point(on, *at)
    line = project(end, ground).coordinates
    gap = [a - b for a, b in zip(top, line, strict=True)]
    length = sqrt(sum(x**2 for x in gap))
    pull = [STIFFNESS * (length - LENGTHS[kind]) / length * x for x in gap]
    contact = mechanism.point("upright", *away(CONTACT, LOWER_BALL))
    loads = [
        Force(ground, *pull, at=end, on=mechanism.body(on), name="spring"),
        Force(ground, 0, 0, F, at=contact, on=mechanism.body("upright"), name="tyre"),
    ]
    equations = newton_euler(mechanism.system(loads))
    places = project(contact, ground).coordinates
    return Suspension(mechanism, equations, length, places, mechanism.coordinates[0])


def double_wishbone() -> Suspension:
    upright, rod, lower = upright_and_rod()
    upper = Link("upper_arm", 3.0, 0.03, 0.01, 0.04, center=(0, 0.13, 0))
    joints = [
        revolute("lower", ground, lower, at=LOWER, axis="X"),
        spherical("lower_ball", lower, upright, at=away(LOWER_BALL, LOWER)),
        revolute("upper", ground, upper, at=UPPER, axis="X"),
        *steering(upright, rod),
        spherical(
            "upper_ball",
            upper,
            upright,
            at=away(UPPER_BALL, UPPER),
            to=away(UPPER_BALL, LOWER_BALL),
            loop=True,
        ),
    ]
    return sprung("double wishbone", assemble(joints), SPRING_TOP, "lower_arm", (0, 0.25, 0))


def macpherson() -> Suspension:
    """The tube of the strut is part of the upright; its piston hangs on the tower and doesn't spin there."""
    upright, rod, lower = upright_and_rod()
    piston = Link("piston", 2.0, 0.02, 0.02, 0.002, center=(0, 0, -0.15))
    x, y, z = away(STRUT_TOP, LOWER_BALL)
    tilt = rotate("X", -float(np.arctan2(y, z))) * rotate("Y", float(np.arctan2(x, np.hypot(y, z))))
    along = tilt * translate(0, 0, float(np.linalg.norm([x, y, z])))
    joints = [
        revolute("lower", ground, lower, at=LOWER, axis="X"),
        spherical("lower_ball", lower, upright, at=away(LOWER_BALL, LOWER)),
        *steering(upright, rod),
        cylindrical("tube", upright, piston, at=along, axis="Z"),
        universal("tower", ground, piston, at=STRUT_TOP, axes="XY", loop=True),
    ]
    return sprung("MacPherson", assemble(joints), STRUT_TOP, "upright", (0, 0, 0))


SUSPENSIONS = {"double wishbone": double_wishbone, "MacPherson": macpherson}


def points_by_hand(kind: str, angle: float, guess: Array) -> Array:
    """Return the points of the upright at an angle of the lower arm, by lengths: balls, rod end and contact."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = away(LOWER_BALL, LOWER)
    ball = np.add(LOWER, [x, c * y - s * z, s * y + c * z])
    names = [LOWER_BALL, UPPER_BALL if kind == "double wishbone" else STRUT_TOP, ROD_BALL, CONTACT]
    given = np.array(names)

    def off(unknown: Array) -> Array:
        others = unknown.reshape(3, 3)
        moved = np.vstack([ball, others])
        pairs = [(i, j) for i in range(4) for j in range(i)]
        if (
            kind == "MacPherson"
        ):  # the line of the strut goes through the tower: the second point slides along it
            arm = moved[1] - moved[0]
            line = np.cross(arm, np.array(STRUT_TOP) - moved[0])
            held = [line @ line * 1e3, *line * 1e2]
        else:
            held = [
                np.linalg.norm(moved[1] - UPPER) - np.linalg.norm(given[1] - UPPER),
                moved[1][0] - given[1][0],
            ]
        rod = np.linalg.norm(moved[2] - RACK) - np.linalg.norm(given[2] - RACK)
        rigid = [np.linalg.norm(moved[i] - moved[j]) - np.linalg.norm(given[i] - given[j]) for i, j in pairs]
        return np.array([*rigid, *held, rod])

    found = least_squares(off, guess, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert np.abs(found.fun).max() < 1e-9
    return np.vstack([ball, found.x.reshape(3, 3)])


@pytest.fixture(scope="module", params=SUSPENSIONS)
def suspension(request: pytest.FixtureRequest) -> tuple[str, Suspension]:
    return request.param, SUSPENSIONS[request.param]()


def test_it_has_one_freedom_and_moves_through_its_travel(suspension: tuple[str, Suspension]) -> None:
    kind, made = suspension
    freedoms = len(made.mechanism.coordinates) - len(made.mechanism.constraints)
    assert freedoms == 1
    guess = np.array([UPPER_BALL if kind == "double wishbone" else STRUT_TOP, ROD_BALL, CONTACT]).ravel()
    state = dict.fromkeys(made.mechanism.coordinates, 0.0)
    for angle in np.linspace(0, 0.25, 6):
        near = {q: value for q, value in state.items() if q != made.travel}
        state = consistent_state(made.equations, {F: 0.0}, {made.travel: angle}, guess=near)
        state = {q: state[q] for q in made.mechanism.coordinates}
        places = points_by_hand(kind, angle, guess)
        guess = places[1:].ravel()
        contact = [c.evaluate(state) for c in made.contact]
        np.testing.assert_allclose(contact, places[3], atol=1e-8)


def test_the_wheel_rate(suspension: tuple[str, Suspension]) -> None:
    kind, made = suspension
    rest = dict.fromkeys(made.mechanism.coordinates, 0.01)
    heights, forces = [], np.array([2990.0, 3000.0, 3010.0])
    for force in forces:
        found = equilibrium(made.equations, {F: force}, guess=rest)
        rest = dict(found.coordinates)
        heights.append(made.contact[2].evaluate(rest))
    rate = (forces[2] - forces[0]) / (heights[2] - heights[0])
    step, angle = 1e-3, rest[made.travel]
    assert abs(angle) < 0.2
    guess = np.array([UPPER_BALL if kind == "double wishbone" else STRUT_TOP, ROD_BALL, CONTACT]).ravel()
    z, U = [], []
    for each in np.linspace(0, angle, 5):
        guess = points_by_hand(kind, each, guess)[1:].ravel()
    for each in angle + step * np.arange(-2, 3):
        places = points_by_hand(kind, each, guess)
        guess = places[1:].ravel()
        end = places[0]
        if kind == "double wishbone":
            end = np.add(LOWER, [0, 0.25 * np.cos(each), 0.25 * np.sin(each)])
            length = np.linalg.norm(np.array(SPRING_TOP) - end)
        else:
            length = np.linalg.norm(np.array(STRUT_TOP) - end)
        z.append(places[3][2])
        U.append(STIFFNESS * (length - LENGTHS[kind]) ** 2 / 2)
    slopes = np.diff(U) / np.diff(z)
    middle = (np.array(z[1:]) + np.array(z[:-1])) / 2
    by_hand = np.polyfit(middle, slopes, 2)
    at = heights[1]
    assert np.polyval(by_hand, at) == pytest.approx(3000.0, rel=1e-4)
    assert np.polyval(np.polyder(by_hand), at) == pytest.approx(rate, rel=2e-3)


def test_the_forces_of_the_joints_hold_the_wheel(suspension: tuple[str, Suspension]) -> None:
    """At rest, the joints on the upright carry the force of the tyre, and the rod pulls along itself."""
    _, made = suspension
    rest = equilibrium(made.equations, {F: 3000.0}, guess=dict.fromkeys(made.mechanism.coordinates, 0.01))
    values = dict(rest.coordinates) | rest.multipliers | {F: 3000.0}
    still = dict.fromkeys((*made.equations.speeds, *made.equations.accelerations), 0.0)
    total = np.zeros(3)
    for joint in made.mechanism.joints:
        names = [str(part) for part in (joint.joint.parent, joint.joint.child)]
        if "upright" in names:
            found = reaction(made.equations, joint.joint, on="upright", frame=ground)
            total += [c.evaluate(values | still) for c in found.force.components]
    spring = next(load for load in made.equations.system.loads if load.name == "spring")
    if spring.on.name == "upright":
        total += [c.evaluate(values) for c in spring.actions[0].vector.components]
    np.testing.assert_allclose(total, [0, 0, -3000.0], atol=1e-5)
    pull = reaction(made.equations, "rod_end", on="upright", frame=ground).force
    rod = project(made.mechanism.joint("rod_end").point, ground).coordinates
    along = np.array([c.evaluate(values) for c in rod]) - RACK
    along /= np.linalg.norm(along)
    force = np.array([c.evaluate(values | still) for c in pull.components])
    np.testing.assert_allclose(force, force @ along * along, atol=1e-6)
