"""Names in LaTeX: the table of rules, and different names that are typeset differently."""

from __future__ import annotations

import random
from itertools import combinations

import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser
from sympy import Symbol
from sympy import latex as sympy_latex

from symbody.errors import ArgumentError
from symbody.symbolic import (
    Expr,
    cos,
    exp,
    function,
    functions_of_time,
    latex,
    listing,
    parse,
    symbol,
    symbols,
    time_derivative,
)
from tests.repeated import repeated

PARSER = MathTextParser("path")


def typeset(formula: str) -> object:
    """The glyphs and the lines that matplotlib draws, with their places."""
    drawn = PARSER.parse(f"${formula}$", prop=FontProperties())
    return [(glyph[0].postscript_name, *glyph[1:]) for glyph in drawn.glyphs], drawn.rects


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("m_1", "m_{1}"),
        ("I__xx", "I_{xx}"),
        ("Ixy", "I_{xy}"),
        ("Fx", "F_{x}"),
        ("x__G", "x_{G}"),
        ("omega0", r"\omega_{0}"),
        ("theta_dot", r"\dot{\theta}"),
        ("omega_bar", r"\bar{\omega}"),
        ("r_vec1", r"\vec{r}_{1}"),
        ("q12", "q_{12}"),
        ("l1_x", "l_{1,x}"),
        ("load", r"\mathrm{load}"),
        ("m_load", r"m_{\mathrm{load}}"),
        ("Omega", r"\Omega"),
        ("varphi", r"\varphi"),
        ("lambda_", r"\lambda"),
        ("x_prime", r"x^{\prime}"),
        ("my-name", r"\mathtt{my-name}"),
    ],
)
def test_the_table(name: str, expected: str) -> None:
    assert latex(symbol(name)) == expected
    typeset(expected)


LETTERS = ["x", "q", "I", "m", "theta", "omega", "phi", "varphi", "Omega", "Gamma", "alpha", "lambda"]
INDICES = ["1", "12", "x", "G", "0", "phi", "B", "xx"]


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (1.5e10, r"1.5 \cdot 10^{10}"),
        (-2e6, r"-2 \cdot 10^{6}"),
        (1e5, "10^{5}"),
        (123000.0, "123000.0"),
        (1.5e-10, r"1.5 \cdot 10^{-10}"),
    ],
)
def test_large_decimals_have_powers_of_ten(value: float, expected: str) -> None:
    assert latex(value * symbol("a")) == f"{expected} a"


@pytest.mark.parametrize("letter", LETTERS)
@pytest.mark.parametrize("index", INDICES)
def test_a_letter_with_an_index_reads_as_in_sympy(letter: str, index: str) -> None:
    assert latex(symbol(f"{letter}_{index}")) == sympy_latex(Symbol(f"{letter}_{index}"))


@pytest.mark.parametrize("seed", [*range(10), *repeated(range(10, 20))])
def test_different_names_are_typeset_differently(seed: int) -> None:
    """Names of few pieces, so that many of them are alike; the judge is what matplotlib draws."""
    chance = random.Random(seed)
    pieces = [
        "x",
        "I",
        "m",
        "theta",
        "θ",
        "load",
        "1",
        "2",
        "12",
        "_",
        "__",
        "dot",
        "_dot",
        "_prime",
        "'",
        "xx",
        "-",
    ]
    names = sorted({"x" + "".join(chance.choices(pieces, k=chance.randint(0, 3))) for _ in range(25)})
    things = [symbol(name) for name in names]
    things += [time_derivative(functions_of_time(name), 1) for name in ("x", "x1", "x_1")]
    _, texts = listing(things, "latex")
    assert len(texts) == len(set(texts))
    drawings = [typeset(text) for text in texts]
    for (a, first), (b, second) in combinations(zip(texts, drawings, strict=True), 2):
        assert first != second, f"{a} looks like {b}"


def test_the_shortest_name_keeps_the_textbook_form() -> None:
    m1, m_1, m__1 = symbols("m1 m_1 m__1")
    assert latex(m1) == latex(m_1) == "m_{1}"
    assert latex(m__1 + m1 + m_1) == r"m_{1} + \mathtt{m\_1} + \mathtt{m\_\_1}"


def test_a_rate_keeps_its_dot() -> None:
    theta, theta_dot = functions_of_time("theta"), symbol("theta_dot")
    assert latex(theta_dot * time_derivative(theta)) == r"\mathtt{theta\_dot} \, \dot{\theta}"
    assert latex(time_derivative(functions_of_time("theta_dot"))) == r"\ddot{\theta}"
    assert latex(theta_dot + theta) == r"\theta + \mathtt{theta\_dot}"
    assert latex([2 * theta_dot, theta]) == r"\left[2 \, \mathtt{theta\_dot}, \theta\right]"
    assert latex(2 * theta_dot) == r"2 \dot{\theta}"


def test_names_give_way_to_what_they_look_like() -> None:
    e, a, cosine = symbol("e"), symbol("a"), symbol("cos_")
    assert latex(e * exp(a)) == r"\mathtt{e} \, e^{a}"
    assert latex(e * a) == "a e"
    assert latex(cosine * cos(a)).startswith(r"\mathtt{cos\_}")


def test_words_do_not_run_into_their_neighbours() -> None:
    load, mass, x = symbols("load mass x")
    assert latex(2 * load * mass * x) == r"2 \, \mathrm{load} \, \mathrm{mass} \, x"
    ab, a, b = symbols("ab a b")
    assert typeset(latex(ab)) != typeset(latex(a * b))


def test_powers_of_primes_have_brackets() -> None:
    assert latex(symbol("x_prime_1") ** 2) == r"\left(x_{1}^{\prime}\right)^{2}"


def test_functions_and_shared_quantities_are_names_too() -> None:
    f_1: Expr = function("f_1")(symbol("x"))
    assert latex(f_1 + symbol("f1")) == r"f_{1} + \mathtt{f\_1}(x)"
    many = parse("(" + " + ".join(f"v{k}" for k in range(60)) + ")")
    total = sum((cos(many) ** k * symbol("z_1") for k in range(2, 50)), start=cos(many))
    definitions, results = listing([total], "latex")
    names = [name for name, _ in definitions]
    assert "z_{1}" in "".join([*results, *(value for _, value in definitions)])
    assert not any(name.startswith("z") for name in names)
    assert len(set(names)) == len(names) > 0


def test_a_class_has_no_formula() -> None:
    """A class whose objects have formulas is refused as other things are."""
    with pytest.raises(ArgumentError, match="latex: "):
        latex(Expr)
