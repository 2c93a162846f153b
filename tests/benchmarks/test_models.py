"""The benchmark of classic systems: its page has what they are, and their motions keep their energy."""

from __future__ import annotations

from benchmarks.models.run import QUICK, page
from benchmarks.models.trial import trial
from symbody import cost, forward_dynamics, newton_euler
from symbody.models import rolling_disc


def test_the_page_has_a_row_for_each() -> None:
    found = [trial(name) for name in QUICK]
    assert all((each.drift or 1) < 1e-6 and each.derivation > 0 and each.motion > 0 for each in found)
    equations = newton_euler(rolling_disc().system)
    operations = cost(forward_dynamics(equations).accelerations).total
    assert (found[-1].coordinates, found[-1].constraints, found[-1].operations) == (5, 2, operations)
    text = page(found, 1)
    assert text.count("\n| [`") == len(QUICK)
    assert f"| 5 | 2 | {found[-1].derivation:.3g} | {operations} |" in text
