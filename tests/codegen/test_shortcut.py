"""Machine code with a shortcut: it is taken where all its conditions are positive, and only there."""

from __future__ import annotations

import pickle
from math import inf, nan

import numpy as np
import pytest

from symbody import Matrix, linear_solve, sin, sqrt, symbols
from symbody.codegen import PreparedCode, Shortcut
from symbody.codegen.machine.prepared_code import WORTH_LANES

x, y, p, q = symbols("x y p q")
VALUES = np.array([2.0, 3.0])


def code() -> PreparedCode:
    """Return a function whose two ways differ, so that they can be distinguished."""
    shortcut = Shortcut((p * x, sin(q) * y), (x - p, sqrt(y)))
    solution = linear_solve(Matrix([[p, x], [x, q]]), [1, y])
    return PreparedCode((p, q), (x, y), (-solution[0], -solution[1] * sin(q)), shortcut)


def safely(u: float, v: float) -> list[float]:
    one, two = np.linalg.solve([[2.0, u], [u, 3.0]], [1.0, v])
    return [-one, -two * np.sin(3.0)]


def test_where_all_conditions_are_positive() -> None:
    np.testing.assert_allclose(
        code().evaluate(VALUES, np.array([5.0, 4.0])), [10.0, 4 * np.sin(3.0)], rtol=1e-15
    )


@pytest.mark.parametrize(("u", "v"), [(2.0, 4.0), (1.0, 4.0), (5.0, 0.0), (5.0, -1.0), (-1.0, -1.0)])
def test_where_some_condition_is_zero_or_negative_or_no_number(u: float, v: float) -> None:
    np.testing.assert_allclose(code().evaluate(VALUES, np.array([u, v])), safely(u, v), rtol=1e-13)


@pytest.mark.parametrize(("u", "v"), [(nan, 1.0), (1.0, nan), (-inf, 1.0)])
def test_what_is_no_number_stays_so(u: float, v: float) -> None:
    assert np.isnan(code().evaluate(VALUES, np.array([u, v]))).any()


def test_after_a_journey() -> None:
    again = pickle.loads(pickle.dumps(code()))
    for state in ([5.0, 4.0], [1.0, 4.0]):
        np.testing.assert_array_equal(
            again.evaluate(VALUES, np.array(state)), code().evaluate(VALUES, np.array(state))
        )


def test_parameters_are_prepared_once_for_both_ways() -> None:
    assert code().constants == 3
    assert set(code().prepare(VALUES)) == {2.0, 3.0, np.sin(3.0)}


def test_no_condition_is_always_positive() -> None:
    brief = PreparedCode((), (x,), (x,), Shortcut((2 * x,), ()))
    assert brief.evaluate(np.array([]), np.array([3.0])) == [6.0]


def test_many_states_are_evaluated_as_one() -> None:
    """Several at a time; code for one state where a condition fails, and constants once where parameters agree."""
    # The two ways differ, so that they can be distinguished.
    either = PreparedCode((p,), (x,), (p * x * abs(x), p + x), Shortcut((2 * p * x**2, p + x), (x,)))
    rows, same = np.linspace(-1, 3, WORTH_LANES + 3)[:, None], np.full((WORTH_LANES + 3, 1), 2.5)
    for parameters in (same, np.linspace(1, 2, len(rows))[:, None]):
        expected = [either.evaluate(*given) for given in zip(parameters, rows, strict=True)]
        np.testing.assert_array_equal(either.evaluate_many(parameters, rows), expected)
