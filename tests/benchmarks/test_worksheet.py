"""The benchmark of worksheets: every command that it measures ends well, and has a row."""

from __future__ import annotations

from benchmarks.worksheet.run import report


def test_the_table_has_a_row_for_each_command() -> None:
    text = report(0)
    rows = [line for line in text.splitlines() if line.startswith("| ")]
    assert len(rows) >= 1 + 6
    assert all("0 failed" in row and "0 different" in row for row in rows[2:])
