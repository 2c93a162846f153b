"""The benchmark of small variables at small sizes: all contenders give the same equations.

Times are for `make bench`: a test of them would fail on a busy machine.
"""

from __future__ import annotations

import pytest

from benchmarks.linear.small_variables import (
    FORMALISMS,
    by_sympy,
    contenders,
    of_small_variables,
    truncated_afterwards,
)
from tests.repeated import repeated


def test_all_contenders_agree() -> None:
    expected = by_sympy(1).residuals
    others = [contender for contender, _ in contenders().values() if contender is not by_sympy]
    for contender in others:
        assert contender(1).residuals == pytest.approx(expected, rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("rods", [10, *repeated([3])])
def test_small_variables_take_no_more_operations(formalism: object, rods: int) -> None:
    found, afterwards = of_small_variables(formalism, rods), truncated_afterwards(formalism, rods)  # type: ignore[arg-type]
    assert found.residuals == pytest.approx(afterwards.residuals, rel=1e-11)
    assert found.operations <= afterwards.operations
