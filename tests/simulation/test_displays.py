"""What a notebook shows of systems, loads, bodies, costs, equilibria and motions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree

import pytest

import symbody as sb
from symbody.symbolic.expression.html_table import html_table

x, y, (m, k, l, g) = sb.functions_of_time("x"), sb.functions_of_time("y"), sb.symbols("m k l g")
CART = sb.Body(sb.translate(x, 0, 0), m, name="cart <1>")
BOB = sb.Body(sb.translate(x, y, 0), m)
SPRING = sb.Force(sb.ground, -k * x, 0, 0, at=CART.center_of_mass, on=CART, reaction=BOB, name="spring")
GRAVITY = sb.Vector(sb.ground, 0, -g, 0)
SYSTEM = sb.System([CART, BOB], [SPRING], [x, y], [x - 2 * y], GRAVITY, name="pair")
OSCILLATOR = sb.newton_euler(
    sb.System([CART], [sb.Force(sb.ground, -k * x, 0, 0, at=CART.center_of_mass, on=CART)], coordinates=[x])
)
SHOWN: dict[str, Callable[[], Any]] = {
    "System": lambda: SYSTEM,
    "Force": lambda: SPRING,
    "Torque": lambda: sb.Torque(sb.ground, 0, 0, k, on=CART),
    "Cost": lambda: sb.cost(SYSTEM.gravity.components if SYSTEM.gravity else ()),
    "Equilibrium": lambda: sb.equilibrium(OSCILLATOR, {m: 1, k: 4}),
    "Motion": lambda: sb.simulate(OSCILLATOR, {m: 1, k: 4}, {x: 0.1}, t=(0, 1)),
}


def cells(thing: Any) -> list[list[str]]:
    """The cells of the tables, as a reader of XML finds them."""
    root = ElementTree.fromstring(f"<div>{thing._repr_html_()}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]


@pytest.mark.parametrize("kind", SHOWN)
def test_tables_are_well_formed(kind: str) -> None:
    rows = cells(SHOWN[kind]())
    assert len(rows) > 1
    assert all(rows)


def test_a_system_shows_what_it_consists_of() -> None:
    rows = cells(SYSTEM)
    assert ["cart <1>", "translate(x, 0, 0)", "m", "0, 0, 0"] in rows
    assert ["Body 2", "translate(x, y, 0)", "m", "0, 0, 0"] in rows
    assert ["spring", f"cart <1>, {BOB}"] in rows
    assert [row for row in rows if row[0] == "coordinate"] == [["coordinate", "x"], ["coordinate", "y"]]
    assert ["x - 2*y = 0", "lambda1"] in rows


def test_a_force_shows_its_reaction() -> None:
    assert [row[:2] for row in cells(SPRING)] == [
        ["kind", "components"],
        ["force", "-k*x, 0, 0"],
        ["force", "k*x, 0, 0"],
    ]


def test_a_motion_shows_its_range() -> None:
    rows = cells(SHOWN["Motion"]())
    assert rows[1][:2] == ["x", "0.1"]
    assert float(rows[1][2]) < float(rows[1][3]) == 0.1


def test_a_body_is_a_formula() -> None:
    assert r"\text{inertia}" in CART._repr_latex_()


def test_long_tables_and_texts_are_shortened() -> None:
    table = html_table("many", ["number"], [[n] for n in range(100)])
    assert table.count("<tr>") == 32
    assert "and 70 more" in table
    many = [sb.Body(sb.translate(x, n, 0), m) for n in range(1, 101)]
    assert len(sb.System(many, coordinates=[x])._repr_html_()) < 20_000
