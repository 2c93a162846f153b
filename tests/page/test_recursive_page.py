"""Equations that are too long term by term are written as a recursion, by quantities whose names tell what they are."""

from __future__ import annotations

import re
from html import unescape

import pytest

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Torque,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    parse,
    rotate,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.dynamics.display.known_terms import KnownTerms
from symbody.dynamics.display.recursion import Recursion
from symbody.dynamics.display.recursive_page import LINES
from symbody.models import bicycle, bricard_mechanism
from symbody.symbolic import Expr, free_symbols, substitute

g = symbols("g")


def arm(axes: str, *, driven: bool = False) -> Equations:
    """Return the equations of an arm of general bodies."""
    q = functions_of_time([f"q{i}" for i in range(len(axes))])
    frame, bodies, drives = ground, list[Body](), list[Torque]()
    for i, axis in enumerate(axes):
        l, b, m, Ix, Iy, Iz = symbols(f"l{i} b{i} m{i} Ix{i} Iy{i} Iz{i}")
        frame = frame * rotate(axis, q[i])
        bodies.append(Body(Point(frame, b, 0, 0), m, Ix, Iy, Iz))
        if driven:
            torque = [functions_of_time(f"tau{i}") * int(axis == each) for each in "XYZ"]
            drives.append(Torque(frame, *torque, on=bodies[-1], reaction=bodies[-2] if i else None))
        frame = frame * translate(l, 0, 0)
    return newton_euler(System(bodies, drives, list(q), gravity=Vector(ground, 0, 0, -g)))


def rows_of(text: str) -> list[str]:
    """Return the formulas of a description without its title, legend and advice."""
    rows = [" ".join(row.split()) for row in re.split(r"\n    (?! )", text)[1:]]
    return [row for row in rows if " := " in row or " = " in row]


def values_of(text: str, equations: Equations) -> dict[str, list[Expr]]:
    """Return the left minus the right sides of the rows of a description by their labels."""
    unknowns = (*equations.accelerations, *equations.speeds, *equations.system.multipliers)
    names = {str(leaf): leaf for leaf in (*equations.system.leaves, *unknowns)}
    found = dict[str, list[Expr]]()
    for row in rows_of(text):
        if " := " in row:
            name, value = row.split(" := ")
            names[name] = parse(value, names)
        else:
            label, _, sides = row.rpartition(": ")
            left, right = (parse(side, names) for side in sides.split(" = "))
            found.setdefault(label, []).append(left - right)
    return found


@pytest.mark.parametrize(
    "equations",
    [arm("ZYZYZYZ", driven=True), newton_euler(bricard_mechanism().system), newton_euler(bicycle().system)],
    ids=["arm", "loop", "bicycle"],
)
def test_the_rows_are_the_equations(equations: Equations) -> None:
    text = equations.description()
    assert equations.is_readable
    assert text.count("\n") <= LINES
    assert max(map(len, text.splitlines())) <= 110
    found = values_of(text, equations)
    for coordinate, residual in zip(equations.coordinates, equations.residuals, strict=True):
        (value,) = found[f"equation of {coordinate}"]
        assert value in {residual, -residual}
    for each, condition in zip(equations.system.conditions, equations.constraints, strict=True):
        assert found[each.label] == [condition]


def test_each_name_tells_what_the_quantity_is() -> None:
    """The scale of mass, length or time changes a quantity by the powers in its unit, as the legend says."""
    equations = arm("ZYXZYX")
    system, text = equations.system, equations.description()
    assert text.splitlines()[1] == (
        "    w: angular velocities; alpha: angular accelerations; a: accelerations less that of gravity; f: forces"
    )
    assert text.splitlines()[2] == ("    n: torques; W: products of angular velocities")
    found = Recursion(system, equations.residuals)
    masses = {leaf: 2 * leaf for leaf in system.leaves if leaf.name[0] in "mI"}
    lengths = {
        leaf: (4 if leaf.name[0] == "I" else 2) * leaf for leaf in system.leaves if leaf.name[0] in "lbIg"
    }
    powers = {"w": (1, 1), "alpha": (1, 1), "W": (1, 1), "a": (1, 2), "f": (2, 2), "n": (2, 4)}
    for name, quantity in zip(found.names, (each.value for each in found._quantities), strict=True):
        by_mass, by_length = (substitute([quantity], each)[0] for each in (masses, lengths))
        assert (by_mass, by_length) == tuple(k * quantity for k in powers[name.name.rstrip("0123456789")]), (
            name
        )


def test_given_torques_are_on_the_right() -> None:
    """Also about parallel axes, where the torque of the next joint cancels."""
    rows = rows_of(arm("ZYYZYX", driven=True).description())
    assert all(row.endswith(f" = tau{k}") for k, row in enumerate(rows[-6:]))
    assert not any("tau" in row.rpartition(" = ")[0] for row in rows)


