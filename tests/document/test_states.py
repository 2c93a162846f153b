"""Reports of systems with states beside the mechanics."""

from __future__ import annotations

from pathlib import Path

from symbody import report
from tests.dynamics.state_models import motor_pendulum


def test_a_report_names_states_and_their_rates(tmp_path: Path) -> None:
    report(motor_pendulum().equations, tmp_path / "motor.md")
    text = (tmp_path / "motor.md").read_text(encoding="utf-8")
    assert "with 2 states beside the mechanics" in text
    assert "| states | 2 |" in text
    assert r"\dot{\mathrm{heat}}" in text
    assert "The rates of the coordinates, by the speeds, are" not in text
