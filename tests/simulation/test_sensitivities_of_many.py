"""Sensitivities of many motions: those of each motion alone, with events, files and workers."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from symbody import Event, SymbodyError, newton_euler, simulate, simulate_many, sin
from symbody.errors import ArgumentError, ParameterError
from symbody.models import four_bar, n_pendulum

MODEL = n_pendulum(2)
EQUATIONS = newton_euler(MODEL.system)
FIRST, SECOND = MODEL.system.coordinates
P, OTHER = list(MODEL.parameters)[:2]
ROWS = {**MODEL.parameters, P: np.array([0.8, 1.0, 1.2]) * MODEL.parameters[P]}
BY, EVENTS = [P, FIRST], [Event(SECOND - 0.05)]


def test_they_are_those_of_each_motion(tmp_path: Path) -> None:
    options = {"t": (0, 3), "sensitivities": BY, "events": EVENTS}
    runs = simulate_many(EQUATIONS, ROWS, MODEL.initial, **options)
    with ThreadPoolExecutor(2) as pool:
        others = [
            simulate_many(EQUATIONS, ROWS, MODEL.initial, executor=pool, **options),
            *(
                simulate_many(EQUATIONS, ROWS, MODEL.initial, path=tmp_path / "runs.npz", **options)
                for _ in range(2)  # the second one is read
            ),
        ]
    for k in range(3):
        numbers = {**MODEL.parameters, P: float(ROWS[P][k])}
        alone = simulate(EQUATIONS, numbers, MODEL.initial, **options)
        for by in BY:
            expected = alone.sensitivity(P * sin(SECOND), by=by)
            for each in (runs, *others):
                assert np.array_equal(each.sensitivity(P * sin(SECOND), by=by)[k], expected)
                assert np.array_equal(each.motion(k).sensitivity(P * sin(SECOND), by=by), expected)
                event = each.motion(k).events[0]
                slope = each.motion(k).instant_sensitivity(event, by=by)
                assert slope == alone.instant_sensitivity(alone.events[0], by=by)


def test_starts_of_loops_move_with_their_parameters() -> None:
    bars = four_bar()
    eqs, crank = newton_euler(bars.system), bars.system.coordinates[1]
    length = next(iter(bars.parameters))
    rows = {**bars.parameters, length: np.array([0.95, 1.05]) * bars.parameters[length]}
    options = {"t": (0, 1), "sensitivities": [length], "constraints": "baumgarte"}
    runs = simulate_many(eqs, rows, bars.initial, **options)
    for k in range(2):
        numbers = {**bars.parameters, length: float(rows[length][k])}
        alone = simulate(eqs, numbers, bars.initial, **options)
        for value in (crank, eqs.multipliers[0]):
            assert np.array_equal(runs.sensitivity(value, by=length)[k], alone.sensitivity(value, by=length))


MISTAKES: list[tuple[type[SymbodyError], Callable[[], object], str]] = [
    (
        ParameterError,
        lambda: simulate_many(EQUATIONS, ROWS, t=(0, 1)).sensitivity(SECOND, by=P),
        f"runs.sensitivity: this motion has no sensitivities; expected simulate_many(..., sensitivities=[{P}])",
    ),
    (
        ParameterError,
        lambda: simulate_many(EQUATIONS, ROWS, t=(0, 1), sensitivities=BY).sensitivity(SECOND, by=OTHER),
        f"runs.sensitivity, by: {OTHER}; expected one of the sensitivities of simulate_many, {P} or {FIRST}",
    ),
    (
        ArgumentError,
        lambda: simulate_many(EQUATIONS, ROWS, t=(0, 1), sensitivities=BY, keep_states=False),
        "simulate_many: keep_states=False, and sensitivities are those of states; leave one of them out",
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(kind) as caught:
        mistake()
    assert str(caught.value) == message
