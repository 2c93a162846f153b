"""Signs of angles and the order of terms: one rule, whatever the names."""

from __future__ import annotations

import itertools
import re

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Matrix,
    System,
    Vector,
    cos,
    describe,
    functions_of_time,
    ground,
    latex,
    newton_euler,
    parse,
    readable,
    rotate,
    sin,
    symbols,
    translate,
)
from symbody.models import full_car, slider_crank

g, R, r, m, a, b, u, k = symbols("g R r m a b u k")
GRAVITY = Vector(ground, 0, -g, 0)


@pytest.mark.parametrize("names", [*itertools.permutations(["hip", "knee", "ankle"])], ids=" ".join)
def test_a_difference_of_angles_begins_with_the_first_coordinate(names: tuple[str, ...]) -> None:
    angles, frame, bodies = functions_of_time([*names]), ground, []
    for place, angle in enumerate(angles):
        before = angles[place - 1] if place else 0
        frame = frame * rotate("Z", angle - before) * translate(0, -symbols(f"l{place}"), 0)
        bodies.append(Body(frame, symbols(f"m{place}")))
    text = describe(newton_euler(System(bodies, coordinates=angles, gravity=GRAVITY)))
    found = re.findall(r"(?:sin|cos)\((\w+) - (\w+)\)", text)
    assert len(found) == 12
    assert all(names.index(first) < names.index(second) for first, second in found)


def test_no_argument_of_a_sine_begins_with_a_minus_sign() -> None:
    q = functions_of_time("q")
    disc = Body(rotate("Z", R * q / (R - r)) * translate(0, r - R, 0), m)
    text = describe(newton_euler(System([disc], coordinates=[q], gravity=GRAVITY)))
    assert "sin(R*q/(R - r))" in text
    assert "(-" not in text
    for given in (sin(-2 * q), cos(-a * q), sin(-q / a) + b):
        assert "(-" not in str(given)


def test_multipliers_stand_in_their_order_after_given_forces() -> None:
    text = " ".join(describe(newton_euler(slider_crank().system)).split())
    assert "= -F*sin(p) + sin(p)*lambda1 - cos(p)*lambda2" in text
    assert "= a*sin(q)*lambda1 - a*cos(q)*lambda2" in text


def test_a_weight_that_a_given_force_carries_is_on_no_side() -> None:
    """Tyres of the car are preloaded by the weight of their wheels."""
    text = describe(newton_euler(full_car().system))
    for row in re.split(r"\n    (?=\S)", text):
        left, equals, right = " ".join(row.split()).rpartition(" = ")
        assert not (equals and "g*mu" in left and "g*mu" in right)


DIVISORS: dict[Expr, str] = {
    b * a / u - m * u - g * k / u: "(a*b - g*k)/u - m*u",
    a / u - b / u: "(a - b)/u",
}


@pytest.mark.parametrize("given", DIVISORS, ids=str)
def test_terms_of_one_divisor_stand_over_it(given: Expr) -> None:
    form = readable(given)
    assert form == given
    assert str(form).count("/u") == 1
    assert str(readable(Matrix([[given]]))[0, 0]) == str(form)


FIXED = [a * b**2 / 2 + b**2 / r**2 + m, a * sin(u) * cos(k) + a * cos(u) * sin(k) + b * a**2 / r]


@pytest.mark.parametrize("given", FIXED, ids=str)
def test_what_is_readable_stays_as_it_is(given: Expr) -> None:
    form = readable(given)
    assert str(readable(form)) == str(form)


def test_positive_factors_stand_outside_of_absolute_values() -> None:
    """`Abs(a*b*x)/b**2` stood for `a*Abs(x)/b`."""
    (a, b), c, x = symbols("a b", positive=True), symbols("c"), functions_of_time("x")
    slider = Body(translate(x, 0, 0), 1)
    drag = Force(ground, -abs(c * a / b * x), 0, 0, at=slider.center_of_mass, on=slider)
    shown = describe(newton_euler(System([slider], [drag], [x])))
    assert shown.splitlines()[1].strip() == "x'' + a*Abs(c*x)/b = 0"


def with_holes(axes: str) -> System:
    """An arm whose links have holes: bodies of negative mass."""
    q, (M, J, e) = functions_of_time(f"q1:{len(axes) + 1}"), symbols("M J e")
    frame, bodies = ground, []
    for axis, angle in zip(axes, q, strict=True):
        frame = frame * rotate(axis, angle)
        hole = Body(frame * translate(e, 0, 0), -m, *(3 * [-m * a**2 / 2]))
        bodies += [Body(frame, M, J, J, J), hole]
        frame = frame * translate(b, 0, 0)
    return System(bodies, coordinates=q, gravity=GRAVITY)


@pytest.mark.parametrize("axes", ["Z", "ZZ", "ZYYX"])
def test_a_hole_leaves_the_coefficient_of_an_acceleration_positive(axes: str) -> None:
    equations = newton_euler(with_holes(axes))
    pages = (equations, *map(equations.equation_of, equations.system.coordinates))
    for text in map(describe, pages):
        assert not re.search(r"(^|\n) +(equation of q\d: )?-\(.*(\n.*)?- J", text)
    if axes == "Z":
        assert describe(equations).splitlines()[1].strip().startswith("(J - 1/2*m*a**2 - m*e**2)*q1''")
        inertia = r"J - \frac{1}{2} m a^{2} - m e^{2}"
        assert rf"\left({inertia}\right) \ddot{{q}}_{{1}}" in latex(equations)
        assert inertia in latex(equations.matrix_form())
        left, _, right = describe(equations).splitlines()[1].partition(" = ")
        assert parse(left) - parse(right) == equations.residuals[0]


def test_differences_of_moments_of_masses_have_one_direction() -> None:
    (theta, phi), (m_1, m_2, c) = functions_of_time("theta phi"), symbols("m_1 m_2 c")
    seat = rotate("Z", theta) * translate(0, -a, 0)
    turned = seat * rotate("Z", phi)
    rider = [Body(seat, m), Body(turned * translate(0, b, 0), m_1), Body(turned * translate(0, -c, 0), m_2)]
    equations = newton_euler(System(rider, coordinates=[theta, phi], gravity=GRAVITY))
    text, formulas = describe(equations), equations.latex()
    assert "- a*(c*m_2 - b*m_1)*sin(phi)*(2*theta'*phi' + phi'**2)" in text
    assert (text.count("c*m_2 - b*m_1"), text.count("b*m_1 - c*m_2")) == (7, 0)
    assert (formulas.count("c m_{2} - b m_{1}"), formulas.count("b m_{1} - c m_{2}")) == (7, 0)
    (rows,) = [" ".join(text.split("\n", 1)[1].split())]
    known = {str(leaf): leaf for leaf in (theta, phi, m, m_1, m_2, a, b, c, g)}
    sides = [row.strip() for row in rows.split("= 0") if row.strip()]
    assert [parse(side, known) for side in sides] == [*equations.residuals]
