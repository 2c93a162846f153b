"""Printed forms: plain text, LaTeX that a typesetter accepts, Maple that reads back."""

from __future__ import annotations

import re

import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

from symbody.symbolic import (
    Expr,
    Max,
    atan2,
    cos,
    functions_of_time,
    latex,
    listing,
    listing_of_equations,
    maple,
    number,
    sqrt,
    symbols,
    time_derivative,
)
from symbody.symbolic.text.parse import parse
from tests.repeated import repeated
from tests.symbolic.random_expression import NAMES, doubling, expression

m, m1, m2, l1, l2, l10, k = symbols("m m1 m2 l1 l2 l10 k")
theta1, theta2 = functions_of_time("theta1 theta2")
w1, w2 = time_derivative(theta1), time_derivative(theta2)


def test_textbook_forms() -> None:
    coupling = l2 * m2 * l1 * cos(theta1 - theta2)
    assert str(coupling) == "l1*l2*m2*cos(theta1 - theta2)"
    energy = (m1 + m2) * l1**2 * w1**2 / 2 + m2 * l2**2 * w2**2 / 2 + coupling * w1 * w2
    assert str(energy) == (
        "(m1 + m2)*l1**2*theta1'**2/2 + m2*l2**2*theta2'**2/2 + l1*l2*m2*cos(theta1 - theta2)*theta1'*theta2'"
    )
    assert str(time_derivative(theta1, 2) * m + k * (l10 - l2)) == "m*theta1'' + k*(l10 - l2)"


def test_numbers() -> None:
    assert [str(number(v)) for v in (0, -3, 0.5, 1e-7, 1e300, -2.0)] == [
        "0",
        "-3",
        "0.5",
        "1e-7",
        "1e300",
        "-2.0",
    ]
    assert str(number(2) / 3 * m) == "2*m/3"
    assert str(0.25 * m - 1.5) == "0.25*m - 1.5"
    assert str(sqrt(8)) == "2*sqrt(2)"
    assert latex(1.5e-7 * m) == r"1.5 \cdot 10^{-7} m"


def test_latex() -> None:
    assert latex(m2 * l1**2 * w1**2 / 2) == r"\frac{m_{2} l_{1}^{2} \dot{\theta}_{1}^{2}}{2}"
    assert latex(cos(theta1) ** 2 / (m1 + m2)) == r"\frac{\cos^{2}(\theta_{1})}{m_{1} + m_{2}}"


def test_maple() -> None:
    assert (
        maple(m * time_derivative(theta1, 2) - k * w1**2)
        == "m*diff(theta1(t),`$`(t,2))-k*diff(theta1(t),t)^2"
    )


@pytest.mark.parametrize("seed", range(40))
def test_a_typesetter_accepts_the_latex(seed: int) -> None:
    formula = latex(expression(seed, 3, only_common=True))
    assert formula.count(r"\left") == formula.count(r"\right")
    MathTextParser("path").parse(f"${formula}$", prop=FontProperties())


@pytest.mark.parametrize("seed", [*range(40), *repeated(range(40, 100))])
def test_maple_reads_back(seed: int) -> None:
    e = expression(seed, only_common=True)
    text = maple(e)
    assert "**" not in text
    assert "'" not in text
    text = re.sub(r"`\$`\(t,(\d+)\)", r"t,\1", text)
    for ours, theirs in (("atan", "arctan"), ("sign", "signum"), ("pi", "Pi")):
        text = re.sub(rf"\b{theirs}\b", ours, text)
    assert parse(text, NAMES | {"D_": NAMES["D"]}) == e  # D is Maple's own


def test_a_large_expression_is_no_wall_of_text() -> None:
    e = doubling(60)
    lines = str(e).splitlines()
    assert 20 < len(lines) < 100
    assert max(map(len, lines)) < 120
    assert re.fullmatch(r"z1 = .*", lines[0])
    assert latex(e).startswith("\\begin{aligned}\nz_{1} &= ")
    assert maple(e).startswith("z1 := ")


def test_a_listing_names_what_is_shared_once() -> None:
    e = doubling(20)
    definitions, results = listing([e * m, e + m])
    last = definitions[-1][0]
    assert results == [f"m*{last}", f"m + {last}"]
    assert listing([m + k]) == ([], ["k + m"])


def test_exponents_stand_beside_names_of_functions_of_one_argument() -> None:
    assert latex(cos(k) ** 2) == r"\cos^{2}(k)"
    assert latex(Max(0, k) ** (number(3) / 2)) == r"\max(0, k)^{3/2}"
    assert latex(atan2(k, m) ** 2) == r"\operatorname{atan2}(k, m)^{2}"


@pytest.mark.parametrize(
    ("term", "text", "typeset"),
    [
        (3 * m / 2, "3/2*m", r"\frac{3}{2} m"),
        (-3 * cos(k) / 2, "-3/2*cos(k)", r"-\frac{3}{2} \cos(k)"),
        (2 * w1**2 / 3, "2/3*theta1'**2", r"\frac{2}{3} \dot{\theta}_{1}^{2}"),
        (2 * (m + k) / 3, "2/3*(k + m)", r"\frac{2}{3} \left(k + m\right)"),
        (k * (3 * m / 2 + l1), "k*(l1 + 3/2*m)", r"k \left(l_{1} + \frac{3}{2} m\right)"),
        (3 * number(2) ** k / 4, "3/4*2**k", r"\frac{3}{4} \cdot 2^{k}"),
        (m / 2, "m/2", r"\frac{m}{2}"),
        (3 * m / (2 * k), "3*m/(2*k)", r"\frac{3 m}{2 k}"),
        (2 * sqrt(number(3)) / 3, "2*sqrt(3)/3", r"\frac{2 \sqrt{3}}{3}"),
        (cos(3 * k / 2), "cos(3*k/2)", r"\cos\left(\frac{3 k}{2}\right)"),
        (cos(k * m / 2), "cos(k*m/2)", r"\cos\left(\frac{k m}{2}\right)"),
    ],
)
def test_fractions_lead_the_products_of_equations(term: Expr, text: str, typeset: str) -> None:
    """They don't where a bar is as short, and neither in an argument of one term."""
    assert listing_of_equations((term,), "text", (), ())[1] == [text]
    assert listing_of_equations((term,), "latex", (), ())[1] == [typeset]


@pytest.mark.parametrize("seed", [*range(40), *repeated(range(40, 100))])
def test_terms_of_equations_read_back(seed: int) -> None:
    e = expression(seed, 3)
    definitions, (text,) = listing_of_equations((e,), "text", (), ())
    assert not definitions
    assert parse(text, NAMES) == e
