"""The benchmark of lowering: its page has the sizes of what is lowered."""

from __future__ import annotations

from benchmarks.lower.run import CASES, QUICK, lowered, page


def test_the_page_has_a_row_for_each() -> None:
    found = [lowered(case, 1) for case in CASES[:QUICK]]
    assert found[0].entries == 12 * 24
    text = page(found, 1)
    assert text.count("\n| ") == 1 + QUICK
    for each in found:
        assert f"| {each.entries} | {each.operations} |" in text
        assert each.operations > each.entries
