"""Loads that depend on accelerations: their share stands in the mass matrix, whatever the formalism."""

from __future__ import annotations

from random import Random

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Frame,
    System,
    Torque,
    Vector,
    functions_of_time,
    gibbs_appell,
    ground,
    jacobian,
    kane,
    lagrange_equations,
    newton_euler,
    number,
    rotate,
    symbols,
    time_derivative,
    translate,
)
from symbody.errors import ModelNotice
from tests.laws.random_system import random_system
from tests.repeated import repeated

FORMALISMS = [newton_euler, lagrange_equations, kane, gibbs_appell]
a, m, k = symbols("a m k")
r, q = functions_of_time("r q")


def pushed(seed: int) -> System:
    """Return a random system whose bodies are also held back in proportion to accelerations."""
    system = random_system(seed, loads=1)
    random = Random(seed)
    loads = list(system.loads)
    for body in system.bodies[:2]:
        size = [a * time_derivative(random.choice(system.coordinates), 2), number(0), k]
        vector = Vector(random.choice([ground, body.frame]), *random.sample(size, 3))
        loads += [Force(vector, at=body.center_of_mass, on=body), Torque(vector, on=body)]
    return System(system.bodies, loads, system.coordinates, gravity=system.gravity)


def inertia(equations: Equations) -> list[Expr]:
    n = len(equations.coordinates)
    M, accelerations = equations.mass_matrix, equations.accelerations
    return [sum((M[i, j] * accelerations[j] for j in range(n)), start=number(0)) for i in range(n)]


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("seed", [*range(4), *repeated(range(4, 12))])
def test_the_parts_make_the_residuals(formalism: type, seed: int) -> None:
    equations = formalism(pushed(seed))
    for residual, first, second in zip(equations.residuals, inertia(equations), equations.bias, strict=True):
        assert residual == first + second
    at_rest = dict.fromkeys(equations.accelerations, 0)
    assert tuple(residual.subs(at_rest) for residual in equations.residuals) == equations.bias
    assert jacobian(equations.residuals, equations.accelerations) == equations.mass_matrix


@pytest.mark.parametrize("seed", [*range(4), *repeated(range(4, 12))])
def test_both_formalisms_give_the_same_nodes(seed: int) -> None:
    one, two = newton_euler(pushed(seed)), lagrange_equations(pushed(seed))
    for left, right in (
        (one.residuals, two.residuals),
        (one.bias, two.bias),
        (one.mass_matrix.entries, two.mass_matrix.entries),
    ):
        assert [x.id for x in left] == [x.id for x in right]


@pytest.mark.parametrize("formalism", FORMALISMS)
def test_a_body_in_a_fluid(formalism: type) -> None:
    """(m + a) r'' - m r q'^2 along a turning tube."""
    tube = rotate("Z", q) * translate(r, 0, 0)
    body = Body(tube, m)
    fluid = Force(tube, -a * time_derivative(r, 2), 0, 0, at=body.center_of_mass, on=body)
    equations = formalism(System([body], [fluid], [q, r]))
    assert equations.mass_matrix.tolist() == [[m * r**2, 0], [0, m + a]]
    assert equations.bias[1] == -m * r * time_derivative(q) ** 2


def test_natural_coordinates() -> None:
    x, y, u, v = functions_of_time("x y u v")
    rod = Frame([[u, -v, 0, x], [v, u, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])
    body = Body(rod, m)
    fluid = Force(ground, -a * time_derivative(x, 2), 0, 0, at=body.center_of_mass, on=body)
    equations = lagrange_equations(System([body], [fluid], [x, y, u, v], [u**2 + v**2 - 1]))
    assert equations.mass_matrix[0, 0] == m + a
    assert equations.mass_matrix[1, 1] == m


@pytest.mark.parametrize("formalism", FORMALISMS)
def test_only_what_acts_in_the_system_counts(formalism: type) -> None:
    body, outside = Body(translate(r, 0, 0), m), Body(translate(r, q, 0), m)
    fluid = Force(ground, -a * time_derivative(r, 2), 0, 0, at=body.center_of_mass, on=body, reaction=outside)
    with pytest.warns(ModelNotice, match="System: .* acts on .*, none of its bodies, which is left out"):
        system = System([body], [fluid], [r])
    assert formalism(system).mass_matrix.tolist() == [[m + a]]
