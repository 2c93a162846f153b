"""Fits recover what made the measurements, with the covariance that theory and SciPy give."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from scipy import optimize

from symbody import (
    Body,
    Experiment,
    Fit,
    Force,
    Measurement,
    ModelNotice,
    System,
    fit,
    functions_of_time,
    ground,
    newton_euler,
    sign,
    simulate,
    symbols,
    time_derivative,
    translate,
)
from symbody.models import four_bar
from tests.simulation.oscillator import OSCILLATOR, c, cart, displacement, k, m, u, x

NOISE = 0.002
T = np.linspace(0, 10, 101)
LATER = np.linspace(1, 7, 50)
offset = symbols("offset")


def measured(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Two releases, of which the second is measured with an offset."""
    noise = np.random.default_rng(seed)
    one = displacement(4, 0.3, 0.1, T) + NOISE * noise.normal(size=T.size)
    other = displacement(4, 0.3, 0.2, LATER) + 0.01 + NOISE * noise.normal(size=LATER.size)
    return one, other


def both(seed: int = 3, **options: Any) -> Fit:
    one, other = measured(seed)
    experiments = [
        Experiment([Measurement(x, T, one, deviation=NOISE)], unknown={x: 0.15}),
        Experiment([Measurement(x + offset, LATER, other, deviation=NOISE)], unknown={x: (0.15, 0, 1)}),
    ]
    unknown = {k: (3.5, 0, 10), c: (0.1, 0, 1), offset: 0.0}
    return fit(OSCILLATOR, experiments, {m: 1.0}, unknown=unknown, **options)


def of_closed_form(seed: int) -> optimize.OptimizeResult:
    """The same least squares with the closed form, and with difference quotients."""
    one, other = measured(seed)

    def residuals(p: np.ndarray) -> np.ndarray:
        first = displacement(p[0], p[1], p[3], T) - one
        second = displacement(p[0], p[1], p[4], LATER) + p[2] - other
        return np.concatenate([first, second]) / NOISE

    return optimize.least_squares(residuals, [3.5, 0.1, 0, 0.15, 0.15], xtol=1e-12, ftol=1e-12)


def test_several_experiments_with_unknowns_of_their_own() -> None:
    found, expected = both(), of_closed_form(3)
    np.testing.assert_allclose(found.x, expected.x, rtol=1e-5)
    covariance = np.linalg.inv(expected.jac.T @ expected.jac)
    np.testing.assert_allclose(found.covariance, covariance, rtol=1e-4)
    assert found[k] == found.estimates[0].value == found.x[0]
    assert found.cost == pytest.approx(expected.cost, rel=1e-6)
    assert found.given(1)[1] == {x: found.x[4]}
    assert found.motion(0)[x][0] == pytest.approx(found.x[3])


def test_estimates_scatter_as_their_covariance_says() -> None:
    """Six noises: the errors relative to the deviations are those of chi-squared with 30 degrees of freedom."""
    exact = np.array([4, 0.3, 0.01, 0.1, 0.2])
    total = 0.0
    for seed in range(6):
        found = both(seed)
        error = found.x - exact
        total += float(error @ np.linalg.solve(found.covariance, error))
    assert 13 < total < 60


def test_unknown_deviations_come_from_the_residuals() -> None:
    one, _ = measured(3)
    found = fit(
        OSCILLATOR, Experiment([Measurement(x, T, one)], initial={x: 0.1}), {m: 1.0}, unknown={k: 3.5, c: 0.1}
    )
    assert np.sqrt(found.variance) == pytest.approx(NOISE, rel=0.15)
    curve = optimize.curve_fit(lambda t, *p: displacement(*p, 0.1, t), T, one, p0=[3.5, 0.1])
    np.testing.assert_allclose(found.x, curve[0], rtol=1e-5)
    np.testing.assert_allclose(found.covariance, curve[1], rtol=1e-3)
    low, high = found.estimates[0].low, found.estimates[0].high
    assert high - low == pytest.approx(2 * 1.984 * found.estimates[0].deviation, rel=1e-3)


def test_several_outputs_with_weights() -> None:
    """A speed and an acceleration, at instants of their own."""
    t, other = np.linspace(0, 4, 21), np.linspace(0.5, 3, 11)
    motion = simulate(OSCILLATOR, {m: 2.0, k: 5.0, c: 0.4}, {x: 0.2}, np.union1d(t, other))
    rows = {expression: motion[expression] for expression in (u, time_derivative(u))}
    release = Experiment(
        [
            Measurement(u, t, rows[u][np.isin(motion.t, t)], deviation=0.01),
            Measurement(
                time_derivative(u), other, rows[time_derivative(u)][np.isin(motion.t, other)], deviation=1.0
            ),
        ],
        parameters={m: 2.0},
        initial={x: 0.2},
    )
    found = fit(OSCILLATOR, release, unknown={k: 3.0, c: 0.0})
    np.testing.assert_allclose(found.x, [5.0, 0.4], rtol=1e-6)


