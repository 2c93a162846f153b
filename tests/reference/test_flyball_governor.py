"""IFToMM benchmark A05: the flyball governor on stiff springs, by explicit and by implicit methods.

The benchmark publishes a plot; the rows are of two integrations, Radau's and BDF, of equations derived elsewhere.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import ModelNotice, angular_momentum, simulate, symbols, time_derivative
from tests.reference.mechanisms.flyball_governor import flyball_governor
from tests.reference.mechanisms.problem import reference

RUN = reference("flyball_governor")["results"]["IFToMM"]
ROWS = np.array(RUN["rows"])
PROBLEM = flyball_governor()


def test_it_begins_as_the_reference() -> None:
    psi, alpha, s = PROBLEM.equations.coordinates
    columns = [*(psi, alpha, s), *map(time_derivative, (psi, alpha, s))]
    assert_allclose([PROBLEM.initial[name] for name in columns], ROWS[0, 1:], rtol=1e-15)


@pytest.mark.parametrize(
    ("method", "rtol"), [("auto", 1e-10), ("bdf", 1e-11), ("esdirk34", 1e-11), ("ida", 1e-11)]
)
def test_it_moves_as_the_reference(method: str, rtol: float) -> None:
    """All 41 rows of angles, height and rates, within what the reference's two integrations differ by."""
    if method == "ida":
        pytest.importorskip("sksundae")
    motion = simulate(
        PROBLEM.equations,
        PROBLEM.parameters,
        PROBLEM.initial,
        ROWS[:, 0],
        method=method,
        rtol=rtol,
        atol=1e-13,
    )
    assert_allclose(motion.states, ROWS[:, 1:], rtol=0, atol=RUN["radau_vs_bdf_max"])


def test_that_it_is_stiff_is_told_and_another_method_is_faster() -> None:
    """At a tolerance at which springs and dampers that have settled would let steps be long."""
    given = (PROBLEM.equations, PROBLEM.parameters, PROBLEM.initial, (0, 10))
    with pytest.warns(ModelNotice, match="stiff"):
        explicit = simulate(*given, rtol=1e-5, atol=1e-7)
    implicit = simulate(*given, rtol=1e-5, atol=1e-7, method="bdf")
    assert 10 * implicit.statistics.evaluations < explicit.statistics.evaluations


@pytest.mark.parametrize("damping", [RUN["c"], 0.0])
def test_energy_is_kept_but_for_the_work_of_springs_and_dampers(damping: float) -> None:
    parameters = PROBLEM.parameters | {symbols("c"): damping}
    motion = simulate(PROBLEM.equations, parameters, PROBLEM.initial, (0, 10), rtol=1e-10)
    assert motion.energy_drift < 1e-9


def test_no_load_turns_the_governor() -> None:
    """Springs act within it, weights are parallel to the shaft: the angular momentum about the shaft stays."""
    motion = simulate(PROBLEM.equations, PROBLEM.parameters, PROBLEM.initial, (0, 10), rtol=1e-10)
    _, _, about_the_shaft = angular_momentum(PROBLEM.equations.system).components
    assert_allclose(motion[about_the_shaft], motion[about_the_shaft][0], rtol=1e-11)
