"""Solved equations over a determinant that has one form and a name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import pytest

from symbody import (
    Body,
    Expr,
    System,
    Vector,
    describe,
    forward_dynamics,
    functions_of_time,
    ground,
    hamilton,
    newton_euler,
    parse,
    rotate,
    symbols,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody.models import furuta_pendulum

x, q1, q2 = functions_of_time("x q1 q2")
M, m, l, g, J, k, c, D = symbols("M m l g J k c D")
DOWN = Vector(ground, 0, -g, 0)


def cart_pole(mass: Expr = M) -> System:
    cart = Body(translate(x, 0, 0), mass)
    pole = Body(translate(x, 0, 0) * rotate("Z", q1) * translate(0, -l, 0), m, 0, 0, J)
    return System([cart, pole], [torsion_spring(x, k, damping=c, on=cart)], [x, q1], gravity=DOWN)


def double_pendulum() -> System:
    upper = rotate("Z", q1) * translate(0, -l, 0)
    lower = upper * rotate("Z", q2) * translate(0, -k, 0)
    return System([Body(upper, M), Body(lower, m)], coordinates=[q1, q2], gravity=DOWN)


SYSTEMS = [cart_pole(), double_pendulum(), furuta_pendulum().system]


def read(text: str, leaves: Iterable[Expr]) -> dict[str, Expr]:
    """Return the right sides of a page as expressions, with the definitions put in."""
    names: dict[str, Expr] = {leaf.name: leaf for leaf in leaves}
    found = dict[str, Expr]()
    joined = " ".join(line if line.startswith("     ") else f"\n{line}" for line in text.splitlines()[1:])
    for row in joined.strip().splitlines():
        name, _, side = " ".join(row.split()).replace(" *(", "*(").replace(" /(", "/(").partition("= ")
        value = parse(side, names)
        if name.endswith(":"):
            names[name.removesuffix(" :")] = value
        else:
            found[name.strip()] = value
    return found


def leaves_of(values: Iterable[Expr]) -> set[Expr]:
    leaves = {leaf for value in values for leaf in value.free_symbols}
    return {leaf for leaf in leaves if leaf.kind == "symbol" or leaf.order == 0} | {x, q1, q2}


@pytest.mark.parametrize("system", SYSTEMS, ids=["cart-pole", "double pendulum", "Furuta"])
def test_accelerations(system: System) -> None:
    solution = forward_dynamics(newton_euler(system))
    text = describe(solution)
    leaves = {*system.coordinates, *leaves_of(solution.accelerations)}
    values = read(text, leaves)
    for q, value in zip(system.coordinates, solution.accelerations, strict=True):
        assert values[f"{q}''"] == value
    assert text.startswith(f"ACCELERATIONS of {', '.join(map(str, system.coordinates))}\n")
    assert text.count("D := ") == 1 or text.count("/(M + m*sin(q2)**2)") == 2


@pytest.mark.parametrize("system", SYSTEMS, ids=["cart-pole", "double pendulum", "Furuta"])
def test_canonical_equations(system: System) -> None:
    canonical = hamilton(system)
    text = describe(canonical)
    every = [canonical.hamiltonian, *canonical.rates.values()]
    values = read(text, {*canonical.coordinates, *canonical.momenta, *leaves_of(every)})
    rates: Mapping[Expr, Expr] = canonical.rates
    assert values["H"] == canonical.hamiltonian
    for name, value in rates.items():
        assert values[str(name)] == value
    assert text.count("D := ") == 1


def test_the_name_gives_way_to_those_of_the_model() -> None:
    solution = forward_dynamics(newton_euler(cart_pole(D)))
    assert "Delta := " in describe(solution)
    assert r"\Delta &= " in solution.latex()


@pytest.mark.parametrize("system", [SYSTEMS[0], SYSTEMS[2]], ids=["cart-pole", "Furuta"])
def test_a_determinant_is_positive(system: System) -> None:
    """It is that of a mass matrix with positive parameters, so that the signs of forces can be read off."""
    equations = newton_euler(system)
    names = {leaf.name: leaf for leaf in leaves_of(equations.mass_matrix.entries)}
    definition = describe(forward_dynamics(equations)).partition("D := ")[2].partition("'' = ")[0]
    value = parse(" ".join(definition.split()).rpartition(" ")[0], names)
    assert value == equations.mass_matrix.det()


def test_without_a_common_divisor_there_is_no_name() -> None:
    pendulum = System([Body(rotate("Z", q1) * translate(0, -l, 0), m)], coordinates=[q1], gravity=DOWN)
    assert describe(forward_dynamics(newton_euler(pendulum))).splitlines()[1:] == ["    q1'' = -g*sin(q1)/l"]
    assert time_derivative(q1, 2) != forward_dynamics(newton_euler(pendulum)).accelerations[0]
