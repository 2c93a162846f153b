"""Law: sensitivities of motions are the limits of finite differences, for systems and parameters of every kind."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from random import Random

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import (
    Body,
    Equations,
    Expr,
    Motion,
    System,
    Torque,
    Vector,
    embedded,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    simulate,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.models import (
    ball_and_beam,
    chaplygin_sleigh,
    four_bar,
    furuta_pendulum,
    n_pendulum,
    quarter_car,
    rattleback,
    single_track_car,
    slider_crank,
    snakeboard,
    spatial_arm,
)
from symbody.models.classic_system import ClassicSystem
from tests.repeated import repeated

Array = NDArray[np.float64]
Simulate = Callable[[Mapping[Expr, float], Mapping[Expr, float]], Motion]
INSTANTS = np.linspace(0, 0.4, 5)
TIGHT = {"rtol": 1e-12, "atol": 1e-13}


def differences(
    run: Simulate, parameters: Mapping[Expr, float], initial: Mapping[Expr, float], by: Expr, step: float
) -> Array:
    """Return the derivatives of the states by central differences, extrapolated to fourth order [Richardson 1911]."""
    base = parameters if by in parameters else initial
    h = step * (abs(base[by]) or 1.0)

    def states(change: float) -> Array:
        moved = {**base, by: base[by] + change}
        return (run(moved, initial) if by in parameters else run(parameters, moved)).states

    wide, narrow = (states(h) - states(-h)) / (2 * h), (states(h / 2) - states(-h / 2)) / h
    return (4 * narrow - wide) / 3


def motions_of(equations: Equations, **given: object) -> Callable[..., Motion]:
    """Return precise motions as a function of parameters and initial values."""

    def run(parameters: Mapping[Expr, float], initial: Mapping[Expr, float], **options: object) -> Motion:
        return simulate(equations, parameters, initial, INSTANTS, **TIGHT, **given, **options)  # type: ignore[arg-type]

    return run


def compare(
    run: Callable[..., Motion],
    parameters: Mapping[Expr, float],
    initial: Mapping[Expr, float],
    by: list[Expr],
    step: float = 1e-3,
    tolerance: float = 3e-7,
) -> Motion:
    """Compare all sensitivities of a motion with finite differences."""
    motion = run(parameters, initial, sensitivities=by)
    assert motion.slopes is not None
    for column, name in enumerate(by):
        expected = differences(run, parameters, initial, name, step)
        scale = np.abs(expected).max() + 1e-3
        assert_allclose(
            motion.slopes[:, :, column], expected, rtol=0, atol=tolerance * scale, err_msg=str(name)
        )
    return motion


MODELS = [
    n_pendulum,
    furuta_pendulum,
    quarter_car,
    ball_and_beam,
    spatial_arm,
    single_track_car,
    four_bar,
    chaplygin_sleigh,
    snakeboard,
]


@pytest.mark.parametrize("model", [*MODELS, pytest.param(rattleback, marks=pytest.mark.slow)])
def test_classic_systems(model: Callable[[], ClassicSystem]) -> None:
    """Trees, a loop, nonholonomic constraints, quasi-velocities, inputs and states."""
    classic = model()
    equations, parameters = newton_euler(classic.system), dict(classic.parameters)
    by = [p for p in parameters if p in equations.parameters][:4]
    by += [] if equations.constraints else list(classic.initial)[:2]

    run = motions_of(equations, inputs=classic.inputs, guess=classic.guess)
    compare(run, parameters, classic.initial, by)


@pytest.mark.parametrize("seed", range(4))
def test_random_trees(seed: int) -> None:
    """Lengths, masses, springs, an amplitude of a drive, and all initial values."""
    random = Random(f"sensitivities {seed}")
    q = functions_of_time("q1 q2 q3")
    m, l, c, k, a, g = symbols("m l c k a g")
    first = rotate(random.choice("XY"), q[0]) * translate(0, 0, -l)
    second = first * rotate(random.choice("XYZ"), q[1]) * translate(random.uniform(0.3, 0.6) * l, 0, -0.2)
    third = first * translate(random.uniform(-0.4, 0.4), q[2], 0.3 * q[2])
    bodies = [
        Body(frame, m * random.uniform(0.5, 2), Ix=m * l**2 / 9, Iy=0.1, Iz=0.12, name=f"body {place}")
        for place, frame in enumerate((first, second, third))
    ]
    torque = Torque(ground, -c * time_derivative(q[0]), a * sin(2 * t), -k * q[1], on=bodies[1])
    system = System(bodies, [torque], q, gravity=Vector(ground, 0, 1, -g))
    equations = newton_euler(system)
    parameters = {m: 1.3, l: 0.7, c: 0.2, k: 3.0, a: 0.5, g: 9.81}
    initial = {name: random.uniform(-0.6, 0.6) for name in (*q, *map(time_derivative, q))}

    by = [p for p in parameters if p in equations.parameters]
    compare(motions_of(equations), parameters, initial, [*by, *q, *map(time_derivative, q)])


@pytest.mark.parametrize("constraints", ["projection", "free", *repeated(["baumgarte"])])
def test_a_loop_whose_start_follows_from_its_parameters(constraints: str) -> None:
    """By lengths, and by the crank's angle and speed, on which the other coordinates and speeds depend."""
    classic = slider_crank()
    equations, (q, x, p) = newton_euler(classic.system), classic.system.coordinates
    initial = {q: 1.1, time_derivative(q): 3.0}
    by = [*list(classic.parameters)[:3], q, time_derivative(q)]

    run = motions_of(equations, guess={x: 1.0, p: -0.4}, constraints=constraints)
    motion = compare(run, classic.parameters, initial, by)
    for name in by:
        for constraint in equations.constraints:
            size = 1e-9 if constraints == "projection" else 1e-6
            assert np.abs(motion.sensitivity(constraint, by=name)).max() < size


