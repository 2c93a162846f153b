"""Lines of long formulas: nothing is lost, inner terms are indented deeper, and no short bracket is torn."""

from __future__ import annotations

import random
import re

import pytest

from symbody.symbolic.expression.latex_layout import broken
from symbody.symbolic.expression.text_layout import lines


def formula(draw: random.Random, depth: int) -> str:
    """Return a random sum of products as text, with brackets in brackets."""
    terms = [product(draw, depth) for _ in range(draw.randrange(1, 6))]
    return "".join(
        f"{draw.choice([' + ', ' - ']) if place else ''}{term}" for place, term in enumerate(terms)
    )


def product(draw: random.Random, depth: int) -> str:
    factors = [draw.choice(["m1", "l12", "sin(q1 + q2)", "x'", "a**2"]) for _ in range(draw.randrange(1, 4))]
    if depth:
        factors += [f"({formula(draw, depth - 1)})" for _ in range(draw.randrange(3))]
    draw.shuffle(factors)
    return "*".join(factors)


def levels(text: str) -> list[int]:
    """Return the number of open brackets at each place of a text."""
    level, found = 0, []
    for letter in text:
        found.append(level)
        level += {"(": 1, ")": -1}.get(letter, 0)
    return found


@pytest.mark.parametrize("seed", range(40))
def test_lines_of_random_formulas(seed: int) -> None:
    draw = random.Random(seed)
    text = f"{formula(draw, 3)} = {draw.choice(['0', 'tau'])}"
    pieces = lines(text, 60)
    stripped = [piece.strip() for piece in pieces]
    assert re.sub(r"\s", "", "".join(pieces)) == re.sub(r"\s", "", text)
    assert all(len(piece) <= 60 for piece in pieces)
    assert not stripped[-1].startswith("=")
    place, known = 0, levels("".join(stripped))
    for piece, plain in zip(pieces, stripped, strict=True):
        is_inner = known[place] > 0
        assert piece.startswith("    ") or not is_inner
        if not is_inner and known[place + len(plain) - 1] > 0:
            inside = [known[place + k] for k, letter in enumerate(plain) if letter in "+-" and k]
            assert 0 not in inside, "a term that is broken shares its first line"
        place += len(plain)


@pytest.mark.parametrize("seed", range(20))
def test_a_side_of_several_terms_stands_on_one_line(seed: int) -> None:
    """`= T + r*cos(q)*lambda1` isn't broken if it fits: it begins a line if need be."""
    draw = random.Random(seed)
    right = f" = tau + {product(draw, 0)} - {product(draw, 0)}"
    for left in (formula(draw, 2), f"{formula(draw, 1)} + {'c' * 70}", "c" * 90 + " - d*x'"):
        pieces = lines(left + right, 100)
        assert right in f" {pieces[-1].strip()}"
        assert all(len(piece) <= 100 for piece in pieces)


@pytest.mark.parametrize("seed", range(20))
def test_short_brackets_are_whole(seed: int) -> None:
    """Products of brackets, each of which fits a line with room to spare, are broken between these."""
    draw = random.Random(seed)
    brackets = [f"({'a' * draw.randrange(5, 12)} + {'b' * draw.randrange(5, 12)})" for _ in range(5)]
    pieces = lines("*".join(brackets), 50)
    assert len(pieces) > 1
    assert all(piece.count("(") == piece.count(")") for piece in pieces)
    formula = " ".join(rf"\left({bracket[1:-1]}\right)" for bracket in brackets)
    rows = broken("x &= ", formula, 50)
    assert len(rows) > 1
    assert all(row.count(r"\left") == row.count(r"\right") and r"\big" not in row for row in rows)
    assert all(r"{} \cdot \left(" in row for row in rows[1:])


def test_exponents_and_matrices_are_not_broken() -> None:
    assert lines("a**(b + c + d)", 8) == ["a**(b + c + d)"]
    assert lines("a*sqrt(b + c + d)*e", 12) == ["a*sqrt(b + c", "    + d)*e"]
