"""Simulated energy of random conservative systems, in all their forms: it drifts by less than 1e-9 at rtol 1e-10.

The forms have the same motion: multipliers, embedding, speeds of choice, and Hamilton's equations.
"""

from __future__ import annotations

import warnings
from random import Random

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    ModelNotice,
    Motion,
    Point,
    System,
    Vector,
    consistent_state,
    cos,
    embedded,
    functions_of_time,
    ground,
    hamilton,
    kane,
    lagrange_equations,
    newton_euler,
    number,
    project,
    rotate,
    simulate,
    sin,
    symbols,
    time_derivative,
    translate,
    velocity,
)
from tests.laws.random_speeds import by_chosen_speeds
from tests.repeated import repeated

RTOL = 1e-10
b_y = symbols("b_y")


def tree(random: Random) -> System:
    """Return an arm with a branch: three bodies with weight, by angles and a slide along a slope."""
    q = functions_of_time("q1 q2 q3")
    first = rotate(random.choice("XY"), q[0]) * translate(0, 0, -random.uniform(0.5, 1))
    second = first * rotate(random.choice("XYZ"), q[1]) * translate(random.uniform(0.3, 0.6), 0, -0.2)
    third = first * translate(random.uniform(-0.4, 0.4), q[2], 0.3 * q[2])
    bodies = [body(frame, random) for frame in (first, second, third)]
    return System(bodies, (), q, gravity=Vector(ground, 0, 1, -9.81))


def body(frame: object, random: Random) -> Body:
    inertia = [random.uniform(0.08, 0.15) for _ in range(3)]
    return Body(frame, random.uniform(0.5, 2), *inertia)  # type: ignore[arg-type]


def loop(random: Random) -> System:
    """Return the tree with a bar between its end and ground, as long as it has to be at the start."""
    free = tree(random)
    end = project(Point(free.bodies[1].frame, 0.1, 0.2, 0.1), ground).coordinates
    far = [random.uniform(0.5, 1.5) for _ in range(3)]
    square = sum(((x - h) ** 2 for x, h in zip(end, far, strict=True)), start=number(0))
    length = square.evaluate(start(free))
    return System(free.bodies, (), free.coordinates, [square - length], free.gravity)


def skate(random: Random) -> System:
    """Return the tree with a linear condition on the speeds: a body doesn't slip in one direction."""
    free = tree(random)
    sideways = velocity(free.bodies[1].center_of_mass).projected(free.bodies[1].frame).components
    slip = sideways[0] + (1 + sin(free.coordinates[2]) / 2) * sideways[1]
    return System(free.bodies, (), free.coordinates, [slip], free.gravity)


KINDS = {"tree": tree, "loop": loop, "skate": skate}


def start(system: System) -> dict[Expr, float]:
    return {q: 0.3 + 0.2 * k for k, q in enumerate(system.coordinates)}


def motion(equations: Equations, state: dict[Expr, float]) -> Motion:
    values = {name: 0.4 for name in equations.parameters if name == b_y}
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelNotice)
        return simulate(equations, values, state, np.linspace(0, 1, 6), rtol=RTOL, atol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [0, *repeated([1, 2])])
def test_all_forms_keep_the_energy_and_have_the_same_motion(seed: int, kind: str) -> None:
    system = KINDS[kind](Random(seed))
    plain = newton_euler(system)
    guess = {speed: 0.5 + k for k, speed in enumerate(plain.speeds)}
    state = consistent_state(plain, {}, start(system), guess=guess)
    chosen = by_chosen_speeds(system, Random(seed), defined=seed % 2 == 1, drift=False)
    forms = [
        plain,
        lagrange_equations(chosen),
        hamilton(system).equations,
        hamilton(chosen).equations,
    ]
    if system.constraints:
        forms += [embedded(kane(system)), embedded(kane(chosen))]
    reference, *others = (motion(form, state if form is plain else starting(form, state)) for form in forms)
    assert reference.energy_drift < 1e-9
    assert max(np.ptp(reference[q]) for q in system.coordinates) > 0.1
    for other in others:
        assert other.energy_drift < 1e-9
        for q in system.coordinates:
            assert_allclose(other[q], reference[q], rtol=0, atol=1e-7)


def starting(form: Equations, state: dict[Expr, float]) -> dict[Expr, float]:
    """Return a state by coordinates and their rates, which all forms take."""
    rates = [time_derivative(q) for q in form.coordinates]
    return {name: state[name] for name in (*form.coordinates, *rates)}


def test_nonholonomic_speeds_keep_the_energy() -> None:
    """The disc that rolls, in three speeds for five coordinates [Neimark & Fufaev 1972], also by its momenta."""
    x, y, psi, lean, phi, u1, u2, u3 = functions_of_time("x y psi lean phi u1 u2 u3")
    m, r = 2.0, 0.4
    frame = translate(x, y, 0) * rotate("Z", psi) * rotate("X", lean) * translate(0, 0, r) * rotate("Y", phi)
    disc = Body(frame, m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    d = time_derivative
    turning = {u1: d(lean), u2: d(phi) + d(psi) * sin(lean), u3: d(psi) * cos(lean)}
    rolling = {d(x): r * d(phi) * cos(psi), d(y): r * d(phi) * sin(psi)}
    system = System(
        [disc], (), [x, y, psi, lean, phi], gravity=Vector(ground, 0, 0, -9.81), kinematics=turning | rolling
    )
    begin = {lean: 0.2, d(phi): 3.0, d(psi): 0.5, d(lean): 0.1}
    one = motion(kane(system), begin)
    two = motion(hamilton(system).equations, begin)
    assert one.energy_drift < 1e-9
    assert two.energy_drift < 1e-9
    for q in system.coordinates:
        assert_allclose(two[q], one[q], rtol=0, atol=1e-8)