def test_the_nearest_start_moves_with_the_parameters() -> None:
    """Where the given values don't determine the start, it is the nearest to a guess, and so are its derivatives."""
    x, y = functions_of_time("x y")
    m, l, g = symbols("m l g")
    pendulum = System(
        [Body(translate(x, y, 0), m)], (), [x, y], [x**2 + 2 * y**2 - l**2], Vector(ground, 0, -g, 0)
    )
    equations = newton_euler(pendulum)
    v = time_derivative(x)

    run = motions_of(equations, guess={x: 1.0, y: -2.0, time_derivative(y): 1.0})
    # the nearest state itself is found to 1e-8
    compare(run, {m: 1.0, l: 1.5, g: 9.81}, {}, [l, g], step=0.03, tolerance=1e-5)
    compare(run, {m: 1.0, l: 1.5, g: 9.81}, {v: 0.3}, [l, g, v], step=0.03, tolerance=1e-5)


def test_embedded_equations_agree_with_those_with_multipliers() -> None:
    classic = slider_crank()
    equations, (q, x, p) = newton_euler(classic.system), classic.system.coordinates
    initial, guess = {q: 1.1, time_derivative(q): 3.0}, {x: 1.0, p: -0.4}
    by = list(classic.parameters)[:3]
    full, reduced = (
        simulate(each, classic.parameters, initial, INSTANTS, guess=guess, sensitivities=by, **TIGHT)  # type: ignore[arg-type]
        for each in (equations, embedded(equations))
    )
    for name in by:
        for coordinate in (q, x, p):
            expected = full.sensitivity(coordinate, by=name)
            assert_allclose(reduced.sensitivity(coordinate, by=name), expected, rtol=1e-7, atol=1e-8)


@pytest.mark.parametrize("method", ["tsit5", "bdf", "esdirk34"])
def test_methods_agree(method: str) -> None:
    classic = n_pendulum(2)
    equations, by = (
        newton_euler(classic.system),
        [*list(classic.parameters)[:3], classic.system.coordinates[0]],
    )
    rtol = 1e-10 if method == "tsit5" else 1e-8
    motion, expected = (
        simulate(
            equations,
            classic.parameters,
            classic.initial,
            INSTANTS,
            sensitivities=by,
            method=name,
            rtol=tolerance,
            atol=tolerance,
        )
        for name, tolerance in ((method, rtol), ("dop853", 1e-12))
    )
    assert motion.slopes is not None
    assert expected.slopes is not None
    scale = np.abs(expected.slopes).max()
    assert_allclose(motion.slopes, expected.slopes, rtol=0, atol=2e3 * rtol * scale)
