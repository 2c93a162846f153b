"""Systems of `symbody.models` in the variables of the benchmarks: they move as the others do."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from symbody import Expr, System, consistent_state, forward_dynamics, models, newton_euler, subs, symbols
from symbody.models import ClassicSystem


def test_a_cart_with_point_masses_has_the_equations_of_poles_with_their_mass_at_the_end() -> None:
    n = 3
    poles, points = models.cart_pole(n), models.cart_pole(n, point_masses=True)
    at_the_end = {symbols(f"a{k}"): symbols(f"l{k}") for k in range(1, n + 1)}
    nothing = dict.fromkeys([poles["F"], poles["b"], *(poles[f"I{k}"] for k in range(1, n + 1))], 0)
    residuals = subs(list(newton_euler(poles.system).residuals), at_the_end | nothing)
    assert residuals == [*newton_euler(points.system).residuals]


def accelerations(system: System, values: Mapping[Expr, float]) -> dict[str, float]:
    equations = newton_euler(system)
    found = forward_dynamics(equations).accelerations
    return {str(u): each.evaluate(values) for u, each in zip(equations.speeds, found, strict=True)}


def moving(model: ClassicSystem, state: Mapping[str, float]) -> tuple[dict[str, float], dict[str, float]]:
    """Return a state that the constraints of a model allow, by names, and the accelerations there."""
    start = {model[name]: value for name, value in state.items()}
    whole = consistent_state(newton_euler(model.system), model.parameters, start)
    found = accelerations(model.system, {**model.parameters, **model.inputs, **whole})
    return {str(name): value for name, value in whole.items()}, found


def by_speeds(model: ClassicSystem, state: Mapping[str, float], *, yaw: str, lean: str) -> dict[str, float]:
    """Return the accelerations of a model in quasi-velocities, in the state of one with all speeds."""
    values = dict(state) | {"omega_yaw": state[yaw], "omega_lean": state[lean]}
    known = {leaf: values[name] for name, leaf in model.names.items() if name in values}
    rates = {leaf: values[name] for leaf in model.system.speeds if (name := str(leaf)) in values}
    return accelerations(
        model.system, {**model.parameters, **model.inputs, **known, **rates, **pose(model, values)}
    )


def pose(model: ClassicSystem, values: Mapping[str, float]) -> dict[Expr, float]:
    return {q: values[str(q)] for q in model.system.coordinates if str(q) in values}


@pytest.mark.parametrize("thin", [True, False])
def test_the_disc_moves_the_same_by_quasi_velocities(thin: bool) -> None:
    state = {
        "x": 0.0,
        "y": 0.0,
        "psi": 0.4,
        "theta": 0.3,
        "phi": 0.2,
        "psi'": 1.2,
        "theta'": -0.5,
        "phi'": 4.0,
    }
    whole, expected = moving(models.rolling_disc(thin=thin), state)
    found = by_speeds(models.rolling_disc(thin=thin, quasi_velocities=True), whole, yaw="psi'", lean="theta'")
    assert [*found.values()] == pytest.approx(
        [expected[name] for name in ("psi'", "theta'", "phi'")], rel=1e-9
    )


def test_the_bicycle_moves_the_same_by_quasi_velocities() -> None:
    state = {"x": 0.0, "y": 0.0, "yaw": 0.4, "lean": 0.2, "steer": 0.3, "rear_angle": 0.1, "front_angle": 0.2}
    rates = {"rear_angle'": -12.0, "lean'": 0.5, "steer'": -0.7}
    whole, expected = moving(models.bicycle(), state | rates)
    found = by_speeds(models.bicycle(quasi_velocities=True), whole, yaw="yaw'", lean="lean'")
    names = ("yaw'", "lean'", "pitch'", "steer'", "rear_angle'", "front_angle'")
    assert [*found.values()] == pytest.approx([expected[name] for name in names], rel=1e-9)
