"""Law: the gradient by adjoint equations is that of the sensitivities, for systems and functionals of every kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import simpson

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    functions_of_time,
    gradient_of_motion,
    ground,
    newton_euler,
    sign,
    simulate,
    sin,
    symbols,
    time_derivative,
    translate,
)
from symbody import System as SystemOf
from symbody.models import (
    ball_and_beam,
    cart_pole,
    chaplygin_sleigh,
    four_bar,
    n_pendulum,
    quarter_car,
    single_track_car,
    slider_crank,
    snakeboard,
)
from symbody.models.classic_system import ClassicSystem
from symbody.simulation import MotionGradient

INSTANTS = np.linspace(0, 1, 2001)
x = functions_of_time("x")
m, k, c = symbols("m k c")
v = time_derivative(x)


def compare(
    equations: Equations,
    parameters: Any,
    initial: Any,
    by: list[Expr],
    final: Expr,
    integral: Expr,
    tolerance: float = 1e-7,
    **more: Any,
) -> None:
    """Compare the gradient of a functional with that of the sensitivities of its parts."""
    options = {"rtol": 1e-11, "atol": 1e-13, **more}
    found = gradient_of_motion(
        equations, parameters, initial, INSTANTS, by=by, final=final, integral=integral, **options
    )
    motion = simulate(equations, parameters, initial, INSTANTS, sensitivities=by, **options)
    value = motion[final][-1] + simpson(motion[integral], x=motion.t)
    expected = [
        motion.sensitivity(final, by=p)[-1] + simpson(motion.sensitivity(integral, by=p), x=motion.t)
        for p in by
    ]
    assert found.value == pytest.approx(value, rel=tolerance)
    assert list(found.derivatives) == by
    assert_allclose([found[p] for p in by], expected, rtol=0, atol=tolerance * np.abs(expected).max())


@pytest.mark.parametrize(
    "model",
    [
        n_pendulum,
        cart_pole,
        quarter_car,
        single_track_car,
        ball_and_beam,
        four_bar,
        chaplygin_sleigh,
        snakeboard,
    ],
)
def test_classic_systems(model: Callable[[], ClassicSystem]) -> None:
    """Trees, a loop, nonholonomic constraints, quasi-velocities and inputs."""
    classic = model()
    equations, parameters = newton_euler(classic.system), classic.parameters
    by = [p for p in parameters if p in equations.parameters]
    by += [] if equations.constraints else list(classic.initial)[:2]
    q, u = equations.coordinates, equations.speeds
    final, integral = q[0] + sin(q[-1]) + by[0] * q[0], u[0] * q[-1] + by[0] * u[-1] ** 2
    compare(
        equations,
        parameters,
        classic.initial,
        by,
        final,
        integral,
        inputs=classic.inputs,
        guess=classic.guess,
    )


def test_a_start_that_depends_on_lengths() -> None:
    classic = slider_crank()
    equations, (q, slide, p) = newton_euler(classic.system), classic.system.coordinates
    initial = {q: 1.1, time_derivative(q): 3.0}
    by = [*(p for p in classic.parameters if p in equations.parameters), q, time_derivative(q)]
    guess = {slide: 1.0, p: -0.4}
    compare(equations, classic.parameters, initial, by, slide**2, slide, guess=guess)
    (multiplier, *_) = equations.multipliers
    compare(
        equations, classic.parameters, initial, by, slide, time_derivative(q, 2) + multiplier, guess=guess
    )


def cart(*forces: Expr) -> Equations:
    """Return a cart on a line, with forces along it."""
    body = Body(translate(x, 0, 0), m)
    loads = [Force(ground, force, 0, 0, at=body.center_of_mass, on=body) for force in forces]
    return newton_euler(SystemOf([body], loads, [x]))


@pytest.mark.filterwarnings("ignore:simulate. stability")
@pytest.mark.parametrize("damping", [3.0, 300.0, 1e4])
def test_damped_motions_are_followed_from_checkpoint_to_checkpoint(damping: float) -> None:
    """Backwards in time, a strongly damped motion leaves its way at once."""
    equations, parameters = cart(-k * x, -c * v), {m: 1.0, k: 40.0, c: damping}
    found = gradient_of_motion(
        equations, parameters, {x: 0.3, v: 0.0}, (0, 1), by=[m, k, c, x, v], final=x, integral=x**2
    )
    motion = simulate(equations, parameters, {x: 0.3, v: 0.0}, INSTANTS, sensitivities=[m, k, c, x, v])
    for p in found.derivatives:
        squares = simpson(motion.sensitivity(x**2, by=p), x=motion.t)
        assert found[p] == pytest.approx(motion.sensitivity(x, by=p)[-1] + squares, rel=2e-5, abs=2e-8)


def test_the_scale_of_a_functional_does_not_matter() -> None:
    equations, parameters = cart(-k * x), {m: 1.0, k: 4.0}
    by_k = [
        gradient_of_motion(equations, parameters, {x: 0.1}, (0, 1), by=[k], final=scale * x)[k] / scale
        for scale in (1e-12, 1.0, 1e12)
    ]
    assert_allclose(by_k, -0.1 * np.sin(2) / 4, rtol=1e-6)


def test_a_kink_does_no_harm() -> None:
    """The law v |v|, and |x| in the integral, against differences of the value."""
    rubbing, values = cart(-k * x, -c * v**2 * sign(v)), {m: 1.0, k: 40.0, c: 0.1}

    def result(changed: dict[Expr, float]) -> MotionGradient:
        return gradient_of_motion(
            rubbing, values | changed, {x: 0.3}, by=[m, k, c], integral=x * sign(x), t=(0, 1), rtol=1e-11
        )

    found = result({})
    for p, value in values.items():
        h = 1e-4 * value
        quotient = (result({p: value + h}).value - result({p: value - h}).value) / (2 * h)
        assert found[p] == pytest.approx(quotient, rel=1e-5)
