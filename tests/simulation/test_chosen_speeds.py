"""Systems by speeds of the user's choice: the same motions, states, rests and loads as by rates of coordinates."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Equations,
    Expr,
    Force,
    Point,
    System,
    Vector,
    angular_velocity,
    consistent_state,
    cos,
    equilibrium,
    functions_of_time,
    generate,
    ground,
    inverse_dynamics,
    kinetic_energy,
    mechanical_energy,
    newton_euler,
    project,
    report,
    rotate,
    simulate,
    sin,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)

m, I, l, g, k, d = symbols("m I l g k d")
x, y, phi, u1, u2, u3 = functions_of_time("x y phi u1 u2 u3")
xp, yp, phip = map(time_derivative, (x, y, phi))
CORNER = translate(x, y, 0) * rotate("Z", phi)
PLATE = Body(CORNER * translate(l, 0, 0), m, I, I, I, name="plate")
SPRING = Force(ground, -k * x, -k * y - d * yp, 0, at=PLATE.center_of_mass, on=PLATE, name="spring")
ADDED = Force(ground, -d * time_derivative(xp), -k * y, 0, at=PLATE.center_of_mass, on=PLATE, name="water")
IN_PLATE = {u1: xp * cos(phi) + yp * sin(phi), u2: yp * cos(phi) - xp * sin(phi), u3: phip}
"""The velocity of the corner, in the axes of the plate."""
EDGE = yp * cos(phi) - xp * sin(phi)
PARAMETERS = {m: 2, I: 0.3, l: 0.4, g: 9.81, k: 3, d: 0.6}
START = {x: 1, y: 0, phi: 0.3}
MODELS = {
    "spring": ([SPRING], []),
    "acceleration in a load": ([ADDED], []),
    "knife edge": ([SPRING], [EDGE]),
    "circle": ([SPRING], [x**2 + y**2 - 1]),
    "both": ([SPRING], [EDGE, x**2 + phi - 1.3]),
}


def equations(model: str, *, by_speeds: bool) -> Equations:
    loads, constraints = MODELS[model]
    system = System(
        [PLATE],
        loads,
        [x, y, phi],
        constraints,
        Vector(ground, 0, -g, 0),
        kinematics=IN_PLATE if by_speeds else {},
    )
    return newton_euler(system)


def values(eqs: Equations) -> dict[Expr, float]:
    """Return the values of the parameters of the equations, and of those in the energy."""
    names = {*eqs.parameters, l, m, I}
    return {name: value for name, value in PARAMETERS.items() if name in names}


def state(eqs: Equations, model: str) -> dict[Expr, float]:
    """Return a consistent state with the speed along the plate, and its turning, as far as constraints let it."""
    along, turning = 0.0 if MODELS[model][1] else 0.7, 0.0 if model in ("both",) else 0.5
    if eqs.system.chosen:
        return START | {u1: along, u2: 0.0, u3: turning}
    return START | {xp: along * np.cos(0.3), yp: along * np.sin(0.3), phip: turning}


@pytest.mark.parametrize("method", ["dop853", "ida"])
@pytest.mark.parametrize("model", MODELS)
def test_the_same_motion(model: str, method: str) -> None:
    outputs = {"x": x, "y": y, "phi": phi, "T": kinetic_energy(PLATE), "x'": xp, "x''": time_derivative(xp)}
    ends = []
    for by_speeds in (False, True):
        eqs = equations(model, by_speeds=by_speeds)
        tolerance = 1e-12 if method == "dop853" else 1e-9
        motion = simulate(
            eqs,
            values(eqs),
            state(eqs, model),
            [0, 0.3, 0.7],
            rtol=tolerance,
            atol=tolerance,
            outputs=outputs,
            method=method,
        )
        ends.append([motion.outputs[name] for name in outputs])
    assert_allclose(ends[1], ends[0], rtol=0, atol=1e-9 if method == "dop853" else 2e-5)
    assert np.ptp(ends[0][0]) > 1e-3


def test_energy_is_kept() -> None:
    system = System([PLATE], (), [x, y, phi], [EDGE], Vector(ground, 0, -g, 0), kinematics=IN_PLATE)
    eqs = newton_euler(system)
    given = {name: PARAMETERS[name] for name in (m, I, l, g)}
    energy = mechanical_energy(system)
    start = START | {u1: 0.7, u2: 0, u3: 0.5}
    motion = simulate(eqs, given, start, np.linspace(0, 3, 7), rtol=1e-10, atol=1e-10, outputs={"E": energy})
    assert np.ptp(motion.outputs["E"]) < 1e-9 * 20


def test_states_by_rates_or_by_speeds() -> None:
    eqs = equations("spring", by_speeds=True)
    by_rates = consistent_state(eqs, values(eqs), START | {xp: 0.7, yp: -0.2, phip: 0.5})
    expected = [0.7 * np.cos(0.3) - 0.2 * np.sin(0.3), -0.7 * np.sin(0.3) - 0.2 * np.cos(0.3), 0.5]
    assert_allclose([by_rates[u] for u in (u1, u2, u3)], expected, rtol=1e-12)


def test_rates_that_are_not_given_are_zero() -> None:
    """With Euler angles and angular velocities in the body's axes, two rates at rest leave q1' alone."""
    f = rotate("Z", x) * rotate("X", y) * rotate("Z", phi)
    spins = project(angular_velocity(f), f).components
    gyro = newton_euler(
        System(
            [Body(f, 1, 0.2, 0.2, 0.1)],
            (),
            [x, y, phi],
            kinematics=dict(zip((u1, u2, u3), spins, strict=True)),
        )
    )
    by_rate = consistent_state(gyro, {}, {y: 0.5, phi: 0.4, xp: 3})
    at = {x: 0, y: 0.5, phi: 0.4, xp: 3, yp: 0, phip: 0}
    assert_allclose([by_rate[u] for u in (u1, u2, u3)], [float(subs(w, at)) for w in spins], atol=1e-12)
    # Speeds change least where a speed is given, and rates stay near guessed speeds.
    by_speed = consistent_state(gyro, {}, {y: 0.5, phi: 0.4, u1: 2})
    assert_allclose([by_speed[u] for u in (u1, u2, u3)], [2, 0, 0], atol=1e-12)
    near = consistent_state(gyro, {}, {y: 0.5, phi: 0.4, xp: 3}, guess={yp: 0.7})
    moved = {**at, yp: 0.7}
    assert_allclose([near[u] for u in (u1, u2, u3)], [float(subs(w, moved)) for w in spins], atol=1e-12)


def test_rates_change_least_where_constraints_bind_them() -> None:
    """A corner that moves along x + y + 2*phi = 0 with x' = 1: |y'|^2 + |phi'|^2 is least at y' = -1/5, phi' = -2/5."""
    bound = newton_euler(System([PLATE], (), [x, y, phi], [x + y + 2 * phi], kinematics=IN_PLATE))
    state = consistent_state(bound, {}, {x: 0.2, y: 0.4, phi: -0.3, xp: 1})
    c, s = np.cos(-0.3), np.sin(-0.3)
    assert_allclose([state[u] for u in (u1, u2, u3)], [c - 0.2 * s, -s - 0.2 * c, -0.4], atol=1e-12)


