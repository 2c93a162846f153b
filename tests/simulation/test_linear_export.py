"""State spaces for SciPy, python-control and MATLAB; and code of linear models, compiled and run."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lsim

from symbody import (
    Body,
    Force,
    StateSpace,
    System,
    functions_of_time,
    generate,
    ground,
    linearize,
    newton_euler,
    state_space,
    symbols,
    time_derivative,
    translate,
)

m, c, k = symbols("m c k")
x, F = functions_of_time("x F")
PARAMETERS = {m: 2.0, c: 0.4, k: 8.0}


def oscillator(**options: Any) -> StateSpace:
    cart = Body(translate(x, 0, 0), m)
    load = Force(ground, F - k * x - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    system = System([cart], [load], coordinates=[x], name="Oscillator")
    return state_space(linearize(newton_euler(system), inputs=[F], **options), PARAMETERS)


def test_scipy() -> None:
    """The step response of a damped oscillator: ``1/k (1 - exp(-d t) (cos w t + d/w sin w t))``."""
    t = np.linspace(0, 5, 200)
    _, y, _ = lsim(oscillator(outputs=[x]).to_scipy(), np.ones_like(t), t)
    d = 0.1
    w = np.sqrt(4 - d**2)
    assert_allclose(y, (1 - np.exp(-d * t) * (np.cos(w * t) + d / w * np.sin(w * t))) / 8, atol=1e-12)


def test_states_are_outputs_if_there_are_none() -> None:
    system = oscillator().to_scipy()
    assert_allclose(system.C, np.eye(2))
    assert_allclose(system.D, np.zeros((2, 1)))


def test_control() -> None:
    space = oscillator(outputs={"force": k * x})
    made = space.to_control()
    for found, expected in zip(
        (made.A, made.B, made.C, made.D), (space.A, space.B, space.C, space.D), strict=True
    ):
        assert_allclose(found, expected)
    assert (made.state_labels, made.input_labels, made.output_labels) == (["x", "x'"], ["F"], ["force"])
    assert made.name == "Oscillator"
    assert_allclose(made(2j), space.C @ np.linalg.solve(2j * np.eye(2) - space.A, space.B), rtol=1e-12)


def test_matlab() -> None:
    text = oscillator(outputs={"force": k * x}).to_matlab()
    assert text == (
        "% Oscillator: x' = A x + B r, y = C x + D r\n"
        "A = [0.0 1.0; -4.0 -0.2];\n"
        "B = [0.0; 0.5];\n"
        "C = [8.0 0.0];\n"
        "D = [0.0];\n"
        "sys = ss(A, B, C, D, 'StateName', {'x', 'x'''}, 'InputName', {'F'}, 'OutputName', {'force'});\n"
    )


def test_display() -> None:
    space = oscillator(outputs=[x])
    assert repr(space) == "StateSpace(states x, x'; inputs F; outputs x)"
    assert re.search(r"-4</td><td[^>]*>-0\.2</td><td[^>]*>0\.5", space._repr_html_())


@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs a C compiler")
def test_generated_code_checks_itself(tmp_path: Path) -> None:
    cart = Body(translate(x, 0, 0), m)
    load = Force(ground, F - k * x**3 - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    linear = linearize(
        newton_euler(System([cart], [load], coordinates=[x])), {x: symbols("x0"), F: k * symbols("x0") ** 3}
    )
    generate(linear, "c", tmp_path, name="duffing")
    finished = subprocess.run(
        ["make", "-C", str(tmp_path), "check"], capture_output=True, text=True, check=False
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr


@pytest.mark.parametrize(
    "target", ["fortran", "matlab", "python", "julia", "jax", "casadi", "modelica", "rust"]
)
def test_every_target(tmp_path: Path, target: str) -> None:
    cart = Body(translate(x, 0, 0), m)
    load = Force(ground, F - k * x, 0, 0, at=cart.center_of_mass, on=cart)
    linear = linearize(newton_euler(System([cart], [load], coordinates=[x])))
    files = generate(linear, target, tmp_path)
    assert any("state_space" in file.read_text(encoding="utf-8") for file in files)


def test_generated_python(tmp_path: Path) -> None:
    cart = Body(translate(x, 0, 0), m)
    load = Force(ground, F - k * x - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    linear = linearize(newton_euler(System([cart], [load], coordinates=[x])), outputs=[time_derivative(x, 2)])
    generate(linear, "python", tmp_path, name="plant")
    scope: dict[str, Any] = {}
    exec((tmp_path / "plant.py").read_text(encoding="utf-8"), scope)
    A, B, C, D = scope["state_space"](scope["prepare"]([PARAMETERS[name] for name in linear.parameters]))
    space = state_space(linear, PARAMETERS)
    for found, expected in zip((A, B, C, D), (space.A, space.B, space.C, space.D), strict=True):
        assert_allclose(np.reshape(found, expected.shape), expected, rtol=1e-15)
