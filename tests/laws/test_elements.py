"""Laws of all elements: one equation by all formalisms, and the balance of power and energy."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Element,
    Expr,
    System,
    dot,
    gravitational_energy,
    kinetic_energy,
    lambdify,
    mechanical_energy,
    newton_euler,
    number,
    power,
    project,
    velocity,
)
from symbody.symbolic import free_symbols, time_derivative
from tests.laws.random_element import DRIVING, MADE, random_element_system
from tests.laws.test_formalisms import check_same_nodes, moving_along
from tests.repeated import repeated

SEEDS = {"contact": (1, 6), "tire": (1, 2, 3, 6)}
"""Seeds whose spheres touch and whose wheels move along the road; contacts of two bodies take long to compare."""
FEW = [(kind, seed) for kind in MADE for seed in SEEDS.get(kind, range(4))[:2]]
MORE = [(kind, seed) for kind in MADE for seed in SEEDS.get(kind, range(4))[2:]]
CASES = [*FEW, *repeated(MORE)]
PASSIVE = [case for case in (*FEW, *MORE) if case[0] not in DRIVING]


def element_of(system: System) -> Element:
    (element,) = system.loads
    assert isinstance(element, Element)
    return element


@pytest.mark.parametrize(("kind", "seed"), CASES)
def test_all_formalisms_give_the_same_nodes(kind: str, seed: int) -> None:
    check_same_nodes(random_element_system(kind, seed))


@pytest.mark.parametrize(("kind", "seed"), CASES)
def test_power_is_the_rate_of_the_energy(kind: str, seed: int) -> None:
    """dE/dt - P = residuals . q', with weight by its power."""
    system = random_element_system(kind, seed)
    assert system.gravity is not None
    falls = (body.mass * dot(velocity(body.center_of_mass), system.gravity) for body in system.bodies)
    weight = sum(falls, start=number(0))
    along = moving_along(newton_euler(system))
    assert time_derivative(kinetic_energy(system)) - weight - power(element_of(system)) == along
    assert time_derivative(gravitational_energy(system)) == -weight


def losses(system: System) -> np.ndarray:
    """The power of the element plus the rate of its potential, at random states."""
    element = element_of(system)
    total = power(element)
    if element.potential is not None:
        total += time_derivative(element.potential)
    return values(total)


def values(total: Expr, count: int = 200) -> np.ndarray:
    leaves = sorted(free_symbols([total]), key=str)
    random = np.random.default_rng(1)
    drawn = [
        random.uniform(0.2, 2, count) if leaf.kind == "symbol" else random.normal(0, 1, count)
        for leaf in leaves
    ]
    return np.asarray(lambdify(leaves, total)(*drawn))


@pytest.mark.parametrize(("kind", "seed"), PASSIVE)
def test_passive_elements_take_energy_or_give_back_what_they_took(kind: str, seed: int) -> None:
    lost = losses(random_element_system(kind, seed))
    assert lost.max() <= 1e-9 * max(1, -lost.min())
    assert np.count_nonzero(lost < -1e-3) > 50  # of 200 states; spheres are above the plane in some


@pytest.mark.parametrize("kind", MADE)
def test_the_other_body_takes_the_opposite(kind: str) -> None:
    """Force and moment of an element between two bodies of a system add up to zero, seen from any point."""
    for seed in range(8):
        element = element_of(random_element_system(kind, seed))
        if len({action.body for action in element.actions}) == 1:
            continue
        ground = element.actions[0].body.frame.ancestor
        sums = [number(0)] * 6
        for action in element.actions:
            F = action.components(ground)
            if action.point is None:
                parts = (number(0),) * 3, F
            else:
                r = project(action.point, ground).coordinates
                parts = (
                    F,
                    (r[1] * F[2] - r[2] * F[1], r[2] * F[0] - r[0] * F[2], r[0] * F[1] - r[1] * F[0]),
                )
            sums = [a + b for a, b in zip(sums, (*parts[0], *parts[1]), strict=True)]
        assert all(each == 0 for each in sums)
        return
    assert kind in {"air_force", "tire"}, "no seed draws two bodies"


@pytest.mark.parametrize(
    "kind", [kind for kind in MADE if kind not in {*DRIVING, "air_force", "friction", "tire"}]
)
def test_the_mechanical_energy_holds_the_potential(kind: str) -> None:
    system = random_element_system(kind, 1)
    potential = element_of(system).potential
    assert potential is not None
    assert mechanical_energy(system) == kinetic_energy(system) + gravitational_energy(system) + potential
