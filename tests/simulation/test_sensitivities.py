"""Sensitivities of motions: closed forms, outputs, events, rates that jump, and starts that constraints decide."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Event,
    Force,
    ModelNotice,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    sign,
    simulate,
    symbols,
    t,
    time_derivative,
    translate,
)

x, y, z = functions_of_time("x y z")
m, k, c, g, F, t0 = symbols("m k c g F t0")
v = time_derivative(x)
VALUES = {m: 2.0, k: 8.0}


def cart(*forces: object, **options: object) -> Equations:
    """Return a cart on a line, with forces along it."""
    body = Body(translate(x, 0, 0), m)
    loads = [Force(ground, force, 0, 0, at=body.center_of_mass, on=body) for force in forces]  # type: ignore[arg-type]
    return newton_euler(System([body], loads, [x], **options))  # type: ignore[arg-type]


def test_an_oscillator_in_closed_form() -> None:
    motion = simulate(cart(-k * x), VALUES, {x: 0.3}, (0, 3), sensitivities=[k, x, v])
    omega, time = 2.0, motion.t
    by_k = -0.3 * np.sin(omega * time) * time / (2 * omega * VALUES[m])
    assert_allclose(motion.sensitivity(x, by=k), by_k, atol=1e-8)
    assert_allclose(motion.sensitivity(v, by=x), -omega * np.sin(omega * time), atol=1e-7)
    assert_allclose(motion.sensitivity(x, by=v), np.sin(omega * time) / omega, atol=1e-8)


def test_expressions_hold_parameters_accelerations_and_rates() -> None:
    motion = simulate(cart(-k * x), VALUES, {x: 0.3}, (0, 2), sensitivities=[k])
    at, slope = motion[x], motion.sensitivity(x, by=k)
    assert_allclose(motion.sensitivity(k * x**2, by=k), at**2 + 2 * VALUES[k] * at * slope, atol=1e-9)
    acceleration = -(at + VALUES[k] * slope) / VALUES[m]
    assert_allclose(motion.sensitivity(time_derivative(x, 2), by=k), acceleration, atol=1e-9)


def test_a_parameter_that_is_tiny_or_zero() -> None:
    """The tolerances suit the sizes of parameters: a compliance of 1e-9, and damping of zero."""
    soft = cart(-x / k, -c * v)
    motion = simulate(soft, {m: 1e9, k: 1e-9, c: 0.0}, {x: 0.3}, (0, 2), sensitivities=[k, c])
    by_k = 0.3 * np.sin(motion.t) * motion.t / 2 * 1e9
    assert_allclose(motion.sensitivity(x, by=k), by_k, atol=1e-7 * 1e9)
    by_c = -0.3e-9 * (motion.t * np.cos(motion.t) - np.sin(motion.t)) / 2
    assert_allclose(motion.sensitivity(x, by=c), by_c, atol=1e-6 * 1e-9)


def test_a_state_beside_the_mechanics() -> None:
    """A lag z' = (F - z)/c drives the cart."""
    eqs = cart(z, states={z: (F - z) / c})
    motion = simulate(eqs, {m: 2.0, F: 3.0, c: 0.5}, {}, (0, 1), sensitivities=[c, F, z])
    lag = np.exp(-motion.t / 0.5)
    assert_allclose(motion.sensitivity(z, by=F), 1 - lag, atol=1e-8)
    assert_allclose(motion.sensitivity(z, by=z), lag, atol=1e-8)
    assert_allclose(motion.sensitivity(z, by=c), -3.0 * motion.t / 0.25 * lag, atol=1e-7)
    assert_allclose(motion.sensitivity(v, by=F), (motion.t - 0.5 * (1 - lag)) / 2, atol=1e-8)


def test_the_work_is_still_integrated() -> None:
    with_slopes, without = (
        simulate(cart(-k * x - c * v), {**VALUES, c: 0.4}, {x: 0.3}, (0, 3), sensitivities=by)
        for by in ([k, c], None)
    )
    assert_allclose(with_slopes.work, without.work, atol=1e-9)
    assert with_slopes.energy_drift < 1e-7
    assert without.slopes is None


def test_the_instant_of_an_event() -> None:
    """A fall from the height h ends at sqrt(2 h/g)."""
    ball = System([Body(translate(0, 0, z), 1)], (), [z], gravity=Vector(ground, 0, 0, -g))
    landing = Event(z - c, direction=-1, terminal=True, name="landing")
    motion = simulate(
        newton_euler(ball), {g: 9.81, c: 0.0}, {z: 4.905}, (0, 2), events=[landing], sensitivities=[z, g, c]
    )
    (event,) = motion.events
    assert motion.instant_sensitivity(event, by=z) == pytest.approx(1 / 9.81, rel=1e-9)
    assert motion.instant_sensitivity(event, by=g) == pytest.approx(-0.5 / 9.81, rel=1e-9)
    assert motion.instant_sensitivity(event, by=c) == pytest.approx(-1 / 9.81, rel=1e-9)
    assert motion.t[-1] == event.t
    assert_allclose(motion.sensitivity(z, by=g)[-1], -0.5, rtol=1e-9)


def test_the_sensitivities_at_an_end_before_the_last_instant() -> None:
    motion = simulate(
        cart(-k * x), VALUES, {x: 0.3}, (0, 2), events=[Event(x, terminal=True)], sensitivities=[k]
    )
    assert motion.slopes is not None
    assert motion.slopes.shape == (len(motion.t), 2, 1)
    end = motion.t[-1]
    assert_allclose(motion.sensitivity(x, by=k)[-1], -0.3 * np.sin(2 * end) * end / 8, atol=1e-9)


def test_sensitivities_after_a_jump_are_not_a_number() -> None:
    """Friction changes its sign where the cart turns back, at an instant that depends on k."""
    friction = cart(-k * x - 0.2 * sign(v))
    with pytest.warns(ModelNotice, match=r"the rates jump at t = 1\.57"):
        motion = simulate(friction, VALUES, {x: 0.3}, (0, 2), sensitivities=[k])
    before, after = motion.t < 1.5, motion.t > 1.6
    assert np.isfinite(motion.sensitivity(x, by=k)[before]).all()
    assert np.isnan(motion.sensitivity(x, by=k)[after]).all()
    assert np.isfinite(motion[x]).all()
    assert motion.events == ()


def test_kinks_and_jumps_at_given_instants_do_no_harm() -> None:
    """The law v |v| has a kink; a switch at a time that no parameter moves leaves the sensitivities continuous."""
    drag = cart(-k * x - 0.1 * v**2 * sign(v) + 0.5 * sign(t - 1))
    by_k = simulate(drag, VALUES, {x: 0.3}, (0, 2), sensitivities=[k], rtol=1e-10).sensitivity(x, by=k)
    h = 1e-3
    ends = [
        simulate(drag, {**VALUES, k: VALUES[k] + d}, {x: 0.3}, (0, 2), rtol=1e-10)[x][-1] for d in (h, -h)
    ]
    assert by_k[-1] == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-5)


def test_a_switching_instant_that_is_a_parameter() -> None:
    switched = cart(-k * x + 0.5 * sign(t - t0))
    with pytest.warns(ModelNotice, match="the rates jump at t = 1 s, where"):
        motion = simulate(switched, {**VALUES, t0: 1.0}, {x: 0.3}, (0, 2), sensitivities=[t0])
    assert np.isnan(motion.sensitivity(x, by=t0)[-1])
    motion = simulate(switched, {**VALUES, t0: 1.0}, {x: 0.3}, (0, 2), sensitivities=[k])
    assert np.isfinite(motion.sensitivity(x, by=k)).all()
