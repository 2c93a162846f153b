"""Equations as they are shown, beside those of textbooks: equal, as short, and on lines that fit."""

from __future__ import annotations

import re

import pytest

from scripts.textbook import PAGE, page
from symbody import cost
from tests.page.classic import Classic, length
from tests.page.classics import CLASSICS

each = pytest.mark.parametrize("classic", CLASSICS, ids=lambda classic: classic.name)


@each
def test_the_book_is_right_and_takes_no_fewer_operations(classic: Classic) -> None:
    """Residuals that are read collect like terms; what was derived takes up to three times as many operations."""
    read, derived = classic.equations.residuals, classic.equations.derived_residuals
    book = tuple(map(classic.difference, classic.book))
    assert book == read == derived
    assert cost(read).total <= min(cost(derived).total, 1.15 * cost(book).total)
    for one, other in zip(read, derived, strict=True):
        assert str(other).startswith("-") or not str(one).startswith("-")


@each
def test_what_is_shown_is_equal(classic: Classic) -> None:
    for row, residual in zip(classic.rows, classic.equations.residuals, strict=True):
        assert classic.difference(row) == residual, row


@each
def test_what_is_shown_is_as_short_as_the_book(classic: Classic) -> None:
    assert length(classic.ours) <= 1.1 * length(classic.book)


@each
def test_lines_fit(classic: Classic) -> None:
    assert max(map(len, classic.equations.description().splitlines())) <= 110


@each
def test_each_acceleration_has_one_coefficient(classic: Classic) -> None:
    for row in classic.rows:
        for acceleration in map(str, classic.equations.accelerations):
            assert len(re.findall(rf"\b{acceleration}", row)) <= 1, row


def test_the_page_is_up_to_date() -> None:
    """`python -m scripts.textbook` writes it."""
    assert PAGE.read_text(encoding="utf-8") == page()