def test_the_same_equilibrium() -> None:
    """A plate that hangs by its corner on a spring."""
    hung = Force(ground, -k * x, -k * y, 0, at=Point(CORNER, 0, 0, 0), on=PLATE)
    for kinematics in ({}, IN_PLATE):
        system = System([PLATE], [hung], [x, y, phi], (), Vector(ground, 0, -g, 0), kinematics=kinematics)
        eqs = newton_euler(system)
        given = {name: PARAMETERS[name] for name in eqs.parameters}
        rest = equilibrium(eqs, given, guess={x: 0.1, y: -6.0, phi: -1.4})
        assert_allclose([rest.coordinates[q] for q in (x, y, phi)], [0, -2 * 9.81 / 3, -np.pi / 2], atol=1e-9)


def test_the_same_forces_along_prescribed_coordinates() -> None:
    motion, times = {x: sin(t), y: cos(2 * t), phi: t**2}, np.linspace(0, 1, 5)
    along = []
    for by_speeds in (False, True):
        eqs = equations("spring", by_speeds=by_speeds)
        given = {name: PARAMETERS[name] for name in eqs.parameters}
        result = inverse_dynamics(eqs, motion, given, times)
        along.append([result.forces[q] for q in (x, y, phi)])
    assert_allclose(along[1], along[0], atol=1e-9)
    assert np.ptp(along[0], axis=1).min() > 0.1


@pytest.mark.parametrize("model", MODELS)
def test_python_code_computes_the_accelerations(model: str, tmp_path: Path) -> None:
    """The generated module agrees with the numbers of its check, which the expressions gave."""
    generate(equations(model, by_speeds=True), "python", tmp_path)
    (check,) = tmp_path.glob("*_check.py")
    done = subprocess.run(
        [sys.executable, check.name], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_report_and_other_parameters(tmp_path: Path) -> None:
    eqs = equations("knife edge", by_speeds=True)
    text = Path(report(eqs, tmp_path / "plate.md")).read_text(encoding="utf-8")
    assert "quasi-velocities" in text
    heavy = subs(eqs.system, {m: 5})
    assert heavy.kinematics == eqs.system.kinematics
    assert newton_euler(heavy).residuals == tuple(row.subs({m: 5}) for row in eqs.residuals)
