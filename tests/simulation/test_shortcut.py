"""Rates by independent speeds: the same numbers, also where other speeds have to be independent."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from symbody import (
    Body,
    System,
    dot,
    functions_of_time,
    lambdify,
    newton_euler,
    origin,
    simulate,
    symbols,
    translate,
)
from symbody.simulation.model.model import Model, model_of
from tests.reference.mechanisms.andrews import andrews
from tests.reference.mechanisms.double_pendulum import natural_double_pendulum
from tests.reference.mechanisms.n_fourbar import n_fourbar
from tests.reference.mechanisms.problem import Problem
from tests.reference.mechanisms.simple_pendulum import natural_simple_pendulum, simple_pendulum, theta
from tests.reference.mechanisms.slider_crank import slider_crank

DURATIONS = {
    andrews: 0.03,
    natural_double_pendulum: 3.0,
    natural_simple_pendulum: 3.0,
    n_fourbar: 3.0,
    slider_crank: 10.0,
}


def values(problem: Problem, model: Model) -> NDArray[np.float64]:
    return np.array([problem.parameters[name] for name in model.parameters])


@pytest.mark.parametrize("describe", DURATIONS)
def test_rates_and_corrections_are_those_of_the_other_way(describe: Callable[[], Problem]) -> None:
    """Along a motion, and off the constraints; relative to the largest, as sums of large terms cancel."""
    problem = describe()
    model = model_of(problem.equations)
    assert model.shortcut is not None
    motion = simulate(
        problem.equations, problem.parameters, problem.initial, t=np.linspace(0, DURATIONS[describe], 200)
    )
    rng, own = np.random.default_rng(1), values(problem, model)
    for code in (model.rates_code, *model.correction_codes):
        assert code.shortcut is not None
        slow = model.code(code.expressions)
        for t, state in zip(motion.t, motion.states, strict=True):
            row = np.zeros(1 + model.width)
            row[0], row[1 : 1 + len(state)] = t, state * (1 + 1e-3 * rng.normal(size=len(state)))
            found, expected = code.evaluate(own, row), slow.evaluate(own, row)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8 * np.abs(expected).max())


def test_where_the_dependent_speed_is_at_its_dead_centre() -> None:
    """A mass on a circle, x independent, on the level of the centre: y moves, x can't."""
    problem = natural_simple_pendulum()
    model = model_of(problem.equations)
    assert model.shortcut is not None
    conditions = lambdify([*model.state, *model.parameters], list(model.shortcut.conditions))
    own, slow = values(problem, model), model.code(model.rates)
    for y, is_accurate in ((0.0, False), (1e-4, False), (0.3, True)):
        x = -np.sqrt(1 - y**2)
        state = [x, y, 0.4 * y, -0.4 * x]
        assert bool(np.all(conditions(*state, *own) > 0)) == is_accurate
        row = np.array([0.0, *state])
        np.testing.assert_allclose(
            model.rates_code.evaluate(own, row), slow.evaluate(own, row), rtol=1e-12, atol=1e-14
        )


def test_what_would_be_long_or_needs_much_derivation_has_none() -> None:
    """A net of masses on bars, and as many masses with one constraint over all of them."""
    places = functions_of_time([f"{axis}{i}" for i in range(12) for axis in "xyz"])
    masses = [translate(*places[3 * i : 3 * i + 3]) for i in range(12)]
    m, l = symbols("m l")
    sides = [origin(masses[i]) - origin(masses[j]) for i in range(12) for j in (i - 1, i - 4) if j >= 0]
    net = System([Body(mass, m) for mass in masses], [], places, [dot(side, side) - l**2 for side in sides])
    ring = System([Body(mass, m) for mass in masses], [], places, [sum(place**2 for place in places) - l**2])
    for system in (net, ring):
        model = model_of(newton_euler(system))
        assert model.solution.method == "schur_complement"
        assert model.shortcut is None


def test_through_dead_centres() -> None:
    """The mass on the circle starts on the level of the centre, and comes back there again and again."""
    natural, angle = natural_simple_pendulum(), simple_pendulum()
    settings = {"t": np.linspace(0, 10, 301), "rtol": 1e-11, "atol": 1e-12}
    found = simulate(natural.equations, natural.parameters, natural.initial, **settings)
    expected = simulate(angle.equations, angle.parameters, angle.initial, **settings)
    np.testing.assert_allclose(found.states[:, 0], np.cos(expected[theta]), atol=1e-8)
    assert found.energy_drift < 1e-9
    assert found.constraint_drift < 1e-12
