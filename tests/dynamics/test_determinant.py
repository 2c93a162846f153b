"""Solved equations over a determinant that has one form and a name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache

import pytest

from symbody import (
    Body,
    Expr,
    ForwardDynamics,
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


def cart_pole() -> System:
    cart, pole = cart_and_pole(M)
    return System([cart, pole], [torsion_spring(x, k, damping=c, on=cart)], [x, q1], gravity=DOWN)


def cart_and_pole(mass: Expr) -> tuple[Body, Body]:
    cart = translate(x, 0, 0)
    return Body(cart, mass), Body(cart * rotate("Z", q1) * translate(0, -l, 0), m, 0, 0, J)


def double_pendulum() -> System:
    upper = rotate("Z", q1) * translate(0, -l, 0)
    lower = upper * rotate("Z", q2) * translate(0, -k, 0)
    return System([Body(upper, M), Body(lower, m)], coordinates=[q1, q2], gravity=DOWN)


SYSTEMS = [cart_pole(), double_pendulum(), furuta_pendulum().system]
NAMES = ["cart-pole", "double pendulum", "Furuta"]


@cache
def accelerations(name: str) -> tuple[ForwardDynamics, str]:
    """Return the solved equations of a system, and what is shown of them."""
    solution = forward_dynamics(newton_euler(SYSTEMS[NAMES.index(name)]))
    return solution, describe(solution)


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


@pytest.mark.parametrize("name", NAMES)
def test_accelerations(name: str) -> None:
    coordinates = SYSTEMS[NAMES.index(name)].coordinates
    solution, text = accelerations(name)
    values = read(text, {*coordinates, *leaves_of(solution.accelerations)})
    for q, value in zip(coordinates, solution.accelerations, strict=True):
        assert values[f"{q}''"] == value
    assert text.startswith(f"ACCELERATIONS of {', '.join(map(str, coordinates))}\n")
    assert text.count("D := ") == 1 or text.count("/(M + m*sin(q2)**2)") == 2


@pytest.mark.parametrize("system", SYSTEMS, ids=NAMES)
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
    solution = forward_dynamics(newton_euler(System(cart_and_pole(D), coordinates=[x, q1])))
    assert "Delta := " in describe(solution)
    assert r"\Delta &= " in solution.latex()


@pytest.mark.parametrize("name", ["cart-pole", "Furuta"])
def test_a_determinant_is_positive(name: str) -> None:
    """It is that of a mass matrix with positive parameters, so that the signs of forces can be read off."""
    mass_matrix = newton_euler(SYSTEMS[NAMES.index(name)]).mass_matrix
    names = {leaf.name: leaf for leaf in leaves_of(mass_matrix.entries)}
    definition = accelerations(name)[1].partition("D := ")[2].partition("'' = ")[0]
    value = parse(" ".join(definition.split()).rpartition(" ")[0], names)
    assert value == mass_matrix.det()


def test_without_a_common_divisor_there_is_no_name() -> None:
    pendulum = System([Body(rotate("Z", q1) * translate(0, -l, 0), m)], coordinates=[q1], gravity=DOWN)
    assert describe(forward_dynamics(newton_euler(pendulum))).splitlines()[1:] == ["    q1'' = -g*sin(q1)/l"]
    assert time_derivative(q1, 2) != forward_dynamics(newton_euler(pendulum)).accelerations[0]
