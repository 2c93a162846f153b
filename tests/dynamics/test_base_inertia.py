"""Inertias that are numbers go where they cost least, and no equation changes."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    Expr,
    Point,
    System,
    Vector,
    cost,
    forward_dynamics,
    functions_of_time,
    gradient,
    gravitational_energy,
    ground,
    jacobian,
    kinetic_energy,
    lagrange,
    lambdify,
    newton_euler,
    number,
    rotate,
    translate,
)
from symbody.dynamics.inertia.base_inertia import BaseInertias, base_inertias
from symbody.dynamics.inertia.composite import Composite
from symbody.dynamics.tree.frame_tree import frame_tree
from symbody.symbolic import derivation
from tests.dynamics.models import chain
from tests.laws.random_system import random_system
from tests.reference.robot import robot
from tests.repeated import repeated


def regrouped(system: System, *, particles: bool = False) -> BaseInertias:
    with derivation():
        return base_inertias(system, frame_tree(system), particles=particles)


def parameters(body: Composite) -> list[Expr]:
    """Return the ten inertial parameters."""
    return [body.mass, *body.moment, *body.second_moments, *body.inertia[3:]]


@pytest.mark.parametrize("seed", [*range(20), *repeated(range(20, 40))])
def test_regrouping_changes_no_equation(seed: int) -> None:
    """Against Lagrange's equations by hand, from the energies of the bodies as they were given."""
    system = random_system(seed, symbolic=False, loads=0)
    equations = newton_euler(system)
    L = kinetic_energy(system) - gravitational_energy(system)
    assert list(equations.residuals) == [lagrange(L, q) for q in system.coordinates]
    momenta = gradient(kinetic_energy(system), equations.speeds)
    assert equations.mass_matrix == jacobian(momenta, equations.speeds)


def test_the_panda_has_43_base_parameters() -> None:
    """The rank of Pinocchio's regressor at a hundred random states is 43, of 70 parameters.

    Beyond each joint but the first one 7 are left; of the first link's only the inertia about its vertical axis counts.
    """
    first, *others = (body for _, body in sorted(regrouped(robot("panda_7dof").system).composites.items()))
    assert [sum(entry != 0 for entry in parameters(body)) for body in others] == [7] * 6
    assert first.mass == 0
    assert first.inertia[2] != 0


def test_operations_of_the_panda() -> None:
    equations = newton_euler(robot("panda_7dof").system)
    assert cost(equations.residuals).total <= 562
    assert cost(equations.mass_matrix.entries).total <= 359
    assert cost(forward_dynamics(equations, method="articulated_body").accelerations).total <= 1141


@pytest.mark.parametrize(("name", "bound"), [("double_pendulum", 29), ("furuta", 55), ("gimbal_gyro", 52)])
def test_operations_of_small_robots(name: str, bound: int) -> None:
    assert cost(newton_euler(robot(name).system).residuals).total <= bound


def test_symbols_stay_where_they_are() -> None:
    system = chain(3)
    assert regrouped(system) == BaseInertias(
        [(frame_tree(system).index(body.frame), body) for body in system.bodies]
    )


def test_a_wheel_is_its_moment_of_inertia_about_the_axle() -> None:
    tilt, spin = functions_of_time("tilt spin")
    fork = translate(0, 0, 0.5) * rotate("X", tilt)
    wheel = Body(fork * rotate("Z", spin), 2, 0.25, 0.25, 0.5)
    inertias = regrouped(System([Body(fork, 1), wheel], coordinates=[tilt, spin])).composites
    outer = inertias[max(inertias)]
    assert parameters(outer)[:4] == [number(0)] * 4
    assert outer.inertia == (0, 0, number(0.5), 0, 0, 0)


def test_masses_go_to_the_origins_that_a_body_carries() -> None:
    """Point masses at the joints of a chain: what the others have is the acceleration of their own joint."""
    frame, bodies, coordinates = ground, [], []
    for k in range(3):
        coordinates.append(functions_of_time(f"q{k}"))
        frame = frame * rotate("XYZ"[k], coordinates[-1]) * translate(0.25, 0.5, 0.125)
        bodies.append(Body(frame, k + 1))
    inertias = regrouped(System(bodies, coordinates=coordinates), particles=True)
    assert not [body for body in inertias.composites.values() if body.mass != 0]
    assert len(inertias.particles) == 3


def swing(offset: float) -> System:
    """Return two links, the second one almost at the axis of the first."""
    q, r = functions_of_time("q r")
    arm = rotate("Z", q)
    bodies = [Body(Point(arm, 0.5, 0.25, 0.125), 3, 1, 1, 2), Body(Point(arm, 0, 0, 0), 1)]
    bodies.append(Body(Point(arm * translate(offset, 0, 0) * rotate("X", r), 0.1, 0.2, 0.3), 2, 1, 2, 3))
    return System(bodies, coordinates=[q, r], gravity=Vector(ground, 0, -9.81, 0))


@pytest.mark.parametrize("offset", [1e-12, 1e-3, 1])
def test_no_mass_is_so_large_that_digits_are_lost(offset: float) -> None:
    inertias = regrouped(swing(offset), particles=True)
    assert all(abs(float(taken.mass)) <= 6 for _, taken in inertias.particles)
    equations = newton_euler(swing(offset))
    variables = [*equations.coordinates, *equations.speeds, *equations.accelerations]
    state = [0.3, -1.2, 2.5, 0.7, -1.5, 0.4]
    L = kinetic_energy(swing(offset)) - gravitational_energy(swing(offset))
    plain = lambdify(variables, [lagrange(L, q) for q in equations.coordinates])(*state)
    assert np.allclose(lambdify(variables, equations.residuals)(*state), plain, rtol=1e-14, atol=1e-14)


def test_a_link_without_inertia_stays_without() -> None:
    """A free body whose angles are one after the other: nothing is left on the way."""
    *places, a, b, c = coordinates = functions_of_time("x y z a b c")
    frame = translate(*places) * rotate("Z", a) * rotate("Y", b) * rotate("X", c)
    system = System([Body(frame, 2, 1, 2, 3)], coordinates=coordinates)
    assert len(regrouped(system, particles=True).composites) == 1
