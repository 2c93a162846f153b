"""Rods: each term of their inertia has one fraction in front, as `1/3*m2*l2**2 + 1/2*l1*l2*m2*cos(q2)`."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Equations,
    Point,
    System,
    Vector,
    describe,
    functions_of_time,
    ground,
    linearize,
    newton_euler,
    parse,
    rotate,
    spring,
    symbols,
    translate,
)


def rods(axes: str, *, is_absolute: bool = False, are_equal: bool = False) -> Equations:
    """A chain of rods with pins, whose angles are relative or absolute."""
    names = range(1, len(axes) + 1)
    q, g, frame, bodies = functions_of_time([f"q{k}" for k in names]), symbols("g"), ground, []
    before = [0, *q[:-1]] if is_absolute else [0] * len(q)
    for k, axis, angle, other in zip(names, axes, q, before, strict=True):
        m, l = symbols("m l" if are_equal else f"m{k} l{k}")
        frame = frame * rotate(axis, angle - other)
        bodies.append(Body(frame * translate(l / 2, 0, 0), m, 0, m * l**2 / 12, m * l**2 / 12))
        frame = frame * translate(l, 0, 0)
    return newton_euler(System(bodies, coordinates=q, gravity=Vector(ground, 0, -g, 0)))


FRACTION_BEFORE_A_SUM = re.compile(r"\d/\d+\*(?:\w+\*)*\((?=[^()]*\()[^()]*\d\*")


@pytest.mark.parametrize("axes", ["ZZ", "ZZZ", "ZYY"])
@pytest.mark.parametrize("is_absolute", [False, True], ids=["relative", "absolute"])
def test_no_fraction_stands_before_inertia_of_several_terms(axes: str, is_absolute: bool) -> None:
    equations = rods(axes, is_absolute=is_absolute)
    shown = equations.matrix_form().mass_matrix
    assert shown == equations.mass_matrix
    text = describe(equations.matrix_form()).partition("\n    c1")[0]
    assert not FRACTION_BEFORE_A_SUM.search(text)
    assert FRACTION_BEFORE_A_SUM.search("1/6*l2*m2*(2*l2 + 3*l1*cos(q2))")


def test_a_double_pendulum_of_rods_has_the_terms_of_the_book() -> None:
    """The arm of two links in Spong & Vidyasagar 1989, ch. 6, with I = m*l**2/12 and l_c = l/2."""
    inertia = describe(rods("ZZ").matrix_form())
    assert "M11 = 1/3*(m1 + 3*m2)*l1**2 + 1/3*m2*l2**2 + l1*l2*m2*cos(q2)" in inertia
    assert "M12 = M21 = 1/3*m2*l2**2 + 1/2*l1*l2*m2*cos(q2)" in inertia
    book = "m1*l1**2/4 + m2*(l1**2 + l2**2/4 + l1*l2*cos(q2)) + m1*l1**2/12 + m2*l2**2/12"
    q1, q2 = functions_of_time("q1 q2")
    assert parse(book, names={"q1": q1, "q2": q2}) == rods("ZZ").mass_matrix[0, 0]


def test_equal_rods_have_a_fraction_for_each_term_where_denominators_differ() -> None:
    equations = rods("ZZ", are_equal=True)
    assert equations.matrix_form().description().splitlines()[1:] == [
        "    M11 = 5/3*m*l**2 + m*l**2*cos(q2)",
        "    M12 = M21 = 1/3*m*l**2 + 1/2*m*l**2*cos(q2)",
        "    M22 = 1/3*m*l**2",
        "    c1 = -1/2*m*l**2*sin(q2)*(2*q1'*q2' + q2'**2)",
        "    c2 = 1/2*m*l**2*sin(q2)*q1'**2",
        "    g1 = 1/2*g*l*m*(3*cos(q1) + cos(q1 + q2))",
        "    g2 = 1/2*g*l*m*cos(q1 + q2)",
    ]
    assert equations.matrix_form().mass_matrix == equations.mass_matrix


def test_functions_with_the_same_factors_are_added() -> None:
    form = rods("ZZZ", are_equal=True).matrix_form()
    assert "M13 = M31 = 1/3*m*l**2 + 1/2*m*l**2*(cos(q2 + q3) + cos(q3))" in form.description()


def test_numbers_of_one_entry_have_no_factor_in_common_behind_a_fraction() -> None:
    """Rods on a cart whose length is 2*l: their inertia is 4/3*m*l**2."""
    (x, alpha, beta, s), (m, M, l, L) = functions_of_time("x alpha beta s"), symbols("m M l L")
    first = Body(translate(x, 0, 0) * rotate("Y", alpha) * translate(0, 0, l), m, Iy=m * l**2 / 3)
    second = Body(
        first.frame * translate(0, 0, l) * rotate("Y", beta) * translate(0, 0, l), m, Iy=m * l**2 / 3
    )
    double = System([Body(translate(x, 0, 0), M), first, second], coordinates=[x, alpha, beta])
    assert "(4/3*m*l**2 + 2*m*l**2*cos(beta))*alpha''" in " ".join(describe(newton_euler(double)).split())
    rod = Body(rotate("Z", alpha) * translate(L / 2, 0, 0), m, Iz=m * L**2 / 12)
    collar = Body(rotate("Z", alpha) * translate(s, 0, 0), M)
    sliding = System([rod, collar], coordinates=[alpha, s], gravity=Vector(ground, 0, -symbols("g"), 0))
    text = describe(newton_euler(sliding))
    assert "+ g*(M*s + 1/2*L*m)*cos(alpha) = 0" in text


@pytest.mark.parametrize(("half", "coefficient"), [(0.5, "1/3"), (0.25, "0.4375/3"), (0.3, "0.52/3")])
def test_a_decimal_that_meets_a_fraction_is_shown_exactly(half: float, coefficient: str) -> None:
    """0.5**2 + 1/12 is 1/3; no digits are lost, as they would be in 0.3333333333333333."""
    m, l = symbols("m l")
    (q,) = functions_of_time(["q"])
    body = Body(rotate("Z", q) * translate(half * l, 0, 0), m, 0, 0, m * l**2 / 12)
    equations = newton_euler(System([body], coordinates=[q]))
    row = describe(equations).splitlines()[-1].strip()
    assert row == f"{coefficient}*m*l**2*q'' = 0"
    assert parse(f"{coefficient}*m*l**2", {"m": m, "l": l}) == equations.mass_matrix[0, 0]


@pytest.mark.parametrize("form", ["text", "latex"])
def test_sums_in_brackets_have_leading_fractions(form: str) -> None:
    """A cylinder and a ball roll with a cart on which a rod hangs."""
    (x, theta), (m, M, a, r) = functions_of_time("x theta"), symbols("m M a r")
    hanging = translate(x, 0, 0) * rotate("Z", theta) * translate(0, -a, 0)
    bodies = [
        Body(translate(x, 0, 0) * rotate("Z", -x / r), M, Iz=M * r**2 / 2),
        Body(translate(x, 0, 0) * rotate("Z", x / r), m, Iz=2 * m * r**2 / 5),
        Body(hanging, m, Iz=m * a**2 / 4),
    ]
    equations = newton_euler(System(bodies, coordinates=[x, theta]))
    shown = describe(equations) if form == "text" else equations.latex()
    for expected in LEADING[form]:
        assert expected in shown


LEADING = {
    "text": ("(3/2*M + 12/5*m)*x''", "5/4*m*a**2*theta''"),
    "latex": (r"\frac{3}{2} M + \frac{12}{5} m", r"\frac{5}{4} m a^{2}"),
}


def test_divisors_have_no_fractions() -> None:
    """A damper from the middle of a rod: its rate is divided by the square of its length."""
    (q,), (m, a, b, c, d) = functions_of_time(["q"]), symbols("m a b c d")
    frame = rotate("Z", q)
    rod = Body(frame * translate(a, 0, 0), m)
    damper = spring(Point(frame, a / 2, 0, 0), Point(ground, b, -c, 0), 0, damping=d, on=rod)
    equations = newton_euler(System([rod], [damper], coordinates=[q]))
    assert "*q'/((2*b - a*cos(q))**2 + (2*c + a*sin(q))**2) = 0" in describe(equations)
    linear = linearize(equations, about={q: 0})
    assert "C = [d*a**2*c**2/(4*c**2 + (a - 2*b)**2)]" in describe(linear)
