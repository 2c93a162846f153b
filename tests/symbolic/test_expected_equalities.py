"""The table of expected equalities says what is so, and the document holds this table."""

from __future__ import annotations

import pytest

from symbody.symbolic import derivation
from tests.laws.trees import compare, tree_in
from tests.symbolic import reading
from tests.symbolic.expected_equalities import (
    DIFFERENCES,
    DOCUMENT,
    EQUALITIES,
    Difference,
    Equality,
    written,
)


def name(row: Equality | Difference) -> str:
    return f"{row.left} and {row.right}"


def equal(row: Equality | Difference) -> bool:
    """Return the verdict of `==`, which is the same in a derivation and however it is asked."""
    left, right = reading.expression(row.left), reading.expression(row.right)
    verdict = bool(left == right)
    assert verdict == bool(right == left) == left.equals(right)
    with derivation():
        assert verdict == (reading.expression(row.left) == reading.expression(row.right))
    return verdict


@pytest.mark.parametrize("row", EQUALITIES, ids=name)
def test_rows_are_true(row: Equality) -> None:
    verdict = compare(tree_in(row.left), tree_in(row.right))
    assert verdict.is_equal is True


@pytest.mark.parametrize("row", EQUALITIES, ids=name)
def test_rows_are_known_as_the_table_says(row: Equality) -> None:
    assert equal(row) == row.is_known


@pytest.mark.parametrize("row", DIFFERENCES, ids=name)
def test_what_only_looks_equal_is_never_equal(row: Difference) -> None:
    assert not reading.agrees(row.left, row.right)
    assert not equal(row)


@pytest.mark.parametrize("place", ["2*({})", "y + ({})", "y*({})", "y - ({})", "y/({})", "f({})", "f(y, {})"])
def test_what_only_looks_equal_is_never_equal_inside_a_larger_expression(place: str) -> None:
    rows = [row for row in DIFFERENCES if "/" not in place or "0" not in (row.left, row.right)]
    placed = [Difference(place.format(row.left), place.format(row.right), row.reason) for row in rows]
    assert [row for row in placed if equal(row)] == []


def test_the_document_holds_the_tables() -> None:
    document = DOCUMENT.read_text()
    assert document == written(document), "python -m tests.symbolic.expected_equalities writes them"
