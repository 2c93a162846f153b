"""Angles of steady motions are those nearest to the guess, and parts that are turned far from it are told."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    ModelNotice,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    symbols,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody.simulation.steady_state.steady_problem import Search, SteadyProblem, steady_problem
from symbody.simulation.steady_state.whole_turns import without_whole_turns

psi, theta = functions_of_time("psi theta")
m, l, g, k = symbols("m l g k")


def carousel(guess: float, *, coil: bool = False, **options: object) -> SteadyProblem:
    """A swing on the rim of a carousel that turns at a given rate."""
    arm = rotate("Z", psi) * translate(2 * l, 0, 0)
    rim = Body(arm, 0, name="rim")
    bob = Body(arm * rotate("Y", theta) * translate(0, 0, -l), m, name="bob")
    loads = [torsion_spring(theta, k, on=bob, reaction=rim)] if coil else []
    system = System([rim, bob], loads, [psi, theta], gravity=Vector(ground, 0, 0, -g))
    values = {m: 1.0, l: 1.0, g: 9.81} | ({k: 1.0} if coil else {})
    search = Search(
        newton_euler(system), values, given={time_derivative(psi): 2.0}, guess={theta: guess}, **options
    )  # type: ignore[arg-type]
    return steady_problem(search)


def angle(problem: SteadyProblem, value: float) -> float:
    x = problem.start.copy()
    x[problem.names.index(theta)] = value
    return float(without_whole_turns(problem, x, np.zeros(problem.balance.count))[problem.names.index(theta)])


def test_whole_turns_are_taken_off() -> None:
    assert angle(carousel(0.0), -0.84 + 6 * np.pi) == pytest.approx(-0.84)
    assert angle(carousel(12.0), -0.84 + 2 * np.pi) == pytest.approx(-0.84 + 4 * np.pi)


def test_the_angle_of_a_coil_spring_counts_turns() -> None:
    assert angle(carousel(0.0, coil=True), -0.84 + 6 * np.pi) == -0.84 + 6 * np.pi


def test_angles_within_limits_stay_there() -> None:
    with pytest.warns(ModelNotice, match=r"theta = 5.4 rad is more than a quarter"):
        assert angle(carousel(0.0, limits={theta: (5, 6)}), 5.4) == 5.4


def test_a_part_that_is_turned_round_is_told() -> None:
    with pytest.warns(ModelNotice) as caught:
        assert angle(carousel(0.1), 2.6) == 2.6
    assert [str(each.message) for each in caught] == [
        (
            "steady: theta = 2.6 rad is more than a quarter of a turn from where the search began, at 0.1: check that "
            "this is the motion that you mean; if not, give a guess, or limits such as limits={theta: (-1, 1)}"
        )
    ]
