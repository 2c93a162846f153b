"""What is compiled without being asked for: decided by the size of the function and the points of the call alone."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import CompiledFunction, linear_solve, newton_euler, symbols
from symbody import lambdify as function_of
from symbody.codegen.machine.compile_threshold import is_worth_compiling
from tests.reference.robot import robot


def inverse_dynamics(name: str) -> tuple[CompiledFunction, int]:
    """A function of large robots, and how many rows its argument has."""
    equations = newton_euler(robot(name).system)
    inputs = [*equations.coordinates, *equations.speeds, *equations.accelerations, *equations.parameters]
    return function_of([inputs], equations.residuals), len(inputs)


@pytest.mark.parametrize("operations", [1, 100, 10_000, 10_000_000])
def test_few_points_are_never_compiled_and_enough_points_are(operations: int) -> None:
    assert not any(is_worth_compiling(operations, points) for points in (1, 20, 1001, 2000))
    assert is_worth_compiling(operations, 2000 + 200_000 // operations + 1)


def test_nothing_is_compiled_for_nothing() -> None:
    assert not is_worth_compiling(0, 10**9)
    assert not is_worth_compiling(10**9, 0)


def test_a_large_function_is_evaluated_at_few_points_and_compiled_at_many(
    compiled_functions: list[str],
) -> None:
    function, rows = inverse_dynamics("solo12_floating")
    states = np.random.default_rng(3).uniform(-1, 1, (rows, 4000))
    few = function(states[:, :20])
    assert compiled_functions == []
    many = function(states)
    assert compiled_functions == ["batch"]
    assert np.array_equal(function(states[:, :20]), few)
    np.testing.assert_allclose(many[:, :20], few, rtol=1e-12, atol=1e-12 * np.abs(few).max())


def test_who_asks_for_it_gets_machine_code_and_who_forbids_it_does_not(compiled_functions: list[str]) -> None:
    x = symbols("x")
    function_of([x], [x * x], compile=True)(2.0)
    function_of([x], [x * x], compile=False)(np.ones(10**6))
    assert compiled_functions == ["scalar"]


def test_linear_systems_are_compiled_for_their_notices(compiled_functions: list[str]) -> None:
    a, b = symbols("a b")
    solution = linear_solve([[a, b], [b, -a]], [1, 2])
    function_of([a, b], solution)(1.0, 2.0)
    assert compiled_functions == ["scalar"]
