"""Benchmarks whose systems are those of `symbody.models` in other variables."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from benchmarks.derive.by_symbody import cart_pendulum, rolling
from symbody import (
    Expr,
    System,
    consistent_state,
    forward_dynamics,
    functions_of_time,
    models,
    newton_euler,
    subs,
    symbols,
    time_derivative,
)
from symbody.models import ClassicSystem
from symbody.symbolic import ExprLike


def test_the_pendulum_on_a_cart_is_that_of_the_gallery_with_points_for_poles() -> None:
    n = 3
    q = [functions_of_time(f"q{k}") for k in range(n + 1)]
    angles = {functions_of_time(f"theta{k}"): -q[k] for k in range(1, n + 1)}
    lengths = [symbols(f"l{k}") for k in range(n)]
    points: dict[Expr, ExprLike] = {symbols("M"): symbols("m0"), symbols("b"): 0}
    points |= {symbols(f"I{k}"): 0 for k in range(1, n + 1)}
    points |= {symbols(f"a{k}"): lengths[k - 1] for k in range(1, n + 1)}
    points |= {symbols(f"l{k}"): lengths[k - 1] for k in range(1, n)}
    gallery = subs(list(newton_euler(models.cart_pole(n).system).residuals), points)
    gallery = subs(gallery, {functions_of_time("x"): q[0], functions_of_time("F"): 0} | angles)
    along, *about = newton_euler(cart_pendulum.system(n)).residuals
    assert gallery == [along, *(-each for each in about)]  # the gallery's angles are clockwise


def accelerations(system: System, values: Mapping[Expr, float]) -> dict[str, float]:
    equations = newton_euler(system)
    found = forward_dynamics(equations).accelerations
    return {str(u): each.evaluate(values) for u, each in zip(equations.speeds, found, strict=True)}


def moving(model: ClassicSystem, **state: float) -> tuple[dict[str, float], dict[str, float]]:
    """Return the values of a model in a state that its constraints allow, and its accelerations."""
    start = {model.names[name.replace("_rate", "'")]: value for name, value in state.items()}
    whole = consistent_state(newton_euler(model.system), model.parameters, start)
    values = {**model.parameters, **model.inputs, **whole}
    return {str(name): value for name, value in values.items()}, accelerations(model.system, values)


def test_the_disc_is_that_of_the_gallery() -> None:
    """There z is upwards, so that yaw and spin have the other sign."""
    model = models.rolling_disc()
    state = {"x": 0.0, "y": 0.0, "psi": 0.4, "theta": 0.3, "phi": 0.2}
    at, gallery = moving(model, **state, psi_rate=1.2, theta_rate=-0.5, phi_rate=4.0)
    tensor = at["m"] * at["r"] ** 2
    values = {rolling.phi: 0.3, rolling.yaw: -1.2, rolling.lean: -0.5, time_derivative(rolling.rear): -4.0}
    numbers = {"mR": at["m"], "rR": at["r"], "g": at["g"], "IRxx": tensor / 4, "IRyy": tensor / 2}
    found = accelerations(rolling.disc(), values | {symbols(name): each for name, each in numbers.items()})
    expected = [-gallery["psi'"], gallery["theta'"], -gallery["phi'"]]
    assert [*found.values()] == pytest.approx(expected, rel=1e-9)


def test_the_bicycle_is_that_of_the_gallery() -> None:
    """Its speeds are other ones: yaw and lean of the rear wheel, whose angle counts from the frame."""
    model = models.bicycle()
    state = {"x": 0.0, "y": 0.0, "yaw": 0.4, "lean": 0.2, "steer": 0.3, "rear_angle": 0.1, "front_angle": 0.2}
    at, gallery = moving(model, **state, rear_angle_rate=-12.0, lean_rate=0.5, steer_rate=-0.7)
    named = {"phi": "lean", "theta": "pitch", "delta": "steer"}
    rates = {"theta": "pitch'", "delta": "steer'", "front": "front_angle'"}
    values = {getattr(rolling, ours): at[theirs] for ours, theirs in named.items()}
    values |= {time_derivative(getattr(rolling, ours)): at[theirs] for ours, theirs in rates.items()}
    values |= {rolling.yaw: at["yaw'"], rolling.lean: at["lean'"]}
    values |= {time_derivative(rolling.rear): at["rear_angle'"] - at["pitch'"]}
    found = accelerations(rolling.bicycle(), {**model.parameters, **values})
    expected = [gallery[f"{name}'"] for name in ("yaw", "lean", "pitch", "steer")]
    expected += [gallery["rear_angle'"] - gallery["pitch'"], gallery["front_angle'"]]
    assert [*found.values()] == pytest.approx(expected, rel=1e-9)
