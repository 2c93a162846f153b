"""The benchmark of worksheets: every kind of command that it measures ends well, and has a row."""

from __future__ import annotations

import pytest

from benchmarks.worksheet import run


def test_the_table_has_a_row_for_each_command(monkeypatch: pytest.MonkeyPatch) -> None:
    """One sheet of a user and one of our own: the tests of worksheets run the others."""
    monkeypatch.setattr(run, "SEEDS", run.SEEDS[:1])
    monkeypatch.setattr(run, "LARGEST", run.LARGEST[:1])
    rows = [line for line in run.report(0).splitlines() if line.startswith("| ")]
    assert len(rows) == 1 + 2 + len(run.SEEDS) + 1
    assert all("0 failed" in row and "0 different" in row for row in rows[2:])
