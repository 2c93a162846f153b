"""Equations from given parts are those of the system from which the parts come, in every use."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from symbody import (
    Body,
    Equations,
    Force,
    System,
    Vector,
    consistent_state,
    cos,
    embedded,
    equations_of,
    equilibrium,
    forward_dynamics,
    functions_of_time,
    ground,
    lambdify,
    newton_euler,
    report,
    rotate,
    show,
    simulate,
    simulate_many,
    sin,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.codegen import generate
from symbody.errors import ModelError, ViewError
from tests.repeated import repeated

(x, y), (m, l, g) = functions_of_time("x y"), symbols("m l g")
ENERGY = m * (time_derivative(x) ** 2 + time_derivative(y) ** 2) / 2 + m * g * y
CIRCLE = [x**2 + y**2 - l**2]
VALUES = {m: 2, l: 0.7, g: 9.81}


def given() -> Equations:
    return equations_of(
        [[m, 0], [0, m]], [0, -m * g], [x, y], constraints=CIRCLE, energy=ENERGY, name="pendulum"
    )


def derived() -> Equations:
    weight = Vector(ground, 0, -g, 0)
    return newton_euler(System([Body(translate(x, y, 0), m)], (), [x, y], CIRCLE, weight))


def sleigh() -> tuple[Equations, Equations]:
    """Return a knife edge by quasi-velocities with kinematics, given and derived in coordinates."""
    theta, v, n, w, J = *functions_of_time("theta v n w"), symbols("J")
    kinematics = {
        time_derivative(x): v * cos(theta) - n * sin(theta),
        time_derivative(y): v * sin(theta) + n * cos(theta),
        time_derivative(theta): w,
    }
    forces = [m * n * w + m * g * cos(theta), -m * v * w - m * g * sin(theta), 0]
    edge = equations_of(
        [[m, 0, 0], [0, m, 0], [0, 0, J]],
        forces,
        [x, y, theta],
        constraints=[n],
        speeds=[v, n, w],
        kinematics=kinematics,
    )
    sideways = time_derivative(y) * cos(theta) - time_derivative(x) * sin(theta)
    blade = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J)
    return edge, newton_euler(System([blade], (), [x, y, theta], [sideways], Vector(ground, g, 0, 0)))


def test_same_values_as_the_system() -> None:
    mine, own = given(), derived()
    assert mine.residuals == own.residuals
    assert mine.mass_matrix == own.mass_matrix
    assert mine.bias == own.bias
    assert mine.constraint_jacobian == own.constraint_jacobian
    assert forward_dynamics(mine).accelerations == forward_dynamics(own).accelerations
    assert mine.baumgarte(3, 1) == own.baumgarte(3, 1)


@pytest.mark.parametrize(
    "method", ["dop853", "bdf", "ida", *repeated(["tsit5", "esdirk34", "tr_bdf2", "ida2", "ida3"])]
)
def test_same_motion_by_every_method(method: str) -> None:
    initial = consistent_state(given(), VALUES, {x: 0.4}, guess={y: -0.5})
    mine, own = (simulate(each, VALUES, initial, t=(0, 1), method=method) for each in (given(), derived()))
    assert_allclose(mine.states, own.states, atol=1e-9)
    assert mine.energy_drift < 1e-4


def test_many_motions_and_rest() -> None:
    mine = given()
    initial = consistent_state(mine, VALUES, {x: 0.4}, guess={y: -0.5})
    runs = simulate_many(mine, VALUES | {g: np.array([9.81, 1.62])}, initial, t=(0, 1))
    alone = simulate(mine, VALUES | {g: 1.62}, initial, t=(0, 1))
    assert_allclose(runs[x][1], alone[x], atol=1e-8)
    assert_allclose(equilibrium(mine, VALUES, guess={y: -1}).coordinates[y], -0.7)


def test_speeds_with_kinematics_against_coordinates() -> None:
    edge, own = sleigh()
    theta, v, n, w = functions_of_time("theta v n w")
    (J,) = (each for each in edge.parameters if each.name == "J")
    values = {m: 2, J: 0.3, g: 9.81}
    mine = simulate(
        edge, values, {x: 0, y: 0, theta: 0, v: 0.5, n: 0, w: 1.3}, t=(0, 3), rtol=1e-11, atol=1e-11
    )
    rates = {time_derivative(x): 0.5, time_derivative(y): 0, time_derivative(theta): 1.3}
    other = simulate(own, values, {x: 0, y: 0, theta: 0} | rates, t=(0, 3), rtol=1e-11, atol=1e-11)
    assert_allclose(mine[y], other[y], atol=1e-9)
    assert_allclose(mine.multipliers, other.multipliers, atol=1e-7)


def test_mass_matrix_that_is_not_symmetric_against_scipy() -> None:
    F = functions_of_time("F")
    mine = equations_of([[2, 1], [0, 3]], [-5 * x + F, -y], [x, y])
    assert forward_dynamics(mine).method == "pivoted"
    assert mine.inputs == (F,)
    motion = simulate(
        mine, {}, {x: 1, y: 0.5}, t=np.linspace(0, 5, 11), inputs={F: sin(t)}, rtol=1e-11, atol=1e-11
    )

    def rates(at: float, state: np.ndarray) -> list[float]:
        down = -state[1] / 3
        return [state[2], state[3], (-5 * state[0] + np.sin(at) - down) / 2, down]

    expected = solve_ivp(rates, (0, 5), [1, 0.5, 0, 0], t_eval=motion.t, rtol=1e-11, atol=1e-11)
    assert_allclose(motion.states, expected.y.T, atol=1e-8)


@pytest.mark.parametrize("language", ["c", "fortran", "python", "matlab", "julia", "rust", "modelica"])
def test_code(language: str, tmp_path: Path) -> None:
    files = generate(given(), language, path=tmp_path)
    assert files
    assert any(tmp_path.iterdir())


def test_shown_and_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    show(given())
    assert "m*y'' + g*m = 2*y*lambda1" in capsys.readouterr().out
    initial = consistent_state(given(), VALUES, {x: 0.4}, guess={y: -0.5})
    equations = given()
    motion = simulate(equations, VALUES, initial, t=(0, 1))
    text = report(equations, tmp_path / "model.md", motion=motion).read_text(encoding="utf-8")
    headings = [line[3:] for line in text.splitlines() if line.startswith("## ")]
    assert headings == [
        "Nomenclature", "Kinematics", "Energies", "Equations of motion", "Size", "Checks", "Motion"
    ]  # fmt: skip


def test_substituted() -> None:
    assert subs(given(), {g: 0}).bias == (0, 0)
    assert subs(given(), {l: 2}).constraints == (x**2 + y**2 - 4,)


def test_without_bodies_nothing_is_drawn() -> None:
    initial = consistent_state(given(), VALUES, {x: 0.4}, guess={y: -0.5})
    motion = simulate(given(), VALUES, initial, t=(0, 1))
    assert motion.plot() is not None
    with pytest.raises(ViewError, match="given without bodies"):
        motion.animate()


def test_energy_is_unknown_unless_it_is_given() -> None:
    motion = simulate(equations_of([[1]], [-x], [x]), {}, {x: 1}, t=(0, 1))
    with pytest.raises(ModelError, match="the energy isn't known"):
        _ = motion.energy_drift


def test_regular_matrices_with_zeros_on_the_diagonal_are_pivoted() -> None:
    """``M u' = f`` with M = [[0, m], [m, 0]]: no mass moves alone, and the accelerations are known."""
    a, b = symbols("a b")
    swapped = equations_of([[0, m], [m, 0]], [a, b], [x, y])
    solution = forward_dynamics(swapped)
    assert solution.method == "pivoted"
    found = lambdify([m, a, b], list(solution.accelerations))(2.0, 3.0, 5.0)
    assert_allclose(found, [2.5, 1.5], rtol=1e-14)