def test_a_length_of_a_linkage() -> None:
    """Constraints: the start moves with the length that is estimated."""
    model = four_bar()
    equations = newton_euler(model.system)
    length = model["LB"]
    where = {"inputs": model.inputs, "guess": model.guess}
    t = np.linspace(0, 1, 21)
    motion = simulate(equations, model.parameters, model.initial, t, **where)
    others = {name: value for name, value in model.parameters.items() if name != length}
    start = 1.02 * model.parameters[length]
    run = Experiment([Measurement(each, t, motion[each]) for each in equations.coordinates[:2]])
    found = fit(equations, run, others, model.initial, unknown={length: start}, **where)
    assert found[length] == pytest.approx(model.parameters[length], rel=1e-6)


def test_what_is_not_determined_is_named() -> None:
    """Mass, stiffness and damping have a common factor; a parameter of another model has no effect at all."""
    one, _ = measured(3)
    release = Experiment([Measurement(x, T, one)], initial={x: 0.1})
    with pytest.warns(ModelNotice, match="determine a combination of k, c and m only, not each of them"):
        found = fit(OSCILLATOR, release, unknown={k: 3.5, c: 0.1, m: 1.1})
    assert np.isinf([each.deviation for each in found.estimates]).all()
    assert found[k] / found[m] == pytest.approx(4, rel=1e-2)
    still = Experiment([Measurement(x, T, np.zeros(T.size))], initial={x: 0.0})
    with pytest.warns(ModelNotice, match="the measurements don't depend on k: their deviations are infinite"):
        fit(OSCILLATOR, still, {m: 1.0, c: 0.1}, unknown={k: 3.5})


def test_outliers_count_less_by_a_robust_loss() -> None:
    one, _ = measured(3)
    one[10:90:10] += 0.5
    release = Experiment([Measurement(x, T, one, deviation=NOISE)], initial={x: 0.1})
    robust = fit(OSCILLATOR, release, {m: 1.0}, unknown={k: 3.9, c: 0.25}, loss="soft_l1")
    assert robust[k] == pytest.approx(4, abs=0.03)


def test_rates_that_jump_are_fitted_by_difference_quotients() -> None:
    """Dry friction: its sensitivities are not known after the first jump."""
    mu = symbols("mu")
    rubbing = Force(ground, -k * x - mu * sign(u), 0, 0, at=cart.center_of_mass, on=cart)
    block = newton_euler(System([cart], [rubbing], [x]))
    t = np.linspace(0, 2.5, 26)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        motion = simulate(block, {m: 1.0, k: 4.0, mu: 0.02}, {x: 0.1, u: 0.5}, t, max_step=0.05)
    release = Experiment([Measurement(x, t, motion[x])], initial={x: 0.1, u: 0.5})
    with pytest.warns(ModelNotice, match="derivatives are difference quotients"):
        found = fit(block, release, {m: 1.0}, unknown={k: 4.2, mu: 0.03}, max_step=0.05)
    np.testing.assert_allclose(found.x, [4.0, 0.02], rtol=1e-4)


def test_a_bound_is_told() -> None:
    one, _ = measured(3)
    release = Experiment([Measurement(x, T, one)], initial={x: 0.1})
    with pytest.warns(ModelNotice, match="fit: k is at a bound"):
        fit(OSCILLATOR, release, {m: 1.0}, unknown={k: (3.0, 0, 3.5), c: 0.1})


def test_a_search_turns_back_where_there_is_no_motion() -> None:
    """A mass falls towards a centre: with a strong pull, it arrives before the last measurement."""
    y, pull = functions_of_time("y"), symbols("pull")
    body = Body(translate(y, 0, 0), 1)
    fall = newton_euler(
        System([body], [Force(ground, -pull / y**2, 0, 0, at=body.center_of_mass, on=body)], [y])
    )
    t = np.linspace(0, 1.05, 22)
    motion = simulate(fall, {pull: 1.0}, {y: 1.0}, t)
    found = fit(fall, Experiment([Measurement(y, t, motion[y])], initial={y: 1.0}), unknown={pull: 0.2})
    assert found[pull] == pytest.approx(1.0, rel=1e-6)
