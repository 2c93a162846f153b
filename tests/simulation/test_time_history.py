"""Inputs given as tables: for all motions, or values of its own for each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Force,
    System,
    center_of_mass,
    functions_of_time,
    ground,
    lambdify,
    measures,
    newton_euler,
    simulate,
    simulate_many,
    study,
    symbols,
    t,
    time_histories,
    time_history,
    translate,
)
from symbody.errors import ParameterError
from symbody.simulation.integrate import native

INSTANTS = np.array([0.0, 0.3, 0.5, 1.2, 1.5])
SOME = np.random.default_rng(6)
ROWS = SOME.uniform(-2, 2, (9, len(INSTANTS)))

x, f = functions_of_time("x f")
m, k = symbols("m k")
cart = Body(translate(x, 0, 0), m)
equations = newton_euler(
    System([cart], [Force(ground, f - k * x, 0, 0, at=center_of_mass(cart), on=cart)], coordinates=[x])
)
OPTIONS: dict[str, Any] = {
    "t": np.linspace(0, 2, 9),
    "rtol": 1e-9,
    "atol": 1e-11,
    "max_step": 0.1,
    "progress": False,
}


def test_values_are_those_of_numpy() -> None:
    """Beyond its ends it is constant, as there."""
    places = np.linspace(-1, 3, 81)
    found = lambdify([t], time_history(INSTANTS, ROWS[0]))(places)
    np.testing.assert_allclose(found, np.interp(places, INSTANTS, ROWS[0]), rtol=0, atol=1e-14)


def test_motion_is_that_of_solve_ivp() -> None:
    motion = simulate(equations, {m: 2.0, k: 3.0}, {}, inputs={f: time_history(INSTANTS, ROWS[1])}, **OPTIONS)

    def rates(time: float, state: np.ndarray) -> list[float]:
        return [state[1], (np.interp(time, INSTANTS, ROWS[1]) - 3 * state[0]) / 2]

    given = {"rtol": 1e-10, "atol": 1e-12, "max_step": 0.01, "t_eval": OPTIONS["t"]}
    expected = solve_ivp(rates, (0, 2), [0.0, 0.0], method="DOP853", **given)
    np.testing.assert_allclose(motion.states, expected.y.T, rtol=0, atol=1e-8)


def test_each_motion_has_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """In lanes, too: close to a bend, rounding errors decide on the next step. A study has the values at an instant."""
    force, cases = time_histories("f", INSTANTS, ROWS)
    given = equations, {m: 2.0, k: 3.0}, {}
    options = {**OPTIONS, "cases": cases, "inputs": {f: force}}
    monkeypatch.setattr(native, "WORTH_LANES", 1)
    runs = simulate_many(*given, **options)
    for states, row in zip(runs.states, ROWS, strict=True):
        alone = simulate(*given, **OPTIONS, inputs={f: time_history(INSTANTS, row)})
        np.testing.assert_allclose(states, alone.states, rtol=0, atol=1e-7)
    found = study(*given, **options, measures={"force": measures.value_at(f, 0.4)})
    expected = [np.interp(0.4, INSTANTS, row) for row in ROWS]
    np.testing.assert_allclose(found["force"], expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: time_history([0, 1, 1], [1, 2, 3]),
            "time_history: instants [0.0, 1.0, 1.0]; expected two or more in increasing order",
        ),
        (
            lambda: time_history([0, 1], [1, 2, 3]),
            "time_history: values of shape (3,), and 2 instants; expected one value for each",
        ),
        (
            lambda: time_history([0, 1], [1, float("nan")]),
            "time_history: values: nan is among them; expected finite numbers",
        ),
        (
            lambda: time_histories("f", [0, 1], [1, 2]),
            "time_histories: rows of shape (2,), and 2 instants; expected a row for each motion, of shape (k, 2)",
        ),
        (
            lambda: time_history([0, 1], ["a", 1]),
            "time_history: values: ['a', 1] is a list; expected numbers",
        ),
    ],
)
def test_what_is_no_table_is_an_error(call: Any, message: str) -> None:
    with pytest.raises(ParameterError) as caught:
        call()
    assert str(caught.value) == message
