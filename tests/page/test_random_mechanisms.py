"""The rules of the page on random mechanisms of the textbook's kind."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from functools import cache
from itertools import pairwise

import pytest

from symbody import (
    Equations,
    Expr,
    cos,
    factor_terms,
    functions_of_time,
    models,
    newton_euler,
    number,
    simplify,
    sin,
    symbols,
    time_derivative,
)
from symbody.symbolic.calculus.rewrite import textbook_form
from tests.page.random_mechanism import random_mechanism
from tests.repeated import repeated

each = pytest.mark.parametrize("seed", [*range(12), 19, *repeated([*range(12, 19), *range(20, 60)])])


@cache
def shown(seed: int) -> tuple[Equations, list[str]]:
    """Return the equations of a mechanism and the rows of their page, each on one line."""
    equations = newton_euler(random_mechanism(seed))
    return equations, re.split(r"\n    (?! )", re.sub(r"\n {8}", " ", equations.description()))[1:]


@each
def test_each_acceleration_has_one_coefficient(seed: int) -> None:
    equations, rows = shown(seed)
    for row in (row for row in rows if ":=" not in row):
        for acceleration in map(str, equations.accelerations):
            assert len(re.findall(rf"\b{acceleration}", row)) <= 1, row


@each
def test_accelerations_come_first_and_the_first_one_is_positive(seed: int) -> None:
    equations, rows = shown(seed)
    for row in (row for row in rows if ":=" not in row):
        assert not row.startswith("-"), row
        places = [row.find(str(acceleration)) for acceleration in equations.accelerations]
        later = re.search(r"\bq\d'(?!')", row)
        assert later is None or max(places) < later.start(), row


@each
def test_squares_of_sines_are_not_written_by_cosines(seed: int) -> None:
    _, rows = shown(seed)
    for row in rows:
        assert not re.search(r"\b1 - (sin|cos)\([^()]*\)\*\*2", row), row


@each
def test_a_difference_has_one_direction(seed: int) -> None:
    """`R - r` or `r - R`, as the model has it, in all equations."""
    _, rows = shown(seed)
    text = " ".join(rows)
    for i in (1, 2, 3):
        assert not (f"(R{i} - r{i})" in text and f"(r{i} - R{i})" in text), text


@each
def test_a_coordinate_stands_before_a_drive(seed: int) -> None:
    _, rows = shown(seed)
    for row in rows:
        assert not re.search(r"\(\d?\*?Omega\*t [-+] [^()]*q\d", row), row


@each
def test_no_double_angle_of_a_difference(seed: int) -> None:
    """Waves of `2*q - 2*Omega*t` are products of those of `q - Omega*t`."""
    _, rows = shown(seed)
    for row in rows:
        assert not re.search(r"(sin|cos)\(2\*q\d [-+] 2\*[^()]*\)", row), row


@each
def test_rows_are_equal_to_the_residuals_and_fit(seed: int) -> None:
    equations, _ = shown(seed)
    for balance, residual in zip(equations.display.page.balances, equations.residuals, strict=True):
        assert balance.residual == residual
    assert max(map(len, equations.description().splitlines())) <= 110


def random_terms(seed: int) -> list[Expr]:
    """Return the terms of a sum of products of parameters, waves and speeds."""
    rng = random.Random(seed)
    names, (p, q) = symbols("a b c k l m"), functions_of_time("p q")
    dp, dq = time_derivative(p), time_derivative(q)
    speeds = [number(1), number(1), dp, dq, dp**2, dq**2, dp * dq]
    terms = []
    for _ in range(rng.randint(3, 8)):
        term = number(rng.choice([1, 1, 1, 2, 3, -1, -1, -2])) * rng.choice(speeds)
        for _ in range(rng.randint(1, 3)):
            term *= rng.choice(names) ** rng.choice([1, 1, 2])
        for _ in range(rng.randint(0, 2)):
            term *= rng.choice([sin, cos])(rng.choice([p, q, p + q, p - q, 2 * p, 2 * q]))
        terms.append(term)
    return terms


@pytest.mark.parametrize("rewrite", [textbook_form, simplify, factor_terms])
@pytest.mark.parametrize("seed", [6, 17, 26, 29, 38, 86])  # each had several forms in one of the rewrites
def test_the_order_of_addition_does_not_show(rewrite: Callable[[Expr], Expr], seed: int) -> None:
    terms, forms = random_terms(seed), set()
    for shuffle in range(6):
        random.Random(shuffle).shuffle(terms)
        total = terms[0]
        for _, term in pairwise(terms):
            total += term
        forms.add(str(rewrite(total)))
    assert len(forms) == 1


m1, m2, a, l, R, r = symbols("m1 m2 a l R r")
x, y = functions_of_time("x y")


@pytest.mark.parametrize(
    ("given", "form"),
    [
        ((R - r) * ((m1 + m2) * (R - r) + l * cos(x)), "(m1 + m2)*(R - r)**2 + l*(R - r)*cos(x)"),
        (
            (m1 + m2) * (a + l) ** 2 + m2 * r**2 * (1 - cos(x) ** 2),
            "(m1 + m2)*(a + l)**2 + m2*r**2*sin(x)**2",
        ),
        (
            (m1 + m2) * ((l * sin(x) + (R - r) * sin(x + y)) ** 2 + (l * cos(x) + (R - r) * cos(x + y)) ** 2),
            "(m1 + m2)*(l**2 + (R - r)**2 + 2*l*(R - r)*cos(y))",
        ),
    ],
)
def test_sums_of_parameters_stay_closed(given: Expr, form: str) -> None:
    assert str(textbook_form(given)) == form


def test_sums_of_waves_are_products_where_that_is_shorter() -> None:
    assert str(textbook_form(a * (sin(x + y) - sin(x - y)))) == "2*a*cos(x)*sin(y)"
    assert str(textbook_form(a * (cos(x - y) - cos(x + y)))) == "2*a*sin(x)*sin(y)"
    assert str(textbook_form(a * cos(x + y) + l * cos(x - y))) == "a*cos(x + y) + l*cos(x - y)"


@pytest.mark.parametrize("model", [models.andrews_mechanism, models.rattleback])
def test_long_roots_are_broken(model: Callable[[], models.ClassicSystem]) -> None:
    """A line is broken in the argument of a function where nothing else is left."""
    lines = newton_euler(model().system).description(whole=True).splitlines()
    assert max(map(len, lines)) <= 110
    assert "sqrt(" in " ".join(lines)
