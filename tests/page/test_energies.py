"""Kinetic energies read alike by themselves and in reports: one coefficient for each product of speeds."""

from __future__ import annotations

from itertools import combinations_with_replacement

import pytest

from symbody import (
    Body,
    Expr,
    Frame,
    System,
    diff,
    functions_of_time,
    kinetic_energy,
    newton_euler,
    readable,
    rotate,
    symbols,
    time_derivative,
    translate,
)
from symbody.document.sections.energies import energies
from symbody.document.subject import Subject
from symbody.symbolic.calculus.reading import awkward_terms
from symbody.symbolic.calculus.shown_form import shown_form
from symbody.symbolic.calculus.summands import summands

q1, q2, q3, x, y = functions_of_time("q1 q2 q3 x y")
m1, m2, m3, l1, l2, c1, c2, c3, I1, I2, I3 = symbols("m1 m2 m3 l1 l2 c1 c2 c3 I1 I2 I3")


def links(root: Frame, *, is_turned_back: bool = False) -> list[Body]:
    elbow = root * rotate("Z", q1) * translate(l1, 0, 0)
    wrist = elbow * rotate("Z", q2 - q1 if is_turned_back else q2)
    return [Body(elbow * translate(c1 - l1, 0, 0), m1, Iz=I1), Body(wrist * translate(c2, 0, 0), m2, Iz=I2)]


def spatial() -> list[Body]:
    fore = rotate("Z", q1) * rotate("Y", q2) * translate(l1, 0, 0)
    hand = fore * rotate("Y", q3) * translate(c3, 0, 0)
    return [Body(fore * translate(c2, 0, 0), m2, I1, I2, I3), Body(hand, m3)]


MODELS: dict[str, tuple[list[Body], list[Expr]]] = {
    "two links": (links(rotate("Z", 0)), [q1, q2]),
    "two links on a cart": ([*links(translate(x, 0, 0)), Body(translate(x, 0, 0), m3)], [x, q1, q2]),
    "two links on a hull": (links(translate(x, y, 0) * rotate("Z", q3)), [x, y, q3, q1, q2]),
    "absolute angles": (links(translate(x, 0, 0), is_turned_back=True), [x, q1, q2]),
    "an arm in space": (spatial(), [q1, q2, q3]),
}


@pytest.mark.parametrize("name", MODELS)
def test_each_product_of_speeds_occurs_once(name: str) -> None:
    bodies, coordinates = MODELS[name]
    T = kinetic_energy(System(bodies, coordinates=coordinates))
    found = readable(T)
    assert found == T
    assert shown_form(T).same_form(found)
    for p, q in combinations_with_replacement(map(time_derivative, coordinates), 2):
        terms = [term for term in summands(found) if not diff(diff(term, p), q).is_zero]
        assert len(terms) <= 1, (p, q)


@pytest.mark.parametrize("name", MODELS)
def test_an_entry_by_itself_has_flat_squares_of_lengths(name: str) -> None:
    """``J2 + m2*(c2**2 + c2*l1*cos(q2))``, which stood as ``J2 + c2*m2*(c2 + l1*cos(q2))``."""
    bodies, coordinates = MODELS[name]
    for entry in newton_euler(System(bodies, coordinates=coordinates)).mass_matrix.entries:
        found = readable(entry)
        assert found == entry
        assert awkward_terms(found) == 0


def test_a_report_has_the_same_terms() -> None:
    bodies, coordinates = MODELS["two links"]
    system = System(bodies, coordinates=coordinates)
    block = str(energies(Subject(newton_euler(system), None, {}, {}, {})))
    assert "I_{1} + I_{2}" in block
    assert str(readable(kinetic_energy(system))) == (
        "(I2 + m2*c2**2)*q2'**2/2 + (I1 + I2 + m1*c1**2 + m2*(c2**2 + l1**2 + 2*c2*l1*cos(q2)))*q1'**2/2"
        " + (I2 + m2*(c2**2 + c2*l1*cos(q2)))*q1'*q2'"
    )


def test_what_a_person_wrote_stays() -> None:
    """Squares of sums of speeds, as books print them, are not multiplied out."""
    u, v, w = map(time_derivative, (x, q1, q2))
    for energy in (m1 * (u + l1 * v) ** 2 / 2, I1 * v**2 / 2 + (I2 + m2 * c2**2) * (v + w) ** 2 / 2):
        assert shown_form(energy).same_form(energy)
