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
    "Runs": lambda: sb.simulate_many(OSCILLATOR, {m: 1, k: [1, 4, 9]}, {x: [0.1, 0.2, 0.3]}, t=(0, 1)),
    "InverseDynamics": lambda: sb.inverse_dynamics(OSCILLATOR, {x: sb.t**2}, {m: 2, k: 3}, t=[0, 0.5, 1]),
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
    assert [row[:4] + row[5:] for row in rows if row[0] in {"spring", "gravity"}] == [
        ["spring", "force", "-k*x, 0, 0", "ground", "cart <1>"],
        ["spring", "force", "k*x, 0, 0", "ground", "Body 2"],
        ["gravity", "acceleration", "0, -g, 0", "ground", "all bodies"],
    ]
    assert ["coordinates", "x, y"] in rows
    assert ["", "x - 2*y = 0", "lambda1"] in rows


def test_a_system_shows_its_picture() -> None:
    """The names of the bodies are in the picture, and all of it is inside its frame."""
    svg = "{http://www.w3.org/2000/svg}"
    picture = ElementTree.fromstring(f"<div>{SYSTEM._repr_html_()}</div>").find(f"figure/{svg}svg")
    assert picture is not None
    texts = list(picture.iter(f"{svg}text"))
    assert {"x", "y", "ground", "cart <1>"} <= {text.text for text in texts}
    left, top, width, height = map(float, picture.get("viewBox", "").split())
    assert all(left <= float(text.get("x", "")) <= left + width for text in texts)
    assert all(top <= float(text.get("y", "")) <= top + height for text in texts)


def test_a_system_without_a_position_says_so() -> None:
    impossible = sb.System([BOB], coordinates=[x, y], constraints=[x**2 + y**2 + l**2])
    assert "There is no picture, because the reference position was not found." in impossible._repr_html_()


def test_long_equations_show_their_sizes() -> None:
    """A hundred carts in a row: at once, and with the first and the last ones."""
    places = sb.functions_of_time(" ".join(f"x{k}" for k in range(1, 101)))
    carts = [sb.Body(sb.translate(place, 0, 0), m) for place in places]
    pairs = zip(carts, carts[1:], places, places[1:], strict=False)
    springs = [
        sb.Force(sb.ground, k * sb.sin(q - p) ** 3, 0, 0, at=a.center_of_mass, on=a, reaction=b)
        for a, b, p, q in pairs
    ]
    equations = sb.newton_euler(sb.System(carts, springs, places))
    assert equations._repr_latex_() is None
    table = equations._repr_html_()
    assert table is not None
    rows = [
        ["".join(cell.itertext()) for cell in row]
        for row in ElementTree.fromstring(f"<div>{table}</div>").iter("tr")
    ]
    assert [row[0] for row in rows[1:]] == ["x1", "x2", "x3", "x4", "...", "x97", "x98", "x99", "x100"]
    assert rows[1][1] == str(sb.cost(equations.residuals[0]).total)
    assert OSCILLATOR._repr_html_() is None, "short equations are formulas"


def test_vectors_and_points_show_their_frames() -> None:
    turned = sb.rotate("Z", x)
    vector, point = sb.Vector(turned, l, 0, 0), sb.Point(turned, l, 0, 0, name="A_1")
    assert r'\quad \text{in the axes of rotate("Z", x)}' in vector._repr_latex_()
    assert point._repr_latex_().startswith(r"$\displaystyle \text{A}\_\text{1} = \begin{bmatrix}")
    assert r'\text{from the origin of rotate("Z", x), in its axes}' in point._repr_latex_()


def test_an_equilibrium_shows_its_stability() -> None:
    rows = [row for row in cells(SHOWN["Equilibrium"]()) if row[0] == "coordinate"]
    assert rows == [["coordinate", "x", "0"]]
    assert "Stable equilibrium" in SHOWN["Equilibrium"]()._repr_html_()
    assert "Unstable equilibrium" in sb.equilibrium(OSCILLATOR, {m: 1, k: -4})._repr_html_()


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


def test_a_batch_shows_its_cases() -> None:
    """The values that differ, and the last states, which are those of the motions of the cases."""
    runs = SHOWN["Runs"]()
    header, *rows = cells(runs)
    assert header == ["case", "k", "initial x", "last x", "last x'", "result"]
    assert [row[1:3] for row in rows] == [["1", "0.1"], ["4", "0.2"], ["9", "0.3"]]
    for case, row in enumerate(rows):
        assert float(row[3]) == pytest.approx(runs.motion(case)[x][-1], rel=1e-5)
        assert row[-1] == "completed"


def test_a_batch_shows_the_cases_that_ended_early() -> None:
    """A case that ends by an event has its last known state; one that fails has its reason."""
    stop = sb.Event(x - 1.5, terminal=True)
    push = sb.Force(sb.ground, k / x, 0, 0, at=CART.center_of_mass, on=CART)
    pushed = sb.newton_euler(sb.System([CART], [push], coordinates=[x]))
    with pytest.warns(sb.ModelNotice):
        runs = sb.simulate_many(pushed, {m: 1, k: [1, 0, -1]}, {x: 1.0}, t=(0, 3), events=[stop])
    first, second, third = cells(runs)[1:]
    assert float(first[2]) == pytest.approx(1.5, abs=0.01)
    assert first[-1] == "ended by an event"
    assert second[-1] == "completed"
    assert third[-1].startswith(runs.failures[0].message[:20])


def test_inverse_dynamics_shows_the_range_of_its_loads() -> None:
    """F = m x'' + k x with x = t^2: from 4 to 7."""
    rows = cells(SHOWN["InverseDynamics"]())
    assert rows[0] == ["quantity", "first", "least", "largest", "last"]
    assert rows[1] == ["generalised force of x", "4", "4", "7", "7"]
    assert [row[0] for row in rows[2:]] == ["x", "x'"]


def test_a_body_is_a_formula() -> None:
    assert r"\text{inertia}" in CART._repr_latex_()


def test_long_tables_and_texts_are_shortened() -> None:
    table = html_table("many", ["number"], [[n] for n in range(100)])
    assert table.count("<tr>") == 32
    assert "and 70 more" in table
    many = [sb.Body(sb.translate(x, n, 0), m) for n in range(1, 101)]
    assert len(sb.System(many, coordinates=[x])._repr_html_()) < 20_000