def test_embedding_of_given_equations() -> None:
    """As of a system with bodies: the same mass matrix and bias in one speed, and the same motion."""
    x, y, theta = functions_of_time("x y theta")
    m, J, k = symbols("m J k")
    xt, yt = time_derivative(x), time_derivative(y)
    blade = yt * cos(theta) - xt * sin(theta)
    body = Body(translate(x, y, 0) * rotate("Z", theta), m, Iz=J)
    pull = Force(ground, -k * x, 0, 0, at=body.center_of_mass, on=body)
    whole = newton_euler(System([body], [pull], [x, y, theta], [blade]))
    given = equations_of(
        [[m, 0, 0], [0, m, 0], [0, 0, J]],
        [-k * x, 0, 0],
        [x, y, theta],
        constraints=[blade],
        energy=(m * (xt**2 + yt**2) + J * time_derivative(theta) ** 2 + k * x**2) / 2,
    )
    speeds = [xt, time_derivative(theta)]
    one, other = embedded(whole, speeds), embedded(given, speeds)
    assert other.mass_matrix == one.mass_matrix
    assert other.bias == one.bias
    start = {xt: 1.0, time_derivative(theta): 0.3}
    motion = simulate(other, {m: 2, J: 0.1, k: 3}, start, t=(0, 2), rtol=1e-10, atol=1e-12)
    assert motion.energy_drift < 1e-9
    assert_allclose(
        motion[y],
        simulate(whole, {m: 2, J: 0.1, k: 3}, start, t=(0, 2), rtol=1e-10, atol=1e-12)[y],
        atol=1e-8,
    )
    stiffer = embedded(subs(given, {k: 2 * k}), speeds)
    assert subs(other, {k: 2 * k}).bias == stiffer.bias
    assert subs(other, {k: 2 * k}).system.eliminated == stiffer.system.eliminated


def test_states_beside_given_equations() -> None:
    """A force that lags behind the position: the motion of a system of first order by SciPy."""
    x, z = functions_of_time("x z")
    m, k, T = symbols("m k T")
    lagging = equations_of([[m]], [-k * z], [x], states={z: (x - z) / T})
    motion = simulate(lagging, {m: 1.0, k: 4.0, T: 0.1}, {x: 1.0, z: 1.0}, t=(0, 3), rtol=1e-10, atol=1e-12)
    found = solve_ivp(
        lambda _, s: [s[1], -4 * s[2], (s[0] - s[2]) / 0.1],
        (0, 3),
        [1.0, 0.0, 1.0],
        t_eval=motion.t,
        rtol=1e-11,
        atol=1e-12,
    ).y
    assert_allclose(motion[x], found[0], atol=1e-8)
    assert_allclose(motion[z], found[2], atol=1e-8)
    assert subs(lagging, {T: 0.2}).state_rates == {time_derivative(z): (x - z) / 0.2}
