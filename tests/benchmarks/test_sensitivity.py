"""The benchmark of sensitivities: everybody finds the same derivatives, and the bound is kept."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.sensitivity.contenders import CONTENDERS, Contender, forward
from benchmarks.sensitivity.run import report


@pytest.mark.parametrize("contender", CONTENDERS[1:], ids=lambda each: each.label)
def test_contenders_agree(contender: Contender) -> None:
    if not contender.is_installed:
        pytest.skip(f"{contender.needs} is not installed")
    exact = forward(1e-12, 1e-13)()
    assert np.abs(contender.prepare()() - exact).max() < 1e-3 * np.abs(exact).max()


def test_the_table_has_a_row_for_each() -> None:
    text = report(1)
    assert text.count("\n| ") == 1 + len(CONTENDERS)
    assert "symbody, sensitivities" in text
