"""Law: derivatives of equilibria, steady motions and eigenvalues are the limits of finite differences."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from symbody import (
    Body,
    Expr,
    Force,
    System,
    Torque,
    Vector,
    equilibrium,
    functions_of_time,
    ground,
    linearize,
    modes,
    newton_euler,
    rotate,
    steady,
    symbols,
    time_derivative,
    translate,
)
from symbody.models import four_bar, n_pendulum, single_track_car

x, y, z, q, F = functions_of_time("x y z q F")
m, k, l, g, c, T = symbols("m k l g c T")


def difference(value: Callable[[float], float], at: float, step: float = 1e-4) -> float:
    """Return a derivative by central differences, extrapolated to fourth order."""
    h = step * (abs(at) or 1.0)
    wide, narrow = ((value(at + d) - value(at - d)) / (2 * d) for d in (h, h / 2))
    return (4 * narrow - wide) / 3


def leaning() -> System:
    """Return a pendulum that a torque, a spring and the lag of a state hold aside."""
    bob = Body(rotate("Z", q) * translate(0, -l, 0), m)
    loads = [Torque(ground, 0, 0, T - k * q - z, on=bob)]
    return System([bob], loads, [q], gravity=Vector(ground, 0, -g, 0), states={z: c * q**3 - z})


HELD = {m: 1.2, k: 3.0, l: 0.7, g: 9.81, c: 0.4, T: 2.5}


@pytest.mark.parametrize("by", [m, k, l, g, c, T])
def test_an_equilibrium_with_a_state(by: Expr) -> None:
    equations = newton_euler(leaning())

    def at(value: float) -> Mapping[Expr, float]:
        return equilibrium(equations, {**HELD, by: value}, guess={q: 0.3})

    found = equilibrium(equations, HELD, guess={q: 0.3})
    for name in (q, z):
        assert found.sensitivity(name, by=by) == pytest.approx(
            difference(lambda p, name=name: at(p)[name], HELD[by]), rel=1e-7
        )
    own = z if by in (T, k) else by * q
    total = difference(
        lambda p: float((own.subs({by: p}) if own is not z else z).evaluate(dict(at(p)))), HELD[by]
    )
    assert found.sensitivity(own, by=by) == pytest.approx(total, rel=1e-7)


def test_an_equilibrium_on_a_constraint() -> None:
    """A bead on an ellipse with a spring: by its size, with the multiplier; and by a coordinate that is held."""
    bead = Body(translate(x, y, 0), m)
    spring = Force(ground, -k * (x - 2), 0, 0, at=bead.center_of_mass, on=bead)
    equations = newton_euler(
        System([bead], [spring], [x, y], [x**2 + 2 * y**2 - l**2], Vector(ground, 0, -g, 0))
    )
    values = {m: 1.0, k: 5.0, l: 1.5, g: 9.81}
    (multiplier,) = equations.multipliers
    found = equilibrium(equations, values, guess={x: 0.5, y: -1.0})
    for by, start in values.items():

        def at(value: float, by: Expr = by) -> tuple[float, float]:
            other = equilibrium(equations, {**values, by: value}, guess=found)
            return other[x], other.multipliers[multiplier]

        assert found.sensitivity(x, by=by) == pytest.approx(difference(lambda p: at(p)[0], start), rel=1e-6)
        by_differences = difference(lambda p: at(p)[1], start)
        assert found.sensitivity(multiplier, by=by) == pytest.approx(by_differences, rel=1e-6)
    held = equilibrium(equations, values, guess={y: -1.0}, fixed={x: 0.5})
    y_of_x = difference(lambda p: equilibrium(equations, values, guess={y: -1.0}, fixed={x: p})[y], 0.5)
    assert held.sensitivity(y, by=x) == pytest.approx(y_of_x, rel=1e-7)


def test_a_closed_loop_at_rest() -> None:
    classic = four_bar()
    equations = newton_euler(classic.system)
    first, *others = equations.coordinates
    values = {**classic.parameters}
    near = {**classic.guess, **classic.initial}
    guess = {name: near.get(name, 0.0) for name in equations.coordinates}
    found = equilibrium(equations, values, guess=guess, inputs=classic.inputs)
    for by in [p for p in values if p in equations.parameters]:
        slope = found.sensitivity(others[-1], by=by)
        expected = difference(
            lambda p, by=by: equilibrium(
                equations, {**values, by: p}, guess=found.coordinates, inputs=classic.inputs
            )[others[-1]],
            values[by],
        )
        assert slope == pytest.approx(expected, rel=1e-5, abs=1e-8)
    assert first in found


def test_a_car_in_a_bend() -> None:
    """The steering angle by all parameters, and by the yaw rate, which was given."""
    car = single_track_car()
    equations, delta, r, v = newton_euler(car.system), car["delta"], car["r"], car["v"]

    def bend(values: Mapping[Expr, float], rate: float) -> Mapping[Expr, float]:
        return steady(equations, values, given={r: rate}, unknown=[delta])

    found = steady(equations, car.parameters, given={r: 0.25}, unknown=[delta])
    for by in [p for p in car.parameters if p in equations.parameters]:
        for name in (delta, v):
            slope = difference(
                lambda p, by=by, name=name: bend({**car.parameters, by: p}, 0.25)[name], car.parameters[by]
            )
            assert found.sensitivity(name, by=by) == pytest.approx(slope, rel=1e-6, abs=1e-9)
    by_rate = difference(lambda p: bend(car.parameters, p)[delta], 0.25)
    assert found.sensitivity(delta, by=r) == pytest.approx(by_rate, rel=1e-7)


def test_eigenvalues_of_pendulums() -> None:
    model = n_pendulum(3)
    linear = linearize(newton_euler(model.system))
    found = modes(linear, model.parameters)
    for by in linear.parameters:
        for mode in found:
            slope = difference(
                lambda p, by=by, mode=mode: (
                    modes(linear, {**model.parameters, by: p}).near(mode.eigenvalue).eigenvalue.imag
                ),
                model.parameters[by],
            )
            assert mode.sensitivity(by=by).imag == pytest.approx(slope, rel=1e-6, abs=1e-8)


def test_a_damped_eigenvalue_in_closed_form() -> None:
    """``m s^2 + c s + k = 0``, so ``ds/dk = -1/(2 m s + c)``."""
    cart = Body(translate(x, 0, 0), m)
    loads = [Force(ground, -k * x - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)]
    linear = linearize(newton_euler(System([cart], loads, [x])))
    values = {m: 2.0, k: 50.0, c: 3.0}
    (mode,) = modes(linear, values)
    s = mode.eigenvalue
    divisor = 2 * values[m] * s + values[c]
    for by, expected in {k: -1 / divisor, c: -s / divisor, m: -(s**2) / divisor}.items():
        assert abs(mode.sensitivity(by=by) - expected) < 1e-12 * abs(expected)


def test_eigenvalues_about_an_equilibrium_that_moves() -> None:
    """The chain rule: the equilibrium's derivative goes along with the parameter."""
    equations = newton_euler(leaning())
    q0, z0 = symbols("q0 z0")
    linear = linearize(equations, about={q: q0, z: z0})

    def frequency(value: float) -> complex:
        values = {**HELD, m: value}
        at = equilibrium(equations, values, guess={q: 0.3})
        found = modes(linear, {**values, q0: at[q], z0: at[z]})
        return max((mode.eigenvalue for mode in found), key=lambda s: s.imag)

    rest = equilibrium(equations, HELD, guess={q: 0.3})
    found = modes(linear, {**HELD, q0: rest[q], z0: rest[z]})
    mode = max(found, key=lambda mode: mode.eigenvalue.imag)
    moved = {q0: rest.sensitivity(q, by=m), z0: rest.sensitivity(z, by=m)}
    slope = mode.sensitivity(by=m, together=moved)
    for part in ("real", "imag"):
        expected = difference(lambda p, part=part: getattr(frequency(p), part), HELD[m])
        assert getattr(slope, part) == pytest.approx(expected, rel=1e-6)
    assert np.isfinite(slope)
    assert mode.sensitivity(by=m) == pytest.approx(slope, rel=1e-9)  # by the conditions of the equilibrium
    assert mode.sensitivity(by=m, together={q0: moved[q0]}) == pytest.approx(slope, rel=1e-9)