def test_the_acceleration_of_a_row_has_a_positive_coefficient() -> None:
    equations = arm("ZYZYZYZ")
    texts = [
        equations.description(),
        *(equations.equation_of(q).description() for q in equations.coordinates),
    ]
    rows = [row for text in texts for row in rows_of(text) if " := " not in row]
    assert any("q1''" in row for row in rows)
    assert not [row for row in rows for k in range(7) if re.search(rf"- ([\w*]+|\([^()]*\))\*q{k}''", row)]


@pytest.mark.parametrize("axes", ["ZYZYZYZ", "ZYYZYX"])
def test_each_name_is_used(axes: str) -> None:
    """Each is defined once and occurs elsewhere; terms that are a quantity are its name."""
    equations = arm(axes, driven=True)
    found = Recursion(equations.system, equations.residuals)
    leaves = free_symbols([*found.values, *found.terms])
    assert {*found.names} <= leaves
    known = KnownTerms()
    for name, value in zip(found.names, found.values, strict=True):
        assert known.rewritten(value) == value
        known.add(name, value)


@pytest.mark.parametrize("driven", [False, True])
def test_the_rows_have_the_sign_of_their_inertia(driven: bool) -> None:
    """Also those that are one moment, ``n1 = tau6``."""
    equations = arm("ZYZYZYZ", driven=driven)
    found = values_of(equations.description(), equations)
    assert [*found.values()] == [[each] for each in equations.residuals]
    assert not [row for row in rows_of(equations.description()) if ": -" in row]


def test_one_equation_has_the_quantities_that_it_needs() -> None:
    equations = arm("ZYZYZYZ")
    for k in (3, 6):
        page = equations.equation_of(equations.coordinates[k])
        (value,) = values_of(page.description(), equations)[""]
        assert value in {equations.residuals[k], -equations.residuals[k]}
    assert len(page.texts) < 40


def test_a_letter_of_the_model_stands_for_nothing_else() -> None:
    """The links have lengths a1 and a2 and torques n1: accelerations are A1, torques N1."""
    q, frame, bodies = functions_of_time("w1:5"), ground, []
    for i, axis in enumerate("ZYZY"):
        a, b, m, Ix, Iy, Iz = symbols(f"a{i} b{i} f{i} Ix{i} Iy{i} Iz{i}")
        frame = frame * rotate(axis, q[i])
        bodies.append(Body(Point(frame, b, 0, 0), m, Ix, Iy, Iz))
        frame = frame * translate(a, 0, 0)
    equations = newton_euler(System(bodies, [], [*q], gravity=Vector(ground, 0, 0, -g)))
    legend = "; ".join(line.strip() for line in equations.description().splitlines()[1:3])
    assert legend.split(": ")[0] == "omega"
    assert "; A: accelerations less that of gravity; F: forces; n: torques" in legend
    defined = {row.split(" := ")[0] for row in rows_of(equations.description()) if " := " in row}
    assert not defined & {leaf.name for leaf in equations.system.leaves}


def test_latex_has_the_same_quantities() -> None:
    equations = arm("ZYZY")
    text, latex = equations.description(), equations.latex()
    names = re.findall(r"^    (\w+) :=", text, re.MULTILINE)
    assert len(names) > 20
    for name in names:
        letter, number = re.fullmatch(r"([a-zA-Z]+)(\d+)", name).groups()
        assert f"{chr(92) + letter if len(letter) > 1 else letter}_{{{number}}} &= " in latex
    assert r"&w\colon \text{angular velocities};\; \alpha\colon \text{angular accelerations}" in latex
    assert time_derivative(equations.speeds[3]) in equations.accelerations


def test_a_notebook_shows_it_in_a_box_that_is_scrolled() -> None:
    equations = arm("ZYXZYX")
    html = equations._repr_html_()
    assert equations._repr_latex_() is None
    assert html is not None
    assert "overflow: auto" in html
    assert unescape(re.sub("<[^>]*>", "", html)) == equations.description()


def test_an_arm_with_a_drive_at_a_given_speed_has_the_same_kinds_of_quantities() -> None:
    q, frame, bodies = [*functions_of_time("q1:7")], ground, list[Body]()
    for i, (axis, angle) in enumerate(zip("ZYZYZY", [symbols("Omega") * t, *q[1:]], strict=True)):
        l, b, m, Ix, Iy, Iz = symbols(f"l{i} b{i} m{i} Ix{i} Iy{i} Iz{i}")
        frame = frame * rotate(axis, angle)
        bodies.append(Body(Point(frame, b, 0, 0), m, Ix, Iy, Iz))
        frame = frame * translate(l, 0, 0)
    equations = newton_euler(System(bodies, [], q[1:], gravity=Vector(ground, 0, 0, -g)))
    lines = equations.description().splitlines()
    assert lines[1].startswith("    w: angular velocities; alpha: angular accelerations;")
    assert "other quantities" not in lines[1] + lines[2]


def test_its_names_are_no_namesakes_of_those_of_the_user() -> None:
    """A notice would be an error here."""
    symbols("w1 alpha1 a1 f1 n1")
    assert "w1 := " in arm("ZYXZYX").description()
