"""Measures are what the closed form of the motion gives, or a fine evaluation of it."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import (
    Body,
    Event,
    Force,
    Max,
    System,
    functions_of_time,
    ground,
    measures,
    newton_euler,
    sample,
    simulate,
    sin,
    small,
    study,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.models import four_bar
from tests.simulation.oscillator import OSCILLATOR, c, displacement, k, m, oscillators, u, x

CASES = sample({k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}, 32, seed=1)
FINE = np.linspace(0, 6, 60001)
EXACT = displacement(CASES[k][:, None], CASES[c][:, None], 0.1, FINE)


def test_values_at_instants_and_at_the_end() -> None:
    found = oscillators(CASES, measures={"end": measures.final(x), "2.5": measures.value_at(x, 2.5)})
    np.testing.assert_allclose(found["end"], EXACT[:, -1], atol=1e-8)
    np.testing.assert_allclose(found["2.5"], EXACT[:, 25000], atol=1e-8)
    np.testing.assert_array_equal(found.t, [0, 2.5, 6])


def test_extremes_are_located_between_the_instants() -> None:
    found = oscillators(
        CASES, measures={"low": measures.minimum(x), "high": measures.maximum(x), "fast": measures.maximum(u)}
    )
    half = np.pi / np.sqrt(CASES[k] - CASES[c] ** 2 / 4)
    np.testing.assert_allclose(found["low"], displacement(CASES[k], CASES[c], 0.1, half), rtol=1e-8)
    np.testing.assert_allclose(found["low instant"], half, rtol=1e-7)
    np.testing.assert_array_equal(found["high"], 0.1)
    np.testing.assert_array_equal(found["high instant"], 0.0)
    speeds = np.gradient(EXACT, FINE, axis=1).max(axis=1)
    np.testing.assert_allclose(found["fast"], speeds, rtol=1e-6)


def test_integrals_are_in_the_error_estimate() -> None:
    given = {
        "cost": measures.integral(x**2),
        "mean": measures.average(x),
        "effective": measures.rms(x),
        "of accelerations": measures.integral(time_derivative(u)),
    }
    found = oscillators(CASES, measures=given, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(found["cost"], np.trapezoid(EXACT**2, FINE, axis=1), rtol=1e-7)
    np.testing.assert_allclose(found["mean"], np.trapezoid(EXACT, FINE, axis=1) / 6, atol=1e-9)
    effective = np.sqrt(np.trapezoid(EXACT**2, FINE, axis=1) / 6)
    np.testing.assert_allclose(found["effective"], effective, rtol=1e-7)
    gained = oscillators(CASES, measures={"u": measures.final(u)}, rtol=1e-10, atol=1e-12)["u"]
    np.testing.assert_allclose(found["of accelerations"], gained, atol=1e-9)


@pytest.mark.parametrize("level", [0.03, 0.0, -0.2, 0.2])
def test_times_above_a_level(level: float) -> None:
    """Also where the motion is always above, never above, or begins on the level."""
    found = oscillators(CASES, measures={"above": measures.time_above(x, level)})
    np.testing.assert_allclose(found["above"], 6 * (level < EXACT).mean(axis=1), atol=1e-3)


def test_a_level_on_which_the_motion_begins() -> None:
    found = oscillators(
        CASES, measures={"above": measures.time_above(x, 0.1), "right": measures.time_above(u)}
    )
    np.testing.assert_array_equal(found["above"], 0.0)
    half = np.pi / np.sqrt(CASES[k] - CASES[c] ** 2 / 4)
    forth = np.where(half < 6, np.minimum(2 * half, 6) - half, 0) + np.maximum(0, 6 - 3 * half)
    np.testing.assert_allclose(found["right"], forth, atol=1e-7)


def test_settling_times_and_first_crossings() -> None:
    given = {
        "settled": measures.settling_time(x, 0.05),
        "at once": measures.settling_time(x, 0.2),
        "never": measures.settling_time(x, 0.05, target=1),
        "falls": measures.first_crossing(x, direction=-1),
        "rises": measures.first_crossing(x - 1),
    }
    found = oscillators(CASES, measures=given)
    outside = np.abs(EXACT) > 0.05
    last = FINE[len(FINE) - 1 - outside[:, ::-1].argmax(axis=1)]
    np.testing.assert_allclose(found["settled"], np.where(outside[:, -1], np.nan, last), atol=2e-4)
    np.testing.assert_array_equal(found["at once"], 0.0)
    assert np.isnan(found["never"]).all()
    assert np.isnan(found["rises"]).all()
    np.testing.assert_allclose(found["falls"], FINE[(EXACT < 0).argmax(axis=1)], atol=1e-3)


def test_measures_end_where_the_motion_ends() -> None:
    given = {
        "x": measures.final(x),
        "time": measures.integral(x / x),
        "low": measures.minimum(x),
        "mean": measures.average(u),
    }
    passing = Event(x, direction=-1, terminal=True)
    found = oscillators({c: [0.0] * 3, k: [1.0, 4.0, 0.01]}, measures=given, events=[passing])
    quarter = np.pi / 2 / np.array([1.0, 2.0])
    np.testing.assert_allclose(found["time"], [*quarter, 6.0], rtol=1e-7)
    np.testing.assert_allclose(found["low"][:2], 0.0, atol=1e-12)
    np.testing.assert_allclose(found["mean"][:2], -0.1 / quarter, rtol=1e-7)
    assert found["x"][2] == pytest.approx(0.1 * np.cos(0.6))


def test_integrals_of_squares_of_small_variables() -> None:
    """The equations keep first order; a cost of second order is kept whole."""
    marked = small(x)
    body = Body(translate(marked, 0, 0), m)
    equations = newton_euler(System([body], [], [marked]))
    found = study(
        equations,
        {m: 1},
        {time_derivative(marked): 0.5},
        (0, 2),
        measures={"cost": measures.integral(marked**2)},
    )
    assert found["cost"][0] == pytest.approx(0.25 * 8 / 3)


def test_measures_of_a_mechanism_with_constraints() -> None:
    """Multipliers, kinks and inputs: the maximum between instants is at least that on a fine grid, and hardly more."""
    model = four_bar()
    equations = newton_euler(model.system)
    crank = equations.coordinates[0]
    speed = time_derivative(crank)
    force = equations.multipliers[0]
    given = {
        "force": measures.maximum(force),
        "turn": measures.final(crank),
        "kink": measures.maximum(Max(speed, 0)),
    }
    where = {"inputs": model.inputs, "guess": model.guess}
    found = study(equations, model.parameters, model.initial, (0, 1), measures=given, **where)
    fine = np.linspace(0, 1, 4001)
    motion = simulate(equations, model.parameters, model.initial, fine, **where)
    assert found["force"][0] == pytest.approx(motion[force].max(), rel=1e-5)
    assert found["force"][0] >= motion[force].max() - 1e-6
    assert found["turn"][0] == pytest.approx(motion[crank][-1], abs=1e-6)
    assert found["kink"][0] == pytest.approx(max(0, motion[speed].max()), rel=1e-5)


def test_random_inputs_are_random_parameters_of_inputs() -> None:
    """A force of random amplitude and phase on a free mass: ``x = A (sin(phase) + t cos(phase) - sin(t + phase))``."""
    force, (amplitude, phase) = functions_of_time("F"), symbols("amplitude phase")
    body = Body(translate(x, 0, 0), m)
    equations = newton_euler(
        System([body], [Force(ground, force, 0, 0, at=body.center_of_mass, on=body)], [x])
    )
    cases = sample({amplitude: ("normal", 1, 0.2), phase: ("uniform", 0, 6.28)}, 16)
    found = study(
        equations,
        {m: 1},
        t=(0, 2),
        cases=cases,
        inputs={force: amplitude * sin(t + phase)},
        measures={"x": measures.final(x)},
    )
    A, p = cases[amplitude], cases[phase]
    np.testing.assert_allclose(found["x"], A * (np.sin(p) + 2 * np.cos(p) - np.sin(2 + p)), atol=1e-8)


def test_nothing_depends_on_the_integrals() -> None:
    """Beside the integrals, the motion is the same within the tolerance, and the equations are untouched."""
    before = OSCILLATOR.states
    alone, beside = (
        oscillators(CASES, measures={"x": measures.final(x)} | more)
        for more in ({}, {"cost": measures.integral(x**2)})
    )
    assert before == OSCILLATOR.states == ()
    np.testing.assert_allclose(alone["x"], beside["x"], atol=1e-9)
