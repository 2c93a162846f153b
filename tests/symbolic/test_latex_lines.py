"""Long formulas in LaTeX: broken at terms, nothing lost."""

from __future__ import annotations

import re

import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

from symbody.symbolic import expand, latex
from symbody.symbolic.expression.latex_layout import LINE, broken, lines, width
from tests.repeated import repeated
from tests.symbolic.random_expression import expression

PARSER = MathTextParser("path")


def squeezed(text: str) -> str:
    """The text without spaces, and with brackets of one size."""
    for size, plain in ((r"\bigl", r"\left"), (r"\bigr", r"\right")):
        text = text.replace(size, plain)
    return re.sub(r"\s", "", text)


def with_factors(text: str) -> str:
    """The formula without brackets, and with fractions as lines have those that are too long: before the numerator."""
    text = re.sub(r"\\left\(|\\right\)", "", text)
    before, found, rest = text.partition(r"\frac{")
    if not found:
        return text
    numerator, rest = group(rest)
    denominator, rest = group(rest.removeprefix("{"))
    factor = "" if numerator == "1" else with_factors(numerator)
    return f"{before}[{with_factors(denominator)}]{factor}{with_factors(rest)}"


def group(text: str) -> tuple[str, str]:
    """What stands before the brace that ends a group, and after it."""
    depth = 1
    for place, letter in enumerate(text):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if depth == 0:
            return text[:place], text[place + 1 :]
    raise AssertionError(text)


def test_a_long_sum_above_a_line_is_broken() -> None:
    assert lines(r"\frac{a + b + c}{2} + d", 4) == [r"\frac{1}{2} \bigl(a", "+ b", r"+ c\bigr)", "+ d"]
    assert lines(r"\frac{a + b + c}{2} + d", 20) == [r"\frac{a + b + c}{2} + d"]


def test_a_sum_that_ends_a_long_numerator_stays_over_its_denominator() -> None:
    formula = r"a + \frac{k n \left(x - y\right)}{\sqrt{c + d}}"
    assert lines(formula, 6) == ["a", r"+ k n \frac{x - y}{\sqrt{c + d}}"]


@pytest.mark.parametrize("seed", [*range(15), *repeated(range(15, 30))])
@pytest.mark.parametrize("line", [20, LINE])
def test_pieces_are_the_formula(seed: int, line: int) -> None:
    formula = latex(expression(seed, 4, only_common=True))
    pieces = lines(formula, line)
    together = "".join(
        piece.removeprefix(r"\cdot ") for piece in pieces
    )  # a factor that begins a line has a dot
    assert with_factors(squeezed(together)) == with_factors(squeezed(formula))
    for piece in pieces:
        assert piece.count(r"\left") == piece.count(r"\right")
        assert piece.count("{") == piece.count("}")
        PARSER.parse(
            f"${piece.replace('bigl', '').replace('bigr', '')}$".replace("\\(", "(").replace("\\)", ")")
        )


@pytest.mark.parametrize("seed", range(10))
def test_a_sum_of_short_terms_fits(seed: int) -> None:
    e = expand((expression(seed, 2, only_common=True) + expression(seed + 50, 2, only_common=True)) ** 2)
    pieces = lines(latex(e), LINE)
    for piece in pieces:
        assert width(piece) <= LINE or " + " not in re.sub(r"\{.*\}|\\left.*\\right", "", piece)


def test_width_is_what_is_seen() -> None:
    assert width(r"\frac{m_{2} l_{1}^{2}}{2}") == len("m2l122")
    assert width(r"\dot{\theta}_{1} \sin\left(x\right)") == len("t1sin(x)")


def test_a_short_formula_stays_on_its_line() -> None:
    assert broken("x &= ", "a + b") == ["x &= a + b"]
    assert broken("x &= ", "a + b", 2) == ["x &= a", r"&\quad {} + b"]


def test_long_factors_are_broken_in_their_brackets() -> None:
    assert lines(r"a \left(b + c \left(d + e\right)\right) - f", 10) == [
        r"a \bigl(b",
        r"+ c \left(d + e\right)\bigr)",
        "- f",
    ]
    whole = r"\sin\left(a + b + c\right)"
    assert lines(whole, 3) == [whole]
    PARSER.parse(r"$\mathtt{m\_1}$", prop=FontProperties())
